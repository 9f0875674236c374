// The reference's samplers against their densities (chi-square), its weights against value over density, reciprocity, and the moments of
// the phase function.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "reference/bsdf.h"
#include "reference/phase.h"
#include "reference/sampling.h"
#include "support/truth.h"

namespace stokes::reference {
namespace {

constexpr int kThetaCells = 16, kPhiCells = 24, kSamples = 200000;
// Narrow lobes about the poles need a fine step in the cosine.
constexpr int kThetaSteps = 200, kPhiSteps = 6;

/// The probability that a chi-square variable of `k` degrees of freedom exceeds x (Wilson & Hilferty 1931).
double chi_square_p(double x, int k) {
  const double v = 2.0 / (9.0 * k);
  return 0.5 * std::erfc((std::cbrt(x / k) - (1 - v)) / std::sqrt(2 * v));
}

struct Grid {
  std::vector<double> cells = std::vector<double>(kThetaCells * kPhiCells, 0.0);
  static std::size_t index(Vec3d d) {
    const int theta = std::min(kThetaCells - 1, int((1 - d.z) / 2 * kThetaCells));
    const int phi = std::min(kPhiCells - 1, int((std::atan2(d.y, d.x) / (2 * kPi) + 0.5) * kPhiCells));
    return std::size_t(theta * kPhiCells + phi);
  }
};

/// Integrates a density over the cells by the midpoint rule.
template <typename Density>
Grid integrate(Density density) {
  Grid grid;
  const double solid_angle = 4 * kPi / (kThetaCells * kPhiCells * kThetaSteps * kPhiSteps);
  for (int i = 0; i < kThetaCells * kThetaSteps; i++)
    for (int j = 0; j < kPhiCells * kPhiSteps; j++) {
      const double z = 1 - 2 * (i + 0.5) / (kThetaCells * kThetaSteps), phi = 2 * kPi * ((j + 0.5) / (kPhiCells * kPhiSteps) - 0.5);
      const double s = std::sqrt(1 - z * z);
      const Vec3d d = {s * std::cos(phi), s * std::sin(phi), z};
      grid.cells[Grid::index(d)] += density(d) * solid_angle;
    }
  return grid;
}

/// Cells with few expected samples are pooled. Prints the statistic; the threshold is p = 1e-4.
void check_chi_square(const std::string& name, const Grid& expected, const Grid& counted, int samples) {
  double statistic = 0, pooled_expected = 0, pooled_counted = 0;
  int cells = 0;
  for (std::size_t i = 0; i < expected.cells.size(); i++) {
    const double e = expected.cells[i] * samples;
    if (e < 10) {
      pooled_expected += e, pooled_counted += counted.cells[i];
      continue;
    }
    statistic += square(counted.cells[i] - e) / e;
    cells++;
  }
  if (pooled_expected > 5) statistic += square(pooled_counted - pooled_expected) / pooled_expected, cells++;
  ASSERT_GT(cells, 3) << name;
  const double p = chi_square_p(statistic, cells);
  std::printf("%s: chi-square %.1f over %d cells, p %.3g (threshold 1e-4)\n", name.c_str(), statistic, cells, p);
  EXPECT_GT(p, 1e-4) << name;
}

struct Lobe {
  std::string name;
  Bsdf bsdf;
};

std::vector<Lobe> lobes() {
  const auto make = [](std::string name, std::uint32_t type, double parameter, double eta, double k) {
    Bsdf b;
    b.type = type;
    b.ng = b.n = {0, 0, 1};
    b.albedo = 0.7;
    b.parameter = parameter;
    b.eta = eta;
    b.k = k;
    return Lobe{std::move(name), b};
  };
  return {make("lambertian", layout::MATERIAL_LAMBERTIAN, 0, 1, 0),
          make("phong_5", layout::MATERIAL_PHONG, 5, 1, 0),
          make("phong_40", layout::MATERIAL_PHONG, 40, 1, 0),
          make("blinn_phong_10", layout::MATERIAL_BLINN_PHONG, 10, 1, 0),
          make("conductor_03", layout::MATERIAL_CONDUCTOR, 0.3, 0.2, 3.9),
          make("conductor_08", layout::MATERIAL_CONDUCTOR, 0.8, 1.5, 2),
          make("rough_dielectric_in", layout::MATERIAL_DIELECTRIC, 0.4, 1.5, 0),
          make("rough_dielectric_out", layout::MATERIAL_DIELECTRIC, 0.4, 1 / 1.5, 0)};
}

std::vector<Vec3d> view_directions() {
  std::vector<Vec3d> directions;
  for (const double degrees : {1.0, 40.0, 75.0}) directions.push_back(direction_at(std::cos(degrees * kPi / 180), 0.1));
  return directions;
}

TEST(ReferenceBsdf, SamplesFollowTheirDensity) {
  for (const Lobe& lobe : lobes())
    for (const Vec3d wo : view_directions()) {
      Random random(7, 0, 0);
      Grid counted;
      int valid = 0;
      for (int i = 0; i < kSamples; i++) {
        const BsdfSample s = bsdf_sample(lobe.bsdf, wo, random);
        if (s.weight <= 0) continue;
        valid++;
        counted.cells[Grid::index(s.wi)]++;
        ASSERT_NEAR(s.pdf, bsdf_pdf(lobe.bsdf, wo, s.wi), 1e-9 * s.pdf) << lobe.name;
        ASSERT_NEAR(s.weight * s.pdf, bsdf_eval(lobe.bsdf, wo, s.wi), 1e-9 * s.weight * s.pdf) << lobe.name;
      }
      // Directions that carry nothing are drawn too (Phong below the surface); the density of those that do is what remains.
      const Grid expected = integrate([&](Vec3d d) { return bsdf_eval(lobe.bsdf, wo, d) > 0 ? bsdf_pdf(lobe.bsdf, wo, d) : 0; });
      ASSERT_GT(valid, kSamples / 4) << lobe.name;
      check_chi_square(lobe.name + " at cosine " + std::to_string(wo.z), expected, counted, kSamples);
    }
}

TEST(ReferenceBsdf, IsReciprocal) {
  Random random(8, 0, 0);
  for (const Lobe& lobe : lobes()) {
    for (int i = 0; i < 2000; i++) {
      const double u1 = random.next(), u2 = random.next(), u3 = random.next(), u4 = random.next();
      const Vec3d wo = direction_at(0.05 + 0.95 * u1, u2), wi = direction_at(2 * u3 - 1, u4);
      const double forward = bsdf_eval(lobe.bsdf, wo, wi) / std::abs(wi.z);
      if (forward == 0) continue;
      Bsdf back = lobe.bsdf;
      double scale = 1;
      if (wi.z < 0) {
        // Seen from below, the surface's normal and index turn round; radiance over the squared index is what is symmetric.
        back.n = back.ng = {0, 0, -1};
        back.eta = 1 / lobe.bsdf.eta;
        scale = square(lobe.bsdf.eta);
      }
      // darts' Phong lobes have no cosine in the denominator: value, not BSDF, is symmetric.
      const bool phong = lobe.bsdf.type == layout::MATERIAL_PHONG || lobe.bsdf.type == layout::MATERIAL_BLINN_PHONG;
      const double f = phong ? forward * std::abs(wi.z) : forward * scale;
      const double b = bsdf_eval(back, wi, wo) / (phong ? 1 : std::abs(wo.z));
      ASSERT_NEAR(f, b, 1e-7 * f) << lobe.name;
    }
  }
}

TEST(ReferencePhase, SamplesFollowTheDensity) {
  for (const double g : {-0.6, 0.0, 1e-6, 0.5, 0.8}) {
    const Vec3d wo = normalize(Vec3d{0.3, -0.5, 0.6});
    Random random(9, 0, 0);
    Grid counted;
    for (int i = 0; i < kSamples; i++) {
      const double u1 = random.next(), u2 = random.next();
      counted.cells[Grid::index(phase_hg_sample(g, wo, u1, u2))]++;
    }
    check_chi_square("hg " + std::to_string(g), integrate([&](Vec3d d) { return phase_hg_eval(g, dot(-wo, d)); }), counted, kSamples);
  }
}

TEST(ReferencePhase, HasItsMoments) {
  constexpr int kCount = 1000000;
  for (const truth::HenyeyGreenstein& t : truth::kHenyeyGreenstein) {
    Random random(10, 0, 0);
    const Vec3d wo = {0, 0, -1};
    double mean = 0, mean_square = 0, fourth = 0, below[4] = {};
    for (int i = 0; i < kCount; i++) {
      const double u1 = random.next(), u2 = random.next();
      const double c = phase_hg_sample(t.g, wo, u1, u2).z;
      mean += c / kCount, mean_square += c * c / kCount, fourth += c * c * c * c / kCount;
      below[0] += c < -0.5, below[1] += c < 0, below[2] += c < 0.5, below[3] += c < 0.9;
    }
    EXPECT_NEAR(mean, t.mean, 4 * std::sqrt((mean_square - mean * mean) / kCount)) << t.g;
    EXPECT_NEAR(mean_square, t.mean_square, 4 * std::sqrt((fourth - mean_square * mean_square) / kCount)) << t.g;
    const double expected[4] = {t.below_minus_half, t.below_0, t.below_half, t.below_09};
    for (int i = 0; i < 4; i++)
      EXPECT_NEAR(below[i] / kCount, expected[i], 4 * std::sqrt(expected[i] * (1 - expected[i]) / kCount)) << t.g << " " << i;
  }
}

}  // namespace
}  // namespace stokes::reference
