// Scattering at surfaces: the material of a hit with its spectra already read, and the triad eval, sample, pdf over it. Blends are resolved
// here; the wavelength shift of fluorescent materials is not (fluorescence.h). Knows nothing of lights or paths.
#pragma once
#include "reference/random.h"
#include "reference/texture.h"

namespace stokes::reference {

/// A surface's scattering at one point, one wavelength and one wo. `value` always means BSDF times |cosine to n|, for radiance that
/// travels towards wo.
struct Bsdf {
  std::uint32_t type = layout::MATERIAL_BLACK;
  Vec3d ng;          ///< geometric normal, turned to wo's side
  Vec3d n;           ///< shading normal, on the same side
  double albedo = 1; ///< dielectric: the fraction kept at each event
  double eta = 1;    ///< dielectric: index beyond the surface over the index on wo's side; conductor: eta
  double k = 0;
  double parameter = 0;
};

/// Lets chance choose between the children of blends (Bernoulli trials with the point's amounts), and returns the leaf's index.
std::uint32_t resolve_blends(const CompiledScene& scene, std::uint32_t material, const SurfacePoint& point, Vec3d wo, Wavelength w, Random& random);

/// Reads a leaf material's spectra. A fluorescent or reradiating material becomes its lambertian base.
Bsdf bsdf_at(const CompiledScene& scene, const layout::Material& material, const SurfacePoint& point, Vec3d wo, Wavelength w);
/// A lambertian surface of this albedo at the point.
Bsdf lambertian_at(const SurfacePoint& point, Vec3d wo, double albedo);

/// True when light reaches the material by sampling alone: mirrors, smooth dielectrics, darts' metal.
bool is_specular(const Bsdf& bsdf);

/// Value per steradian; 0 for specular ones.
double bsdf_eval(const Bsdf& bsdf, Vec3d wo, Vec3d wi);
/// Density of bsdf_sample per steradian; 0 for specular ones.
double bsdf_pdf(const Bsdf& bsdf, Vec3d wo, Vec3d wi);

struct BsdfSample {
  Vec3d wi;
  double weight = 0;       ///< value over density; 0: the path ends
  double pdf = 0;          ///< 0 for specular ones
  double index_ratio = 1;  ///< index on wi's side over the index on wo's
};
BsdfSample bsdf_sample(const Bsdf& bsdf, Vec3d wo, Random& random);

/// The mirror image of wo about n.
inline Vec3d mirror(Vec3d wo, Vec3d n) { return n * (2 * dot(wo, n)) - wo; }

// The families, each in its own file.
double conductor_eval(const Bsdf& bsdf, Vec3d wo, Vec3d wi);
double conductor_pdf(const Bsdf& bsdf, Vec3d wo, Vec3d wi);
BsdfSample conductor_sample(const Bsdf& bsdf, Vec3d wo, Random& random);
double dielectric_eval(const Bsdf& bsdf, Vec3d wo, Vec3d wi);
double dielectric_pdf(const Bsdf& bsdf, Vec3d wo, Vec3d wi);
BsdfSample dielectric_sample(const Bsdf& bsdf, Vec3d wo, Random& random);
double phong_eval(const Bsdf& bsdf, Vec3d wo, Vec3d wi);
double phong_pdf(const Bsdf& bsdf, Vec3d wo, Vec3d wi);
BsdfSample phong_sample(const Bsdf& bsdf, Vec3d wo, Random& random);
double blinn_phong_eval(const Bsdf& bsdf, Vec3d wo, Vec3d wi);
double blinn_phong_pdf(const Bsdf& bsdf, Vec3d wo, Vec3d wi);
BsdfSample blinn_phong_sample(const Bsdf& bsdf, Vec3d wo, Random& random);

}  // namespace stokes::reference
