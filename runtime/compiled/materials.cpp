// Materials with their defaults, and the emission that they give to their surfaces.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiled/compilation.h"

namespace stokes::compiled {
namespace {

constexpr double kDefaultAlbedo = 0.5, kDefaultIor = 1.5, kDefaultAmount = 0.5;

// A spectrum table that must be positive everywhere, as indices of refraction are.
std::uint32_t compile_index(Compilation& c, const SpectrumPtr& s, double fallback, bool may_be_zero) {
  if (!s) return c.spectra.add(c.spectra.constant(fallback));
  const Curve curve = c.spectra.curve(*s, SpectrumRole::Index);
  for (std::size_t i = 0; i < curve.size(); i++)
    if (curve[i] < 0 || (curve[i] == 0 && !may_be_zero))
      c.fail(s->pointer, "an index of refraction must be positive; it is " + std::to_string(curve[i]) + " at " + c.spectra.place(i));
  return c.spectra.add(curve);
}

// Reflectances above 1 make light from nothing; darts allows them, so they are only reported.
std::uint32_t compile_albedo(Compilation& c, const MaterialDescription& m, double fallback) {
  const std::uint32_t reference = compile_color(c, m.albedo, SpectrumRole::Reflectance, fallback);
  const Curve peak = peak_curve(c, reference);
  const auto worst = std::max_element(peak.begin(), peak.end());
  if (*worst > 1 + 1e-5 && !(reference & STOKES_TEXTURE_BIT))
    c.warn(m.pointer + ": the albedo is " + std::to_string(*worst) + " > 1 at " + c.spectra.place(std::size_t(worst - peak.begin())));
  return reference;
}

void fill_dielectric(Compilation& c, const MaterialDescription& m, layout::Material& out) {
  out.albedo = compile_albedo(c, m, 1);
  out.eta = compile_index(c, m.ior, kDefaultIor, false);
  out.parameter = float(m.alpha);
  if (!is_flat(c.spectra.read(out.eta))) {
    out.flags |= MATERIAL_DISPERSIVE;
    c.out.features.dispersion = true;
  }
  (m.alpha > 0 ? c.out.features.rough_dielectric : c.out.features.smooth_dielectric) = true;
}

void fill_conductor(Compilation& c, const MaterialDescription& m, layout::Material& out) {
  out.albedo = compile_albedo(c, m, 1);
  out.eta = compile_index(c, m.eta, 0, true);
  out.k = compile_index(c, m.k, 1, true);
  out.parameter = float(m.alpha);
  c.out.features.conductor = true;
}

void fill_blend(Compilation& c, const MaterialDescription& m, layout::Material& out) {
  if (!m.a || !m.b) c.fail(m.pointer, "two materials are needed");
  out.child_a = compile_material(c, *m.a);
  out.child_b = compile_material(c, *m.b);
  out.amount = float(m.amount.value_or(kDefaultAmount));
  if (m.amount_texture) out.amount_texture = compile_texture(c, *m.amount_texture, TextureUse::Scalar);
  else if (!(out.amount >= 0 && out.amount <= 1)) c.fail(m.pointer, "the amount must be in [0, 1]");
  c.out.features.blends = true;
}

void fill_fluorescent(Compilation& c, const MaterialDescription& m, layout::Material& out) {
  if (c.spectra.rgb()) c.fail(m.pointer, "fluorescence needs wavelengths: it cannot be rendered in rgb mode");
  out.albedo = compile_albedo(c, m, 0);
  out.first_dye = compile_dyes(c, m.dyes, 1, true);
  out.dye_count = std::uint32_t(m.dyes.size());
  check_energy(c, out.first_dye, out.dye_count, peak_curve(c, out.albedo), m.pointer);
  c.out.features.fluorescent_surfaces |= out.dye_count > 0;
}

void fill_reradiation(Compilation& c, const MaterialDescription& m, layout::Material& out) {
  if (c.spectra.rgb()) c.fail(m.pointer, "reradiation needs wavelengths: it cannot be rendered in rgb mode");
  if (!m.matrix) c.fail(m.pointer, "the matrix is missing");
  Curve albedo;
  out.first_dye = compile_reradiation(c, *m.matrix, m.pointer, albedo);
  out.albedo = c.spectra.add(albedo);
  c.out.features.reradiation = true;
}

void fill_reflector(Compilation& c, const MaterialDescription& m, layout::Material& out, double parameter) {
  out.albedo = compile_albedo(c, m, kDefaultAlbedo);
  out.parameter = float(parameter);
}

layout::Material fill_material(Compilation& c, const MaterialDescription& m) {
  layout::Material out{};
  out.albedo = out.eta = out.k = out.child_a = out.child_b = out.amount_texture = out.first_dye = STOKES_NONE;
  switch (m.kind) {
    case MaterialKind::Lambertian:
      out.type = layout::MATERIAL_LAMBERTIAN;
      fill_reflector(c, m, out, 0);
      break;
    case MaterialKind::Metal:
      out.type = layout::MATERIAL_METAL;
      fill_reflector(c, m, out, std::clamp(m.roughness, 0.0, 1.0));
      c.out.features.metal = true;
      break;
    case MaterialKind::Phong:
    case MaterialKind::BlinnPhong:
      out.type = m.kind == MaterialKind::Phong ? layout::MATERIAL_PHONG : layout::MATERIAL_BLINN_PHONG;
      fill_reflector(c, m, out, m.exponent);
      c.out.features.phong = true;
      break;
    case MaterialKind::Conductor: out.type = layout::MATERIAL_CONDUCTOR, fill_conductor(c, m, out); break;
    case MaterialKind::Dielectric: out.type = layout::MATERIAL_DIELECTRIC, fill_dielectric(c, m, out); break;
    case MaterialKind::Interface: out.type = layout::MATERIAL_INTERFACE; break;
    case MaterialKind::DiffuseLight: out.type = layout::MATERIAL_BLACK; break;
    case MaterialKind::Blend: out.type = layout::MATERIAL_BLEND, fill_blend(c, m, out); break;
    case MaterialKind::DiffuseFluorescent: out.type = layout::MATERIAL_FLUORESCENT, fill_fluorescent(c, m, out); break;
    case MaterialKind::Reradiation: out.type = layout::MATERIAL_RERADIATION, fill_reradiation(c, m, out); break;
  }
  return out;
}

// A uv_light's exitance: the emission is scaled so that pi * int L dl = power. The integral is spectral in RGB mode too.
double power_scale(const Compilation& c, const MaterialDescription& m, const Spectrum& emit) {
  if (!m.power) return 1;
  const Spectra spectral(false, c.scene.source);
  const double integral = spectral.integral(spectral.curve(emit, SpectrumRole::Emission));
  if (!(*m.power >= 0) || !(integral > 0)) c.fail(m.pointer, "`power` needs an emission with a positive integral, and must not be negative");
  return *m.power / (std::numbers::pi * integral);
}

std::uint32_t light_emission(Compilation& c, const MaterialDescription& m) {
  Spectrum number;
  number.value = 1;
  const Spectrum& emit = m.emit ? *m.emit : number;
  ColorSource source{std::make_shared<const Spectrum>(emit), nullptr};
  Curve curve = c.spectra.read(compile_color(c, source, SpectrumRole::Emission, 0));
  const double factor = power_scale(c, m, emit);
  for (double& v : curve) v *= factor;
  return c.spectra.add(curve);
}

}  // namespace

std::uint32_t compile_material(Compilation& c, const MaterialDescription& m) {
  if (const auto known = c.materials.find(&m); known != c.materials.end()) return known->second;
  const layout::Material out = fill_material(c, m);
  c.out.materials.push_back(out);
  const auto index = std::uint32_t(c.out.materials.size() - 1);
  c.materials.emplace(&m, index);
  return index;
}

std::uint32_t compile_emission(Compilation& c, const MaterialDescription& m) {
  if (m.kind == MaterialKind::DiffuseLight) {
    if (m.emit_texture) return compile_texture(c, *m.emit_texture, TextureUse::Emission) | STOKES_TEXTURE_BIT;
    return light_emission(c, m);
  }
  if (m.kind != MaterialKind::Blend || !m.a || !m.b) return STOKES_NONE;

  // A blend of lights emits the weighted sum; where the weight is a texture there is no one number for it.
  const std::uint32_t a = compile_emission(c, *m.a), b = compile_emission(c, *m.b);
  if (a == STOKES_NONE && b == STOKES_NONE) return STOKES_NONE;
  if (m.amount_texture || (a != STOKES_NONE && (a & STOKES_TEXTURE_BIT)) || (b != STOKES_NONE && (b & STOKES_TEXTURE_BIT)))
    c.fail(m.pointer, "lights can be blended only by a constant amount and only with untextured emissions; give the surface an `emit` instead");
  const double amount = m.amount.value_or(kDefaultAmount);
  Curve sum = c.spectra.constant(0);
  const auto add = [&](std::uint32_t reference, double weight) {
    if (reference == STOKES_NONE) return;
    const Curve curve = c.spectra.read(reference);
    for (std::size_t i = 0; i < sum.size(); i++) sum[i] += weight * curve[i];
  };
  add(a, 1 - amount);
  add(b, amount);
  return c.spectra.add(sum);
}

}  // namespace stokes::compiled
