// What a skin says of itself, and the second surface that it needs.
#include "scene/skin_reader.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <tuple>

#include "scene/mesh_reader.h"
#include "scene/recent_meshes.h"
#include "scene/spectrum_reader.h"
#include "spectral/skin.h"

namespace stokes {
namespace {

constexpr double kMillimetresPerCentimetre = 10;

SpectrumPtr per_millimetre(Spectrum per_centimetre, const std::string& pointer) {
  per_centimetre.scale /= kMillimetresPerCentimetre;
  per_centimetre.pointer = pointer;
  return std::make_shared<Spectrum>(std::move(per_centimetre));
}

MediumPtr layer(const std::string& name, const Spectrum& sigma_a, const SkinComposition& skin, const ReadContext& context,
                const std::string& pointer) {
  auto m = std::make_shared<MediumDescription>();
  m->name = name;
  m->pointer = pointer;
  m->sigma_a = per_millimetre(sigma_a, pointer);
  m->sigma_s = per_millimetre(skin_sigma_s(skin), pointer);
  m->g = make_number_spectrum(skin.g, pointer);
  // Without a scene unit one scene unit is one millimetre here, as for generated meshes.
  if (context.scene.scene_unit != LengthUnit::None) m->unit = LengthUnit::Millimetre;
  return m;
}

// The skin that a material is, or that lies under its paint.
const SkinDescription* find_skin(const ReadContext& context, const SurfaceDescription& s, const MaterialDescription& m) {
  if (m.kind != MaterialKind::Blend) return m.skin.get();
  const SkinDescription *a = find_skin(context, s, *m.a), *b = find_skin(context, s, *m.b);
  if (a && b && a != b) throw SceneError(context.scene.source, s.pointer, "a surface cannot be two skins at once");
  return a ? a : b;
}

// Positions and triangles alone; vertices that differ in normal or uv only become one, so that seams close.
MeshData welded(const MeshData& mesh) {
  MeshData out;
  std::map<std::tuple<double, double, double>, std::uint32_t> known;
  std::vector<std::uint32_t> place;
  for (const Vec3d& p : mesh.positions) {
    const auto [it, fresh] = known.emplace(std::tuple{p.x, p.y, p.z}, static_cast<std::uint32_t>(out.positions.size()));
    if (fresh) out.positions.push_back(p);
    place.push_back(it->second);
  }
  for (const auto& t : mesh.triangles) out.triangles.push_back({place[t[0]], place[t[1]], place[t[2]]});
  return out;
}

// How much the transform enlarges, when it does so alike in all directions; else 0.
double uniform_scale(const Affine& transform) {
  const double x = length(transform.vector({1, 0, 0})), y = length(transform.vector({0, 1, 0})), z = length(transform.vector({0, 0, 1}));
  const double volume = std::abs(transform.determinant()), mean = std::cbrt(volume);
  return std::abs(x / mean - 1) + std::abs(y / mean - 1) + std::abs(z / mean - 1) < 1e-9 ? mean : 0;
}

Affine translated(Affine transform, Vec3d direction, double distance) {
  const Vec3d t = normalize(direction) * distance;
  transform.m[3] += t.x, transform.m[7] += t.y, transform.m[11] += t.z;
  return transform;
}

std::shared_ptr<const MeshData> shell(const std::shared_ptr<const MeshData>& mesh, double distance, const Affine& to_world) {
  const auto make = [&] {
    std::vector<MeshData> parts = extract_materials(offset_surface(raw_mesh_of(welded(*mesh)), distance, to_world));
    return MadeMesh{{std::make_shared<MeshData>(std::move(parts[0]))}, {""}, {}};
  };
  return recent_mesh("skin" + offset_key(distance, to_world), mesh, make).parts[0];
}

// The same shape `depth` scene units further to the inside.
void sink(const ReadContext& context, SurfaceDescription& s, double depth) {
  const auto fail = [&](const std::string& message) { throw SceneError(context.scene.source, s.pointer, message); };
  const double outwards = s.flip ? depth : -depth;
  switch (s.kind) {
    case SurfaceKind::Quad: {
      s.transform = translated(s.transform, s.transform.normal({0, 0, 1}), outwards);
      return;
    }
    case SurfaceKind::Triangle: {
      const std::vector<Vec3d>& v = s.mesh->positions;
      s.transform = translated(s.transform, s.transform.normal(cross(v[1] - v[0], v[2] - v[0])), outwards);
      return;
    }
    case SurfaceKind::Sphere: {
      const double scale = uniform_scale(s.transform);
      if (scale == 0) fail("skin on a sphere needs a transform that scales alike in all directions (use a mesh)");
      s.radius += outwards / scale;
      if (s.radius <= 0) fail("the sphere is smaller than the epidermis is thick (" + show(depth) + ")");
      return;
    }
    case SurfaceKind::Mesh:
      try {
        s.mesh = shell(s.mesh, outwards, s.transform);
      } catch (const std::runtime_error& error) {
        fail(std::string("skin on this mesh: ") + error.what());
      }
  }
}

SurfaceDescription inner_boundary(const ReadContext& context, const SurfaceDescription& outer, const SkinDescription& skin) {
  SurfaceDescription s = outer;
  auto material = std::make_shared<MaterialDescription>();
  material->kind = MaterialKind::Interface;
  material->name = outer.material->name + " dermis";
  material->pointer = outer.material->pointer;
  s.name = outer.name.empty() ? "" : outer.name + " dermis";
  s.material = material;
  s.outside = skin.epidermis;
  s.inside = skin.dermis;
  s.emit = nullptr;
  sink(context, s, skin.thickness * context.units_per_millimetre());
  return s;
}

}  // namespace

const std::vector<std::string>& skin_keys() {
  static const std::vector<std::string> keys = {
      "melanosome fraction", "blood fraction", "oxygenation", "epidermis thickness", "g", "ior", "alpha"};
  return keys;
}

void read_skin(ReadContext& context, const JsonObject& o, MaterialDescription& m) {
  const std::string& pointer = o.node().pointer();
  const SkinComposition composition{.melanosomes = o.number("melanosome fraction", 0.25, kUnitInterval),
                                    .blood = o.number("blood fraction", 0.01, kUnitInterval),
                                    .saturation = o.number("oxygenation", 0.75, kUnitInterval),
                                    .g = o.number("g", 0.8, {0, 0.99})};
  auto skin = std::make_shared<SkinDescription>();
  skin->thickness = o.number("epidermis thickness", 0.06, {0.001, 10});
  skin->epidermis = layer("epidermis", epidermis_sigma_a(composition), composition, context, pointer);
  skin->dermis = layer("dermis", dermis_sigma_a(composition), composition, context, pointer);
  m.kind = MaterialKind::Dielectric;
  const auto ior = o.find("ior");
  m.ior = ior ? read_spectrum(context, *ior, SpectrumRole::Index, kPositive) : make_number_spectrum(1.4, pointer);
  m.alpha = o.number("alpha", 0, kUnitInterval);
  m.skin = skin;
}

void check_skin(const ReadContext& context, const SurfaceDescription& s) {
  const SkinDescription* skin = find_skin(context, s, *s.material);
  if (!skin) return;
  if (s.inside) throw SceneError(context.scene.source, s.pointer + "/inside", "skin has its own layers inside");
  if (s.kind != SurfaceKind::Mesh) inner_boundary(context, s, *skin);
}

void expand_skin(ReadContext& context) {
  std::vector<SurfaceDescription> all;
  for (SurfaceDescription& s : context.scene.surfaces) {
    check_skin(context, s);
    const SkinDescription* skin = find_skin(context, s, *s.material);
    if (!skin) {
      all.push_back(std::move(s));
      continue;
    }
    SurfaceDescription inner = inner_boundary(context, s, *skin);
    s.inside = skin->epidermis;
    all.push_back(std::move(s));
    all.push_back(std::move(inner));
  }
  context.scene.surfaces = std::move(all);
}

}  // namespace stokes
