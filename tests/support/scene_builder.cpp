// See scene_builder.h.
#include "support/scene_builder.h"

#include <numbers>

namespace stokes::tests {
namespace {

SpectrumPtr spectrum(SpectrumKind kind, double value) {
  auto s = std::make_shared<Spectrum>();
  s->kind = kind;
  s->value = value;
  return s;
}

}  // namespace

SpectrumPtr number(double value) { return spectrum(SpectrumKind::Number, value); }
SpectrumPtr constant(double value) { return spectrum(SpectrumKind::Constant, value); }

SpectrumPtr box(double begin, double end, double value) {
  auto s = std::make_shared<Spectrum>();
  s->kind = SpectrumKind::Box;
  s->value = value;
  s->a = begin;
  s->b = end;
  return s;
}

SpectrumPtr sum(std::vector<SpectrumPtr> of) {
  auto s = std::make_shared<Spectrum>();
  s->kind = SpectrumKind::Sum;
  s->of = std::move(of);
  return s;
}

MaterialPtr lambertian(double albedo) {
  auto m = std::make_shared<MaterialDescription>();
  m->kind = MaterialKind::Lambertian;
  m->albedo.spectrum = number(albedo);
  return m;
}

MaterialPtr dielectric(double ior) {
  auto m = std::make_shared<MaterialDescription>();
  m->kind = MaterialKind::Dielectric;
  m->ior = number(ior);
  return m;
}

MaterialPtr interface_material() {
  auto m = std::make_shared<MaterialDescription>();
  m->kind = MaterialKind::Interface;
  return m;
}

MaterialPtr black() { return lambertian(0); }

MediumPtr medium(double sigma_t, double albedo, double g) {
  auto m = std::make_shared<MediumDescription>();
  m->sigma_t = number(sigma_t);
  m->albedo = number(albedo);
  m->g = number(g);
  return m;
}

Affine translation(Vec3d t) { return {{1, 0, 0, t.x, 0, 1, 0, t.y, 0, 0, 1, t.z}}; }
Affine scaling(Vec3d s) { return {{s.x, 0, 0, 0, 0, s.y, 0, 0, 0, 0, s.z, 0}}; }
Affine frame(Vec3d x, Vec3d y, Vec3d z, Vec3d o) { return {{x.x, y.x, z.x, o.x, x.y, y.y, z.y, o.y, x.z, y.z, z.z, o.z}}; }

SurfaceDescription rectangle(const Affine& transform, double width, double height, MaterialPtr material) {
  SurfaceDescription s;
  s.kind = SurfaceKind::Quad;
  s.width = width;
  s.height = height;
  s.transform = transform;
  s.material = std::move(material);
  return s;
}

SurfaceDescription horizontal_square(double z, double side, MaterialPtr material) {
  return rectangle(translation({0, 0, z}), side, side, std::move(material));
}

SurfaceDescription sphere(Vec3d center, double radius, MaterialPtr material) {
  SurfaceDescription s;
  s.kind = SurfaceKind::Sphere;
  s.radius = radius;
  s.transform = translation(center);
  s.material = std::move(material);
  return s;
}

CameraDescription parallel_camera(double degrees, double distance, double height, int pixels, Vec3d at) {
  const double angle = degrees * std::numbers::pi / 180;
  const Vec3d towards_camera = {std::sin(angle), 0, std::cos(angle)}, y = {0, 1, 0};
  CameraDescription camera;
  camera.orthographic = true;
  camera.height = height;
  camera.width = camera.height_pixels = pixels;
  camera.transform = frame(cross(y, towards_camera), y, towards_camera, at + towards_camera * distance);
  return camera;
}

SceneDescription empty_scene(const CameraDescription& camera, IntegratorKind integrator, ColorMode mode) {
  SceneDescription scene;
  scene.camera = camera;
  scene.integrator.kind = integrator;
  scene.integrator.mode = mode;
  scene.integrator.max_bounces = 100000;
  scene.integrator.russian_roulette = 8;
  return scene;
}

std::shared_ptr<const MeshData> cube_mesh(double half) {
  auto mesh = std::make_shared<MeshData>();
  for (int i = 0; i < 8; i++) mesh->positions.push_back({i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half});
  // Counter-clockwise seen from outside.
  mesh->triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

}  // namespace stokes::tests
