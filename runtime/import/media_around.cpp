// Rays from surfaces that name no medium to the boundaries of media. Knows the shapes that importers write, not where they come from.
#include "import/media_around.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <tuple>

#include "import/affine_json.h"

namespace stokes {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();
constexpr double kNothing = 1e-9;  // a distance that counts as none
constexpr std::size_t kRun = 32;
constexpr std::size_t kPlaces = 6;  // of a surface that are looked at
const Vec3d kDirections[] = {{0.36, 0.48, 0.8}, {-0.64, 0.6, -0.48}, {0.6, -0.64, -0.48}, {-0.48, -0.6, 0.64}};

Affine affine_of(const ImportJson& surface) {
  Affine a;
  if (!surface.contains("transform")) return a;
  const ImportJson& t = surface["transform"];
  const auto column = [&](const char* key, std::size_t i) {
    for (std::size_t row = 0; row < 3; row++) a.m[row * 4 + i] = t[key][row].get<double>();
  };
  if (t.contains("matrix"))
    for (std::size_t i = 0; i < 12; i++) a.m[i] = t["matrix"][i].get<double>();
  else
    column("x", 0), column("y", 1), column("z", 2), column("o", 3);
  return a;
}

struct Triangle {
  Vec3d a, b, c;
  bool turned = false;  // its front is not where its winding says
};

struct Box {
  Vec3d low{kEndless, kEndless, kEndless}, high{-kEndless, -kEndless, -kEndless};

  void add(Vec3d p) { low = min(low, p), high = max(high, p); }
};

/// A sphere, or triangles, in its own frame.
struct Solid {
  Affine to_world;
  double radius = 0;  // 0: triangles
  std::vector<Triangle> triangles;
  std::vector<Box> boxes;  // of every kRun triangles that follow each other, which in most files lie close together
  bool flip = false;
  ImportJson inside, outside;  // null: vacuum

  void add(const Triangle& t) {
    if (triangles.size() % kRun == 0) boxes.emplace_back();
    triangles.push_back(t);
    for (const Vec3d& p : {t.a, t.b, t.c}) boxes.back().add(p);
  }

  std::vector<Vec3d> places() const {
    std::vector<Vec3d> all;
    if (radius > 0)
      for (const Vec3d& axis : {Vec3d{1, 0, 0}, Vec3d{-1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, -1, 0}, Vec3d{0, 0, 1}, Vec3d{0, 0, -1}})
        all.push_back(axis * radius);
    const std::size_t step = std::max<std::size_t>(1, triangles.size() / kPlaces);
    for (std::size_t i = 0; i < triangles.size(); i += step) all.push_back((triangles[i].a + triangles[i].b + triangles[i].c) * (1.0 / 3));
    for (Vec3d& p : all) p = to_world.point(p);
    return all;
  }
};

struct Hit {
  double t = kEndless;
  bool from_inside = false;
};

void meet_triangle(const Triangle& t, Vec3d o, Vec3d d, Hit& hit) {
  const Vec3d e1 = t.b - t.a, e2 = t.c - t.a, n = cross(e1, e2), q = cross(o - t.a, d);
  const double slope = -dot(d, n);
  if (slope == 0) return;
  const double u = dot(e2, q) / slope, v = -dot(e1, q) / slope, distance = dot(o - t.a, n) / slope;
  if (u < 0 || v < 0 || u + v > 1 || distance <= kNothing || distance >= hit.t) return;
  hit = {distance, (slope < 0) != t.turned};
}

void meet_sphere(double radius, Vec3d o, Vec3d d, Hit& hit) {
  const double a = dot(d, d), b = dot(o, d), c = dot(o, o) - radius * radius, root = b * b - a * c;
  if (root < 0) return;
  for (const double sign : {-1.0, 1.0}) {
    const double t = (-b + sign * std::sqrt(root)) / a;
    if (t <= kNothing || t >= hit.t) continue;
    hit = {t, sign > 0};
    return;
  }
}

bool misses(const Box& s, Vec3d o, Vec3d d) {
  double near = 0, far = kEndless;
  for (const auto& [at, along, low, high] :
       {std::tuple{o.x, d.x, s.low.x, s.high.x}, std::tuple{o.y, d.y, s.low.y, s.high.y}, std::tuple{o.z, d.z, s.low.z, s.high.z}}) {
    const double one = (low - at) / along, other = (high - at) / along;
    near = std::max(near, std::min(one, other));
    far = std::min(far, std::max(one, other));
  }
  return near > far * (1 + 1e-9) + 1e-9;
}

Hit meet(const Solid& s, Vec3d point, Vec3d direction) {
  const Affine to_local = s.to_world.inverse();
  const Vec3d o = to_local.point(point), d = to_local.vector(direction);
  Hit hit;
  if (s.radius > 0) {
    meet_sphere(s.radius, o, d, hit);
  } else {
    for (std::size_t run = 0; run < s.boxes.size(); run++) {
      if (misses(s.boxes[run], o, d)) continue;
      for (std::size_t i = run * kRun; i < std::min((run + 1) * kRun, s.triangles.size()); i++) meet_triangle(s.triangles[i], o, d, hit);
    }
  }
  hit.from_inside ^= s.flip;
  return hit;
}

/// The surfaces of a scene as solids.
class Solids {
 public:
  Solids(const ImportedScene& scene, const ImportTarget& target) : target_(target) {
    for (const auto& [name, mesh] : scene.meshes) meshes_[name] = &mesh;
  }

  Solid of(const ImportJson& surface, const Affine& parent) {
    Solid s;
    s.to_world = parent * affine_of(surface);
    s.flip = surface.value("flip", false);
    s.inside = surface.value("inside", ImportJson());
    s.outside = surface.value("outside", ImportJson());
    if (surface["type"] == "sphere") s.radius = surface["radius"].get<double>();
    if (surface["type"] == "quad") {
      const double h = surface["size"].get<double>() / 2;
      s.add({{-h, -h, 0}, {h, -h, 0}, {h, h, 0}});
      s.add({{-h, -h, 0}, {h, h, 0}, {-h, h, 0}});
    }
    if (surface["type"] == "mesh") add_mesh(surface["filename"].get<std::string>(), s);
    return s;
  }

 private:
  void add_mesh(const std::string& name, Solid& s) {
    auto known = meshes_.find(name);
    if (known == meshes_.end()) {
      try {
        read_.push_back(std::make_unique<ImportedMesh>(read_obj_mesh((std::filesystem::path(target_.folder) / name).string())));
      } catch (const std::runtime_error&) {
        read_.push_back(std::make_unique<ImportedMesh>());  // the scene's reader says what is wrong with it
      }
      known = meshes_.emplace(name, read_.back().get()).first;
    }
    const ImportedMesh& mesh = *known->second;
    const auto vector = [](const std::vector<std::array<double, 3>>& all, int i) {
      const auto& v = all[static_cast<std::size_t>(i)];
      return Vec3d{v[0], v[1], v[2]};
    };
    for (const auto& t : mesh.triangles) {
      Triangle triangle{vector(mesh.positions, t[0]), vector(mesh.positions, t[1]), vector(mesh.positions, t[2])};
      if (!mesh.normals.empty()) {
        const Vec3d normal = vector(mesh.normals, t[0]) + vector(mesh.normals, t[1]) + vector(mesh.normals, t[2]);
        triangle.turned = dot(normal, cross(triangle.b - triangle.a, triangle.c - triangle.a)) < 0;
      }
      s.add(triangle);
    }
  }

  const ImportTarget& target_;
  std::map<std::string, const ImportedMesh*> meshes_;
  std::vector<std::unique_ptr<ImportedMesh>> read_;
};

/// Calls `leaf(surface, parent's map)` for every surface that is no group.
template <class Leaf>
void for_each_leaf(ImportJson& surfaces, const Affine& parent, const Leaf& leaf) {
  for (ImportJson& surface : surfaces)
    if (surface["type"] == "group")
      for_each_leaf(surface["children"], parent * affine_of(surface), leaf);
    else
      leaf(surface, parent);
}

/// How often rays from a solid's places come to which medium.
std::map<std::string, int> media_met(const Solid& solid, const std::vector<Solid>& boundaries) {
  std::map<std::string, int> votes;
  for (const Vec3d& place : solid.places())
    for (const Vec3d& direction : kDirections) {
      Hit nearest;
      const Solid* met = nullptr;
      for (const Solid& boundary : boundaries)
        if (const Hit hit = meet(boundary, place, direction); hit.t < nearest.t) nearest = hit, met = &boundary;
      if (met) votes[(nearest.from_inside ? met->inside : met->outside).dump()]++;
    }
  return votes;
}

}  // namespace

ImportJson place_of(const std::string& file, int line) { return {{"file", file}, {"line", line}}; }

void name_media_around(ImportedScene& scene, const ImportTarget& target, const std::string& camera_medium) {
  Solids solids(scene, target);
  std::vector<Solid> boundaries;
  for_each_leaf(scene.json["surfaces"], {}, [&](const ImportJson& surface, const Affine& parent) {
    if (surface.contains("inside") || surface.contains("outside")) boundaries.push_back(solids.of(surface, parent));
  });
  for_each_leaf(scene.json["surfaces"], {}, [&](ImportJson& surface, const Affine& parent) {
    const ImportJson place = surface.value(kPlaceKey, ImportJson());
    surface.erase(kPlaceKey);
    if (surface.contains("inside") || surface.contains("outside") || (boundaries.empty() && camera_medium.empty())) return;
    const auto note = [&](const std::string& text) { scene.note(place.value("file", ""), place.value("line", 1), text); };
    const std::map<std::string, int> votes = media_met(solids.of(surface, parent), boundaries);
    ImportJson medium;
    if (votes.empty() && !camera_medium.empty()) {
      medium = camera_medium;
      note("a shape without a medium interface leaves rays in their medium: it is taken to stand in the camera's, \"" + camera_medium +
           "\"");
    } else if (!votes.empty()) {
      const auto most = std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
      medium = ImportJson::parse(most->first);
      const std::string name = medium.is_string() ? "\"" + medium.get<std::string>() + "\""
                               : medium.is_null() ? "vacuum"
                                                  : "the medium most of it is in";
      if (votes.size() > 1)
        note("a shape without a medium interface leaves rays in their medium, and this one stands in several: it is taken to stand in " +
             name);
    }
    if (medium.is_null()) return;
    surface["inside"] = medium;
    surface["outside"] = medium;
  });
}

}  // namespace stokes
