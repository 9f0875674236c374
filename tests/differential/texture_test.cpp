// Textures of the kernels against the reference: colours, amounts, masks, and textures within textures.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "reference/texture.h"
#include "support/kernel_program.h"
#include "support/test_shapes.h"

namespace stokes::testing {
namespace {

constexpr std::size_t kRays = 1 << 13;

/// A mesh, quads, spheres, and one texture of each kind; see the comments for their indices.
CompiledScene texture_scene(bool rgb) {
  CompiledScene s = shapes_scene(6, 6, 4, 3);
  Mesh mesh = soup_mesh(60, 5, 0.5);
  s.positions = mesh.positions, s.triangles = mesh.triangles;
  s.header.triangle_count = layout::uint(mesh.triangles.size());
  const compiled::Bvh bvh = compiled::build_bvh(s.positions, s.triangles, 8);
  s.bvh_nodes = bvh.nodes, s.bvh_leaves = bvh.leaves;
  s.surfaces[0].flags = SURFACE_HAS_UV;
  Numbers u(9);
  for (std::size_t i = 0; i < 2 * s.positions.size(); i++) s.uvs.push_back(float(3 * u.signed_one()));
  // Tables 0 to 4.
  for (int t = 0; t < 5; t++)
    for (int i = 0; i < (rgb ? 3 : 1000); i++) s.spectra.push_back(float(0.2 * t + (rgb ? 0.05 * i : 0.1 * std::sin(i / 100.0))));
  const auto texture = [&](layout::TextureType type, layout::uint a, layout::uint b) -> layout::Texture& {
    layout::Texture t{};
    t.type = type, t.a = a, t.b = b, t.scale = 0.13f, t.parameter = 0.07f;
    for (int i = 0; i < 12; i++) t.to_texture[i] = float(i % 5 == 0 ? 1.5 : 0.3 * u.signed_one());
    s.textures.push_back(t);
    return s.textures.back();
  };
  const auto image = [&](layout::uint flags, layout::uint illuminant) {
    layout::Texture& t = texture(layout::TEXTURE_IMAGE, STOKES_NONE, illuminant);
    t.flags = flags, t.image_offset = layout::uint(s.texels.size()), t.image_width = 5, t.image_height = 7;
    for (int i = 0; i < 35 * (flags & TEXTURE_SCALAR_IMAGE ? 1 : 4); i++) s.texels.push_back(float(3 * u.signed_one()));
  };
  texture(layout::TEXTURE_CHECKER, 0, 1);                                             // 0
  texture(layout::TEXTURE_MARBLE, 2, 3).scale = 4;                                    // 1
  image(0, STOKES_NONE);                                                              // 2
  image(TEXTURE_WRAP_CLAMP, 4);                                                       // 3
  image(TEXTURE_NEAREST, STOKES_NONE);                                                // 4
  texture(layout::TEXTURE_WIREFRAME, 0 | STOKES_TEXTURE_BIT, 1 | STOKES_TEXTURE_BIT); // 5: checker, marble
  texture(layout::TEXTURE_CHECKER, 5 | STOKES_TEXTURE_BIT, 2 | STOKES_TEXTURE_BIT);   // 6: three deep
  texture(layout::TEXTURE_FRESNEL, STOKES_NONE, STOKES_NONE).parameter = 1.5f;        // 7
  layout::Texture& region = texture(layout::TEXTURE_REGION, STOKES_NONE, STOKES_NONE);// 8
  region.shape_count = 3;
  s.regions = {{{0.5f, 0, 0}, 0.4f, {0, 0, 0}, layout::REGION_SPHERE}, {{-1, -1, -1}, 0, {0, 0, 0}, layout::REGION_BOX},
               {{0, 0.5f, 0.5f}, 0.3f, {1, 1, -1}, layout::REGION_CAPSULE}};
  texture(layout::TEXTURE_VERTEX_MASK, STOKES_NONE, STOKES_NONE).image_offset = layout::uint(s.texels.size()); // 9
  for (std::size_t i = 0; i < s.positions.size(); i++) s.texels.push_back(float(u.one()));
  image(TEXTURE_SCALAR_IMAGE, STOKES_NONE);                                           // 10
  texture(layout::TEXTURE_CHECKER, 7 | STOKES_TEXTURE_BIT, 2);                        // 11: fresnel or the number of table 2
  return s;
}

struct Sample {
  reference::SurfacePoint point;
  Vec3d wo;
  bool hit;
};
/// The reference's point, from the kernel's position and coordinates: textures alone are compared.
Sample sample_of(const CompiledScene& scene, const float* words, const Ray& ray) {
  Sample s{};
  std::int32_t primitive;
  std::memcpy(&primitive, words + 7, 4);
  s.hit = primitive >= 0;
  if (!s.hit) return s;
  const Vec3d position{words[0], words[1], words[2]};
  const bool triangle = reference::primitive_ref(scene, std::uint32_t(primitive)).kind == reference::PrimitiveKind::Triangle;
  s.point = reference::surface_point(scene, std::uint32_t(primitive), position, triangle ? words[5] : words[3], triangle ? words[6] : words[4]);
  EXPECT_NEAR(s.point.u, words[3], 3e-5);
  EXPECT_NEAR(s.point.v, words[4], 3e-5);
  s.point.u = words[3], s.point.v = words[4];
  s.wo = {-ray.d[0], -ray.d[1], -ray.d[2]};
  return s;
}

std::vector<Ray> texture_rays() {
  Numbers u(7);
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < kRays; i++) {
    const Vec3d o = u.cube(1.5), d = u.direction();
    rays.push_back(make_ray(o.x, o.y, o.z, d.x, d.y, d.z));
  }
  return rays;
}

KernelProgram program_for(const CompiledScene& scene, int lanes, bool rgb) {
  KernelVariant v;
  v.lanes = lanes;
  v.rgb = rgb;
  v.wavelengths = rgb ? 3 : 4;
  v.x86 = lanes != 1;
  v.without = {"SMOOTH_NORMALS"};
  KernelProgram program("tests/differential/probes.cl", v);
  program.set_scene(scene);
  return program;
}

class KernelTexture : public ::testing::TestWithParam<bool> {};

TEST_P(KernelTexture, ColoursMatchTheReference) {
  const bool rgb = GetParam();
  const std::size_t count = rgb ? 3 : 4;
  const CompiledScene scene = texture_scene(rgb);
  const std::vector<Ray> rays = texture_rays();
  std::vector<std::uint32_t> refs;
  std::vector<float> lambdas, colors(kRays * count), points(kRays * 8);
  Numbers u(3);
  for (std::size_t i = 0; i < kRays; i++) {
    const auto texture = std::uint32_t(i % 8);
    refs.push_back(texture == 7 ? 3u : texture | STOKES_TEXTURE_BIT);
    for (std::size_t k = 0; k < count; k++) lambdas.push_back(rgb ? float(k) : float(300 + 450 * u.one()));
  }
  std::vector<std::vector<float>> all;
  for (int lanes : {8, 1}) {
    KernelProgram program = program_for(scene, lanes, rgb);
    program.run_with_scene("probe_color", kRays / std::size_t(lanes), ray_floats(rays), refs, lambdas, Out{colors}, Out{points});
    all.push_back(colors);
  }
  EXPECT_EQ(std::memcmp(all[0].data(), all[1].data(), colors.size() * 4), 0);
  int hits = 0, different[8] = {};
  for (std::size_t i = 0; i < kRays; i++) {
    const Sample s = sample_of(scene, &points[8 * i], rays[i]);
    hits += s.hit;
    for (std::size_t k = 0; k < count; k++) {
      const reference::Wavelength w{rgb ? 0.0 : double(lambdas[i * count + k]), rgb ? int(k) : -1};
      const double exact = s.hit ? reference::color_eval(scene, refs[i], s.point, s.wo, w) : 0;
      if (std::abs(colors[i * count + k] - exact) > 5e-4) different[i % 8]++;
    }
  }
  EXPECT_GT(hits, 1500);
  // At the border of two squares, wires or texels a rounding may choose the other.
  for (int t = 0; t < 8; t++) EXPECT_LE(different[t], 8) << "texture " << t;
}
INSTANTIATE_TEST_SUITE_P(Modes, KernelTexture, ::testing::Bool());

TEST(KernelTextureScalar, AmountsMatchTheReference) {
  const CompiledScene scene = texture_scene(false);
  const std::vector<Ray> rays = texture_rays();
  KernelProgram program = program_for(scene, 8, false);
  const std::uint32_t kinds[] = {7, 8, 9, 10, 11};
  std::vector<std::uint32_t> textures;
  for (std::size_t i = 0; i < kRays; i++) textures.push_back(kinds[i % 5]);
  std::vector<float> values(kRays), points(kRays * 8);
  program.run_with_scene("probe_scalar", kRays / 8, ray_floats(rays), textures, Out{values}, Out{points});
  int different[5] = {};
  double sums[5] = {};
  for (std::size_t i = 0; i < kRays; i++) {
    const Sample s = sample_of(scene, &points[8 * i], rays[i]);
    if (!s.hit) continue;
    double exact = reference::texture_eval(scene, textures[i], s.point, s.wo, {280, -1});
    if (std::abs(values[i] - exact) > 2e-4) different[i % 5]++;
    sums[i % 5] += std::abs(values[i]);
  }
  for (int k = 0; k < 5; k++) {
    EXPECT_LE(different[k], 4) << "texture " << kinds[k];
    EXPECT_GT(sums[k], 10) << "texture " << kinds[k];
  }
}

}  // namespace
}  // namespace stokes::testing
