// The kernels' scattering lobes: value and density against the reference's on random directions, samples against the density by
// chi-square, Fresnel's equations on a grid. Specular lobes are compared sample by sample.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "reference/bsdf.h"
#include "reference/fresnel.h"
#include "reference/phase.h"
#include "reference/sampling.h"
#include "support/kernel_program.h"

namespace stokes::testing {
namespace {

constexpr std::uint32_t kPhase = 100;  // as in lobe_probes.cl
constexpr int kPairs = 1 << 14, kSamples = 1 << 17;
constexpr double kPi = std::numbers::pi;

struct Lobe {
  const char* name;
  std::uint32_t type;
  float parameter, eta, k;
};
std::ostream& operator<<(std::ostream& out, const Lobe& lobe) { return out << lobe.name; }
constexpr Lobe kLobes[] = {{"lambertian", layout::MATERIAL_LAMBERTIAN, 0, 1, 0},
                           {"phong_5", layout::MATERIAL_PHONG, 5, 1, 0},
                           {"phong_40", layout::MATERIAL_PHONG, 40, 1, 0},
                           {"blinn_phong_10", layout::MATERIAL_BLINN_PHONG, 10, 1, 0},
                           {"conductor_03", layout::MATERIAL_CONDUCTOR, 0.3f, 0.2f, 3.9f},
                           {"conductor_08", layout::MATERIAL_CONDUCTOR, 0.8f, 1.5f, 2},
                           {"rough_dielectric_in", layout::MATERIAL_DIELECTRIC, 0.4f, 1.5f, 0},
                           {"rough_dielectric_out", layout::MATERIAL_DIELECTRIC, 0.4f, 0.7f, 0},
                           {"phase_back", kPhase, -0.6f, 1, 0},
                           {"phase_isotropic", kPhase, 0, 1, 0},
                           {"phase_forward", kPhase, 0.8f, 1, 0}};

reference::Bsdf bsdf_of(const Lobe& lobe) {
  reference::Bsdf b;
  b.type = lobe.type;
  b.ng = b.n = {0, 0, 1};
  b.parameter = lobe.parameter;
  b.eta = lobe.eta;
  b.k = lobe.k;
  return b;
}

double exact_value(const Lobe& lobe, Vec3d wo, Vec3d wi) {
  return lobe.type == kPhase ? reference::phase_hg_eval(lobe.parameter, -dot(wo, wi)) : reference::bsdf_eval(bsdf_of(lobe), wo, wi);
}
double exact_pdf(const Lobe& lobe, Vec3d wo, Vec3d wi) {
  return lobe.type == kPhase ? exact_value(lobe, wo, wi) : reference::bsdf_pdf(bsdf_of(lobe), wo, wi);
}

Vec3d direction(double z, double u) {
  const double s = std::sqrt(std::max(0.0, 1 - z * z));
  return {s * std::cos(2 * kPi * u), s * std::sin(2 * kPi * u), z};
}
void append(std::vector<float>& out, Vec3d d) { out.insert(out.end(), {float(d.x), float(d.y), float(d.z)}); }
Vec3d at(const std::vector<float>& v, std::size_t i) { return {v[3 * i], v[3 * i + 1], v[3 * i + 2]}; }

KernelProgram& program() {
  static KernelProgram p("tests/differential/lobe_probes.cl", {});
  return p;
}

class KernelLobes : public ::testing::TestWithParam<Lobe> {};
std::string lobe_name(const ::testing::TestParamInfo<Lobe>& info) { return info.param.name; }

TEST_P(KernelLobes, ValuesAndDensitiesMatchTheReference) {
  const Lobe lobe = GetParam();
  reference::Random random(3, 0, 0);
  std::vector<float> wos, wis, values(kPairs), pdfs(kPairs);
  for (int i = 0; i < kPairs; i++) {
    const double z = random.next(), u = random.next(), z2 = random.next(), u2 = random.next();
    append(wos, direction(0.02 + 0.98 * z, u));
    append(wis, direction(2 * z2 - 1, u2));
  }
  program().run("probe_lobe_eval", kPairs / program().lanes(), int(lobe.type), lobe.parameter, lobe.eta, lobe.k, wos, wis, Out{values}, Out{pdfs});
  int positive = 0;
  for (std::size_t i = 0; i < kPairs; i++) {
    const Vec3d wo = normalize(at(wos, i)), wi = normalize(at(wis, i));
    const double value = exact_value(lobe, wo, wi);
    positive += value > 0;
    // The sine of a grazing direction in floats is good to some 1e-7 / cosine; refraction's half vector is a small difference.
    const double tolerance = (lobe.type == layout::MATERIAL_DIELECTRIC ? 1e-3 : 3e-5) + 1e-6 / std::min(wo.z, std::abs(wi.z));
    ASSERT_NEAR(values[i], value, tolerance * std::max(value, 1e-3)) << lobe.name << " wo.z " << wo.z << " wi.z " << wi.z;
    if (value > 0) {
      const double pdf = exact_pdf(lobe, wo, wi);
      ASSERT_NEAR(pdfs[i], pdf, tolerance * std::max(pdf, 1e-3)) << lobe.name << " wo.z " << wo.z << " wi.z " << wi.z;
    }
  }
  EXPECT_GT(positive, kPairs / 20);
}

// ---- Chi-square -------------------------------------------------------------------------------------------------
constexpr int kRows = 16, kColumns = 24, kRowSteps = 100, kColumnSteps = 6;

std::size_t cell_of(Vec3d d) {
  const int row = std::min(kRows - 1, int((1 - d.z) / 2 * kRows));
  const int column = std::min(kColumns - 1, int((std::atan2(d.y, d.x) / (2 * kPi) + 0.5) * kColumns));
  return std::size_t(row * kColumns + column);
}

/// Cells with few expected samples are pooled. The tail is Wilson and Hilferty's (1931).
double chi_square_p(const std::vector<double>& expected, const std::vector<double>& counted) {
  double statistic = 0, pooled_expected = 0, pooled_counted = 0;
  int cells = 0;
  for (std::size_t i = 0; i < expected.size(); i++) {
    if (expected[i] < 10) {
      pooled_expected += expected[i], pooled_counted += counted[i];
      continue;
    }
    statistic += (counted[i] - expected[i]) * (counted[i] - expected[i]) / expected[i];
    cells++;
  }
  if (pooled_expected > 5) statistic += (pooled_counted - pooled_expected) * (pooled_counted - pooled_expected) / pooled_expected, cells++;
  const double v = 2.0 / (9.0 * cells);
  return 0.5 * std::erfc((std::cbrt(statistic / cells) - (1 - v)) / std::sqrt(2 * v));
}

TEST_P(KernelLobes, SamplesFollowTheDensity) {
  const Lobe lobe = GetParam();
  reference::Random random(5, 0, 0);
  for (const double degrees : {1.0, 40.0, 75.0}) {
    // The phase function's local frame has the direction of travel as z.
    const Vec3d wo = lobe.type == kPhase ? Vec3d{0, 0, -1} : direction(std::cos(degrees * kPi / 180), 0.1);
    std::vector<float> wos, us, samples(5 * kSamples);
    for (int i = 0; i < kSamples; i++) {
      append(wos, wo);
      for (int k = 0; k < 3; k++) us.push_back(float(std::clamp(random.next(), 1e-7, 1 - 1e-7)));
    }
    program().run("probe_lobe_sample", kSamples / program().lanes(), int(lobe.type), lobe.parameter, lobe.eta, lobe.k, wos, us, Out{samples});
    std::vector<double> counted(kRows * kColumns), expected(kRows * kColumns);
    for (std::size_t i = 0; i < kSamples; i++) {
      const float* s = &samples[5 * i];
      const Vec3d wi{s[0], s[1], s[2]};
      ASSERT_NEAR(length(wi), 1, 1e-5);
      const double value = exact_value(lobe, wo, normalize(wi));
      // Phong's own sampler leaves it to bsdf_sample to drop what points below the surface.
      if (s[3] <= 0 || value <= 0) continue;
      counted[cell_of(wi)]++;
      // A lobe's weight is its value over its density; near the surface both lose digits.
      if (std::abs(wi.z) > 0.01) {
        ASSERT_NEAR(s[3] * s[4], value, 2e-3 * std::max(value, 1e-2)) << lobe.name;
      }
    }
    const double solid_angle = 4 * kPi / (kRows * kColumns * kRowSteps * kColumnSteps);
    for (int i = 0; i < kRows * kRowSteps; i++)
      for (int j = 0; j < kColumns * kColumnSteps; j++) {
        const Vec3d d = direction(1 - 2 * (i + 0.5) / (kRows * kRowSteps), (j + 0.5) / (kColumns * kColumnSteps) - 0.5);
        if (exact_value(lobe, wo, d) > 0) expected[cell_of(d)] += exact_pdf(lobe, wo, d) * solid_angle * kSamples;
      }
    const double p = chi_square_p(expected, counted);
    std::printf("%s at %.0f degrees: p %.3g (threshold 1e-4)\n", lobe.name, degrees, p);
    EXPECT_GT(p, 1e-4) << lobe.name << " at " << degrees << " degrees";
    if (lobe.type == kPhase) break;
  }
}
INSTANTIATE_TEST_SUITE_P(Lobe, KernelLobes, ::testing::ValuesIn(kLobes), lobe_name);

// ---- Specular lobes and Fresnel ---------------------------------------------------------------------------------
TEST(KernelSpecular, SmoothDielectricsReflectByFresnelAndRefractBySnell) {
  reference::Random random(6, 0, 0);
  for (const float eta : {1.5f, 1 / 1.5f}) {
    std::vector<float> wos, us, samples(5 * kPairs);
    for (int i = 0; i < kPairs; i++) {
      const double z = random.next(), u = random.next();
      append(wos, direction(0.02 + 0.98 * z, u));
      for (int k = 0; k < 3; k++) us.push_back(float(random.next()));
    }
    program().run("probe_lobe_sample", kPairs / program().lanes(), int(layout::MATERIAL_DIELECTRIC), 0.0f, eta, 0.0f, wos, us, Out{samples});
    for (std::size_t i = 0; i < kPairs; i++) {
      const Vec3d wo = normalize(at(wos, i)), wi{samples[5 * i], samples[5 * i + 1], samples[5 * i + 2]};
      const double f = reference::fresnel_dielectric(wo.z, eta), u = us[3 * i + 2];
      if (std::abs(u - f) < 1e-5) continue;
      ASSERT_EQ(wi.z > 0, u < f);
      const double scale = u < f ? 1 : 1 / eta;
      ASSERT_NEAR(wi.x, -wo.x * scale, 1e-5);
      ASSERT_NEAR(wi.y, -wo.y * scale, 1e-5);
      ASSERT_NEAR(length(wi), 1, 1e-4);
      ASSERT_NEAR(samples[5 * i + 3], u < f ? 1 : 1 / (eta * eta), 1e-6);
    }
  }
}

TEST(KernelSpecular, FuzzyMirrorsStayWithinTheirBall) {
  reference::Random random(7, 0, 0);
  constexpr float kRoughness = 0.3f;
  std::vector<float> wos, us, samples(5 * kPairs);
  for (int i = 0; i < kPairs; i++) {
    append(wos, direction(0.6, 0.2));
    for (int k = 0; k < 3; k++) us.push_back(float(random.next()));
  }
  program().run("probe_lobe_sample", kPairs / program().lanes(), int(layout::MATERIAL_METAL), kRoughness, 1.0f, 0.0f, wos, us, Out{samples});
  const Vec3d wo = direction(0.6, 0.2), mirror{-wo.x, -wo.y, wo.z};
  Vec3d sum;
  double least = 1;
  for (std::size_t i = 0; i < kPairs; i++) {
    const Vec3d wi{samples[5 * i], samples[5 * i + 1], samples[5 * i + 2]};
    sum = sum + wi;
    least = std::min(least, dot(wi, mirror));
  }
  // From the ball's tangent cone; the mean direction is the mirror's.
  EXPECT_GE(least, std::sqrt(1 - kRoughness * kRoughness) - 1e-5);
  EXPECT_LT(least, std::sqrt(1 - kRoughness * kRoughness) + 0.01);
  EXPECT_GT(dot(normalize(sum), mirror), 1 - 1e-4);
}

TEST(KernelFresnel, MatchesTheReference) {
  std::vector<float> cosines, etas, ks;
  for (const float eta : {0.2f, 0.66f, 0.9f, 1.0f, 1.1f, 1.5f, 2.4f, 4.0f})
    for (const float k : {0.0f, 0.5f, 2.0f, 7.0f})
      for (int i = 0; i < 256; i++) cosines.push_back(float(i + 1) / 256), etas.push_back(eta), ks.push_back(k);
  const std::size_t count = cosines.size();
  std::vector<float> dielectric(count), beyond(count), conductor(count);
  program().run("probe_fresnel", count / std::size_t(program().lanes()), cosines, etas, ks, Out{dielectric}, Out{beyond}, Out{conductor});
  for (std::size_t i = 0; i < count; i++) {
    double cosine_beyond;
    const double exact = reference::fresnel_dielectric(cosines[i], etas[i], &cosine_beyond);
    // Near the critical angle the refracted cosine is a root of what cancels.
    const double tolerance = cosine_beyond > 0.05 ? 2e-5 : 5e-3;
    ASSERT_NEAR(dielectric[i], exact, tolerance) << cosines[i] << " " << etas[i];
    ASSERT_NEAR(beyond[i], cosine_beyond, tolerance) << cosines[i] << " " << etas[i];
    ASSERT_NEAR(conductor[i], reference::fresnel_conductor(cosines[i], etas[i], ks[i]), 5e-5) << cosines[i] << " " << etas[i] << " " << ks[i];
  }
}

}  // namespace
}  // namespace stokes::testing
