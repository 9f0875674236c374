// Fluorescent events, seen from the camera: at a vertex that gives off light at the path's wavelengths lo, excitation wavelengths li
// are drawn, and the path goes on at those. physics.md's kernel: K(li, lo) = absorption(li) yield emission(lo) [li / lo].
//
// Dyes without a Stokes mask *collapse*: K is a product, so the slots' emissions at lo are summed up once and for all into the mixture, and
// N stratified excitation wavelengths share it. Masked dyes and measured matrices are not products: slot k keeps its own chain lo_k -> li_k.
#ifndef STOKES_FLUORESCENCE_CL
#define STOKES_FLUORESCENCE_CL
#include "material.cl"
#include "throughput.cl"

#define DYE_WORDS 8
#define RERADIATION_WORDS 8

/// Four words of a dye, at row 0 (absorption, emission, excitation, yield) or 1 (strength, flags, curves, -).
STOKES_FN void dye_row(const SceneView* view, Int dye, int row, Int* x4) {
  gather_int4((const __global uint*)view->dyes, dye * (DYE_WORDS / 4) + row, x4);
}

/// The throughput beyond a fluorescent event, not yet divided by the probability that the path goes on through it.
typedef struct {
  Throughput throughput;
  Real probability;
  Mask lanes;
} Excitation;

/// One dye of a set, chosen in proportion to what it gives off at the path's wavelengths.
typedef struct {
  Int dye, flags;
  Real chosen;  // what the chosen one gives off
  Real total;   // and all of them
  Spectrum emission;  // of the chosen one, as dye_emission
} DyeChoice;

/// A dye's two curves at one wavelength: what it absorbs, and *emission.
STOKES_FN Real dye_curves(const SceneView* view, Int curves, Real lambda, Real* emission) {
  Real f, ends[4];
  const Int c = spectrum_cell(lambda, &f);
  gather_real4(view->spectra, curves * (STOKES_SPECTRUM_STRIDE / 4) + c, ends);
  *emission = fma(f, ends[3] - ends[2], ends[2]);
  return fma(f, ends[1] - ends[0], ends[0]);
}

/// What a dye gives off at the path's wavelengths: emission(lo) [/ lo], per nm. *absorbed receives what it absorbs there.
STOKES_FN Spectrum dye_emission(const SceneView* view, Int flags, Int curves, const Spectrum* lambda, Mask mask, Spectrum* absorbed) {
  Spectrum e = spectrum_constant(real(0.0f));
  if (STOKES_PACKS_SLOTS) {
    *absorbed = e;
    for (uint left = lane_bits(mask); left != 0u;) {
      const SlotPaths paths = slots_take(&left);
      Real emitted;
      const Real taken = dye_curves(view, slots_of_int(&paths, &curves), slots_of_spectrum(&paths, lambda), &emitted);
      slots_return(&paths, taken, absorbed);
      slots_return(&paths, emitted, &e);
    }
  } else {
    FOR_EACH_WAVELENGTH(k) absorbed->v[k] = dye_curves(view, curves, lambda->v[k], &e.v[k]);
  }
  const Mask photon = (flags & (int)DYE_PHOTON_YIELD) != integer(0);
  if (any(mask & photon)) FOR_EACH_WAVELENGTH(k) e.v[k] = photon ? e.v[k] / lambda->v[k] : e.v[k];
  return e;
}

/// sum_k beta_k s_k
STOKES_FN Real beta_sum(const Throughput* t, const Spectrum* s) {
  Real sum = real(0.0f);
  FOR_EACH_WAVELENGTH(k) sum = fma(t->beta.v[k], s->v[k], sum);
  return sum;
}

/// Chooses among `count` dyes from `first` on; *absorbed, unless null, receives what they absorb at the path's wavelengths.
STOKES_FN DyeChoice dye_choose(const SceneView* view, const Throughput* t, Int first, Int count, Real u, Mask mask, Spectrum* absorbed) {
  DyeChoice c;
  c.dye = c.flags = integer(0);
  c.chosen = c.total = real(0.0f);
  c.emission = spectrum_constant(real(0.0f));
  for (int i = 0;; i++) {
    const Mask m = mask & (integer(i) < count);
    if (!any(m)) return c;
    const Int dye = m ? first + i : integer(0);
    Int row[4];
    dye_row(view, dye, 1, row);
    Spectrum a;
    const Spectrum e = dye_emission(view, row[1], row[2], &t->lambda, m, &a);
    const Real strength = m ? as_real(row[0]) * beta_sum(t, &e) : real(0.0f);
    // A reservoir of one: what is left of u is uniform again.
    const Real total = c.total + strength;
    const Real p = total > real(0.0f) ? strength / total : real(0.0f);
    const Mask take = m & (u < p);
    const Real rest = take ? u / max_real(p, real(1e-30f)) : (u - p) / max_real(real(1.0f) - p, real(1e-30f));
    u = m ? rest : u;
    c.dye = take ? dye : c.dye;
    c.flags = take ? row[1] : c.flags;
    c.chosen = take ? strength : c.chosen;
    c.emission = select_spectrum(take, e, c.emission);
    c.total = total;
    if (absorbed) FOR_EACH_WAVELENGTH(k) absorbed->v[k] = m ? absorbed->v[k] + a.v[k] : absorbed->v[k];
  }
}

/// Stratified excitation wavelengths of the masked lanes and their densities per nm; *absorbed and, of a lone lamp, *lamp receive what the curves
/// are there.
STOKES_FN Spectrum excitation_sample(const SceneView* view, Int excitation, Int absorption, Real u, Mask mask, Spectrum* pdf, Spectrum* absorbed,
                                     Spectrum* lamp) {
  const int lamp_table = lone_lamp(view);
  Spectrum li = spectrum_constant(real(STOKES_LAMBDA_MIN));
  if (STOKES_PACKS_SLOTS) {
    *pdf = *absorbed = li;
    for (uint left = lane_bits(mask); left != 0u;) {
      const SlotPaths paths = slots_take(&left);
      Real density;
      const Real drawn = distribution_sample(view, slots_of_int(&paths, &excitation), slots_stratum(slots_of_real(&paths, &u)), all_lanes(), &density);
      slots_return(&paths, drawn, &li);
      slots_return(&paths, density, pdf);
      slots_return(&paths, spectrum_eval1(view, slots_of_int(&paths, &absorption), drawn), absorbed);
      if (lamp_table >= 0) slots_return(&paths, spectrum_eval1(view, integer(lamp_table), drawn), lamp);
    }
  } else {
    FOR_EACH_WAVELENGTH(k) {
      li.v[k] = distribution_sample(view, excitation, stratum(u, k), mask, &pdf->v[k]);
      absorbed->v[k] = spectrum_eval1(view, absorption, li.v[k]);
      if (lamp_table >= 0) lamp->v[k] = mask ? spectrum_eval1(view, integer(lamp_table), li.v[k]) : lamp->v[k];
    }
  }
  return li;
}

/// The throughput beyond an event at the chosen dye: the masked lanes of *out.
STOKES_FN void dye_excite(const SceneView* view, const Throughput* t, const DyeChoice* c, Real u, Mask mask, Throughput* out) {
  const Int dye = mask ? c->dye : integer(0);
  Int row[4];
  dye_row(view, dye, 0, row);
  const Int flags = c->flags;
  const Mask photon = (flags & (int)DYE_PHOTON_YIELD) != integer(0), stokes = (flags & (int)DYE_STOKES) != integer(0);
  const Real scale = as_real(row[3]) / (mask ? c->chosen / c->total : real(1.0f));
  const Real share = hero_share(t);
  Real mean = real(0.0f);
  FOR_EACH_WAVELENGTH(k) mean = fma(t->beta.v[k] * c->emission.v[k], real(1.0f / (float)WAVELENGTHS), mean);
  Spectrum pdf, absorption;
  const Spectrum drawn = excitation_sample(view, row[2], row[0], u, mask, &pdf, &absorption, &out->lamp);
  FOR_EACH_WAVELENGTH(k) {
    const Real li = drawn.v[k], lo = t->lambda.v[k];
    const Real absorbed = absorption.v[k] * (photon ? li : real(1.0f)) * scale / pdf.v[k];
    // Without a mask the slots' emissions move into the mixture; with it each slot carries its own on.
    const Real own = t->beta.v[k] * c->emission.v[k];
    const Real chained = li <= lo ? own * absorbed : real(0.0f);
    const Real mixed = share * (t->mixed ? t->mixture.v[k] * mean : own);
    out->lambda.v[k] = mask ? li : out->lambda.v[k];
    out->beta.v[k] = mask ? (stokes ? chained : absorbed) : out->beta.v[k];
    out->mixture.v[k] = mask ? (stokes ? t->mixture.v[k] : mixed) : out->mixture.v[k];
    out->density.v[k] = mask ? (stokes ? t->density.v[k] : real(1.0f)) : out->density.v[k];
  }
  out->mixed = (mask & (!stokes | t->mixed)) | (!mask & out->mixed);
  out->alone = (mask & stokes & t->alone) | (!mask & out->alone);
}

/// A surface with dyes: takes what they absorb from the base's colour and prepares the fluorescent branch.
STOKES_FN void surface_excite(const SceneView* view, const Throughput* t, Int material, Real u_dye, Real u_lambda, Mask mask, Spectrum* color,
                              Excitation* x) {
  const Int safe = mask ? material : integer(0);
  const Int first = material_uint(view, safe, 9), count = material_uint(view, safe, 10);
  Spectrum absorbed = spectrum_constant(real(0.0f));
  const DyeChoice c = dye_choose(view, t, first, count, u_dye, mask, &absorbed);
  FOR_EACH_WAVELENGTH(k) color->v[k] = mask ? color->v[k] * max_real(real(1.0f) - absorbed.v[k], real(0.0f)) : color->v[k];
  const Mask glows = mask & (c.chosen > real(0.0f));
  const Real all = c.total + beta_sum(t, color);
  dye_excite(view, t, &c, u_lambda, glows, &x->throughput);
  x->probability = glows ? c.total / all : x->probability;
  x->lanes = x->lanes | glows;
}

/// K(li, lo) of a measured matrix, 1/nm: bilinear between its bands, 0 outside.
STOKES_FN Real reradiation_eval(const SceneView* view, Int matrix, Real li, Real lo) {
  const __global uint* words = (const __global uint*)view->reradiations;
  const __global float* reals = (const __global float*)view->reradiations;
  const Int at = matrix * RERADIATION_WORDS;
  const Int columns = gather_int(words, at + 1), rows = gather_int(words, at + 2);
  const Real x = (li - gather_real(reals, at + 3)) / gather_real(reals, at + 4);
  const Real y = (lo - gather_real(reals, at + 5)) / gather_real(reals, at + 6);
  const Mask inside = (x >= real(0.0f)) & (x <= to_real(columns - 1)) & (y >= real(0.0f)) & (y <= to_real(rows - 1));
  const Int i = max_int(min_int(to_int(inside ? x : real(0.0f)), columns - 2), integer(0));
  const Int j = max_int(min_int(to_int(inside ? y : real(0.0f)), rows - 2), integer(0));
  const Real fx = x - to_real(i), fy = y - to_real(j);
  const Int cell = gather_int(words, at) + j * columns + i;
  const Real a = gather_real(view->reradiation_values, cell), b = gather_real(view->reradiation_values, cell + 1);
  const Real c = gather_real(view->reradiation_values, cell + columns), d = gather_real(view->reradiation_values, cell + columns + 1);
  const Real low = fma(fx, b - a, a), high = fma(fx, d - c, c);
  return inside ? fma(fy, high - low, low) : real(0.0f);
}

/// A surface with a measured matrix: prepares the fluorescent branch; each slot keeps its own chain.
STOKES_FN void reradiation_excite(const SceneView* view, const Throughput* t, Int material, Real u, Mask mask, const Spectrum* color, Excitation* x) {
  const __global uint* words = (const __global uint*)view->reradiations;
  const __global float* reals = (const __global float*)view->reradiations;
  const Int matrix = mask ? material_uint(view, mask ? material : integer(0), 9) : integer(0);
  const Int at = matrix * RERADIATION_WORDS;
  const Int rows = gather_int(words, at + 2), first = gather_int(words, at + 7);
  const Real lo_step = gather_real(reals, at + 6);
  Throughput* out = &x->throughput;
  Real glow = real(0.0f);
  FOR_EACH_WAVELENGTH(k) {
    const Real lo = t->lambda.v[k];
    const Real nearest = floor_real((lo - gather_real(reals, at + 5)) / lo_step + real(0.5f));
    const Mask has_row = (nearest >= real(0.0f)) & (nearest < to_real(rows));
    const Int row = first + to_int(has_row ? nearest : real(0.0f));
    Real pdf;
    const Real li = distribution_sample(view, row, stratum(u, k), mask, &pdf);
    const Real response = has_row ? reradiation_eval(view, matrix, li, lo) : real(0.0f);
    // The row's integral over li, which was taken before the values were divided by the band's width.
    const Real strength = has_row ? gather_real((const __global float*)view->distributions, row * 4 + 3) / lo_step : real(0.0f);
    glow = fma(t->beta.v[k], strength, glow);
    out->lambda.v[k] = mask ? li : out->lambda.v[k];
    out->beta.v[k] = mask ? t->beta.v[k] * response / pdf : out->beta.v[k];
    out->mixture.v[k] = mask ? t->mixture.v[k] : out->mixture.v[k];
    out->density.v[k] = mask ? t->density.v[k] : out->density.v[k];
  }
  throughput_see_lamp(view, out, mask);
  out->mixed = (mask & t->mixed) | (!mask & out->mixed);
  out->alone = (mask & t->alone) | (!mask & out->alone);
  const Mask glows = mask & (glow > real(0.0f));
  x->probability = glows ? glow / (glow + beta_sum(t, color)) : x->probability;
  x->lanes = x->lanes | glows;
}

/// Prepares the fluorescent branch of all fluorescent surfaces among the masked lanes and leaves the bases' colours in *color.
STOKES_FN Excitation excitation_at(const SceneView* view, const Throughput* t, Int material, Rng* rng, Mask mask, Bsdf* b) {
  Excitation x;
  x.throughput = *t;
  x.probability = real(0.0f);
  x.lanes = no_lanes();
  if (SCENE_HAS_FLUORESCENT_SURFACES) {
    const Mask dyed = mask & bsdf_is(b, MATERIAL_FLUORESCENT);
    if (any(dyed)) {
      const Real u_dye = random_next_where(rng, dyed), u_lambda = random_next_where(rng, dyed);
      surface_excite(view, t, material, u_dye, u_lambda, dyed, &b->color, &x);
    }
  }
  if (SCENE_HAS_RERADIATION) {
    const Mask measured = mask & bsdf_is(b, MATERIAL_RERADIATION);
    if (any(measured)) reradiation_excite(view, t, material, random_next_where(rng, measured), measured, &b->color, &x);
  }
  return x;
}
#endif
