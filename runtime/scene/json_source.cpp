// JSON text to values. The library's parser goes over it twice: for the grammar, the limits and duplicate keys, then for the values.
#include "scene/json_source.h"

#include <algorithm>
#include <optional>
#include <set>

#include "scene/memory_error.h"

namespace stokes {
namespace {

constexpr bool kComments = true;  // both the C++ and the C kind, as in editors' JSON with comments

// Of the spaced and the underscored spelling neither comes first: they are one key.
struct SpellingLess {
  bool operator()(const std::string& a, const std::string& b) const {
    const auto plain = [](char c) { return c == '_' ? ' ' : c; };
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) { return plain(x) < plain(y); });
  }
};

// Accepts everything within the limits and remembers the first error with its place. Nothing is kept, so that text may be refused before
// memory is spent on it.
struct GrammarCheck : nlohmann::json_sax<Json> {
  explicit GrammarCheck(const InputLimits& l) : limits(l) {}
  const InputLimits& limits;
  struct Level {
    bool array = false;
    std::uint64_t entries = 0;  // begun so far
    std::string key = {};       // the last one
    std::set<std::string, SpellingLess> keys = {};
  };
  struct Duplicate {
    std::string object, key, first;  // pointer of the object; the key and how it was spelt before
    std::size_t entry;               // which key of the object it is
  };
  std::size_t offset = 0;
  std::string token, message;
  std::vector<Level> levels;
  std::uint64_t values = 0;
  std::string beyond;  // which limit was passed
  std::optional<Duplicate> duplicate;  // the first in the text
  bool null() override { return value(); }
  bool boolean(bool) override { return value(); }
  bool number_integer(number_integer_t) override { return value(); }
  bool number_unsigned(number_unsigned_t) override { return value(); }
  bool number_float(number_float_t, const string_t&) override { return value(); }
  bool string(string_t&) override { return value(); }
  bool binary(binary_t&) override { return value(); }
  bool key(string_t& text) override {
    Level& level = levels.back();
    if (!duplicate)
      if (const auto [known, fresh] = level.keys.insert(text); !fresh) duplicate = {container(), text, *known, level.entries};
    level.key = text;
    if (++level.entries > limits.keys) beyond = "more than " + std::to_string(limits.keys) + " keys in one object (--limit keys)";
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
    if (!levels.empty() && levels.back().array) levels.back().entries++;
    if (++values > limits.values) beyond = "more than " + std::to_string(limits.values) + " values (--limit values)";
    return beyond.empty();
  }
  // Of the innermost value that has begun.
  std::string pointer() const { return pointer(levels.size()); }
  // Of the innermost object or array.
  std::string container() const { return pointer(levels.size() - 1); }
  std::string pointer(std::size_t count) const {
    std::string text;
    for (std::size_t i = 0; i < count; i++)
      if (levels[i].entries > 0) text += "/" + (levels[i].array ? std::to_string(levels[i].entries - 1) : escape_token(levels[i].key));
    return text;
  }
  bool enter(bool array) {
    if (!value()) return false;
    levels.push_back({array});
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

// Values, and the index of their places that an error may need; the file's text is there already.
void require_memory_for(std::uint64_t values, const std::string& file_name, const InputLimits& limits) {
  constexpr std::uint64_t kBytesPerValue = 300;
  try {
    require_memory(limits, values * kBytesPerValue, "the scene's JSON");
  } catch (const OutOfMemory& error) {
    throw SceneMemoryError(SourceMap{file_name}, "", error.what());
  }
}

[[noreturn]] void fail_grammar(const std::string& text, const std::string& file_name, const GrammarCheck& check) {
  // Where a comment lacks its end the library counts the end of the text too, and more than once.
  const std::size_t at = std::min(check.offset > 0 ? check.offset - 1 : 0, text.size());
  // NaN and Infinity are what other tools write for numbers that are none.
  for (const char* literal : {"-Infinity", "Infinity", "-inf", "inf", "-NaN", "NaN", "-nan", "nan"}) {
    const std::size_t length = std::string(literal).size();
    for (std::size_t back = 0; back < length && back <= at; back++)
      if (text.compare(at - back, length, literal) == 0)
        throw SceneError(file_name, position_at(text, at - back), check.pointer(), std::string(literal) + " is not a number in JSON; values must be finite");
  }
  throw SceneError(file_name, position_at(text, at), check.pointer(), plain_message(check.message, check.token));
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
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) throw SceneError(file_name, {1, 1}, "", "not JSON: the file is in UTF-16; save it as UTF-8");
  GrammarCheck check(limits);
  const bool valid = Json::sax_parse(text, &check, nlohmann::detail::input_format_t::json, true, kComments);
  if (!check.beyond.empty()) throw SceneError(file_name, {1, 1}, check.pointer(), check.beyond);
  if (!valid) fail_grammar(text, file_name, check);
  // The library takes a character 0 for the end, and what follows it for nothing.
  if (const std::size_t zero = text.find('\0'); zero != std::string::npos) throw SceneError(file_name, position_at(text, zero), "", "not JSON: there is a character 0");
  require_memory_for(check.values, file_name, limits);
  JsonSource source{{}, {file_name, std::make_shared<JsonPlaces>(text)}};
  if (const auto& twice = check.duplicate)
    throw SceneError(file_name, source.map.places->key_of_entry(twice->object, twice->entry), twice->object + "/" + escape_token(twice->key),
                     twice->first == twice->key ? "this key occurs twice" : "this key is \"" + twice->first + "\" again");
  source.root = Json::parse(text, nullptr, true, kComments);
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
  source.map.replaced.push_back(path);
}

}  // namespace stokes
