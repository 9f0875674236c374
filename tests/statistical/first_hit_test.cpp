// What the camera's rays meet first, where the camera stands in a medium: surfaces as if the medium were not there, alpha 1 everywhere.
#include <gtest/gtest.h>

#include "support/backends.h"
#include "support/scene_builder.h"

namespace stokes::tests {
namespace {

/// A plate two units away that covers the left half of the picture, in fog without end: five mean free paths before the plate.
CompiledScene plate_in_fog() {
  SceneDescription scene = empty_scene(parallel_camera(0, 3, 1, 4), IntegratorKind::Mis, ColorMode::Spectral);
  scene.camera.medium = medium(2.5, 0.5, 0);
  SurfaceDescription plate = rectangle(translation({-5, 0, 1}), 10, 10, lambertian(0.4));
  plate.outside = plate.inside = *scene.camera.medium;
  scene.surfaces = {plate};
  scene.background.emission = number(1);
  CompileOptions options;
  options.film_channels = FILM_ALBEDO | FILM_NORMAL | FILM_DEPTH;
  return compile_scene(scene, options);
}

void expect_plate(const Image& image) {
  const auto value = [&](const char* name, int x, int y) {
    const Image::Channel* c = image.find(name);
    EXPECT_TRUE(c) << name;
    return c ? c->values[std::size_t(y * 4 + x)] : -1;
  };
  double plate_albedo = 0;
  // The columns at the plate's edge are left out: a sample on it may fall to either side.
  for (int y = 0; y < 4; y++)
    for (int x = 0; x < 4; x += 3) {
      const bool left = x < 2;
      EXPECT_NEAR(value("A", x, y), 1, 1e-6) << x << ' ' << y;
      EXPECT_NEAR(value("Z", x, y), left ? 2 : 0, 1e-5) << x << ' ' << y;
      EXPECT_NEAR(value("N.Z", x, y), left ? 1 : 0, 1e-6) << x << ' ' << y;
      if (left) plate_albedo += value("Albedo.G", x, y) / 4;
      else EXPECT_EQ(value("Albedo.G", x, y), 0) << x << ' ' << y;
    }
  EXPECT_NEAR(plate_albedo, 0.4, 0.01);
}

TEST(FirstHit, ReferenceSeesSurfacesThroughTheMedium) { expect_plate(develop(render_by_reference(plate_in_fog(), 4000, 1), false)); }
TEST(FirstHit, OpenclSeesSurfacesThroughTheMedium) { expect_plate(develop(render_by_opencl(plate_in_fog(), 4000, 1), false)); }

}  // namespace
}  // namespace stokes::tests
