// The environment image: lookup by direction, sampling by its cumulative tables. See light.h and layout.h for where the image lies.
#include <algorithm>

#include "reference/light.h"
#include "reference/sampling.h"
#include "reference/texture.h"

namespace stokes::reference {
namespace {

struct Place {
  double u, v;
};

Place place_of(const layout::Environment& e, Vec3d wi) {
  const float* m = e.to_local;
  const Vec3d d = {dot({m[0], m[1], m[2]}, wi), dot({m[3], m[4], m[5]}, wi), dot({m[6], m[7], m[8]}, wi)};
  return {0.5 + std::atan2(d.x, -d.z) / (2 * kPi), std::acos(std::clamp(d.y, -1.0, 1.0)) / kPi};
}

Vec3d direction_of(const layout::Environment& e, Place p) {
  const double phi = 2 * kPi * (p.u - 0.5), theta = kPi * p.v;
  const Vec3d d = {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
  // The rows of to_local are orthonormal; its transpose turns back.
  const float* m = e.to_local;
  return Vec3d{m[0], m[1], m[2]} * d.x + Vec3d{m[3], m[4], m[5]} * d.y + Vec3d{m[6], m[7], m[8]} * d.z;
}

/// Draws from `count` cells with the cumulative table cdf[0..count]; returns cell + fraction.
double sample_cells(const float* cdf, std::uint32_t count, double u) {
  const auto above = std::upper_bound(cdf, cdf + count + 1, static_cast<float>(u));
  const auto cell = static_cast<std::uint32_t>(std::clamp<std::ptrdiff_t>(above - cdf - 1, 0, std::ptrdiff_t(count) - 1));
  const double mass = double(cdf[cell + 1]) - cdf[cell];
  const double inside = mass > 0 ? std::clamp((u - cdf[cell]) / mass, 0.0, 1 - 1e-12) : 0.5;
  return cell + inside;
}

const float* row_cdf(const CompiledScene& scene, std::uint32_t row) {
  const layout::Environment& e = scene.environment;
  return &scene.environment_cdf[e.height + 1 + std::size_t(row) * (e.width + 1)];
}

}  // namespace

double environment_eval(const CompiledScene& scene, Vec3d wi, Wavelength w) {
  const layout::Environment& e = scene.environment;
  const Place p = place_of(e, wi);
  const double x = p.u * e.width - 0.5, y = p.v * e.height - 0.5;
  const double x0 = std::floor(x), y0 = std::floor(y), fx = x - x0, fy = y - y0;
  const auto texel = [&](std::int64_t column, std::int64_t row) {
    const auto width = std::int64_t(e.width), height = std::int64_t(e.height);
    const std::int64_t i = std::clamp<std::int64_t>(row, 0, height - 1) * width + ((column % width) + width) % width;
    return texel_eval(&scene.texels[e.image_offset + 4 * static_cast<std::size_t>(i)], w);
  };
  const auto column = std::int64_t(x0), row = std::int64_t(y0);
  const double top = (1 - fx) * texel(column, row) + fx * texel(column + 1, row);
  const double bottom = (1 - fx) * texel(column, row + 1) + fx * texel(column + 1, row + 1);
  return e.scale * spectrum_eval(scene, e.illuminant, w) * ((1 - fy) * top + fy * bottom);
}

Vec3d environment_sample(const CompiledScene& scene, double u1, double u2, double& pdf) {
  const layout::Environment& e = scene.environment;
  const double y = sample_cells(scene.environment_cdf.data(), e.height, u1);
  const double x = sample_cells(row_cdf(scene, static_cast<std::uint32_t>(y)), e.width, u2);
  const Vec3d wi = direction_of(e, {x / e.width, y / e.height});
  pdf = environment_pdf(scene, wi);
  return wi;
}

double environment_pdf(const CompiledScene& scene, Vec3d wi) {
  const layout::Environment& e = scene.environment;
  const Place p = place_of(e, wi);
  const auto column = std::min(e.width - 1, static_cast<std::uint32_t>(p.u * e.width));
  const auto row = std::min(e.height - 1, static_cast<std::uint32_t>(p.v * e.height));
  const float *rows = scene.environment_cdf.data(), *columns = row_cdf(scene, row);
  const double mass = (double(rows[row + 1]) - rows[row]) * (double(columns[column + 1]) - columns[column]);
  const double sine = std::sin(kPi * p.v);
  return sine > 0 ? mass * e.width * e.height / (2 * kPi * kPi * sine) : 0;
}

}  // namespace stokes::reference
