// The JSON schema against the reader: every object of the schema has exactly the keys that the reader knows there. Each word that occurs
// in the readers' sources is tried in each object, so a key that one of the two forgets is found.
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "scene/json_source.h"
#include "unit/scene_support.h"

namespace stokes {
namespace {

using nlohmann::json;

std::string text_of(const std::filesystem::path& path) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

const json& definitions() {
  static const json schema = json::parse(text_of(STOKES_SOURCE_DIR "/scenes/schema/schema.json"));
  return schema.at("definitions");
}

struct Place {
  json scene;
  json::json_pointer pointer;
};

Place in_material(const json& object, const char* material, const char* pointer) {
  json m = json::parse(material);
  m["name"] = "m";
  const json::json_pointer inside(pointer);
  m[inside] = object;
  return {{{"camera", json::object()}, {"materials", {m}}}, json::json_pointer("/materials/0") / inside};
}

Place in_medium(const json& object, const char* pointer) {
  json m = {{"type", "homogeneous"}, {"name", "m"}, {"sigma_t", 1}, {"albedo", 1}};
  const json::json_pointer inside(pointer);
  m[inside] = object;
  return {{{"camera", json::object()}, {"media", {m}}}, json::json_pointer("/media/0") / inside};
}

// A scene in which an object of a definition stands, and where.
Place place_of(const std::string& definition, const json& object) {
  const std::string family = definition.substr(0, definition.find(':'));
  const json camera = json::object();
  json named = object;
  named["name"] = "m";
  const std::string wire = R"({"type": "wireframe"})";
  if (definition == "scene") return {object, json::json_pointer("")};
  if (definition == "camera") return {{{"camera", object}}, json::json_pointer("/camera")};
  if (definition == "sampler" || definition == "integrator" || definition == "film")
    return {json::object({{"camera", camera}, {definition, object}}), json::json_pointer("/" + definition)};
  if (definition == "environment" || family == "spectrum")
    return {{{"camera", camera}, {"background", object}}, json::json_pointer("/background")};
  if (family == "material") return {{{"camera", camera}, {"materials", {named}}}, json::json_pointer("/materials/0")};
  if (family == "medium") return {{{"camera", camera}, {"media", {named}}}, json::json_pointer("/media/0")};
  if (family == "surface") return {{{"camera", camera}, {"surfaces", {object}}}, json::json_pointer("/surfaces/0")};
  if (family == "transform" || definition == "transform command")
    return {{{"camera", {{"transform", object}}}}, json::json_pointer("/camera/transform")};
  if (family == "texture" || definition == "plain constant")
    return in_material(object, R"({"type": "blend", "a": {"type": "metal"}, "b": {"type": "metal"}})", "/amount");
  if (definition == "texture mapping") return in_material(object, R"({"type": "metal", "albedo": {"type": "checker"}})", "/albedo/mapping");
  if (definition == "region shape")
    return in_material(object, R"({"type": "blend", "a": {"type": "metal"}, "b": {"type": "metal"}, "amount": {"type": "region", "shapes": []}})",
                       "/amount/shapes/0");
  if (definition == "dye: surface") return in_material(object, R"({"type": "diffuse fluorescent", "dyes": []})", "/dyes/0");
  if (definition == "dye: medium") {
    Place place = in_medium(json::array({object}), "/dyes");
    return {place.scene, place.pointer / 0};
  }
  if (definition == "phase function") return in_medium(object, "/phase function");
  return {nullptr, json::json_pointer("")};
}

// Every word in quotes of the readers.
std::set<std::string> vocabulary() {
  std::set<std::string> words;
  const std::regex literal("\"([A-Za-z$][A-Za-z0-9_ ]{0,30})\"");
  for (const auto& file : std::filesystem::directory_iterator(STOKES_SOURCE_DIR "/runtime/scene")) {
    const std::string name = file.path().filename().string();
    if (!name.ends_with("_reader.cpp") && name != "read_scene.cpp" && name != "mesh_surface.cpp") continue;
    const std::string text = text_of(file.path());
    for (std::sregex_iterator it(text.begin(), text.end(), literal), end; it != end; ++it) words.insert(canonical_key((*it)[1]));
  }
  return words;
}

bool reader_knows(const std::string& definition, const json& example, const std::string& word) {
  json object = example;
  if (object.contains(word)) return true;
  object[word] = nullptr;
  const Place place = place_of(definition, object);
  const std::string error = error_of(place.scene.dump());
  // "from" makes a look-at of axes, which then has unknown keys beside "from".
  if (definition == "transform: axes") return error.find(": unknown key") == std::string::npos;
  return error.find(": " + (place.pointer / word).to_string() + ": unknown key") == std::string::npos;
}

std::set<std::string> schema_keys(const json& definition) {
  std::set<std::string> keys;
  for (const auto& item : definition.at("properties").items()) keys.insert(canonical_key(item.key()));
  return keys;
}

TEST(SceneSchema, ItsExamplesAreReadAndFilesAreAllTheyLack) {
  for (const auto& [name, definition] : definitions().items()) {
    if (!definition.contains("examples")) continue;
    const Place place = place_of(name, definition.at("examples").at(0));
    ASSERT_FALSE(place.scene.is_null()) << "where does \"" << name << "\" stand in a scene?";
    const std::string error = error_of(place.scene.dump());
    EXPECT_TRUE(error.empty() || error.find("there is no file") != std::string::npos) << name << ": " << error;
  }
}

TEST(SceneSchema, HasTheReadersKeysEverywhere) {
  const std::set<std::string> words = vocabulary();
  ASSERT_GT(words.size(), 200u);
  std::size_t objects = 0;
  for (const auto& [name, definition] : definitions().items()) {
    if (!definition.contains("properties") || definition.contains("allOf")) continue;  // a union is its members
    ASSERT_TRUE(definition.contains("examples")) << name;
    ASSERT_EQ(definition.at("additionalProperties"), false) << name;
    const std::set<std::string> keys = schema_keys(definition);
    objects++;
    for (const std::string& word : words)
      EXPECT_EQ(reader_knows(name, definition.at("examples").at(0), word), keys.count(word) > 0)
          << "\"" << word << "\" in \"" << name << "\": the reader's answer, then the schema's";
    for (const std::string& key : keys) EXPECT_TRUE(words.count(key)) << key << " of " << name << " stands in no reader";
  }
  EXPECT_GT(objects, 50u);
}

// A type that the reader has and the schema lacks would go unnoticed above.
TEST(SceneSchema, HasTheReadersTypes) {
  const std::pair<const char*, const char*> families[] = {{"material", "materials"}, {"surface", "surfaces"}, {"medium", "media"}, {"spectrum", "spectra"}};
  for (const auto& [family, list] : families)
    for (const std::string& word : vocabulary()) {
      const json scene = {{"camera", json::object()}, {list, {{{"type", word}, {"name", "m"}, {"zzz", 1}}}}};
      const bool known = error_of(scene.dump()).find("/0/type: no ") == std::string::npos;
      // Other spellings of a type share its definition.
      if (word == "homogeneous hg" || word == "bbh" || word == "linear") continue;
      std::string spelt = word;
      std::replace(spelt.begin(), spelt.end(), ' ', '_');
      const bool defined = definitions().contains(std::string(family) + ": " + word) || definitions().contains(std::string(family) + ": " + spelt);
      EXPECT_EQ(known, defined) << family << " of type \"" << word << "\": the reader's answer, then the schema's";
    }
}

}  // namespace
}  // namespace stokes
