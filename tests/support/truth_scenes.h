// Scenes whose pixels are known exactly, and their measurement on either integrator. A case looks at a set of pixels that all have the
// same expectation, so the scatter between pixels is the standard error, whoever rendered them.
#pragma once
#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "compiled/compiled_scene.h"
#include "image/film.h"
#include "scene/description.h"

namespace stokes::tests {

/// Renders `spp` samples of every pixel: either integrator.
using Backend = std::function<Image(const CompiledScene&, int spp, std::uint32_t seed)>;

/// A number read off an image: the mean over all pixels of a weighted sum of channels.
struct Measurement {
  std::string label;
  std::vector<std::pair<std::string, double>> channels;
  double expected = 0;
};

struct TruthCase {
  std::string name;    ///< letters, digits, underscores
  std::string source;  ///< where the expectation comes from
  SceneDescription scene;
  CompileOptions options;
  int samples = 16;    ///< per pixel
  std::vector<Measurement> measurements;
};
inline std::ostream& operator<<(std::ostream& out, const TruthCase& c) { return out << c.name; }

struct TruthResult {
  std::string label;
  double expected = 0, mean = 0, standard_error = 0;
  double z = 0, p = 1;  ///< two-sided
};

/// Renders a case and measures it.
std::vector<TruthResult> run_truth_case(const TruthCase& c, const Backend& backend, std::uint32_t seed);

/// Renders, prints and checks: |mean - expected| within three standard errors plus 1e-4 (the tables' own accuracy), and a relative
/// standard error below 1 %, so that a case that measures nothing fails too.
void check_truth_case(const TruthCase& c, const Backend& backend, std::uint32_t seed);

/// Every case, all integrators and modes that it makes sense for.
std::vector<TruthCase> furnace_cases();       ///< Lambertian, dielectric and scattering furnaces, enclosures
std::vector<TruthCase> irradiance_cases();    ///< each type of light by each integrator
std::vector<TruthCase> boundary_cases();      ///< Fresnel sheets, coated Lambertians
std::vector<TruthCase> slab_cases();          ///< slabs and half spaces
std::vector<TruthCase> fluorescence_cases();  ///< patches, plates, enclosures, media
std::vector<TruthCase> chromatic_cases();     ///< chromatic media, dispersion, colours, environments
std::vector<TruthCase> airlight_cases();      ///< small lamps in thin fog

}  // namespace stokes::tests
