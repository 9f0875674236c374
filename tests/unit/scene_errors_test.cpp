// Bad scenes and the message each must give, pointer and all.
#include "unit/scene_support.h"

namespace stokes {
namespace {

struct BadScene {
  const char* name;
  std::string text;
  std::string message;  // from the pointer on
};

std::string quad(const std::string& members) { return with("\"surfaces\": [{\"type\": \"quad\"" + members + "}]"); }
std::string worn(const std::string& material) { return quad(", \"material\": " + material); }
std::string lit(const std::string& spectrum) { return with("\"background\": " + spectrum); }
std::string painted(const std::string& spectrum) { return worn(R"({"type": "lambertian", "albedo": )" + spectrum + "}"); }
std::string filled(const std::string& members) {
  return with(R"("media": [{"type": "homogeneous", "name": "m")" + (members.empty() ? "" : ", " + members) + "}]");
}
std::string placed(const std::string& transform) {
  return with("\"surfaces\": [{\"type\": \"sphere\", \"material\": {\"type\": \"interface\"}, \"transform\": " + transform + "}]");
}
std::string camera(const std::string& members) { return "{\"camera\": {" + members + "}}"; }
const char* kDye = R"("absorption": 0.5, "emission": {"type": "gaussian", "mean": 500, "stddev": 20})";

const BadScene kBadScenes[] = {
    // Top level, camera, sampler, integrator, background, film.
    {"top_level_key", R"({"camera": {}, "surfacs": []})", "/surfacs: unknown key in a scene; did you mean \"surfaces\"?"},
    {"tests_of_darts", R"({"type": "tests", "tests": []})",
     "/tests: a file of tests for darts' own program, not a scene: there is nothing to render"},
    {"no_camera", "{}", "a scene needs \"camera\""},
    {"camera_is_number", R"({"camera": 1})", "/camera: expected a camera, not a number"},
    {"camera_type", camera(R"("type": "ortographic")"),
     "/camera/type: no camera has the type \"ortographic\"; did you mean \"orthographic\"?"},
    {"vfov_zero", camera(R"("vfov": 0)"), "/camera/vfov: 0 is outside (0, 180)"},
    {"vfov_string", camera(R"("vfov": "40")"), "/camera/vfov: expected a number, not a string"},
    {"resolution_fraction", camera(R"("resolution": [1.5, 2])"), "/camera/resolution/0: 1.5 is not a whole number"},
    {"resolution_negative", camera(R"("resolution": [64, -1])"), "/camera/resolution/1: -1 is outside [1, 65536]"},
    {"resolution_three", camera(R"("resolution": [64, 64, 3])"), "/camera/resolution: expected an array of 2 numbers, not of 3"},
    {"aperture_negative", camera(R"("aperture": -0.1)"), "/camera/aperture: -0.1 must not be negative"},
    {"fdist_zero", camera(R"("fdist": 0)"), "/camera/fdist: 0 must be greater than 0"},
    {"height_of_perspective", camera(R"("height": 2)"), "/camera/height: only an orthographic camera has a height: give its \"type\""},
    {"camera_medium", camera(R"("medium": "fog")"), "/camera/medium: no medium named \"fog\" is defined before this"},
    {"samples_negative", with(R"("sampler": {"samples": -1})"), "/sampler/samples: -1 is outside [1, 2147483647]"},
    {"samples_fraction", with(R"("sampler": {"samples": 1.5})"), "/sampler/samples: 1.5 is not a whole number"},
    {"seed_negative", with(R"("sampler": {"seed": -1})"), "/sampler/seed: -1 is outside [0, 4294967295]"},
    {"integrator_name", with(R"("integrator": {"type": "path tracer msi"})"),
     "/integrator/type: no integrator is called \"path tracer msi\"; did you mean \"path tracer mis\"?"},
    {"bounces_negative", with(R"("integrator": {"max_bounces": -1})"), "/integrator/max_bounces: -1 is outside [0, 1000000000]"},
    {"wavelengths", with(R"("integrator": {"wavelengths per path": 3})"), "/integrator/wavelengths per path: 3 is none of 1, 4 and 8"},
    {"mode", with(R"("integrator": {"mode": "RGB"})"), "/integrator/mode: expected \"spectral\" or \"rgb\", not \"RGB\""},
    {"background_negative", lit("-1"), "/background: -1 must not be negative"},
    {"background_type", lit(R"({"type": "enviroment"})"),
     "/background/type: no background has the type \"enviroment\"; did you mean \"environment\"?"},
    {"environment_missing", lit(R"({"type": "environment", "filename": "no.exr"})"),
     "/background/filename: there is no file /nonexistent/no.exr"},
    {"film_bins", with(R"("film": {"spectral": [500, 400, 10]})"), "/film/spectral: the bins must begin below their end"},
    {"scene_unit", with(R"("scene unit": "km")"), "/scene unit: expected \"m\", \"cm\" or \"mm\", not \"km\""},
    // Transforms.
    {"scale_zero", placed(R"({"scale": 0})"), "/surfaces/0/transform: the transform is singular: it flattens space"},
    {"scale_flat", placed(R"([{"scale": [1, 0, 1]}, {"translate": [1, 2, 3]}])"),
     "/surfaces/0/transform: the transform is singular: it flattens space"},
    {"columns_dependent", placed(R"({"x": [1, 0, 0], "y": [1, 0, 0]})"),
     "/surfaces/0/transform: the transform is singular: it flattens space"},
    {"from_is_at", placed(R"({"from": [1, 2, 3], "at": [1, 2, 3]})"), "/surfaces/0/transform: \"from\" and \"at\" are the same point"},
    {"up_parallel", placed(R"({"from": [0, 5, 0], "at": [0, 0, 0], "up": [0, 1, 0]})"),
     "/surfaces/0/transform: \"up\" is parallel to the viewing direction"},
    {"at_and_to", placed(R"({"from": [0, 0, 1], "at": [0, 0, 0], "to": [0, 0, 0]})"),
     "/surfaces/0/transform/to: \"at\" and \"to\" are the same thing: give one of them"},
    {"matrix_short", placed(R"({"matrix": [1, 0, 0, 0]})"), "/surfaces/0/transform/matrix: expected an array of 16 numbers, not of 4"},
    {"matrix_projective", placed(R"({"matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,1,1]})"),
     "/surfaces/0/transform/matrix/14: the last row of the matrix must be 0 0 0 1"},
    {"rotate_axis", placed(R"({"rotate": [30, 0, 0, 0]})"), "/surfaces/0/transform/rotate: the axis of rotation is zero"},
    {"rotate_axis_long", placed(R"({"rotate": [30, 1e200, 0, 0]})"), "/surfaces/0/transform/rotate: the axis of rotation is too long"},
    {"groups_overflow", with(R"("surfaces": [{"type": "group", "transform": {"scale": 1e100}, "children": [{"type": "group", "transform": {"scale": 1e100},
      "children": [{"type": "group", "transform": {"scale": 1e100}, "children": [{"type": "group", "transform": {"scale": 1e100}, "children": [
      {"type": "sphere", "material": {"type": "lambertian"}}]}]}]}]}])"),
     "/surfaces/0/children/0/children/0/children/0/children/0: the transform is not finite"},
    {"two_commands", placed(R"({"scale": 2, "translate": [0, 0, 1]})"),
     "/surfaces/0/transform: one transform command to an entry: use an array"},
    {"command_unknown", placed(R"([{"tranlate": [0, 0, 1]}])"),
     "/surfaces/0/transform/0/tranlate: unknown key in a transform; did you mean \"translate\"?"},
    // Spectra.
    {"albedo_above_one", painted("1.01"), "/surfaces/0/material/albedo: 1.01 is outside [0, 1]"},
    {"albedo_component", painted("[0.5, -0.1, 0.5]"), "/surfaces/0/material/albedo/1: -0.1 is outside [0, 1]"},
    {"albedo_pair", painted("[0.5, 0.5]"), "/surfaces/0/material/albedo: expected an array of 3 numbers, not of 2"},
    {"albedo_name", painted("\"whitee\""), "/surfaces/0/material/albedo: no spectrum named \"whitee\" is defined before this"},
    {"albedo_null", painted("null"),
     "/surfaces/0/material/albedo: expected a spectrum (a number, [r, g, b], an object or a name), not null"},
    {"spectrum_type", painted(R"({"type": "gausian"})"),
     "/surfaces/0/material/albedo/type: neither a spectrum nor a texture has the type \"gausian\"; did you mean \"gaussian\"?"},
    {"spectrum_untyped", painted(R"({"value": 1})"), "/surfaces/0/material/albedo: a colour needs \"type\""},
    {"sampled_unsorted", painted(R"({"type": "sampled", "wavelengths": [400, 500, 450], "values": [0, 0.5, 1]})"),
     "/surfaces/0/material/albedo/wavelengths/2: wavelengths must increase, and 450 follows 500"},
    {"sampled_repeated", painted(R"({"type": "sampled", "wavelengths": [400, 400], "values": [0, 0.5]})"),
     "/surfaces/0/material/albedo/wavelengths/1: wavelengths must increase, and 400 follows 400"},
    {"sampled_lengths", painted(R"({"type": "sampled", "wavelengths": [400, 500], "values": [0]})"),
     "/surfaces/0/material/albedo/values: 1 values for 2 wavelengths"},
    {"sampled_range", painted(R"({"type": "sampled", "wavelengths": [400, 500], "values": [0, 1.5]})"),
     "/surfaces/0/material/albedo/values/1: 1.5 is outside [0, 1]"},
    {"scale_out_of_range", painted(R"({"type": "box", "range": [400, 500], "value": 0.8, "scale": 2})"),
     "/surfaces/0/material/albedo: the value at 400 nm, about 1.6, is outside [0, 1]"},
    {"sum_out_of_range", painted(R"({"type": "sum", "of": [0.6, {"type": "gaussian", "mean": 550, "stddev": 10, "value": 0.5}]})"),
     "/surfaces/0/material/albedo: the value at 544 nm, about 1.01764, is outside [0, 1]"},
    {"box_reversed", lit(R"({"type": "box", "range": [500, 400]})"), "/background/range: the range must begin below its end"},
    {"stddev_zero", lit(R"({"type": "gaussian", "mean": 500, "stddev": 0})"), "/background/stddev: 0 must be greater than 0"},
    {"temperature", lit(R"({"type": "blackbody", "temperature": -300})"), "/background/temperature: -300 is outside [100, 1e+07]"},
    {"illuminant", lit(R"({"type": "illuminant", "name": "D55"})"), "/background/name: no illuminant is called \"D55\""},
    {"extrapolate", lit(R"({"type": "constant", "value": 1, "extrapolate": "clamp"})"),
     "/background/extrapolate: expected \"zero\" or \"hold\", not \"clamp\""},
    {"csv_missing", lit(R"({"type": "file", "filename": "no.csv"})"), "/background/filename: there is no file /nonexistent/no.csv"},
    {"product_empty", lit(R"({"type": "product", "of": []})"), "/background/of: there must be at least one spectrum"},
    {"index_zero", worn(R"({"type": "dielectric", "ior": 0})"), "/surfaces/0/material/ior: 0 must be greater than 0"},
    {"sellmeier_pole", worn(R"({"type": "dielectric", "ior": {"type": "sellmeier", "B": [1, 0, 0], "C": [0.2, 1, 1]}})"),
     "/surfaces/0/material/ior: the index of refraction is not a positive number at 317 nm"},
    {"spectra_unnamed", with(R"("spectra": [{"type": "constant", "value": 1}])"), "/spectra/0: an entry of \"spectra\" needs a \"name\""},
    {"spectra_twice", with(R"("spectra": [{"type": "constant", "value": 1, "name": "a"}, {"type": "constant", "value": 2, "name": "a"}])"),
     "/spectra/1/name: there is already a spectrum named \"a\""},
    // Media.
    {"medium_one", filled(R"("sigma_t": 1)"), "/media/0: a medium needs exactly two of sigma_t, sigma_s, sigma_a and albedo, not 1"},
    {"medium_none", filled(""), "/media/0: a medium needs exactly two of sigma_t, sigma_s, sigma_a and albedo, not 0"},
    {"medium_three", filled(R"("sigma_t": 1, "sigma_a": 0.5, "albedo": 0.5)"),
     "/media/0: a medium needs exactly two of sigma_t, sigma_s, sigma_a and albedo, not 3"},
    {"sigma_s_above_sigma_t", filled(R"("sigma_t": 1, "sigma_s": 2)"), "/media/0: sigma_s 2 is greater than sigma_t 1 at 280 nm"},
    {"sigma_negative", filled(R"("sigma_t": -1, "albedo": 0.5)"), "/media/0/sigma_t: -1 must not be negative"},
    {"medium_albedo", filled(R"("sigma_t": 1, "albedo": 1.5)"), "/media/0/albedo: 1.5 is outside [0, 1]"},
    {"albedo_one_of_sigma_a", filled(R"("sigma_a": 1, "albedo": 1)"),
     "/media/0: sigma_a and an albedo of 1 at 280 nm do not determine sigma_t"},
    {"g_one", filled(R"("sigma_t": 1, "albedo": 1, "g": 1)"), "/media/0/g: 1 is outside (-1, 1)"},
    {"g_twice", filled(R"("sigma_t": 1, "albedo": 1, "g": 0.5, "phase function": {"type": "hg", "g": 0.5})"),
     "/media/0/g: g stands in the phase function or beside it, not both"},
    {"phase_type", filled(R"("sigma_t": 1, "albedo": 1, "phase_function": {"type": "rayleigh"})"),
     "/media/0/phase_function/type: no phase function has the type \"rayleigh\""},
    {"medium_unit", filled(R"("sigma_t": 1, "albedo": 1, "unit": "um")"), "/media/0/unit: expected \"m\", \"cm\" or \"mm\", not \"um\""},
    {"medium_type", with(R"("media": [{"type": "heterogeneous", "name": "m"}])"),
     "/media/0/type: no medium has the type \"heterogeneous\""},
    {"medium_name", quad(R"(, "material": {"type": "interface"}, "inside": "skn")"),
     "/surfaces/0/inside: no medium named \"skn\" is defined before this"},
    // Materials.
    {"material_type", worn(R"({"type": "lambertain"})"),
     "/surfaces/0/material/type: no material has the type \"lambertain\"; did you mean \"lambertian\"?"},
    {"material_key", worn(R"({"type": "metal", "rougness": 1})"),
     "/surfaces/0/material/rougness: unknown key in a material of type \"metal\"; did you mean \"roughness\"?"},
    {"material_missing", quad(""), "/surfaces/0: a quad needs \"material\""},
    {"material_later",
     R"({"camera": {}, "materials": [{"type": "blend", "name": "a", "a": "b", "b": "b"}, {"type": "metal", "name": "b"}]})",
     "/materials/0/a: no material named \"b\" is defined before this"},
    {"material_near",
     R"({"camera": {}, "materials": [{"type": "metal", "name": "chrome"}], "surfaces": [{"type": "quad", "material": "crome"}]})",
     "/surfaces/0/material: no material named \"crome\" is defined before this; did you mean \"chrome\"?"},
    {"material_twice", with(R"("materials": [{"type": "metal", "name": "a"}, {"type": "metal", "name": "a"}])"),
     "/materials/1/name: there is already a material named \"a\""},
    {"amount", worn(R"({"type": "blend", "a": {"type": "metal"}, "b": {"type": "metal"}, "amount": 2})"),
     "/surfaces/0/material/amount: 2 is outside [0, 1]"},
    {"fresnel_as_colour", painted(R"({"type": "fresnel", "ior": 1.5})"),
     "/surfaces/0/material/albedo/type: a texture of type \"fresnel\" is a number, not a colour"},
    {"conductor_k", worn(R"({"type": "conductor", "eta": 1})"), "/surfaces/0/material: a material of type \"conductor\" needs \"k\""},
    {"yield", worn(std::string(R"({"type": "diffuse_fluorescent", "yield": 1.1, )") + kDye + "}"),
     "/surfaces/0/material/yield: 1.1 is outside [0, 1]"},
    {"yield_type", worn(std::string(R"({"type": "diffuse_fluorescent", "yield type": "quantum", )") + kDye + "}"),
     "/surfaces/0/material/yield type: expected \"photon\" or \"energy\", not \"quantum\""},
    {"dark_dye", worn(R"({"type": "diffuse_fluorescent", "absorption": 0.5, "emission": 0})"),
     "/surfaces/0/material/emission: the emission is zero everywhere from 280 to 780 nm"},
    {"dyes_and_dye", worn(std::string(R"({"type": "diffuse_fluorescent", "dyes": [{)") + kDye + R"(}], "absorption": 1})"),
     "/surfaces/0/material/absorption: with \"dyes\" this key belongs into each dye"},
    {"region_radius",
     worn(
         R"({"type": "painted", "base": {"type": "metal"}, "paint": {"type": "metal"}, "mask": {"type": "region", "shapes": [{"sphere": [0, 0, 0]}]}})"),
     "/surfaces/0/material/mask/shapes/0: a region's shape needs \"radius\""},
    {"image_missing", painted(R"({"type": "image", "filename": "no.png"})"),
     "/surfaces/0/material/albedo/filename: there is no file /nonexistent/no.png"},
    // Surfaces.
    {"surface_type", with(R"("surfaces": [{"type": "cube"}])"), "/surfaces/0/type: no surface has the type \"cube\""},
    {"size_negative", quad(R"(, "material": {"type": "metal"}, "size": [1, -2])"), "/surfaces/0/size/1: -2 must be greater than 0"},
    {"radius_zero",
     with(R"("surfaces": [{"type": "sphere", "material": {"type": "metal"}, "radius": 0})"
          "]"),
     "/surfaces/0/radius: 0 must be greater than 0"},
    {"triangle_flat",
     with(R"("surfaces": [{"type": "triangle", "material": {"type": "metal"}, "v0": [0,0,0], "v1": [1,1,1], "v2": [2,2,2]}])"),
     "/surfaces/0: the triangle has no area"},
    {"triangle_two", with(R"("surfaces": [{"type": "triangle", "material": {"type": "metal"}, "v0": [0,0,0], "v1": [1,1,1]}])"),
     "/surfaces/0: a triangle needs \"v2\""},
    {"nested_key",
     with(
         R"("surfaces": [{"type": "group", "children": [{"type": "group", "children": [{"type": "sphere", "material": {"type": "metal"}, "raduis": 1}]}]}])"),
     "/surfaces/0/children/0/children/0/raduis: unknown key in a sphere; did you mean \"radius\"?"},
    {"mesh_missing", with(R"("surfaces": [{"type": "mesh", "material": {"type": "metal"}, "filename": "no.obj"}])"),
     "/surfaces/0/filename: there is no file /nonexistent/no.obj"},
    {"mesh_neither", with(R"("surfaces": [{"type": "mesh", "material": {"type": "metal"}}])"),
     "/surfaces/0: a mesh needs \"filename\" or \"generator\", one of them"},
    {"generator_name", with(R"("surfaces": [{"type": "mesh", "material": {"type": "metal"}, "generator": "foot"}])"),
     "/surfaces/0/generator: no generator is called \"foot\" (there are head and hand)"},
    {"flip_number", quad(R"(, "material": {"type": "metal"}, "flip": 1)"), "/surfaces/0/flip: expected true or false, not a number"},
};

class BadScenes : public testing::TestWithParam<BadScene> {};

TEST_P(BadScenes, GiveTheirMessage) {
  const std::string line = error_of(GetParam().text);
  ASSERT_THAT(line, testing::MatchesRegex("scene\\.json:[0-9]+:[0-9]+: error: .*"));
  EXPECT_THAT(line.substr(line.find(": error: ") + 9), testing::StartsWith(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(Table, BadScenes, testing::ValuesIn(kBadScenes),
                         [](const testing::TestParamInfo<BadScene>& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace stokes
