// Published and closed-form figures that renders are measured against, each with its source. Knows nothing of scenes.
#pragma once

namespace stokes::truth {

// ---- Slabs ------------------------------------------------------------------------------------------------------
/// Reflectance and transmittance of a plane slab for a perpendicular beam, in units of the incident flux.
struct Slab {
  const char* name;
  const char* source;
  double sigma_t, albedo, g, ior, depth;  ///< depth 0: half space
  double reflectance, transmittance;      ///< in total, surface reflection and unscattered light included
};
/// The printed figures of van de Hulst and Giovanelli agree with these, which carry more digits (adding-doubling, 7 digits).
inline constexpr Slab kSlabs[] = {
    {"van_de_Hulst", "van de Hulst 1980, table 35 (Wang & Jacques, MCML 1995, table 1: R 0.09739, T 0.66096)", 100, 0.9, 0.75, 1.0, 0.02, 0.0973946,
     0.6609577},
    {"Giovanelli", "Giovanelli 1955 (MCML 1995, table 2: R 0.2600)", 100, 0.9, 0.0, 1.5, 0, 0.2599186, 0},
    {"Naito_1mm_matched", "skin of Naito et al. 2014; adding-doubling", 104, 0.94, 0.9, 1.0, 0.1, 0.1088235, 0.2777386},
    {"Naito_1mm_n1.5", "skin of Naito et al. 2014; adding-doubling", 104, 0.94, 0.9, 1.5, 0.1, 0.0938598, 0.1694566},
    {"Naito_1mm_n1.1", "skin of Naito et al. 2014; adding-doubling", 104, 0.94, 0.9, 1.1, 0.1, 0.0949430, 0.2593982},
    {"Naito_half_space_n1.5", "skin of Naito et al. 2014; adding-doubling", 104, 0.94, 0.9, 1.5, 0, 0.0866165, 0},
    {"Naito_half_space_matched", "skin of Naito et al. 2014; adding-doubling", 104, 0.94, 0.9, 1.0, 0, 0.1170131, 0},
    {"fog", "sigma_t 1, sigma_s 0.2, isotropic; adding-doubling", 1, 0.2, 0.0, 1.0, 1, 0.0319835, 0.3922578},
};

/// Reflectance of a half space of isotropic scatterers by Chandrasekhar's H function: 1 - H(mu) sqrt(1 - albedo).
struct HalfSpace {
  double albedo, at_0, at_60, at_75;  ///< incidence in degrees
};
inline constexpr HalfSpace kIsotropicHalfSpaces[] = {
    {0.5, 0.115225878, 0.160144433, 0.199348071},
    {0.9, 0.414947479, 0.507938907, 0.572458867},
    {0.99, 0.752720717, 0.815139898, 0.850530397},
};

// ---- Boundaries -------------------------------------------------------------------------------------------------
/// A clear absorbing sheet between two smooth dielectric planes, all orders of inner reflection, scalar Fresnel factors.
struct Sheet {
  double n, mu_a_d, degrees, reflectance, transmittance;
};
inline constexpr Sheet kSheets[] = {
    {1.33, 0.5, 0, 0.0271466875, 0.5825277665}, {1.33, 0.1, 45, 0.0480867430, 0.8408973810}, {1.33, 1.0, 70, 0.1385747270, 0.1832926879},
    {1.5, 0.0, 0, 0.0769230769, 0.9230769231},  {1.5, 0.0, 70, 0.2921201070, 0.7078798930},  {1.5, 0.5, 45, 0.0648342997, 0.5121048322},
    {1.5, 2.0, 70, 0.1717368033, 0.0528179172},
};

/// Directional-hemispherical reflectance of a Lambertian plane under a smooth dielectric one: Rs + (1 - Rs)(1 - Ri) rho / (1 - rho Ri).
struct CoatedLambertian {
  double n, rho, degrees, reflectance;
};
inline constexpr CoatedLambertian kCoatedLambertians[] = {
    {1.1, 0.5, 0, 0.44744018985}, {1.1, 0.8, 70, 0.7737095301797}, {1.5, 0.5, 0, 0.31607088666},
    {1.5, 0.5, 45, 0.32336606714}, {1.5, 0.8, 70, 0.68295261717}, {1.5, 1.0, 45, 1.0},
};

// ---- Henyey-Greenstein ------------------------------------------------------------------------------------------
/// Moments of the cosine and its cumulative distribution at four cosines.
struct HenyeyGreenstein {
  double g, mean, mean_square, below_minus_half, below_0, below_half, below_09;
};
inline constexpr HenyeyGreenstein kHenyeyGreenstein[] = {
    {-0.9, -0.9, 0.8733333333, 0.9449032672, 0.9770967290, 0.9914351220, 0.9985609128},
    {-0.5, -0.5, 0.5, 0.6339745962, 0.8291796068, 0.9330532905, 0.9885042454},
    {0.0, 0.0, 0.3333333333, 0.25, 0.5, 0.75, 0.95},
    {0.3, 0.3, 0.3933333333, 0.1197532100, 0.2860365326, 0.5397166497, 0.8784062495},
    {0.75, 0.75, 0.7083333333, 0.0251321519, 0.0666666667, 0.1569084478, 0.4660471686},
    {0.95, 0.95, 0.935, 0.0040677376, 0.0108881288, 0.0262639612, 0.0906437495},
};

// ---- Irradiance -------------------------------------------------------------------------------------------------
/// Irradiance from a radiance of 1, closed forms (Howell, A Catalog of Radiation Heat Transfer Configuration Factors, B-3, C-12).
inline constexpr double kUnderSquare = 0.7522746884541074;        ///< centre of a parallel 1 x 1 square at distance 1
inline constexpr double kUnderRectangle = 0.7834014644406422;     ///< centre of a parallel 2 x 0.4 rectangle at distance 0.7
inline constexpr double kFromSphere = 0.19634954084936207;        ///< sphere of radius 0.5 at distance 2, overhead
inline constexpr double kFromTiltedSphere = 0.13884009181744894;  ///< the same, 45 degrees off the normal

// ---- Fluorescence -----------------------------------------------------------------------------------------------
/// A flat patch under an irradiance of 2 per nm from 350 to 400 nm; absorption 1 from 340 to 420 nm, emission flat from 480 to 560 nm.
/// Closed form: L(lo) = c Q e(lo) int a E [li / lo] dli / pi, and (1 - c) r E / pi at 350-400 nm.
struct FlatPatch {
  double concentration, yield, albedo;
  bool photon_yield;
  double reflected_350_400, emitted_480_560;  ///< radiance per nm; radiance of the whole band
};
inline constexpr FlatPatch kFlatPatches[] = {
    {1.0, 1.0, 0.0, false, 0.0, 31.830988618379067},
    {1.0, 1.0, 0.0, true, 0.0, 23.000477508266513},
    {0.8, 0.9, 0.6, true, 0.07639437268410974, 16.560343805951895},
    {0.5, 0.5, 1.0, false, 0.3183098861837907, 7.957747154594767},
};

/// Two infinite parallel fluorescent plates. A absorbs 300-400 nm (times c) and emits flat in 400-500 nm, B absorbs 400-500 and emits in
/// 500-600; energy yields; base albedo r. A beam of irradiance 1 per nm in 300-400 nm falls on A. Radiances per nm in the three bands.
struct Plates {
  double r, c, yield_a, yield_b;
  double radiance_a[3], radiance_b[3];
};
inline constexpr Plates kPlates[] = {
    {0.0, 0.7, 0.9, 0.8, {0, 0.20053522829578813, 0}, {0, 0, 0.11229972784564134}},
    {0.5, 0.7, 0.9, 0.8, {0.05161781938115525, 0.23437280151443463, 0.08749917923205557},
     {0.025808909690577624, 0.035155920227165204, 0.17499835846411113}},
};

}  // namespace stokes::truth
