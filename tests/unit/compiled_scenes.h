// Small scene descriptions for the tests of compile_scene, built without the reader.
#pragma once
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

#include "compiled/compiled_scene.h"

namespace stokes::test {

inline SpectrumPtr number(double value) {
  Spectrum s;
  s.value = value;
  s.pointer = "/number";
  return std::make_shared<const Spectrum>(s);
}
inline SpectrumPtr constant(double value) {
  Spectrum s;
  s.kind = SpectrumKind::Constant;
  s.value = value;
  s.pointer = "/constant";
  return std::make_shared<const Spectrum>(s);
}
inline SpectrumPtr color(Vec3d rgb) {
  Spectrum s;
  s.kind = SpectrumKind::Rgb;
  s.rgb = rgb;
  s.pointer = "/rgb";
  return std::make_shared<const Spectrum>(s);
}
inline SpectrumPtr box(double a, double b, double value) {
  Spectrum s;
  s.kind = SpectrumKind::Box;
  s.a = a, s.b = b, s.value = value;
  s.pointer = "/box";
  return std::make_shared<const Spectrum>(s);
}
inline SpectrumPtr sampled(std::vector<double> wavelengths, std::vector<double> values) {
  Spectrum s;
  s.kind = SpectrumKind::Sampled;
  s.wavelengths = std::move(wavelengths), s.values = std::move(values);
  s.pointer = "/sampled";
  return std::make_shared<const Spectrum>(s);
}

inline Affine translate(Vec3d t) { return {{1, 0, 0, t.x, 0, 1, 0, t.y, 0, 0, 1, t.z}}; }
inline Affine scale(Vec3d s) { return {{s.x, 0, 0, 0, 0, s.y, 0, 0, 0, 0, s.z, 0}}; }
inline Affine rotate_z(double radians) {
  const double c = std::cos(radians), s = std::sin(radians);
  return {{c, -s, 0, 0, s, c, 0, 0, 0, 0, 1, 0}};
}
inline Affine rotate_x(double radians) {
  const double c = std::cos(radians), s = std::sin(radians);
  return {{1, 0, 0, 0, 0, c, -s, 0, 0, s, c, 0}};
}

inline MaterialDescription material(MaterialKind kind) {
  MaterialDescription m;
  m.kind = kind;
  m.pointer = "/materials/0";
  return m;
}
inline MaterialPtr share(MaterialDescription m) { return std::make_shared<const MaterialDescription>(std::move(m)); }
inline MaterialPtr lambertian(double albedo = 0.5) {
  MaterialDescription m = material(MaterialKind::Lambertian);
  m.albedo.spectrum = number(albedo);
  return share(m);
}
inline MaterialPtr light(SpectrumPtr emit) {
  MaterialDescription m = material(MaterialKind::DiffuseLight);
  m.emit = std::move(emit);
  return share(m);
}

inline SurfaceDescription quad(MaterialPtr m, Affine transform = {}, double width = 1, double height = 1) {
  SurfaceDescription s;
  s.kind = SurfaceKind::Quad;
  s.width = width, s.height = height;
  s.material = std::move(m);
  s.transform = transform;
  s.pointer = "/surfaces/0";
  return s;
}
inline SurfaceDescription sphere(MaterialPtr m, Affine transform = {}, double radius = 1) {
  SurfaceDescription s = quad(std::move(m), transform);
  s.kind = SurfaceKind::Sphere;
  s.radius = radius;
  return s;
}
inline SurfaceDescription mesh(MaterialPtr m, MeshData data, Affine transform = {}) {
  SurfaceDescription s = quad(std::move(m), transform);
  s.kind = SurfaceKind::Mesh;
  s.mesh = std::make_shared<const MeshData>(std::move(data));
  return s;
}
/// One triangle in the xy-plane, counter-clockwise seen from +z.
inline MeshData one_triangle() {
  MeshData m;
  m.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  m.triangles = {{0, 1, 2}};
  return m;
}
/// A bumpy sphere of 2 n^2 triangles.
MeshData bumpy_sphere(int n);

/// A scene of these surfaces, seen from (0, 0, 5) along -z.
inline SceneDescription scene_of(std::vector<SurfaceDescription> surfaces) {
  SceneDescription scene;
  scene.surfaces = std::move(surfaces);
  scene.camera.transform = translate({0, 0, 5});
  scene.camera.pointer = "/camera";
  scene.background.pointer = "/background";
  return scene;
}

/// What the SceneError of a scene says; empty when there is none.
inline std::string error_of(const SceneDescription& scene, const CompileOptions& options = {}) {
  try {
    compile_scene(scene, options);
  } catch (const SceneError& e) {
    return e.what();
  }
  return "";
}

/// The value of table `t` at a whole nanometre, from the right.
inline float table_at(const CompiledScene& s, std::uint32_t t, int nm) {
  return s.spectra[std::size_t(t) * STOKES_SPECTRUM_STRIDE + 2 * std::size_t(nm - 280)];
}

}  // namespace stokes::test
