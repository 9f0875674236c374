// From surface descriptions to primitives in world space, each with its surface record.
#include <algorithm>
#include <cmath>

#include "compiled/bounds.h"
#include "compiled/compilation.h"
#include "compiled/shapes.h"

namespace stokes::compiled {
namespace {

// The record that a surface's primitives share: material, media of its two sides, emission.
std::uint32_t append_surface(Compilation& c, const SurfaceDescription& s) {
  layout::Surface record{};
  record.material = compile_material(c, *s.material);
  record.medium_outside = compile_medium(c, s.outside.get());
  record.medium_inside = compile_medium(c, s.inside.get());
  record.emission = compile_emission(c, *s.material);
  if (s.emit) {
    Curve own = c.spectra.curve(*s.emit, SpectrumRole::Emission);
    for (double& v : own) v = std::max(v, 0.0);
    if (record.emission != STOKES_NONE) {
      if (record.emission & STOKES_TEXTURE_BIT) c.fail(s.pointer, "`emit` beside a textured light is not supported; put it into the texture");
      const Curve other = c.spectra.read(record.emission);
      for (std::size_t i = 0; i < own.size(); i++) own[i] += other[i];
    }
    record.emission = c.spectra.add(own);
  }
  if (s.flip) record.flags |= SURFACE_FLIPPED;
  if (c.out.materials[record.material].type == layout::MATERIAL_INTERFACE) {
    record.flags |= SURFACE_INTERFACE;
    c.out.features.interfaces = true;
  }
  if (s.kind == SurfaceKind::Quad || s.kind == SurfaceKind::Sphere) record.flags |= SURFACE_HAS_UV;
  c.out.surfaces.push_back(record);
  c.out.surface_names.push_back(s.name.empty() ? s.pointer : s.name);
  return std::uint32_t(c.out.surfaces.size() - 1);
}

void append_sphere(Compilation& c, const SurfaceDescription& s, std::uint32_t index) {
  const double radius = std::abs(s.radius);
  const bool flip = s.flip != (s.radius < 0);
  if (!(radius > 0)) c.fail(s.pointer, "a sphere's radius must not be 0");
  const double determinant = s.transform.determinant();
  if (!(std::abs(determinant) > 0) || !std::isfinite(1 / determinant)) c.fail(s.pointer, "a sphere's transform must be invertible");
  if (uniform_scale(s.transform)) {
    c.out.spheres.push_back(make_sphere(s.transform, radius, flip));
    c.out.spheres.back().surface = index;
  } else {
    c.out.ellipsoids.push_back(make_ellipsoid(s.transform, radius, flip));
    c.out.ellipsoids.back().surface = index;
  }
}

// A quad as two triangles with the quad's own texture coordinates, for scenes with very many.
void append_quad_triangles(Compilation& c, const SurfaceDescription& s, std::uint32_t index) {
  auto mesh = std::make_shared<MeshData>();
  const double w = s.width / 2, h = s.height / 2;
  mesh->positions = {{-w, -h, 0}, {w, -h, 0}, {w, h, 0}, {-w, h, 0}};
  mesh->uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
  SurfaceDescription triangles = s;
  triangles.kind = SurfaceKind::Mesh;
  triangles.mesh = mesh;
  append_mesh(c, triangles, index);
}

void append_quad(Compilation& c, const SurfaceDescription& s, std::uint32_t index) {
  std::optional<layout::Quad> quad = make_quad(s.transform, s.width, s.height, s.flip);
  if (!quad) {
    c.warn(c.out.surface_names[index] + ": a quad without area was dropped");
    return;
  }
  quad->surface = index;
  c.out.quads.push_back(*quad);
}

/// How far the points of a surface can lie from its own origin.
double extent(const SurfaceDescription& s) {
  if (s.kind == SurfaceKind::Quad) return std::hypot(s.width, s.height) / 2;
  if (s.kind == SurfaceKind::Sphere) return std::abs(s.radius);
  double most = 0;
  if (s.mesh)
    for (const Vec3d& p : s.mesh->positions) most = std::max(most, length(p));
  return most;
}

void require_finite(const Compilation& c, const SurfaceDescription& s) {
  for (double v : s.transform.m)
    if (!std::isfinite(v)) c.fail(s.pointer, "the transform is not finite");
  const double scale = std::max({length(s.transform.column(0)), length(s.transform.column(1)), length(s.transform.column(2))});
  if (!(length(s.transform.translation()) + scale * extent(s) <= kFarthestCoordinate)) c.fail(s.pointer, "the surface reaches farther than 1e15 from the origin, beyond what single precision can be trusted with");
}

}  // namespace

void compile_surfaces(Compilation& c) {
  std::size_t quads = 0;
  for (const SurfaceDescription& s : c.scene.surfaces) quads += s.kind == SurfaceKind::Quad;
  for (const SurfaceDescription& s : c.scene.surfaces) {
    require_finite(c, s);
    const std::uint32_t index = append_surface(c, s);
    switch (s.kind) {
      case SurfaceKind::Quad: quads > kMaxAnalyticQuads ? append_quad_triangles(c, s, index) : append_quad(c, s, index); break;
      case SurfaceKind::Sphere: append_sphere(c, s, index); break;
      case SurfaceKind::Triangle:
      case SurfaceKind::Mesh: append_mesh(c, s, index); break;
    }
  }
  c.out.features.quads = !c.out.quads.empty();
  c.out.features.spheres = !c.out.spheres.empty();
  c.out.features.ellipsoids = !c.out.ellipsoids.empty();
  c.out.features.triangles = !c.out.triangles.empty();
}

}  // namespace stokes::compiled
