// The catalogue of planted bugs: what each changes in the kernels, and the check that has to notice. Knows nothing of how checks are run.
#pragma once
#include <ostream>

namespace stokes::tests {

/// A change to one kernel file: the first text, which must stand there exactly once, becomes the second.
struct PlantedBug {
  const char* name;   ///< letters, digits, underscores
  const char* check;  ///< a truth case by its name, or a scene of planted_scenes.cpp
  const char* file;
  const char* find;
  const char* replacement;
};
inline std::ostream& operator<<(std::ostream& out, const PlantedBug& b) { return out << b.name; }

inline constexpr PlantedBug kPlantedBugs[] = {
    // ---- Surfaces ------------------------------------------------------------------------------------------------
    {"albedo_one_percent_more", "white_furnace_sphere_mis_spectral", "material.cl",
     "b.color = color_eval(view, record[1], point, lambda, mask);",
     "b.color = color_eval(view, record[1], point, lambda, mask);\n"
     "  FOR_EACH_WAVELENGTH(k) b.color.v[k] = b.color.v[k] * 1.01f;"},
    {"wrong_fresnel_term", "coated_n1_5_rho0_5_at_45_rgb", "fresnel.cl", "fma(parallel, parallel, perpendicular * perpendicular)",
     "fma(perpendicular, perpendicular, perpendicular * perpendicular)"},
    {"no_total_internal_reflection", "coated_n1_5_rho0_5_at_45_rgb", "fresnel.cl", "return total ? real(1.0f) : f;", "return total ? real(0.5f) : f;"},
    {"refraction_keeps_radiance", "sunken_light_n1_5_at_0", "dielectric.cl", "*weight = reflected ? real(1.0f) : inverse * inverse;",
     "*weight = real(1.0f);"},
    {"lossy_reflection_below_the_surface", "rough_parity", "dielectric.cl",
     "const Mask kept = (*pdf > real(0.0f)) & ((reflects & (wi.z > real(0.0f))) | (!reflects & (wi.z < real(0.0f))));",
     "const Mask kept = *pdf > real(0.0f);"},
    {"shadowing_of_one_side_only", "rough_parity", "dielectric.cl", "return valid ? scale * facets / (real(1.0f) + lambda_o + lambda_i) : real(0.0f);",
     "return valid ? scale * facets / (real(1.0f) + lambda_o) : real(0.0f);"},
    {"texture_shifted_by_one_texel", "texture_parity", "texture.cl", "const Int left = wrap_texel(to_int(x0), width, clamped), right = wrap_texel(to_int(x0) + 1, width, clamped);",
     "const Int left = wrap_texel(to_int(x0) + 1, width, clamped), right = wrap_texel(to_int(x0) + 2, width, clamped);"},
    {"texture_upside_down", "texture_parity", "texture.cl", "fma(real(1.0f) - point->v, to_real(height), -shift)", "fma(point->v, to_real(height), -shift)"},

    // ---- Lights and their weights --------------------------------------------------------------------------------
    {"swapped_mis_weight", "white_furnace_sphere_mis_spectral", "direct.cl", "power_heuristic(s.pdf, pdf)", "power_heuristic(pdf, s.pdf)"},
    {"emission_counted_twice", "white_furnace_sphere_mis_spectral", "path.cl", "return alone ? real(1.0f) : shared;", "return real(1.0f);"},
    {"light_density_without_choice", "texture_parity", "light.cl", "return pdf * gather_real(reals, at + 3);", "return pdf;"},
    {"light_choice_forgotten", "texture_parity", "light.cl", "s.pdf = s.pdf * probability;", ""},
    {"roulette_not_made_up_for", "enclosure_80_mis_spectral", "volpath.cl", "throughput_scale(&path->throughput, real(1.0f) / survival, m & !ends);", ""},
    {"one_bounce_too_many", "enclosure_80_bounces_1_mis_spectral", "volpath.cl", "scatters & (path.bounces >= max_bounces)", "scatters & (path.bounces > max_bounces)"},

    // ---- Wavelengths and the film --------------------------------------------------------------------------------
    {"transposed_colour_matrix", "colored_furnace_spectral", "film.cl", "response.w = 1.0f;",
     "{\n"
     "      // Back to XYZ, then by the transpose of the matrix from XYZ to linear sRGB.\n"
     "      const float4 c = response;\n"
     "      const float X = 0.4123908f * c.x + 0.3575843f * c.y + 0.1804808f * c.z, Y = 0.2126390f * c.x + 0.7151687f * c.y + 0.0721923f * c.z;\n"
     "      const float Z = 0.0193308f * c.x + 0.1191948f * c.y + 0.9505322f * c.z;\n"
     "      response.x = 3.2409699f * X - 0.9692436f * Y + 0.0556301f * Z;\n"
     "      response.y = -1.5373832f * X + 1.8759675f * Y - 0.2039770f * Z;\n"
     "      response.z = -0.4986108f * X + 0.0415551f * Y + 1.0569715f * Z;\n"
     "    }\n"
     "    response.w = 1.0f;"},
    {"all_slots_at_the_last_wavelength", "colored_furnace_spectral", "film.cl", "film_response(view, w->cell[k][j], w->within[k][j])",
     "film_response(view, w->cell[WAVELENGTHS - 1][j], w->within[WAVELENGTHS - 1][j])"},
    {"density_of_wavelengths_forgotten", "colored_furnace_spectral", "spectrum.cl", "inverse_pdf->v[k] = width * real((float)STOKES_CAMERA_KNOTS);", "inverse_pdf->v[k] = real(500.0f);"},
    {"dispersion_loses_the_secondaries", "dispersive_sheet", "throughput.cl", "t->beta.v[0] * real((float)WAVELENGTHS)", "t->beta.v[0]"},

    // ---- Media ---------------------------------------------------------------------------------------------------
    {"sigma_s_one_percent_more", "half_space_0_99_at_0", "medium.cl", "sigma_s.v[k] * scale", "sigma_s.v[k] * scale * 1.01f"},
    {"sign_of_g", "slab_van_de_Hulst_R_rgb", "medium.cl", "isotropic ? real(0.0f) : g", "isotropic ? real(0.0f) : -g"},
    {"missing_one_over_four_pi", "half_space_0_99_at_0", "phase.cl", "(real(1.0f) - g * g) * real(STOKES_INV_4PI)", "(real(1.0f) - g * g)"},
    {"shadow_ray_in_the_wrong_medium", "fog_parity", "direct.cl", "(out ? point->medium_outside : point->medium_inside)",
     "(out ? point->medium_inside : point->medium_outside)"},
    {"shadow_ray_keeps_its_medium", "fog_parity", "shadow.cl", "ray->medium = walking ? (out ? point.medium_outside : point.medium_inside) : ray->medium;", ""},

    {"equiangular_density_forgotten", "ball_of_fog_parity", "flight.cl", "scattering / (scattering + searching)", "real(1.0f)"},
    {"equiangular_jacobian_lost", "airlight_sphere", "equiangular.cl", "e->height / (e->angle * fma(e->height, e->height, along * along))",
     "real(1.0f) / (e->angle * e->height)"},
    {"lamp_along_the_flight_is_not_that_at_its_end", "lamps_in_fog_parity", "airlight.cl", "in_medium & a->chosen : no_lanes()",
     "in_medium & a->sought : no_lanes()"},
    {"densities_of_heroes_before_the_flight_forgotten", "airlight_chromatic", "flight.cl", "distance) * density_sum(&a->before)", "distance)"},

    // ---- Fluorescence --------------------------------------------------------------------------------------------
    {"excitation_density_forgotten", "fluorescent_patch_2_mis", "fluorescence.cl", "(photon ? li : real(1.0f)) * scale / pdf.v[k]", "(photon ? li : real(1.0f)) * scale"},
    {"photon_yield_without_li_over_lo", "fluorescent_patch_2_mis", "fluorescence.cl", "e.v[k] = photon ? e.v[k] / lambda->v[k] : e.v[k];",
     "e.v[k] = photon ? e.v[k] * (1.0f / 520.0f) : e.v[k];"},
    {"branch_probability_missing", "fluorescent_patch_2_mis", "volpath.cl", "throughput_adopt(&path->throughput, &x->throughput, real(1.0f) / x->probability, fluoresces);",
     "throughput_adopt(&path->throughput, &x->throughput, real(1.0f), fluoresces);"},
    {"base_keeps_what_dyes_absorb", "fluorescent_patch_2_mis", "fluorescence.cl", "color->v[k] * max_real(real(1.0f) - absorbed.v[k], real(0.0f))", "color->v[k]"},
    {"splatted_at_the_last_wavelength", "fluorescent_patch_2_mis", "volpath.cl", "path->fluoresced = path->fluoresced | fluoresces;\n  if (SCENE_HAS_MEDIA",
     "path->fluoresced = path->fluoresced | fluoresces;\n"
     "  {\n"
     "    // The number whose first camera wavelength is the path's present one.\n"
     "    Real low = real(0.0f), high = real(0.999f);\n"
     "    for (int i = 0; i < 20; i++) {\n"
     "      const Real middle = (low + high) * 0.5f;\n"
     "      Spectrum lambda, inverse_pdf;\n"
     "      camera_wavelengths(view, middle, &lambda, &inverse_pdf);\n"
     "      const Mask below = lambda.v[0] < path->throughput.lambda.v[0];\n"
     "      low = below ? middle : low;\n"
     "      high = below ? high : middle;\n"
     "    }\n"
     "    path->camera_u = fluoresces ? low : path->camera_u;\n"
     "  }\n"
     "  if (SCENE_HAS_MEDIA"},
    {"fluorescent_emission_counted_twice", "fluorescent_patch_2_mis", "direct.cl", "power_heuristic(s.pdf, pdf)", "real(1.0f)"},
    {"lobe_of_dyes_forgotten", "fluorescent_patch_2_mis", "direct.cl", "collect_light(&x->throughput, &exciting, weight * pdf, seen & x->lanes, &path->radiance);",
     "collect_light(&x->throughput, &exciting, weight, seen & x->lanes, &path->radiance);"},
    {"stokes_mask_ignored", "fluorescent_patch_stokes_mis", "fluorescence.cl", "const Real chained = li <= lo ? own * absorbed : real(0.0f);",
     "const Real chained = own * absorbed;"},
};

}  // namespace stokes::tests
