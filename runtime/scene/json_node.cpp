// Typed reads of JSON values, and the suggestions for misspelt words.
#include "scene/json_node.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace stokes {
namespace {

constexpr std::size_t kLongestWord = 64;  // that suggestions are sought for: the distance takes the product of two lengths

// Optimal string alignment: insertions, deletions, substitutions and swaps of neighbours.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); i++) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); j++) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); i++)
    for (std::size_t j = 1; j <= b.size(); j++) {
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

std::string fold(std::string word) {
  for (char& c : word) c = c == '_' || c == '-' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return word;
}

}  // namespace

std::string show(double x, int digits) {
  char text[32];
  for (int d = 6; d <= digits; d++) {
    std::snprintf(text, sizeof text, "%.*g", d, x);
    if (std::strtod(text, nullptr) == x) break;
  }
  return text;
}

std::string Range::text() const {
  if (low == 0 && !std::isfinite(high)) return low_open ? "must be greater than 0" : "must not be negative";
  return std::string("is outside ") + (low_open ? "(" : "[") + (std::isfinite(low) ? show(low) : "-inf") + ", " +
         (std::isfinite(high) ? show(high) : "inf") + (high_open ? ")" : "]");
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates) {
  if (word.size() > kLongestWord) return "";
  std::size_t best = std::max<std::size_t>(2, word.size() / 3) + 1;
  std::string nearest;
  for (const std::string& candidate : candidates) {
    if (candidate.size() > kLongestWord) continue;
    const std::size_t distance = edit_distance(fold(word), fold(candidate));
    if (distance < best && distance < std::max(word.size(), candidate.size())) {
      best = distance;
      nearest = candidate;
    }
  }
  return nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?";
}

std::string canonical_type(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  std::replace(name.begin(), name.end(), '-', ' ');
  return name;
}

void JsonNode::fail(const std::string& message) const { throw SceneError(source_->map, pointer_, message); }

void JsonNode::fail_type(const std::string& what) const {
  const char* article = json_->is_array() || json_->is_object() ? "an " : json_->is_null() ? "" : "a ";
  fail("expected " + what + ", not " + article + json_->type_name());
}

void JsonNode::fail_at_key(const std::string& message) const {
  const auto place = source_->map.find_key(pointer_);
  if (!place) fail(message);
  throw SceneError(source_->map.file, *place, pointer_, message);
}

double JsonNode::number(const Range& range) const {
  if (!json_->is_number()) fail_type("a number");
  const double x = json_->get<double>();
  if (!std::isfinite(x)) fail("the number is not finite");
  if (!range.contains(x)) fail(json_->dump() + " " + range.text());
  return x;
}

long long JsonNode::integer(long long low, long long high) const {
  if (!json_->is_number()) fail_type("a whole number");
  const double x = json_->get<double>();
  if (x != std::floor(x)) fail(json_->dump() + " is not a whole number");
  if (!(x >= static_cast<double>(low) && x <= static_cast<double>(high)))
    fail(json_->dump() + " is outside [" + std::to_string(low) + ", " + std::to_string(high) + "]");
  return static_cast<long long>(x);
}

bool JsonNode::boolean() const {
  if (!json_->is_boolean()) fail_type("true or false");
  return json_->get<bool>();
}

std::string JsonNode::string() const {
  if (!json_->is_string()) fail_type("a string");
  return json_->get<std::string>();
}

Vec3d JsonNode::vector() const {
  const std::vector<double> v = numbers(3);
  return {v[0], v[1], v[2]};
}

std::vector<double> JsonNode::numbers(std::size_t count) const {
  const std::string what = count ? "an array of " + std::to_string(count) + " numbers" : "an array of numbers";
  if (!json_->is_array()) fail_type(what);
  if (count && json_->size() != count) fail("expected " + what + ", not of " + std::to_string(json_->size()));
  std::vector<double> values;
  for (std::size_t i = 0; i < json_->size(); i++) values.push_back((*this)[i].number());
  return values;
}

JsonNode JsonNode::operator[](std::size_t i) const { return {source_, &(*json_)[i], pointer_ + "/" + std::to_string(i)}; }

JsonNode JsonNode::child(const std::string& key) const { return {source_, &json_->at(key), pointer_ + "/" + escape_token(key)}; }

JsonObject::JsonObject(const JsonNode& node, const std::string& what, std::vector<std::string> known)
    : node_(node), what_(what), known_(std::move(known)) {
  if (!node.is_object()) node.fail_type(what);
  for (const auto& item : node.json().items()) {
    const bool is_known =
        std::any_of(known_.begin(), known_.end(), [&](const std::string& k) { return canonical_key(k) == canonical_key(item.key()); });
    if (!is_known) node.child(item.key()).fail_at_key("unknown key in " + what + did_you_mean(item.key(), known_));
  }
}

std::optional<JsonNode> JsonObject::find(const std::string& key) const {
  for (const auto& item : node_.json().items())
    if (canonical_key(item.key()) == canonical_key(key)) return node_.child(item.key());
  return std::nullopt;
}

JsonNode JsonObject::require(const std::string& key) const {
  if (auto value = find(key)) return *value;
  node_.fail(what_ + " needs \"" + key + "\"");
}

double JsonObject::number(const std::string& key, double fallback, const Range& range) const {
  const auto value = find(key);
  return value ? value->number(range) : fallback;
}

std::string JsonObject::string(const std::string& key, const std::string& fallback) const {
  const auto value = find(key);
  return value ? value->string() : fallback;
}

bool JsonObject::boolean(const std::string& key, bool fallback) const {
  const auto value = find(key);
  return value ? value->boolean() : fallback;
}

std::string type_of(const JsonNode& node, const std::string& what, const std::string& fallback) {
  if (!node.is_object()) node.fail_type(what);
  if (!node.json().contains("type")) {
    if (fallback.empty()) node.fail(what + " needs \"type\"");
    return fallback;
  }
  return canonical_type(node.child("type").string());
}

}  // namespace stokes
