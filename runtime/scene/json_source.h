// A scene file as checked JSON whose values' places can be found. Knows JSON and files, not what a scene may say.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "input/limits.h"
#include "scene/error.h"

namespace stokes {

/// Keeps the file's order, so that the first fault in the file is the one reported.
using Json = nlohmann::ordered_json;

struct JsonSource {
  Json root;
  SourceMap map;
};

/// Parses `text`. Throws SceneError for what JSON forbids, and for what JSON libraries let pass: duplicate keys (the spaced and
/// the underscored spelling of a key count as the same), NaN and infinities, numbers that overflow, text after the end. Depth, values,
/// keys and memory stay within the limits. Comments, `//` and `/* */`, are accepted.
JsonSource parse_json(const std::string& text, const std::string& file_name, const InputLimits& limits = {});

/// Applies `--set POINTER=VALUE`: VALUE is JSON, or failing that a string. Objects that are missing on the way are created;
/// keys may be spelled with spaces or underscores. Throws SceneError where the pointer leads nowhere.
void apply_override(JsonSource& source, const std::string& pointer, const std::string& value);

/// A key as a JSON pointer's reference token.
std::string escape_token(const std::string& key);
/// A key with underscores as spaces: `max_bounces` and `max bounces` are one key.
std::string canonical_key(std::string key);

}  // namespace stokes
