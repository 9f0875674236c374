// JSON text to values and places. The library's parser checks the grammar and gives the values; a second pass over text that is
// known to be valid finds the places and the duplicate keys.
#include "scene/json_source.h"

#include <algorithm>
#include <map>

#include "scene/memory_error.h"

namespace stokes {
namespace {

constexpr bool kComments = true;  // both the C++ and the C kind, as in editors' JSON with comments

SourcePosition position_at(const std::string& text, std::size_t offset) {
  SourcePosition p{1, 1};
  for (std::size_t i = 0; i < std::min(offset, text.size()); i++) {
    if (text[i] == '\n') {
      p.line++;
      p.column = 1;
    } else {
      p.column++;
    }
  }
  return p;
}

// Accepts everything within the limits and remembers the first error with its place. Nothing is kept, so that text may be refused before
// memory is spent on it.
struct GrammarCheck : nlohmann::json_sax<Json> {
  explicit GrammarCheck(const InputLimits& l) : limits(l) {}
  const InputLimits& limits;
  struct Level {
    bool array = false;
    std::uint64_t entries = 0;  // begun so far
    std::size_t name = 0;       // bytes of the JSON pointer up to here
    std::string key = {};       // the last one
  };
  std::size_t offset = 0;
  std::string token, message;
  std::vector<Level> levels;
  std::uint64_t values = 0, pointer_bytes = 0;
  std::string beyond;  // which limit was passed
  bool null() override { return value(); }
  bool boolean(bool) override { return value(); }
  bool number_integer(number_integer_t) override { return value(); }
  bool number_unsigned(number_unsigned_t) override { return value(); }
  bool number_float(number_float_t, const string_t&) override { return value(); }
  bool string(string_t&) override { return value(); }
  bool binary(binary_t&) override { return value(); }
  bool key(string_t& text) override {
    levels.back().key = text;
    if (++levels.back().entries > limits.keys) beyond = "more than " + std::to_string(limits.keys) + " keys in one object (--limit keys)";
    return beyond.empty();
  }
  bool start_object(std::size_t) override { return enter(false); }
  bool start_array(std::size_t) override { return enter(true); }
  bool end_object() override { return leave(); }
  bool end_array() override { return leave(); }
  bool leave() {
    levels.pop_back();
    return true;
  }
  bool value() {
    pointer_bytes += 2 * name();
    if (!levels.empty() && levels.back().array) levels.back().entries++;
    if (++values > limits.values) beyond = "more than " + std::to_string(limits.values) + " values (--limit values)";
    return beyond.empty();
  }
  // Bytes of the pointer of the value that comes next; an index counts as 8.
  std::size_t name() const { return levels.empty() ? 0 : levels.back().name + 1 + (levels.back().array ? 8 : levels.back().key.size()); }
  // Of the innermost value that has begun.
  std::string pointer() const {
    std::string text;
    for (const Level& level : levels)
      if (level.entries > 0) text += "/" + (level.array ? std::to_string(level.entries - 1) : escape_token(level.key));
    return text;
  }
  bool enter(bool array) {
    const std::size_t bytes = name();
    if (!value()) return false;
    levels.push_back({array, 0, bytes});
    if (levels.size() > limits.depth) beyond = "nested deeper than " + std::to_string(limits.depth) + " levels (--limit depth)";
    return beyond.empty();
  }
  bool parse_error(std::size_t position, const std::string& last_token, const nlohmann::detail::exception& e) override {
    offset = position;
    token = last_token;
    message = e.what();
    return false;
  }
};

// The library's own text, without its prefix and its count of lines.
std::string plain_message(const std::string& message, const std::string& token) {
  if (message.find("number overflow") != std::string::npos) return token + " is too large for a number";
  std::string text = message;
  if (const auto colon = text.find(": "); colon != std::string::npos && text.starts_with("[json")) {
    const auto second = text.find(": ", colon + 2);
    text = text.substr(second != std::string::npos ? second + 2 : colon + 2);
  }
  return "not JSON: " + text;
}

void check_grammar(const std::string& text, const std::string& file_name, const InputLimits& limits) {
  GrammarCheck check(limits);
  SourceMap map{file_name, {}};
  const bool valid = Json::sax_parse(text, &check, nlohmann::detail::input_format_t::json, true, kComments);
  if (!check.beyond.empty()) throw SceneError(map, check.pointer(), check.beyond);
  if (valid) {
    // Values with their places; the file's text is there already.
    constexpr std::uint64_t kBytesPerValue = 300;
    try {
      require_memory(limits, check.values * kBytesPerValue + check.pointer_bytes, "the scene's JSON");
    } catch (const OutOfMemory& error) {
      throw SceneMemoryError(map, "", error.what());
    }
    return;
  }
  const std::size_t at = check.offset > 0 ? check.offset - 1 : 0;
  map.places[""] = position_at(text, at);
  // NaN and Infinity are what other tools write for numbers that are none.
  for (const char* literal : {"-Infinity", "Infinity", "-inf", "inf", "-NaN", "NaN", "-nan", "nan"}) {
    const std::size_t length = std::string(literal).size();
    for (std::size_t back = 0; back < length && back <= at; back++)
      if (text.compare(at - back, length, literal) == 0) {
        map.places[""] = position_at(text, at - back);
        throw SceneError(map, check.pointer(), std::string(literal) + " is not a number in JSON; values must be finite");
      }
  }
  throw SceneError(map, check.pointer(), plain_message(check.message, check.token));
}

// Walks text that is known to be valid JSON.
class PlaceFinder {
 public:
  PlaceFinder(const std::string& text, JsonSource& source) : text_(text), source_(source) {
    if (text.starts_with("\xEF\xBB\xBF")) offset_ = 3;
  }
  void run() { value(""); }

 private:
  char peek() const { return offset_ < text_.size() ? text_[offset_] : '\0'; }
  void advance() {
    if (peek() == '\n') {
      line_++;
      line_start_ = offset_ + 1;
    }
    offset_++;
  }
  void skip_space() {
    while (offset_ < text_.size()) {
      if (peek() == '/')
        comment();
      else if (peek() == ' ' || peek() == '\t' || peek() == '\n' || peek() == '\r')
        advance();
      else
        return;
    }
  }
  // Ends where the library's does: a line's at either kind of line end, the other at its closing.
  void comment() {
    const bool block = text_[offset_ + 1] == '*';
    advance(), advance();
    if (!block) {
      while (offset_ < text_.size() && peek() != '\n' && peek() != '\r') advance();
      return;
    }
    while (text_.compare(offset_, 2, "*/") != 0) advance();
    advance(), advance();
  }
  SourcePosition here() const { return {line_, static_cast<int>(offset_ - line_start_) + 1}; }

  std::string quoted() {
    const std::size_t start = offset_;
    advance();
    while (peek() != '"') {
      if (peek() == '\\') advance();
      advance();
    }
    advance();
    return Json::parse(text_.substr(start, offset_ - start)).get<std::string>();
  }

  void value(const std::string& pointer) {
    skip_space();
    source_.map.places[pointer] = here();
    switch (peek()) {
      case '{':
        return object(pointer);
      case '[':
        return array(pointer);
      case '"':
        quoted();
        return;
      default:
        while (offset_ < text_.size() && std::string(",]}/ \t\r\n").find(peek()) == std::string::npos) advance();
    }
  }

  void object(const std::string& pointer) {
    std::map<std::string, std::string> seen;
    advance();
    skip_space();
    while (peek() != '}') {
      const SourcePosition place = here();
      const std::string key = quoted();
      const std::string child = pointer + "/" + escape_token(key);
      const auto [it, fresh] = seen.emplace(canonical_key(key), key);
      if (!fresh) {
        SourceMap map{source_.map.file, {{"", place}}};
        map.places[child] = place;
        throw SceneError(map, child, it->second == key ? "this key occurs twice" : "this key is \"" + it->second + "\" again");
      }
      source_.key_places[child] = place;
      skip_space();
      advance();  // the colon
      value(child);
      skip_space();
      if (peek() == ',') advance();
      skip_space();
    }
    advance();
  }

  void array(const std::string& pointer) {
    advance();
    skip_space();
    for (int i = 0; peek() != ']'; i++) {
      value(pointer + "/" + std::to_string(i));
      skip_space();
      if (peek() == ',') advance();
      skip_space();
    }
    advance();
  }

  const std::string& text_;
  JsonSource& source_;
  std::size_t offset_ = 0, line_start_ = 0;
  int line_ = 1;
};

std::string unescape_token(std::string token) {
  for (std::size_t i = 0; (i = token.find("~1", i)) != std::string::npos; i++) token.replace(i, 2, "/");
  for (std::size_t i = 0; (i = token.find("~0", i)) != std::string::npos; i++) token.replace(i, 2, "~");
  return token;
}

// The spelling that `object` already uses for `key`, else `key` itself.
std::string spelling_in(const Json& object, const std::string& key) {
  if (object.contains(key)) return key;
  for (const auto& item : object.items())
    if (canonical_key(item.key()) == canonical_key(key)) return item.key();
  return key;
}

}  // namespace

std::string escape_token(const std::string& key) {
  std::string token;
  for (const char c : key) {
    if (c == '~')
      token += "~0";
    else if (c == '/')
      token += "~1";
    else
      token += c;
  }
  return token;
}

std::string canonical_key(std::string key) {
  std::replace(key.begin(), key.end(), '_', ' ');
  return key;
}

JsonSource parse_json(const std::string& text, const std::string& file_name, const InputLimits& limits) {
  JsonSource source;
  source.map.file = file_name;
  check_grammar(text, file_name, limits);
  source.root = Json::parse(text, nullptr, true, kComments);
  PlaceFinder(text, source).run();
  return source;
}

void apply_override(JsonSource& source, const std::string& pointer, const std::string& value) {
  const auto fail = [&](const std::string& message) { throw SceneError(source.map, "", "--set " + pointer + ": " + message); };
  if (pointer.empty() || pointer[0] != '/') fail("a JSON pointer begins with /");
  Json* node = &source.root;
  std::string path;
  for (std::size_t begin = 1; begin <= pointer.size();) {
    const std::size_t end = std::min(pointer.find('/', begin), pointer.size());
    std::string token = unescape_token(pointer.substr(begin, end - begin));
    begin = end + 1;
    if (node->is_array()) {
      const bool digits = !token.empty() && token.size() < 9 && token.find_first_not_of("0123456789") == std::string::npos;
      const std::size_t size = node->size();
      if (token == "-")
        token = std::to_string(size);
      else if (!digits || std::stoul(token) >= size)
        fail(path + " has " + std::to_string(size) + " entries, and " + token + " is none of them");
      if (std::stoul(token) == size) node->push_back(nullptr);
      node = &(*node)[std::stoul(token)];
    } else if (node->is_object() || node->is_null()) {
      if (node->is_null()) *node = Json::object();
      token = spelling_in(*node, token);
      node = &(*node)[token];
    } else {
      fail(path + " is neither an object nor an array");
    }
    path += "/" + escape_token(token);
  }
  *node = Json::parse(value, nullptr, false);
  if (node->is_discarded()) *node = value;
  // What stood below is gone; what stands there now has the place of its ancestor.
  std::erase_if(source.map.places, [&](const auto& place) { return place.first.starts_with(path + "/"); });
  std::erase_if(source.key_places, [&](const auto& place) { return place.first.starts_with(path + "/"); });
}

}  // namespace stokes
