// See scene_checks.h.
#include "fuzz/scene_checks.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <set>

#include "fuzz/checks.h"

namespace stokes::fuzz {
namespace {

void require(bool holds, const char* what, const std::string& pointer) {
  if (!holds) finding(what, pointer);
}

bool finite(std::initializer_list<double> numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
}

bool finite(const Affine& a) {
  return std::all_of(a.m.begin(), a.m.end(), [](double x) { return std::isfinite(x); });
}

// Names make graphs, so that each thing is looked at once.
class Walk {
 public:
  void spectrum(const SpectrumPtr& s) {
    if (!s || !seen_.insert(s.get()).second) return;
    require(finite({s->value, s->a, s->b, s->scale, s->uv.value_or(0)}) && is_finite(s->rgb), "a spectrum's number that is not finite", s->pointer);
    for (int i = 0; i < 3; i++) require(finite({s->sellmeier_b[i], s->sellmeier_c[i]}), "a Sellmeier coefficient that is not finite", s->pointer);
    if (s->kind == SpectrumKind::Sampled) samples(*s);
    if (s->kind == SpectrumKind::Box) require(s->a < s->b, "a box without width", s->pointer);
    if (s->kind == SpectrumKind::Gaussian) require(s->b > 0, "a Gaussian without width", s->pointer);
    if (s->kind == SpectrumKind::Blackbody) require(s->a > 0, "a blackbody without temperature", s->pointer);
    if (s->kind == SpectrumKind::Product || s->kind == SpectrumKind::Sum) require(!s->of.empty(), "a combination of nothing", s->pointer);
    for (const SpectrumPtr& part : s->of) {
      require(part != nullptr, "a combination of nothing", s->pointer);
      spectrum(part);
    }
  }

  void texture(const TexturePtr& t) {
    if (!t || !seen_.insert(t.get()).second) return;
    require(finite({t->scale, t->parameter}) && finite(t->transform), "a texture's number that is not finite", t->pointer);
    require((t->kind == TextureKind::Image) == (t->image != nullptr), "a texture without its image", t->pointer);
    for (const RegionShapeDescription& shape : t->shapes)
      require(is_finite(shape.a) && is_finite(shape.b) && finite({shape.radius}), "a region that is not finite", t->pointer);
    color(t->a);
    color(t->b);
  }

  void material(const MaterialPtr& m) {
    if (!m || !seen_.insert(m.get()).second) return;
    require(finite({m->roughness, m->alpha, m->exponent}) && m->roughness >= 0 && m->alpha >= 0 && m->exponent >= 0, "a material's number out of range", m->pointer);
    require(!m->amount || (*m->amount >= 0 && *m->amount <= 1), "an amount out of range", m->pointer);
    require(!m->power || (*m->power >= 0 && finite({*m->power})), "a power out of range", m->pointer);
    if (m->kind == MaterialKind::Blend) require(m->a && m->b && (m->amount || m->amount_texture), "a blend that lacks a part", m->pointer);
    if (m->kind == MaterialKind::DiffuseFluorescent) require(!m->dyes.empty(), "a fluorescent material without dyes", m->pointer);
    if (m->kind == MaterialKind::DiffuseLight) require(m->emit || m->emit_texture, "a light without emission", m->pointer);
    for (const SpectrumPtr& s : {m->ior, m->eta, m->k, m->emit}) spectrum(s);
    for (const TexturePtr& t : {m->emit_texture, m->amount_texture}) texture(t);
    color(m->albedo);
    dyes(m->dyes);
    material(m->a);
    material(m->b);
    if (m->skin) {
      require(m->skin->epidermis && m->skin->dermis && finite({m->skin->thickness}) && m->skin->thickness > 0, "a skin that lacks a layer", m->pointer);
      medium(m->skin->epidermis);
      medium(m->skin->dermis);
    }
  }

  void medium(const MediumPtr& m) {
    if (!m || !seen_.insert(m.get()).second) return;
    int given = 0;
    for (const SpectrumPtr& s : {m->sigma_t, m->sigma_s, m->sigma_a, m->albedo}) {
      given += s != nullptr;
      spectrum(s);
    }
    require(given == (m->vacuum ? 0 : 2), "a medium of another number of coefficients", m->pointer);
    spectrum(m->g);
    dyes(m->dyes);
  }

  void surface(const SurfaceDescription& s) {
    require(s.material != nullptr, "a surface without a material", s.pointer);
    require(finite({s.width, s.height, s.radius}) && s.width > 0 && s.height > 0 && s.radius > 0, "a surface's size out of range", s.pointer);
    require((s.kind == SurfaceKind::Triangle || s.kind == SurfaceKind::Mesh) == (s.mesh != nullptr), "a surface without its mesh", s.pointer);
    if (s.mesh) mesh(*s.mesh, s.pointer);
    material(s.material);
    medium(s.outside);
    medium(s.inside);
    spectrum(s.emit);
  }

 private:
  void color(const ColorSource& c) {
    spectrum(c.spectrum);
    texture(c.texture);
  }

  void dyes(const std::vector<DyeDescription>& list) {
    for (const DyeDescription& dye : list) {
      require(dye.absorption && dye.emission, "a dye without its curves", dye.pointer);
      require(dye.yield >= 0 && dye.yield <= 1 && dye.concentration >= 0 && finite({dye.concentration}), "a dye's number out of range", dye.pointer);
      spectrum(dye.absorption);
      spectrum(dye.emission);
    }
  }

  static void samples(const Spectrum& s) {
    require(!s.wavelengths.empty() && s.wavelengths.size() == s.values.size(), "a curve of unequal columns", s.pointer);
    for (std::size_t i = 0; i < s.values.size(); i++)
      require(finite({s.wavelengths[i], s.values[i]}) && (i == 0 || s.wavelengths[i] > s.wavelengths[i - 1]), "a curve out of order", s.pointer);
  }

  static void mesh(const MeshData& mesh, const std::string& pointer) {
    const std::size_t n = mesh.positions.size();
    require(!mesh.triangles.empty() && (mesh.normals.empty() || mesh.normals.size() == n) && (mesh.uvs.empty() || mesh.uvs.size() == n), "a mesh of unequal arrays", pointer);
    for (const auto& triangle : mesh.triangles)
      for (const auto v : triangle) require(v < n, "a mesh with an index out of range", pointer);
    for (const Vec3d& p : mesh.positions) require(is_finite(p), "a mesh with a position that is not finite", pointer);
    for (const Vec3d& p : mesh.normals) require(is_finite(p), "a mesh with a normal that is not finite", pointer);
    for (const auto& uv : mesh.uvs) require(finite({uv[0], uv[1]}), "a mesh with a uv that is not finite", pointer);
  }

  std::set<const void*> seen_;
};

void check_settings(const SceneDescription& s) {
  const CameraDescription& c = s.camera;
  require(finite(c.transform) && finite({c.vfov, c.height, c.fdist, c.aperture}), "a camera's number that is not finite", c.pointer);
  require(c.vfov > 0 && c.vfov < 180 && c.height > 0 && c.fdist > 0 && c.aperture >= 0 && c.width > 0 && c.height_pixels > 0, "a camera's number out of range", c.pointer);
  const IntegratorDescription& i = s.integrator;
  require(i.max_bounces >= 0 && i.russian_roulette.value_or(0) >= 0 && (i.wavelengths_per_path == 1 || i.wavelengths_per_path == 4 || i.wavelengths_per_path == 8),
          "an integrator's number out of range", "/integrator");
  require(finite({s.background.rotate, s.background.scale}) && s.background.scale >= 0, "a background's number out of range", s.background.pointer);
  require(s.samples > 0, "no samples", "/sampler");
  if (s.spectral_bins) require(s.spectral_bins->begin < s.spectral_bins->end && s.spectral_bins->count > 0, "bins out of order", "/film");
}

}  // namespace

void check_description(const SceneDescription& scene) {
  check_settings(scene);
  Walk walk;
  for (const SpectrumPtr& s : scene.spectra) walk.spectrum(s);
  for (const MediumPtr& m : scene.media) walk.medium(m);
  for (const MaterialPtr& m : scene.materials) walk.material(m);
  for (const SurfaceDescription& s : scene.surfaces) {
    walk.surface(s);
    require(finite(s.transform), "a surface's transform that is not finite", s.pointer);
  }
  walk.spectrum(scene.background.emission);
  if (scene.camera.medium) walk.medium(*scene.camera.medium);
}

}  // namespace stokes::fuzz
