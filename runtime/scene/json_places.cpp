// One walk over a text that is known to be valid, and the look-ups in what it leaves.
#include "scene/json_places.h"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

namespace stokes {

// Walks the text without recursion: how deep it nests is a limit that users may lift.
class JsonIndexer {
 public:
  explicit JsonIndexer(const std::string& text, std::vector<JsonPlaces::Value>& values) : text_(text), values_(values) {
    if (text.starts_with("\xEF\xBB\xBF")) at_ = 3;
  }

  void run() {
    while (!open_.empty() || ended_.empty()) {  // until the root has ended
      skip_space();
      if (at_ >= text_.size()) break;
      const char c = text_[at_];
      if (c == '{' || c == '[') {
        open_.push_back({begun(), c == '{', ended_.size()});
        at_++;
      } else if (c == '}' || c == ']') {
        close();
      } else if (c == ',' || c == ':') {
        at_++;
      } else if (c == '"' && !open_.empty() && open_.back().object && key_ == JsonPlaces::kNone) {
        key_ = at_;
        skip_string();
      } else {
        ended_.push_back(begun());
        c == '"' ? skip_string() : skip_word();
      }
    }
    values_.insert(values_.end(), ended_.begin(), ended_.end());
  }

 private:
  struct Container {
    JsonPlaces::Value value;
    bool object;
    std::size_t entries;  // where they begin in ended_
  };

  // The value that begins here, with the key before it.
  JsonPlaces::Value begun() { return {at_, std::exchange(key_, JsonPlaces::kNone), 0, 0}; }

  void close() {
    Container container = open_.back();
    open_.pop_back();
    const auto entries = ended_.begin() + static_cast<std::ptrdiff_t>(container.entries);
    container.value.first = values_.size();
    container.value.count = ended_.size() - container.entries;
    values_.insert(values_.end(), entries, ended_.end());
    ended_.erase(entries, ended_.end());
    ended_.push_back(container.value);
    at_++;
  }

  void skip_string() {
    for (at_++; at_ < text_.size() && text_[at_] != '"'; at_++)
      if (text_[at_] == '\\') at_++;
    at_++;
  }
  void skip_word() { at_ = std::min(text_.find_first_of(",]}/ \t\r\n", at_), text_.size()); }
  void skip_space() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '/')
        skip_comment();
      else if (c == ' ' || c == '\t' || c == '\n' || c == '\r')
        at_++;
      else
        return;
    }
  }
  // Ends where the library's does: a line's at either kind of line end, the other at its closing.
  void skip_comment() {
    const bool block = text_.compare(at_, 2, "/*") == 0;
    const std::size_t end = block ? text_.find("*/", at_ + 2) : text_.find_first_of("\r\n", at_);
    at_ = end == std::string::npos ? text_.size() : block ? end + 2 : end;
  }

  const std::string& text_;
  std::vector<JsonPlaces::Value>& values_;
  std::vector<Container> open_;
  std::vector<JsonPlaces::Value> ended_;  // whose containers have not ended
  std::size_t at_ = 0, key_ = JsonPlaces::kNone;
};

std::string unescape_token(std::string token) {
  for (std::size_t i = 0; (i = token.find("~1", i)) != std::string::npos; i++) token.replace(i, 2, "/");
  for (std::size_t i = 0; (i = token.find("~0", i)) != std::string::npos; i++) token.replace(i, 2, "~");
  return token;
}

SourcePosition position_at(const std::string& text, std::size_t offset) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(offset, text.size()));
  const auto line = std::find(std::make_reverse_iterator(end), text.rend(), '\n').base();
  return {static_cast<int>(std::count(text.begin(), end, '\n')) + 1, static_cast<int>(end - line) + 1};
}

void JsonPlaces::make_index() const {
  std::call_once(made_, [this] {
    JsonIndexer(text_, values_).run();
    lines_.push_back(0);
    for (std::size_t at = 0; (at = text_.find('\n', at)) != std::string::npos;) lines_.push_back(++at);
  });
}

SourcePosition JsonPlaces::position(std::size_t offset) const {
  const auto line = std::upper_bound(lines_.begin(), lines_.end(), offset) - 1;
  return {static_cast<int>(line - lines_.begin()) + 1, static_cast<int>(offset - *line) + 1};
}

bool JsonPlaces::key_is(const Value& value, const std::string& name) const {
  const std::size_t begin = value.key + 1;
  if (text_.compare(begin, name.size(), name) == 0 && text_[begin + name.size()] == '"' && name.find('\\') == std::string::npos) return true;
  std::size_t end = begin;
  bool escaped = false;
  for (; text_[end] != '"'; end++)
    if (text_[end] == '\\') escaped = true, end++;
  return escaped && nlohmann::json::parse(text_.substr(value.key, end + 1 - value.key)).get<std::string>() == name;
}

const JsonPlaces::Value* JsonPlaces::entry(const Value& container, const std::string& token) const {
  if (container.count == 0) return nullptr;
  const Value* first = &values_[container.first];
  if (first->key == kNone) {
    std::size_t i = 0;
    const auto [stop, error] = std::from_chars(token.data(), token.data() + token.size(), i);
    return error == std::errc() && stop == token.data() + token.size() && i < container.count ? first + i : nullptr;
  }
  const std::string name = unescape_token(token);
  const Value* found = std::find_if(first, first + container.count, [&](const Value& v) { return key_is(v, name); });
  return found == first + container.count ? nullptr : found;
}

JsonPlaces::Found JsonPlaces::find(const std::string& pointer) const {
  make_index();
  const Value* value = &values_.back();
  for (std::size_t begin = 1; begin <= pointer.size();) {
    const std::size_t end = std::min(pointer.find('/', begin), pointer.size());
    const Value* next = entry(*value, pointer.substr(begin, end - begin));
    if (!next) return {value, false};
    value = next;
    begin = end + 1;
  }
  return {value, true};
}

SourcePosition JsonPlaces::value(const std::string& pointer) const { return position(find(pointer).value->offset); }

std::optional<SourcePosition> JsonPlaces::key(const std::string& pointer) const {
  const Found found = find(pointer);
  if (!found.exact || found.value->key == kNone) return std::nullopt;
  return position(found.value->key);
}

SourcePosition JsonPlaces::key_of_entry(const std::string& pointer, std::size_t i) const {
  return position(values_[find(pointer).value->first + i].key);
}

}  // namespace stokes
