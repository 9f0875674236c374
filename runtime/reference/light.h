// Light: emission met by a ray, and the choice of a direction towards a light. Knows nothing of what lies between.
#pragma once
#include <optional>
#include <vector>

#include "reference/intersect.h"
#include "reference/random.h"
#include "reference/spectrum.h"

namespace stokes::reference {

/// A direction towards a light, its radiance without what lies between, and the density of the direction (choice of the light included).
struct LightSample {
  Vec3d wi;
  double distance = kInfinity;
  double Le = 0;
  double pdf = 0;  ///< per steradian; 0: no sample
  std::uint32_t primitive = STOKES_NONE;
};

class Lights {
 public:
  explicit Lights(const CompiledScene& scene);
  /// Chooses a light by its power, then a direction from `from` towards it.
  LightSample sample(Vec3d from, Wavelength w, Random& random) const;
  /// A point on a light that was chosen by its power, and the light's size; none if the choice fell on the surroundings.
  struct Place {
    Vec3d position;
    double size = 0;
  };
  std::optional<Place> sample_place(Random& random) const;
  /// The density with which `sample` takes the direction from `from` to a point on a light's primitive.
  double pdf(const SurfacePoint& point, Vec3d from) const;
  /// The same for a direction that meets nothing: background and environment.
  double pdf_escaped(Vec3d wi) const;
  bool empty() const { return scene_.lights.empty(); }

 private:
  const layout::Light& choose(Random& random) const;

  const CompiledScene& scene_;
  std::vector<double> cumulative_;
};

/// Radiance that a surface emits towards wo (which points away from it): from the front side only.
double surface_emission(const CompiledScene& scene, const SurfacePoint& point, Vec3d wo, Wavelength w);
/// Radiance that arrives from the direction wi where nothing is met: the background and the environment.
double escaped_emission(const CompiledScene& scene, Vec3d wi, Wavelength w);

// environment.cpp
double environment_eval(const CompiledScene& scene, Vec3d wi, Wavelength w);
/// A direction by the image's cumulative tables, and its density per steradian.
Vec3d environment_sample(const CompiledScene& scene, double u1, double u2, double& pdf);
double environment_pdf(const CompiledScene& scene, Vec3d wi);

}  // namespace stokes::reference
