// Where the values of a JSON text stand: an index that is made when the first place is asked for. Knows JSON's grammar, not what the text means.
#pragma once
#include <cstddef>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace stokes {

/// Both count from 1; the column in bytes.
struct SourcePosition {
  int line = 0, column = 0;
};

/// The place of the byte at `offset`, or of the end.
SourcePosition position_at(const std::string& text, std::size_t offset);

/// The key that a JSON pointer's reference token stands for.
std::string unescape_token(std::string token);

/// Places by JSON pointer. Several threads may ask.
class JsonPlaces {
 public:
  /// `text`: valid JSON, comments allowed.
  explicit JsonPlaces(std::string text) : text_(std::move(text)) {}

  /// The place of the value at `pointer`, or of its nearest ancestor that the text has.
  SourcePosition value(const std::string& pointer) const;
  /// The place of the key whose value is at `pointer`; nothing when the text has no such value, or it has no key.
  std::optional<SourcePosition> key(const std::string& pointer) const;
  /// The place of the `i`-th key of the object at `pointer`, which must have so many. Good for keys that occur twice.
  SourcePosition key_of_entry(const std::string& pointer, std::size_t i) const;

 private:
  // A container's entries stand side by side in values_, so that those of arrays are found at once.
  struct Value {
    std::size_t offset = 0, key = kNone;  // into the text; kNone: it has no key
    std::size_t first = 0, count = 0;     // entries
  };
  struct Found {
    const Value* value;
    bool exact;  // else an ancestor
  };
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  friend class JsonIndexer;

  void make_index() const;
  Found find(const std::string& pointer) const;
  const Value* entry(const Value& container, const std::string& token) const;
  bool key_is(const Value& value, const std::string& name) const;
  SourcePosition position(std::size_t offset) const;

  const std::string text_;
  mutable std::once_flag made_;
  mutable std::vector<Value> values_;       // the last one is the root
  mutable std::vector<std::size_t> lines_;  // offsets of their starts
};

}  // namespace stokes
