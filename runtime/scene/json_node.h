// A place in the scene's JSON: typed and range-checked reads whose failures are SceneErrors with the place. Knows nothing of
// what a scene is made of.
#pragma once
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "math/vec.h"
#include "scene/json_source.h"

namespace stokes {

/// An interval that a number must lie in. Ends are inside unless open.
struct Range {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  bool low_open = false, high_open = false;
  bool contains(double x) const { return (low_open ? x > low : x >= low) && (high_open ? x < high : x <= high); }
  std::string text() const;
};
inline constexpr Range kAnyNumber{};
inline constexpr Range kUnitInterval{0, 1};
inline constexpr Range kNotNegative{0};
inline constexpr Range kPositive{0, std::numeric_limits<double>::infinity(), true};

/// A number as a message shows it: as short as is exact, or to `digits` (6 or more).
std::string show(double x, int digits = 17);
/// The candidate nearest to `word` in edit distance, as `; did you mean "x"?`, or nothing when none is near.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates);
/// A name of a type with underscores and hyphens as spaces.
std::string canonical_type(std::string name);

/// One JSON value with its pointer. Cheap to copy; the source must outlive it.
class JsonNode {
 public:
  explicit JsonNode(const JsonSource& source) : source_(&source), json_(&source.root) {}

  const Json& json() const { return *json_; }
  const std::string& pointer() const { return pointer_; }
  const SourceMap& source() const { return source_->map; }

  [[noreturn]] void fail(const std::string& message) const;
  /// Fails with "expected WHAT, not a string" and the like.
  [[noreturn]] void fail_type(const std::string& what) const;
  /// Fails at the key rather than the value.
  [[noreturn]] void fail_at_key(const std::string& message) const;

  bool is_number() const { return json_->is_number(); }
  bool is_string() const { return json_->is_string(); }
  bool is_array() const { return json_->is_array(); }
  bool is_object() const { return json_->is_object(); }

  double number(const Range& range = kAnyNumber) const;
  /// A whole number; 512.0 counts as one, 1.5 does not.
  long long integer(long long low, long long high) const;
  bool boolean() const;
  std::string string() const;
  /// Three numbers.
  Vec3d vector() const;
  /// Exactly `count` numbers (any number of them when 0).
  std::vector<double> numbers(std::size_t count = 0) const;

  std::size_t size() const { return json_->size(); }
  /// Entry of an array.
  JsonNode operator[](std::size_t i) const;
  /// Entry of an object, by the exact key.
  JsonNode child(const std::string& key) const;

 private:
  JsonNode(const JsonSource* source, const Json* json, std::string pointer) : source_(source), json_(json), pointer_(std::move(pointer)) {}
  const JsonSource* source_;
  const Json* json_;
  std::string pointer_;
};

/// An object whose keys are known. Reading it checks every key at once, so that a misspelt one is reported as such and not as a
/// missing one. Spaces and underscores in keys are the same.
class JsonObject {
 public:
  /// `what` names the object in messages ("a sphere"). Throws for a key that is not among `known`.
  JsonObject(const JsonNode& node, const std::string& what, std::vector<std::string> known);

  const JsonNode& node() const { return node_; }
  bool has(const std::string& key) const { return find(key).has_value(); }
  std::optional<JsonNode> find(const std::string& key) const;
  /// The value of `key`, which must be there.
  JsonNode require(const std::string& key) const;

  double number(const std::string& key, double fallback, const Range& range = kAnyNumber) const;
  std::string string(const std::string& key, const std::string& fallback) const;
  bool boolean(const std::string& key, bool fallback) const;

 private:
  JsonNode node_;
  std::string what_;
  std::vector<std::string> known_;
};

/// The value of "type" in canonical form, or `fallback` when there is none. Fails when `node` is no object.
std::string type_of(const JsonNode& node, const std::string& what, const std::string& fallback = "");

}  // namespace stokes
