// Elementary functions, random numbers and samplers of the kernels, against double precision and their own distributions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

#include "support/kernel_program.h"
#include "support/test_shapes.h"

namespace stokes::testing {
namespace {

KernelProgram program_for(int lanes) {
  KernelVariant v;
  v.lanes = lanes;
  v.x86 = lanes != 1;
  return KernelProgram("tests/differential/probes.cl", v);
}

struct Pair {
  std::vector<float> a, b;
};
Pair evaluate(KernelProgram& program, int op, const std::vector<float>& x, const std::vector<float>& y) {
  Pair r{std::vector<float>(x.size()), std::vector<float>(x.size())};
  program.run("probe_math", x.size() / std::size_t(program.lanes()), op, x, y, Out{r.a}, Out{r.b});
  return r;
}

constexpr std::size_t kCount = 1 << 18;
std::vector<float> grid(double a, double b) {
  std::vector<float> x(kCount);
  for (std::size_t i = 0; i < kCount; i++) x[i] = float(a + (b - a) * double(i) / double(kCount - 1));
  return x;
}
/// Logarithmically spaced.
std::vector<float> decades(double a, double b) {
  std::vector<float> x = grid(std::log(a), std::log(b));
  for (float& v : x) v = float(std::exp(double(v)));
  return x;
}

class KernelMath : public ::testing::Test {
 protected:
  static KernelProgram& program() {
    static KernelProgram p = program_for(8);
    return p;
  }
  /// Largest relative error against `exact`, whose results below `floor` count absolutely.
  static double worst(const std::vector<float>& x, const std::vector<float>& y, const std::vector<float>& result,
                      const std::function<double(double, double)>& exact, double floor = 1e-30) {
    double worst = 0;
    for (std::size_t i = 0; i < x.size(); i++) {
      const double e = exact(x[i], y[i]);
      const double error = std::abs(result[i] - e) / std::max(std::abs(e), floor);
      if (!(error <= worst)) worst = error;
    }
    return worst;
  }
};

TEST_F(KernelMath, Log) {
  for (const auto& x : {decades(1.2e-38, 3e38), grid(0.5, 2), grid(0.9999, 1.0001)})
    EXPECT_LT(worst(x, x, evaluate(program(), 0, x, x).a, [](double v, double) { return std::log(v); }), 2e-7);
  const std::vector<float> zero(8, 0.0f);
  EXPECT_EQ(evaluate(program(), 0, zero, zero).a[0], -INFINITY);
}

TEST_F(KernelMath, Exp) {
  for (const auto& x : {grid(-87, 88), grid(-1, 1), grid(-1e-4, 1e-4)})
    EXPECT_LT(worst(x, x, evaluate(program(), 1, x, x).a, [](double v, double) { return std::exp(v); }), 2e-7);
  const std::vector<float> ends = {-1e30f, -88, 89, 1e30f, -INFINITY, INFINITY, 0, -0.0f};
  const Pair r = evaluate(program(), 1, ends, ends);
  EXPECT_EQ(r.a, (std::vector<float>{0, 0, INFINITY, INFINITY, 0, INFINITY, 1, 1}));
}

TEST_F(KernelMath, Pow) {
  for (double power : {0.25, 1 / 2.4, 1.5, 2.0, 40.0, 1000.0, -1.3}) {
    const double reach = std::min(80 / std::abs(power), 85.0);
    const auto x = decades(std::exp(-reach), std::exp(std::min(reach, 80.0)));
    const std::vector<float> y(kCount, float(power));
    EXPECT_LT(worst(x, y, evaluate(program(), 2, x, y).a, [](double v, double p) { return std::pow(v, p); }), 5e-7) << power;
  }
  const std::vector<float> x = {0, 0, 0, 1, 1, 2, 2, 0.5f}, y = {2, 0, 0.5f, 0, 1e6f, 0, 3, 3};
  EXPECT_EQ(evaluate(program(), 2, x, y).a, (std::vector<float>{0, 1, 0, 1, 1, 1, 8, 0.125f}));
}

TEST_F(KernelMath, SineAndCosine) {
  const auto u = grid(-2, 2);
  Pair r = evaluate(program(), 3, u, u);
  const auto error = [](double a, double b) { return std::abs(a - b); };
  double worst_turn = 0, worst_radian = 0;
  for (std::size_t i = 0; i < kCount; i++)
    worst_turn = std::max({worst_turn, error(r.a[i], std::sin(2 * M_PI * u[i])), error(r.b[i], std::cos(2 * M_PI * u[i]))});
  EXPECT_LT(worst_turn, 1e-7);
  const auto x = grid(-1e5, 1e5);
  r = evaluate(program(), 4, x, x);
  for (std::size_t i = 0; i < kCount; i++)
    worst_radian = std::max({worst_radian, error(r.a[i], std::sin(double(x[i]))), error(r.b[i], std::cos(double(x[i])))});
  EXPECT_LT(worst_radian, 1e-7);
}

TEST_F(KernelMath, InverseFunctions) {
  std::vector<float> x(kCount), y(kCount);
  Numbers u(3);
  for (std::size_t i = 0; i < kCount; i++) {
    const double angle = 2 * M_PI * double(i) / kCount, r = std::exp(20 * u.signed_one());
    x[i] = float(r * std::sin(angle)), y[i] = float(r * std::cos(angle));
  }
  EXPECT_LT(worst(x, y, evaluate(program(), 5, x, y).a, [](double s, double c) { return std::atan2(s, c); }), 4e-7);
  const std::vector<float> zeros(8, 0.0f);
  EXPECT_EQ(evaluate(program(), 5, zeros, zeros).a[0], 0.0f);
  for (const auto& c : {grid(-1, 1), grid(0.999, 1), grid(-1, -0.999)})
    EXPECT_LT(worst(c, c, evaluate(program(), 6, c, c).a, [](double v, double) { return std::acos(v); }, 1e-6), 5e-7);
}

TEST_F(KernelMath, DivisionAndSquareRootAreCorrectlyRounded) {
  const auto x = decades(1e-30, 1e30);
  auto y = x;
  std::shuffle(y.begin(), y.end(), std::mt19937(1));
  const Pair r = evaluate(program(), 7, x, y);
  for (std::size_t i = 0; i < kCount; i++) {
    ASSERT_EQ(r.a[i], float(std::sqrt(double(x[i]))));
    const float quotient = x[i] / y[i];
    if (std::isnormal(quotient)) {
      ASSERT_EQ(r.b[i], quotient);
    }
  }
}

TEST_F(KernelMath, EveryLaneCountGivesTheSameBits) {
  const auto x = decades(1e-20, 1e20);
  auto y = grid(-3, 3);
  std::shuffle(y.begin(), y.end(), std::mt19937(1));
  KernelProgram one = program_for(1), sixteen = program_for(16);
  for (int op = 0; op <= 8; op++) {
    const auto& a = op == 1 || op == 3 || op == 4 || op == 6 ? y : x;
    const Pair r8 = evaluate(program(), op, a, y), r1 = evaluate(one, op, a, y), r16 = evaluate(sixteen, op, a, y);
    for (const Pair* r : {&r1, &r16}) {
      EXPECT_EQ(std::memcmp(r->a.data(), r8.a.data(), kCount * 4), 0) << "op " << op;
      EXPECT_EQ(std::memcmp(r->b.data(), r8.b.data(), kCount * 4), 0) << "op " << op;
    }
  }
}

// ---- Random numbers ------------------------------------------------------------------------------------------
struct Streams {
  std::vector<std::uint32_t> pixels, samples;
};
std::vector<float> draw(KernelProgram& program, const char* kernel, const Streams& s, int draws) {
  std::vector<float> u(s.pixels.size() * std::size_t(draws));
  program.run(kernel, s.pixels.size() / std::size_t(program.lanes()), 7u, draws, s.pixels, s.samples, Out{u});
  return u;
}

/// Chi-square of counts against equal expectation, as a standard normal deviate (Wilson and Hilferty 1931).
double deviate(const std::vector<double>& counts) {
  double total = 0, chi2 = 0;
  for (double c : counts) total += c;
  const double expected = total / double(counts.size()), k = double(counts.size() - 1);
  for (double c : counts) chi2 += (c - expected) * (c - expected) / expected;
  return (std::cbrt(chi2 / k) - (1 - 2 / (9 * k))) / std::sqrt(2 / (9 * k));
}

TEST(KernelRandom, UniformWithinAndAcrossStreams) {
  KernelProgram program = program_for(8);
  Streams s;
  for (std::uint32_t i = 0; i < 4096; i++) s.pixels.push_back(i / 16), s.samples.push_back(i % 16);
  constexpr int kDraws = 64;
  const std::vector<float> u = draw(program, "probe_random", s, kDraws);
  for (float v : u) ASSERT_TRUE(v > 0 && v < 1);
  std::vector<double> single(256), successive(64 * 64), first_pair(32 * 32), neighbours(32 * 32);
  const auto cell = [](float v, int n) { return std::size_t(v * float(n)); };
  for (std::size_t i = 0; i < 4096; i++)
    for (std::size_t k = 0; k < kDraws; k++) {
      const float v = u[i * kDraws + k];
      single[cell(v, 256)]++;
      if (k % 2 == 0) successive[cell(v, 64) * 64 + cell(u[i * kDraws + k + 1], 64)]++;
      if (k == 0) first_pair[cell(v, 32) * 32 + cell(u[i * kDraws + 1], 32)]++;
      if (i % 2 == 0) neighbours[cell(v, 32) * 32 + cell(u[(i + 1) * kDraws + k], 32)]++;
    }
  EXPECT_LT(std::abs(deviate(single)), 4);
  EXPECT_LT(std::abs(deviate(successive)), 4);
  EXPECT_LT(std::abs(deviate(first_pair)), 4);
  EXPECT_LT(std::abs(deviate(neighbours)), 4);
}

TEST(KernelRandom, StreamsDependOnTheirKeyAlone) {
  Streams s;
  for (std::uint32_t i = 0; i < 256; i++) s.pixels.push_back(i * 977), s.samples.push_back(i % 5);
  std::vector<std::vector<float>> all;
  for (int lanes : {1, 8, 16}) {
    KernelProgram program = program_for(lanes);
    all.push_back(draw(program, "probe_random", s, 32));
    all.push_back(draw(program, "probe_random_where", s, 32));
  }
  for (const auto& u : all) EXPECT_EQ(u, all[0]);
  // Distinct keys give distinct streams.
  std::vector<float> firsts;
  for (std::size_t i = 0; i < 256; i++) firsts.push_back(all[0][32 * i]);
  std::sort(firsts.begin(), firsts.end());
  EXPECT_EQ(std::adjacent_find(firsts.begin(), firsts.end()), firsts.end());
}

// ---- Samplers ------------------------------------------------------------------------------------------------
/// Stratified numbers, so that the counts of an exact sampler deviate less than chance.
void stratified(std::size_t side, std::vector<float>& u, std::vector<float>& v) {
  Numbers r(9);
  for (std::size_t i = 0; i < side; i++)
    for (std::size_t j = 0; j < side; j++) {
      u.push_back(float((double(i) + r.one()) / double(side)));
      v.push_back(float((double(j) + r.one()) / double(side)));
    }
}

TEST(KernelSampling, FollowTheirDensities) {
  KernelProgram program = program_for(8);
  std::vector<float> u, v;
  stratified(512, u, v);
  const std::size_t n = u.size();
  // With z's distribution function F(z) and the azimuth, both uniform, every sampler fills an even grid.
  const double cone = 1e-3;
  const std::function<double(const float*)> level[] = {
      [](const float* d) { return double(d[2]) * d[2]; }, [](const float* d) { return 0.5 * (1 + double(d[2])); },
      [&](const float* d) { return (double(d[0]) * d[0] + double(d[1]) * d[1]) / (cone * (2 - cone)); },
      [](const float* d) { return double(d[0]) * d[0] + double(d[1]) * d[1]; }};
  for (int op = 0; op < 4; op++) {
    std::vector<float> out(3 * n);
    program.run("probe_sampling", n / 8, op, float(cone), u, v, Out{out});
    std::vector<double> counts(32 * 32);
    double worst_length = 0;
    for (std::size_t i = 0; i < n; i++) {
      const float* d = &out[3 * i];
      if (op < 3) worst_length = std::max(worst_length, std::abs(double(d[0]) * d[0] + double(d[1]) * d[1] + double(d[2]) * d[2] - 1));
      const auto a = std::size_t(std::clamp(level[op](d), 0.0, 0.999999) * 32);
      const auto b = std::size_t(std::clamp((std::atan2(d[1], d[0]) + M_PI) / (2 * M_PI), 0.0, 0.999999) * 32);
      counts[a * 32 + b]++;
    }
    EXPECT_LT(deviate(counts), 2) << "sampler " << op;
    EXPECT_LT(worst_length, 5e-7) << "sampler " << op;
  }
  std::vector<float> out(3 * n);
  program.run("probe_sampling", n / 8, 4, 0.0f, u, v, Out{out});
  double b1 = 0, b2 = 0, b12 = 0;
  for (std::size_t i = 0; i < n; i++) {
    ASSERT_TRUE(out[3 * i] >= 0 && out[3 * i + 1] >= 0 && out[3 * i] + out[3 * i + 1] <= 1.0000002f);
    b1 += out[3 * i], b2 += out[3 * i + 1], b12 += double(out[3 * i]) * out[3 * i + 1];
  }
  // Moments of the uniform triangle: 1/3, 1/3, 1/12.
  EXPECT_NEAR(b1 / double(n), 1.0 / 3, 1e-4);
  EXPECT_NEAR(b2 / double(n), 1.0 / 3, 1e-4);
  EXPECT_NEAR(b12 / double(n), 1.0 / 12, 1e-4);
}

TEST(KernelSampling, FramesAreOrthonormal) {
  KernelProgram program = program_for(8);
  Numbers r(5);
  std::vector<float> n;
  for (int i = 0; i < 4096; i++) {
    Vec3d d = r.direction();
    if (i % 8 == 0) d = normalize(Vec3d{1e-4 * d.x, 1e-4 * d.y, d.z > 0 ? 1.0 : -1.0});
    n.insert(n.end(), {float(d.x), float(d.y), float(d.z)});
  }
  std::vector<float> t(n.size()), b(n.size());
  program.run("probe_frame", n.size() / 24, n, Out{t}, Out{b});
  for (std::size_t i = 0; i < n.size(); i += 3) {
    const Vec3d z{n[i], n[i + 1], n[i + 2]}, x{t[i], t[i + 1], t[i + 2]}, y{b[i], b[i + 1], b[i + 2]};
    EXPECT_NEAR(dot(x, y), 0, 5e-7);
    EXPECT_NEAR(dot(x, z), 0, 5e-7);
    EXPECT_NEAR(dot(x, x), 1, 5e-7);
    EXPECT_NEAR(dot(cross(x, y), z), 1, 5e-7);
  }
}

}  // namespace
}  // namespace stokes::testing
