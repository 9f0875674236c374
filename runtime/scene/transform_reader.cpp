// The commands of a transform, one function each.
#include "scene/transform_reader.h"

#include <cmath>
#include <numbers>

namespace stokes {
namespace {

Affine from_columns(Vec3d x, Vec3d y, Vec3d z, Vec3d o) { return {{x.x, y.x, z.x, o.x, x.y, y.y, z.y, o.y, x.z, y.z, z.z, o.z}}; }

bool is_singular(const Affine& a) {
  const double lengths = length(a.column(0)) * length(a.column(1)) * length(a.column(2));
  return !std::isfinite(lengths) || !is_finite(a.translation()) || !(std::abs(a.determinant()) > 1e-12 * lengths) || lengths == 0;
}

Affine read_look_at(const JsonNode& node) {
  const JsonObject o(node, "a look-at transform", {"from", "at", "to", "up"});
  const auto vector = [&](const char* key, Vec3d fallback) {
    const auto value = o.find(key);
    return value ? value->vector() : fallback;
  };
  if (o.has("at") && o.has("to")) o.require("to").fail("\"at\" and \"to\" are the same thing: give one of them");
  const Vec3d from = vector("from", {0, 0, 1}), up = vector("up", {0, 1, 0});
  const Vec3d at = vector(o.has("to") ? "to" : "at", {0, 0, 0});
  const Vec3d back = from - at;
  if (!(length(back) > 0)) node.fail("\"from\" and \"at\" are the same point");
  const Vec3d z = normalize(back), side = cross(up, z);
  if (!(length(side) > 1e-9 * length(up))) node.fail("\"up\" is parallel to the viewing direction");
  const Vec3d x = normalize(side);
  return from_columns(x, cross(z, x), z, from);
}

Affine read_axes(const JsonNode& node) {
  const JsonObject o(node, "a transform by axes", {"o", "x", "y", "z"});
  const auto vector = [&](const char* key, Vec3d fallback) {
    const auto value = o.find(key);
    return value ? value->vector() : fallback;
  };
  return from_columns(vector("x", {1, 0, 0}), vector("y", {0, 1, 0}), vector("z", {0, 0, 1}), vector("o", {}));
}

Affine rotation(const JsonNode& node, double degrees, Vec3d axis) {
  if (!(length(axis) > 0)) node.fail("the axis of rotation is zero");
  if (!std::isfinite(length(axis))) node.fail("the axis of rotation is too long");
  const Vec3d a = normalize(axis);
  // Quarter turns are exact, so that boxes close without slits.
  const double turns = std::fmod(degrees, 360.0) / 90.0;
  const bool quarter = turns == std::floor(turns);
  const int q = quarter ? (static_cast<int>(turns) + 4) % 4 : 0;
  const double radians = degrees * std::numbers::pi / 180;
  const double c = quarter ? (q == 0) - (q == 2) : std::cos(radians);
  const double s = quarter ? (q == 1) - (q == 3) : std::sin(radians);
  const auto column = [&](Vec3d e) { return e * c + cross(a, e) * s + a * (dot(a, e) * (1 - c)); };
  return from_columns(column({1, 0, 0}), column({0, 1, 0}), column({0, 0, 1}), {});
}

Affine read_matrix(const JsonNode& node) {
  const auto m = node.numbers(16);
  const double last[4] = {0, 0, 0, 1};
  for (std::size_t i = 0; i < 4; i++)
    if (m[12 + i] != last[i]) node[12 + i].fail("the last row of the matrix must be 0 0 0 1");
  Affine a;
  for (std::size_t i = 0; i < 12; i++) a.m[i] = m[i];
  return a;
}

Affine read_command(const JsonNode& node) {
  if (!node.is_object()) node.fail_type("a transform");
  const auto has = [&](std::initializer_list<const char*> keys) {
    for (const char* key : keys)
      if (node.json().contains(key)) return true;
    return false;
  };
  if (has({"from", "at", "to", "up"})) return read_look_at(node);
  if (has({"o", "x", "y", "z"})) return read_axes(node);
  const JsonObject o(node, "a transform",
                     {"translate", "scale", "rotate", "matrix", "angle", "axis", "from", "at", "to", "up", "o", "x", "y", "z"});
  if (o.has("angle") || o.has("axis")) {
    if (node.size() != 2) node.fail("a rotation by \"angle\" needs \"axis\", and nothing else");
    return rotation(node, o.require("angle").number(), o.require("axis").vector());
  }
  if (node.size() != 1) node.fail(node.size() == 0 ? "the transform is empty" : "one transform command to an entry: use an array");
  if (const auto t = o.find("translate")) return from_columns({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, t->vector());
  if (const auto s = o.find("scale")) {
    const double uniform = s->is_number() ? s->number() : 0;
    const Vec3d v = s->is_number() ? Vec3d{uniform, uniform, uniform} : s->vector();
    return from_columns({v.x, 0, 0}, {0, v.y, 0}, {0, 0, v.z}, {});
  }
  if (const auto r = o.find("rotate")) {
    const auto v = r->numbers(4);
    return rotation(*r, v[0], {v[1], v[2], v[3]});
  }
  return read_matrix(o.require("matrix"));
}

}  // namespace

Affine read_transform(const JsonNode& node) {
  Affine result;
  if (node.is_array()) {
    for (std::size_t i = 0; i < node.size(); i++) result = read_command(node[i]) * result;
  } else {
    result = read_command(node);
  }
  if (is_singular(result)) node.fail("the transform is singular: it flattens space");
  return result;
}

}  // namespace stokes
