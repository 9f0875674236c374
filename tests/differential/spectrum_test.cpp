// Spectrum tables, wavelength sampling, the sensor and camera rays of the kernels, against the reference in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "compiled/cumulative_table.h"
#include "reference/camera.h"
#include "reference/spectrum.h"
#include "spectral/tabulate.h"
#include "support/kernel_program.h"
#include "support/test_shapes.h"

namespace stokes::testing {
namespace {

KernelProgram program_for(const CompiledScene& scene, int wavelengths = 4, bool rgb = false) {
  KernelVariant v;
  v.wavelengths = wavelengths;
  v.rgb = rgb;
  v.without = {"TRIANGLES", "TEXTURES"};
  KernelProgram program("tests/differential/probes.cl", v);
  program.set_scene(scene);
  return program;
}

/// Smooth, stepped, empty in places, and a single spike.
CompiledScene spectra_scene() {
  CompiledScene s = mesh_scene({}, 8);
  const auto add = [&](const std::function<double(double)>& f) {
    for (int c = 0; c < 500; c++)
      for (int end = 0; end < 2; end++) s.spectra.push_back(float(f(280 + c + (end ? 1 - 1e-9 : 0))));
  };
  add([](double l) { return 0.5 + 0.4 * std::sin(l / 30); });
  add([](double l) { return l >= 400 && l < 410 ? 2.0 : l >= 700 ? 0.1 : 0.0; });
  add([](double l) { return std::exp(-0.5 * std::pow((l - 365) / 10, 2)); });
  add([](double l) { return l >= 555 && l < 556 ? 7.0 : 0.0; });
  for (layout::uint t = 0; t < 4; t++) {
    // Cumulative sums of the trapezia.
    double sum = 0;
    std::array<double, 501> sums{};
    for (std::size_t c = 0; c < 500; c++) {
      sum += 0.5 * (double(s.spectra[t * 1000 + 2 * c]) + s.spectra[t * 1000 + 2 * c + 1]);
      sums[c + 1] = sum;
    }
    std::array<float, 501> cdf{};
    std::transform(sums.begin(), sums.end(), cdf.begin(), [sum](double v) { return float(v / sum); });
    append_cumulative_table(s.cdfs, std::span(s.spectra).subspan(t * 1000, 1000), sum, cdf);
    s.distributions.push_back({t, t, float(sum), 0});
  }
  s.camera_knots = camera_knots(STOKES_CAMERA_KNOTS, 0, 0, 0);
  s.sensor = sensor_table();
  return s;
}

TEST(KernelSpectrum, ReadsTablesAsTheReference) {
  const CompiledScene scene = spectra_scene();
  KernelProgram program = program_for(scene);
  std::vector<std::uint32_t> tables;
  std::vector<float> lambdas;
  Numbers u(3);
  for (std::uint32_t i = 0; i < 8192; i++) {
    tables.push_back(i % 4);
    // Whole nanometres belong to the cell that begins there; outside, the ends hold.
    lambdas.push_back(float(i % 3 ? 280 + 500 * u.one() : std::floor(280 + 501 * u.one())));
  }
  lambdas[0] = 200, lambdas[1] = 900, lambdas[2] = 780, lambdas[3] = 280;
  std::vector<float> values(tables.size());
  program.run_with_scene("probe_spectrum", tables.size() / 8, tables, lambdas, Out{values});
  for (std::size_t i = 4; i < tables.size(); i++)
    EXPECT_NEAR(values[i], reference::spectrum_eval(scene, tables[i], {lambdas[i], -1}), 1e-6) << lambdas[i];
  EXPECT_EQ(values[0], scene.spectra[0]);
  EXPECT_EQ(values[1], scene.spectra[1999]);
}

TEST(KernelSpectrum, RgbModeReadsChannels) {
  CompiledScene scene = mesh_scene({}, 8);
  scene.spectra = {0.1f, 0.2f, 0.3f, 1, 2, 3};
  KernelProgram program = program_for(scene, 3, true);
  const std::vector<std::uint32_t> tables = {0, 0, 0, 1, 1, 1, 0, 1};
  const std::vector<float> channels = {0, 1, 2, 0, 1, 2, 2, 0};
  std::vector<float> values(8), lambdas(24), inverse(24), rgb(24);
  program.run_with_scene("probe_spectrum", 1, tables, channels, Out{values});
  EXPECT_EQ(values, (std::vector<float>{0.1f, 0.2f, 0.3f, 1, 2, 3, 0.3f, 1}));
  program.run_with_scene("probe_wavelengths", 1, channels, Out{lambdas}, Out{inverse}, Out{rgb});
  for (std::size_t i = 0; i < 24; i++) {
    EXPECT_EQ(lambdas[i], float(i % 3));
    EXPECT_EQ(inverse[i], 1.0f);
  }
}

TEST(KernelSpectrum, DistributionsAreSampledByTheirDensity) {
  const CompiledScene scene = spectra_scene();
  KernelProgram program = program_for(scene);
  constexpr std::size_t n = 1 << 16;
  std::vector<std::uint32_t> ids(n);
  std::vector<float> u(n), lambdas(n), pdfs(n), evaluated(n);
  for (std::uint32_t d = 0; d < 4; d++) {
    for (std::size_t i = 0; i < n; i++) ids[i] = d, u[i] = float((double(i) + 0.5) / double(n));
    program.run_with_scene("probe_distribution", n / 8, ids, u, Out{lambdas}, Out{pdfs}, Out{evaluated});
    double inverse = 0;
    for (std::size_t i = 0; i < n; i++) {
      ASSERT_GT(pdfs[i], 0) << d << " " << lambdas[i];
      ASSERT_NEAR(pdfs[i], evaluated[i], 1e-5 * pdfs[i] + 1e-9) << d << " " << lambdas[i];
      double pdf;
      // The cumulative table's rounding moves a sample by at most its own size over the density.
      ASSERT_NEAR(lambdas[i], reference::distribution_sample(scene, d, u[i], pdf), 1e-3 + 3e-7 / pdfs[i]) << d;
      inverse += 1 / double(pdfs[i]) / double(n);
    }
    // The mean of 1/pdf is the length of the support.
    const double support[] = {500, 90, 0, 1};
    if (d != 2) {
      EXPECT_NEAR(inverse / support[d], 1, 2e-3) << d;
    }
  }
}

// Numbers are odd multiples of 2^-24; just above 1/4 a plain sum with 3/4 rounds to 1, and what is left of it to 0.
TEST(KernelSpectrum, StrataStayInsideTheUnitInterval) {
  const CompiledScene scene = spectra_scene();
  for (int count : {1, 4, 8}) {
    KernelProgram program = program_for(scene, count);
    const float ulp = std::ldexp(1.0f, -24);
    std::vector<float> u, least, most;
    for (int k = 0; k < 8; k++)
      for (const float side : {-1.0f, 1.0f}) u.push_back(float(k) / 8 + side * ulp);
    u.front() = u[1], least.resize(u.size()), most.resize(u.size());
    program.run_with_scene("probe_strata", u.size() / 8, u, Out{least}, Out{most});
    for (std::size_t i = 0; i < u.size(); i++) {
      EXPECT_GT(least[i], 0) << count << " " << u[i];
      EXPECT_LT(most[i], 1) << count << " " << u[i];
    }
  }
}

TEST(KernelSpectrum, CameraWavelengthsAreStratifiedAndTheirSensorIntegratesToWhite) {
  const CompiledScene scene = spectra_scene();
  for (int count : {1, 4, 8}) {
    KernelProgram program = program_for(scene, count);
    constexpr std::size_t n = 1 << 14;
    std::vector<float> u(n), lambdas(n * std::size_t(count)), inverse(lambdas.size()), rgb(3 * n);
    for (std::size_t i = 0; i < n; i++) u[i] = float((double(i) + 0.5) / double(n));
    program.run_with_scene("probe_wavelengths", n / 8, u, Out{lambdas}, Out{inverse}, Out{rgb});
    Vec3d sum{0, 0, 0};
    for (std::size_t i = 0; i < n; i++) {
      for (int k = 0; k < count; k++) {
        double shifted = u[i] + double(k) / count;
        shifted -= std::floor(shifted);
        const reference::CameraWavelength e = reference::camera_wavelength(scene, shifted);
        ASSERT_NEAR(lambdas[i * std::size_t(count) + std::size_t(k)], e.wavelength.nm, 1e-3);
        ASSERT_NEAR(inverse[i * std::size_t(count) + std::size_t(k)], e.inverse_pdf, 2e-2 * e.inverse_pdf);
      }
      sum = sum + Vec3d{rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]} * (inverse[i * std::size_t(count)] / double(n));
      const Vec3d exact = reference::sensor_rgb(scene, lambdas[i * std::size_t(count)]);
      ASSERT_NEAR(rgb[3 * i + 1], exact.y, 1e-6);
    }
    const Vec3d white = reference::sensor_white(scene);
    EXPECT_NEAR(sum.x, white.x, 2e-3);
    EXPECT_NEAR(sum.y, white.y, 2e-3);
    EXPECT_NEAR(sum.z, white.z, 2e-3);
  }
}

TEST(KernelCamera, RaysMatchTheReference) {
  for (int kind = 0; kind < 3; kind++) {
    CompiledScene scene = mesh_scene({}, 8);
    layout::Camera& c = scene.header.camera;
    const Vec3d z = normalize(Vec3d{0.3, -0.2, 0.9}), x = normalize(cross({0, 1, 0}, z)), y = cross(z, x);
    c.position = {1, -2, 3};
    c.type = kind == 1 ? layout::CAMERA_ORTHOGRAPHIC : layout::CAMERA_PERSPECTIVE;
    c.axis_x = to_vec3(x), c.axis_y = to_vec3(y), c.axis_z = to_vec3(z);
    c.half_width = 0.8f, c.half_height = 0.6f;
    c.lens_radius = kind == 2 ? 0.1f : 0;
    c.focal_distance = 5;
    c.width = 40, c.height = 30;
    KernelProgram program = program_for(scene);
    Numbers u(3);
    std::vector<float> px, py, lu, lv, o(3 * 1024), d(3 * 1024);
    for (int i = 0; i < 1024; i++) px.push_back(float(40 * u.one())), py.push_back(float(30 * u.one())), lu.push_back(float(u.one())), lv.push_back(float(u.one()));
    program.run_with_scene("probe_camera", 128, px, py, lu, lv, Out{o}, Out{d});
    for (std::size_t i = 0; i < 1024; i++) {
      const reference::Ray e = reference::camera_ray(c, px[i], py[i], lu[i], lv[i]);
      const Vec3d ro{o[3 * i], o[3 * i + 1], o[3 * i + 2]}, rd{d[3 * i], d[3 * i + 1], d[3 * i + 2]};
      EXPECT_LT(length(rd - e.d), 1e-6) << kind;
      // The lens may be sampled by another map of the square: the point in focus must agree.
      const Vec3d focus = e.o + e.d * (5 / -dot(e.d, z)), ours = ro + rd * ((5 + dot(ro - Vec3d{1, -2, 3}, z)) / -dot(rd, z));
      EXPECT_LT(length((kind == 1 ? ro : ours) - (kind == 1 ? e.o : focus)), 1e-5) << kind;
    }
  }
}

}  // namespace
}  // namespace stokes::testing
