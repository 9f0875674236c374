// The JSON layer: places, what JSON forbids, what JSON libraries let pass, --set.
#include "unit/scene_support.h"

namespace stokes {
namespace {

TEST(SceneJson, ErrorsPointAtTheValue) {
  EXPECT_EQ(error_of("{\n  \"camera\": {},\n  \"media\": [\n    {\"type\": \"vacuum\", \"name\": \"v\"},\n"
                     "    {\"type\": \"homogeneous\", \"name\": \"fog\", \"sigma_t\": 1,\n"
                     "     \"albedo\": 0.5, \"g\": 1.2}\n  ]\n}"),
            "scene.json:6:26: error: /media/1/g: 1.2 is outside (-1, 1)");
}

TEST(SceneJson, UnknownKeysPointAtTheKey) {
  EXPECT_EQ(error_of("{\n \"camera\": {\"vofv\":\n\n 40}}"),
            "scene.json:2:13: error: /camera/vofv: unknown key in a camera; did you mean \"vfov\"?");
}

TEST(SceneJson, PlacesSurviveEscapesAndByteOrderMark) {
  const SceneDescription s = parse("\xEF\xBB\xBF{\"camera\": {},\n \"$schema\": \"a\\\"}\\\\\",\n \"sampler\": {\"samples\": 3}}");
  EXPECT_EQ(s.source.find("/sampler/samples").line, 3);
  EXPECT_EQ(s.source.find("/sampler/samples").column, 25);
  EXPECT_EQ(s.source.find("/sampler/samples/no/such").line, 3);
}

TEST(SceneJson, PointersEscapeTheirTokens) {
  EXPECT_EQ(error_of("{\"a/b~c\": 1}"), "scene.json:1:2: error: /a~1b~0c: unknown key in a scene");
}

TEST(SceneJson, DuplicateKeys) {
  EXPECT_EQ(error_of("{\"camera\": {},\n \"camera\": {}}"), "scene.json:2:2: error: /camera: this key occurs twice");
  EXPECT_EQ(error_of(with("\"integrator\": {\"max bounces\": 1,\n\"max_bounces\": 2}")),
            "scene.json:3:1: error: /integrator/max_bounces: this key is \"max bounces\" again");
}

TEST(SceneJson, DuplicateKeysFarIn) {
  // The second of two that are spelt alike, below others that have the same name; escapes make no other key.
  EXPECT_EQ(error_of("{\"camera\": {},\n \"media\": [[], {\"g\": 1}, {\"g\": {\"a/b\": 1,\n\"c\": 2, \"a\\u002fb\": 3}}]}"),
            "scene.json:3:9: error: /media/2/g/a~1b: this key occurs twice");
  // What is not JSON is told first, wherever it stands.
  EXPECT_THAT(error_of("{\"camera\": {},\n \"camera\": {}\n, x}"), testing::StartsWith("scene.json:3:3: error: /camera: not JSON:"));
}

TEST(SceneJson, PlacesOfKeysWithEscapes) {
  const SceneDescription s = parse("{\"camera\": {},\n \"$sch\\u0065ma\": \"x\",\n \"media\": [{\"type\": \"vacuum\",\n \"n\\u0061me\": \"v\"}]}");
  EXPECT_EQ(s.source.find("/$schema").line, 2);
  EXPECT_EQ(s.source.find("/media/0/name").line, 4);
  EXPECT_EQ(s.source.find("/media/0/name").column, 15);
  EXPECT_EQ(s.source.find_key("/media/0/name").value().column, 2);
  EXPECT_EQ(s.source.find("/media/1/name").line, 3);  // there is none: its nearest ancestor's
  EXPECT_FALSE(s.source.find_key("/media/1/name").has_value());
  EXPECT_FALSE(s.source.find_key("/media/0").has_value());
  EXPECT_EQ(error_of("{\"a\\\"b\\\\\": 1}"), "scene.json:1:2: error: /a\"b\\: unknown key in a scene");
}

TEST(SceneJson, WhatIsNotJson) {
  EXPECT_EQ(error_of(with("\"background\": NaN")), "scene.json:2:15: error: /background: NaN is not a number in JSON; values must be finite");
  EXPECT_EQ(error_of(with("\"background\": Infinity")), "scene.json:2:15: error: /background: Infinity is not a number in JSON; values must be finite");
  EXPECT_EQ(error_of(with("\"background\": -Infinity")),
            "scene.json:2:15: error: /background: -Infinity is not a number in JSON; values must be finite");
  EXPECT_THAT(error_of(with("\"background\": 1e999")), testing::StartsWith("scene.json:2:"));
  EXPECT_THAT(error_of(with("\"background\": 1e999")), testing::HasSubstr("1e999 is too large for a number"));
  EXPECT_THAT(error_of("{\"camera\": {}}\n}"), testing::StartsWith("scene.json:2:1: error: not JSON:"));
  EXPECT_THAT(error_of("{\"camera\": {},}"), testing::StartsWith("scene.json:1:15: error: /camera: not JSON:"));
  EXPECT_THAT(error_of("{\"camera\": {} / eye\n}"), testing::StartsWith("scene.json:1:1"));
  EXPECT_THAT(error_of("{\"camera\": {} /* eye\n}"), testing::HasSubstr("not JSON"));
  EXPECT_THAT(error_of("{\"camera\": {}} /* eye * /"), testing::HasSubstr("not JSON"));
  // A comment to the text's end: the library counts that end too.
  EXPECT_THAT(error_of("{\"a\": 1/"), testing::StartsWith("scene.json:1:"));
  EXPECT_THAT(error_of("{\"a\": 1///"), testing::StartsWith("scene.json:1:"));
  EXPECT_THAT(error_of("{\"a\": 1/* "), testing::StartsWith("scene.json:1:"));
  EXPECT_EQ(error_of(std::string("\xff\xfe{\0}\0", 6)), "scene.json:1:1: error: not JSON: the file is in UTF-16; save it as UTF-8");
  EXPECT_EQ(error_of(std::string("{\"camera\": {}}\n\0}}x", 18)), "scene.json:2:1: error: not JSON: there is a character 0");
  EXPECT_THAT(error_of(""), testing::StartsWith("scene.json:1:1: error: not JSON:"));
  EXPECT_THAT(error_of("{\"camera\": \"\xff\"}"), testing::HasSubstr("not JSON"));
  EXPECT_EQ(error_of("[]"), "scene.json:1:1: error: expected a scene, not an array");
  EXPECT_THAT(error_of("{\"camera\":" + std::string(5000, '[')), testing::HasSubstr("nested deeper"));
}

TEST(SceneJson, PlacesSurviveComments) {
  const SceneDescription s = parse(
      "// a scene {\r\n/* of \"one\"\n * camera **/ {\"camera\": {/**/}, // }\n"
      " \"film\" /* , */ : /*[*/ {} /*]*/, \"$schema\": \"// no comment /*\",\n \"sampler\": {\"samples\":3/**/,\"seed\":4//\n}}//");
  EXPECT_EQ(s.samples, 3);
  EXPECT_EQ(s.seed, 4u);
  EXPECT_EQ(s.source.find("/camera").line, 3);
  EXPECT_EQ(s.source.find("/camera").column, 26);
  EXPECT_EQ(s.source.find("/film").line, 4);
  EXPECT_EQ(s.source.find("/film").column, 25);
  EXPECT_EQ(s.source.find("/sampler/seed").line, 5);
  EXPECT_EQ(s.source.find("/sampler/seed").column, 37);
  EXPECT_EQ(error_of("{// the eye\n\"camera\": {}, /* the\nshapes */ \"surfacs\": []}"),
            "scene.json:3:11: error: /surfacs: unknown key in a scene; did you mean \"surfaces\"?");
}

TEST(SceneJson, EveryErrorIsOneLine) {
  EXPECT_EQ(error_of("{\"a\\nb\": 1}").find('\n'), std::string::npos);
  EXPECT_EQ(error_of("{\"camera\": {\"type\": \"x\\ny\"}}").find('\n'), std::string::npos);
  for (const char* text : {"{", "{\"a\" 1}", "nul", "{\"a\": \"\n\"}"}) EXPECT_EQ(error_of(text).find('\n'), std::string::npos);
  // Nor what else ends lines, or turns the direction of writing.
  const std::string error = error_of("{\"camera\": {\"type\": \"a\\u2028b\\u2029c\\u202ed\\u2066e\\u0085f\\u001bg\\u00e9\\u2030h\"}}");
  EXPECT_THAT(error, testing::HasSubstr("a   b   c   d   e  f g\u00e9\u2030h"));
}

TEST(SceneJson, MissingFile) {
  try {
    read_scene("/nonexistent/scene.json");
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_STREQ(error.what(), "/nonexistent/scene.json:1:1: error: the scene cannot be read: No such file or directory");
  }
  EXPECT_THROW(read_scene("/tmp"), SceneError);
}

TEST(SceneOverride, ReplacesAndCreates) {
  const std::string text =
      R"({"camera": {"vfov": 30}, "integrator": {"max bounces": 3}, "surfaces": [{"type": "quad", "material": {"type": "lambertian"}}]})";
  const SceneDescription s = parse(text, {{"/camera/vfov", "40"},
                                          {"/integrator/max_bounces", "7"},
                                          {"/sampler/samples", "5"},
                                          {"/integrator/type", "path tracer nee"},
                                          {"/surfaces/0/size", "[2, 3]"},
                                          {"/surfaces/-", R"({"type": "sphere", "material": {"type": "interface"}})"}});
  EXPECT_EQ(s.camera.vfov, 40);
  EXPECT_EQ(s.integrator.max_bounces, 7);
  EXPECT_EQ(s.integrator.kind, IntegratorKind::Nee);
  EXPECT_EQ(s.samples, 5);
  EXPECT_EQ(s.surfaces.at(0).height, 3);
  EXPECT_EQ(s.surfaces.size(), 2u);
}

TEST(SceneOverride, PlacesBelowAreGone) {
  const std::string text = "{\"camera\": {\"vfov\": 30},\n \"sampler\": {\"type\": \"cmj\",\n \"seed\": 1},\n \"surfaces\": []}";
  const SceneDescription s = parse(text, {{"/sampler/seed", "2"}, {"/sampler", R"({"seed": 3})"}, {"/camera/fdist", "2"}});
  EXPECT_EQ(s.seed, 3u);
  EXPECT_EQ(s.source.find("/sampler/seed").line, 2);
  EXPECT_EQ(s.source.find("/sampler/seed").column, 13);  // of the sampler that the file has
  EXPECT_EQ(s.source.find("/camera/vfov").column, 21);
  EXPECT_EQ(s.source.find("/camera/fdist").column, 12);
  EXPECT_EQ(error_of(text, {{"/sampler", R"({"sed": 3})"}}), "scene.json:2:13: error: /sampler/sed: unknown key in a sampler; did you mean \"seed\"?");
}

TEST(SceneOverride, FailsWhereThePointerLeadsNowhere) {
  const std::string text = "{\"camera\": {\"vfov\": 30}, \"surfaces\": []}";
  EXPECT_EQ(error_of(text, {{"/surfaces/2/size", "1"}}),
            "scene.json:1:1: error: --set /surfaces/2/size: /surfaces has 0 entries, and 2 is none of them");
  EXPECT_EQ(error_of(text, {{"/camera/vfov/x", "1"}}),
            "scene.json:1:1: error: --set /camera/vfov/x: /camera/vfov is neither an object nor an array");
  EXPECT_EQ(error_of(text, {{"camera", "1"}}), "scene.json:1:1: error: --set camera: a JSON pointer begins with /");
  EXPECT_EQ(error_of(text, {{"/camera/vfvo", "1"}}),
            "scene.json:1:12: error: /camera/vfvo: unknown key in a camera; did you mean \"vfov\"?");
  EXPECT_EQ(error_of(text, {{"/camera/vfov", "200"}}), "scene.json:1:21: error: /camera/vfov: 200 is outside (0, 180)");
}

}  // namespace
}  // namespace stokes
