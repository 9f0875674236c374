// See planted_scenes.h.
#include "planted_scenes.h"

#include "support/scene_builder.h"

namespace stokes::tests {
namespace {

constexpr int kPixels = 32;

SurfaceDescription lamp(Vec3d at, double side, double radiance) {
  SurfaceDescription s = rectangle(frame({1, 0, 0}, {0, -1, 0}, {0, 0, -1}, at), side, side, black());
  s.emit = number(radiance);
  return s;
}

/// An image of 8 x 8 texels on a floor, under a lamp and a dim sky.
ParityScene textured_floor() {
  ParityScene p;
  p.scene = empty_scene(parallel_camera(20, 3, 2, kPixels), IntegratorKind::Mis, ColorMode::Rgb);
  p.scene.integrator.max_bounces = 2;
  auto image = std::make_shared<ImagePixels>();
  image->width = image->height = 8;
  for (int i = 0; i < 64; i++)
    for (const int step : {1, 3, 7}) image->rgb.push_back(float((i * (i + step)) % 9) / 10);
  auto texture = std::make_shared<TextureDescription>();
  texture->kind = TextureKind::Image;
  texture->image = image;
  auto material = std::make_shared<MaterialDescription>(*lambertian(0.5));
  material->albedo.spectrum = nullptr;
  material->albedo.texture = texture;
  p.scene.surfaces = {horizontal_square(0, 2, material), lamp({0.5, 0, 1.5}, 0.5, 10)};
  p.scene.background.emission = number(0.3);
  return p;
}

/// A lit floor in a fog below an index-matched boundary; below the floor the medium is another.
ParityScene foggy_floor() {
  ParityScene p;
  p.scene = empty_scene(parallel_camera(20, 3, 2, kPixels), IntegratorKind::Mis, ColorMode::Rgb);
  p.scene.camera.medium = MediumPtr();
  SurfaceDescription floor = horizontal_square(-0.5, 40, lambertian(0.6)), top = horizontal_square(0, 40, interface_material());
  floor.outside = top.inside = medium(1, 0.4, 0.3);
  floor.inside = medium(4, 0.1, 0);
  p.scene.surfaces = {floor, top, lamp({0.5, 0, 1.5}, 0.5, 10)};
  return p;
}

/// A rough glass ball on a floor.
ParityScene rough_ball() {
  ParityScene p;
  p.scene = empty_scene(parallel_camera(50, 4, 2.5, kPixels, {0, 0, 0.5}), IntegratorKind::Mis, ColorMode::Rgb);
  auto glass = std::make_shared<MaterialDescription>(*dielectric(1.5));
  glass->alpha = 0.6;
  p.scene.surfaces = {horizontal_square(-1, 6, lambertian(0.5)), sphere({}, 1, glass)};
  p.scene.background.emission = number(1);
  p.samples = 512;
  return p;
}

/// A ball of thin chromatic fog in the void, over a floor: lamps of all shapes in it, under a dim sky. `camera_inside` puts the camera in it.
ParityScene lamps_in_fog(bool camera_inside, ColorMode mode) {
  ParityScene p;
  const double distance = camera_inside ? 1.2 : 4;
  p.scene = empty_scene(parallel_camera(20, distance, camera_inside ? 1.2 : 2.4, kPixels), IntegratorKind::Mis, mode);
  auto fog = std::make_shared<MediumDescription>();
  fog->sigma_t = sum({box(280, 550, 0.15), box(550, 780, 0.4)});
  fog->albedo = number(0.9);
  fog->g = sum({box(280, 550, 0), box(550, 780, 0.5)});
  const MediumPtr medium = fog;
  p.scene.camera.medium = camera_inside ? medium : MediumPtr();
  SurfaceDescription boundary = sphere({}, 2, interface_material()), floor = horizontal_square(-0.6, 2, lambertian(0.3));
  boundary.inside = floor.outside = floor.inside = medium;
  SurfaceDescription flat = lamp({0.5, 0.4, 0.4}, 0.1, 20), round = sphere({-0.4, 0.2, 0}, 0.04, black()), long_one = sphere({}, 1, black());
  long_one.transform = translation({0.1, -0.5, 0.1}) * scaling({0.1, 0.02, 0.02});
  round.emit = long_one.emit = number(20);
  for (SurfaceDescription* s : {&flat, &round, &long_one}) s->outside = s->inside = medium;
  round.inside = long_one.inside = nullptr;
  p.scene.surfaces = {boundary, floor, flat, round, long_one};
  p.scene.background.emission = number(0.02);
  return p;
}

}  // namespace

std::map<std::string, ParityScene> parity_scenes() {
  return {{"texture_parity", textured_floor()}, {"fog_parity", foggy_floor()}, {"rough_parity", rough_ball()},
          {"lamps_in_fog_parity", lamps_in_fog(true, ColorMode::Spectral)}, {"ball_of_fog_parity", lamps_in_fog(false, ColorMode::Spectral)}};
}

}  // namespace stokes::tests
