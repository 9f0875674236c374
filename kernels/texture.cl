// Textures: colours, amounts and masks that vary over surfaces. Knows surface points and the tables of layout.h, not materials.
#ifndef STOKES_TEXTURE_CL
#define STOKES_TEXTURE_CL
#include "fresnel.cl"
#include "intersect.cl"
#include "noise.cl"
#include "spectrum.cl"

#define STOKES_TEXTURE_DEPTH 8
#define STOKES_TEXTURE_WORDS ((int)(sizeof(Texture) / 4))

STOKES_FN Int texture_uint(const SceneView* view, Int texture, int word) {
  return gather_int((const __global uint*)view->textures, texture * STOKES_TEXTURE_WORDS + word);
}
STOKES_FN Real texture_float(const SceneView* view, Int texture, int word) {
  return gather_real((const __global float*)view->textures, texture * STOKES_TEXTURE_WORDS + word);
}

/// The point in the texture's space.
STOKES_FN Real3 to_texture(const SceneView* view, Int texture, Real3 p) {
  Real m[12];
  for (int k = 0; k < 12; k++) m[k] = texture_float(view, texture, 12 + k);
  return real3(fma(p.x, m[0], fma(p.y, m[1], fma(p.z, m[2], m[3]))), fma(p.x, m[4], fma(p.y, m[5], fma(p.z, m[6], m[7]))),
               fma(p.x, m[8], fma(p.y, m[9], fma(p.z, m[10], m[11]))));
}

/// One factor of the checker's product. A surface that lies on a boundary of cells (a floor at y = 0) belongs to the cell above it,
/// whatever the rounding of its points.
STOKES_FN Real checker_factor(Real x) {
  const Real s = sin_real(x);
  return abs_real(s) < real(1e-4f) ? real(1.0f) : s;
}

STOKES_FN Mask checker_is_odd(const SceneView* view, Int texture, Real3 position) {
  const Real3 p = to_texture(view, texture, position);
  const Real scale = texture_float(view, texture, 3);
  return checker_factor(p.x / scale) * checker_factor(p.y / scale) * checker_factor(p.z / scale) < real(0.0f);
}

/// The weight of marble's base colour; the rest is veins.
STOKES_FN Real marble_base(const SceneView* view, Int texture, Real3 position) {
  const Real3 p = to_texture(view, texture, position);
  const Real phase = fma(real(10.0f), turbulence(p), texture_float(view, texture, 3) * p.z);
  return fma(real(0.5f), sin_real(phase), real(0.5f));
}

/// Near an edge: of the triangle, or of the uv square of other shapes.
STOKES_FN Mask is_on_wire(const SceneView* view, Int texture, const SurfacePoint* point) {
  const Mask triangle = point->primitive >= integer(first_triangle(view));
  const Real a = triangle ? point->b1 : min_real(point->u, real(1.0f) - point->u);
  const Real b = triangle ? point->b2 : min_real(point->v, real(1.0f) - point->v);
  const Real c = triangle ? real(1.0f) - point->b1 - point->b2 : real(1.0f);
  return min_real(min_real(a, b), c) < texture_float(view, texture, 4);
}

// ---- Images --------------------------------------------------------------------------------------------------
/// Four texels of an image (their numbers, row by row) and their bilinear weights.
typedef struct {
  Int texel[4];
  Real weight[4];
} Footprint;

STOKES_FN Int wrap_texel(Int i, Int size, Mask clamped) {
  const Int repeated = i - size * to_int(floor_real(to_real(i) / to_real(size)));
  const Int kept = clamped ? i : repeated;
  return max_int(min_int(kept, size - 1), integer(0));
}

/// v points up, rows go down; texel centres lie at halves.
STOKES_FN Footprint image_footprint(const SceneView* view, Int texture, const SurfacePoint* point) {
  const Int width = texture_uint(view, texture, 6), height = texture_uint(view, texture, 7);
  const Int flags = texture_uint(view, texture, 10);
  const Mask clamped = (flags & (int)TEXTURE_WRAP_CLAMP) != integer(0), nearest = (flags & (int)TEXTURE_NEAREST) != integer(0);
  const Real shift = nearest ? real(0.0f) : real(0.5f);
  const Real x = fma(point->u, to_real(width), -shift), y = fma(real(1.0f) - point->v, to_real(height), -shift);
  const Real x0 = floor_real(x), y0 = floor_real(y);
  const Real fx = nearest ? real(0.0f) : x - x0, fy = nearest ? real(0.0f) : y - y0;
  const Int left = wrap_texel(to_int(x0), width, clamped), right = wrap_texel(to_int(x0) + 1, width, clamped);
  const Int top = wrap_texel(to_int(y0), height, clamped) * width, bottom = wrap_texel(to_int(y0) + 1, height, clamped) * width;
  Footprint f;
  f.texel[0] = top + left;
  f.texel[1] = top + right;
  f.texel[2] = bottom + left;
  f.texel[3] = bottom + right;
  f.weight[0] = (real(1.0f) - fx) * (real(1.0f) - fy);
  f.weight[1] = fx * (real(1.0f) - fy);
  f.weight[2] = (real(1.0f) - fx) * fy;
  f.weight[3] = fx * fy;
  return f;
}

/// Adds weight times the colour of the texel whose four numbers start at texels[4 i + offset]; upsampled as layout.h says,
/// held below 380 nm.
STOKES_FN void add_texel(const SceneView* view, Int first, Real weight, const Spectrum* lambda, Spectrum* sum) {
  Real c[4];
  for (int k = 0; k < 4; k++) c[k] = gather_real(view->texels, first + k);
  FOR_EACH_WAVELENGTH(k) {
    if (SCENE_RGB) {
      sum->v[k] = fma(weight, c[k], sum->v[k]);
      continue;
    }
    const Real t = (max_real(lambda->v[k], real(380.0f)) - real(STOKES_LAMBDA_MIN)) * (1.0f / (STOKES_LAMBDA_MAX - STOKES_LAMBDA_MIN));
    const Real x = fma(fma(c[0], t, c[1]), t, c[2]);
    // One formula twice: the second keeps its digits where the value is small.
    const Real root = sqrt_real(fma(x, x, real(1.0f)));
    const Real low = real(0.5f) / (root * (root + abs_real(x)));
    const Real value = c[3] * (x > real(0.0f) ? real(1.0f) - low : low);
    sum->v[k] = fma(weight, value, sum->v[k]);
  }
}

STOKES_FN Spectrum image_color(const SceneView* view, Int texture, const SurfacePoint* point, const Spectrum* lambda) {
  const Footprint f = image_footprint(view, texture, point);
  const Int offset = texture_uint(view, texture, 5);
  Spectrum sum = spectrum_constant(real(0.0f));
  for (int k = 0; k < 4; k++) add_texel(view, offset + 4 * f.texel[k], f.weight[k], lambda, &sum);
  const Int illuminant = texture_uint(view, texture, 2);
  const Mask lit = illuminant != integer(-1);
  if (any(lit)) {
    const Spectrum shape = spectrum_eval(view, lit ? illuminant : integer(0), lambda);
    FOR_EACH_WAVELENGTH(k) sum.v[k] = lit ? sum.v[k] * shape.v[k] : sum.v[k];
  }
  return sum;
}

STOKES_FN Real image_scalar(const SceneView* view, Int texture, const SurfacePoint* point) {
  const Footprint f = image_footprint(view, texture, point);
  const Int offset = texture_uint(view, texture, 5);
  Real sum = real(0.0f);
  for (int k = 0; k < 4; k++) sum = fma(f.weight[k], gather_real(view->texels, offset + f.texel[k]), sum);
  return sum;
}

// ---- Masks ---------------------------------------------------------------------------------------------------
STOKES_FN Mask is_in_shape(const SceneView* view, Int shape, Real3 p) {
  const __global float* words = (const __global float*)view->regions;
  const Int base = shape * (int)(sizeof(Region) / 4);
  const Int kind = gather_int((const __global uint*)words, base + 7);
  const Real3 a = gather_real3(words, base), b = gather_real3(words, base + 4);
  const Real radius = gather_real(words, base + 3);
  const Real3 q = sub3(p, a), axis = sub3(b, a);
  const Mask box = (min_real(a.x, b.x) <= p.x) & (p.x <= max_real(a.x, b.x)) & (min_real(a.y, b.y) <= p.y) &
                   (p.y <= max_real(a.y, b.y)) & (min_real(a.z, b.z) <= p.z) & (p.z <= max_real(a.z, b.z));
  // A capsule of no length is a sphere.
  const Real length2 = kind == integer(REGION_CAPSULE) ? dot3(axis, axis) : real(0.0f);
  const Real along = length2 > real(0.0f) ? clamp_real(dot3(q, axis) / length2, real(0.0f), real(1.0f)) : real(0.0f);
  const Real3 away = madd3(q, axis, -along);
  const Mask ball = dot3(away, away) <= sqr(radius);
  const Mask is_box = kind == integer(REGION_BOX);
  return (is_box & box) | (!is_box & ball);
}

STOKES_FN Mask is_in_region(const SceneView* view, Int texture, Real3 position, Mask m) {
  const Real3 p = to_texture(view, texture, position);
  const Int first = texture_uint(view, texture, 8), count = texture_uint(view, texture, 9);
  Mask inside = no_lanes();
  for (int i = 0;; i++) {
    const Mask open = m & !inside & (integer(i) < count);
    if (!any(open)) return inside;
    inside = inside | (open & is_in_shape(view, open ? first + i : integer(0), p));
  }
}

/// One number per vertex of the scene, interpolated; 0 on anything but triangles.
STOKES_FN Real vertex_mask(const SceneView* view, Int texture, const SurfacePoint* point, Mask m) {
  const int triangles = first_triangle(view);
  const Mask on = m & (point->primitive >= integer(triangles));
  if (!SCENE_HAS_TRIANGLES) return real(0.0f);
  const Int base = (on ? point->primitive - triangles : integer(0)) * (int)(sizeof(Triangle) / 4);
  const Int offset = texture_uint(view, texture, 5);
  const __global uint* words = (const __global uint*)view->triangles;
  Real value[3];
  for (int k = 0; k < 3; k++) value[k] = gather_real(view->texels, on ? offset + gather_int(words, base + k) : integer(0));
  const Real b0 = real(1.0f) - point->b1 - point->b2;
  return on ? fma(point->b1, value[1], fma(point->b2, value[2], b0 * value[0])) : real(0.0f);
}

// ---- Evaluation ----------------------------------------------------------------------------------------------
/// The texture that a reference names, else 0 (a valid index), where m is true.
STOKES_FN Int texture_index(Int ref, Mask m) { return m ? ref & 0x7fffffff : integer(0); }

/// Follows textures that only choose between two references (checker, wireframe); returns true where it did.
STOKES_FN Mask follow_choice(const SceneView* view, Int texture, Int type, const SurfacePoint* point, Mask m, Int* ref) {
  const Mask checker = m & (type == integer(TEXTURE_CHECKER)), wire = m & (type == integer(TEXTURE_WIREFRAME));
  Mask second = no_lanes();
  if (any(checker)) second = second | (checker & checker_is_odd(view, texture, point->position));
  if (any(wire)) second = second | (wire & is_on_wire(view, texture, point));
  const Mask chosen = checker | wire;
  *ref = chosen ? (second ? texture_uint(view, texture, 2) : texture_uint(view, texture, 1)) : *ref;
  return chosen;
}

/// The value of a spectrum reference (table or texture) at a surface point. Black where m is false and for STOKES_NONE.
STOKES_FN Spectrum color_eval(const SceneView* view, Int ref, const SurfacePoint* point, const Spectrum* lambda, Mask m) {
  m = m & (ref != integer(-1));
  Spectrum result = spectrum_constant(real(0.0f));
  Mask open = m;
  if (SCENE_HAS_TEXTURES) {
    for (int depth = 0; depth < STOKES_TEXTURE_DEPTH; depth++) {
      const Mask textured = open & (ref < integer(0));
      if (!any(textured)) break;
      const Int texture = texture_index(ref, textured);
      const Int type = texture_uint(view, texture, 0);
      const Mask marble = textured & (type == integer(TEXTURE_MARBLE)), image = textured & (type == integer(TEXTURE_IMAGE));
      follow_choice(view, texture, type, point, textured, &ref);
      if (any(marble)) {
        const Real base = marble_base(view, texture, point->position);
        const Spectrum a = spectrum_eval(view, marble ? texture_uint(view, texture, 1) : integer(0), lambda);
        const Spectrum b = spectrum_eval(view, marble ? texture_uint(view, texture, 2) : integer(0), lambda);
        FOR_EACH_WAVELENGTH(k) result.v[k] = marble ? fma(base, a.v[k] - b.v[k], b.v[k]) : result.v[k];
      }
      if (any(image)) {
        const Int safe = image ? texture : integer(0);
        const Spectrum c = image_color(view, safe, point, lambda);
        result = select_spectrum(image, c, result);
      }
      open = open & !(marble | image);
    }
    // What is nested deeper than that stays black.
    open = open & (ref >= integer(0));
  }
  const Spectrum plain = spectrum_eval(view, open ? ref : integer(0), lambda);
  return select_spectrum(open, plain, result);
}

/// The first entry of a table: scalars are constant.
STOKES_FN Real table_scalar(const SceneView* view, Int table) {
  return gather_real(view->spectra, table * (SCENE_RGB ? STOKES_RGB_STRIDE : STOKES_SPECTRUM_STRIDE));
}

/// The value of a scalar texture (an amount, a mask, a Fresnel reflectance) at a surface point, by its index. wo is a unit vector.
STOKES_FN Real scalar_eval(const SceneView* view, Int texture, const SurfacePoint* point, Real3 wo, Mask m) {
  Real result = real(0.0f);
  if (!SCENE_HAS_TEXTURES) return result;
  Int ref = texture | (int)STOKES_TEXTURE_BIT;
  Mask open = m;
  for (int depth = 0; depth < STOKES_TEXTURE_DEPTH; depth++) {
    const Mask textured = open & (ref < integer(0));
    if (!any(textured)) break;
    const Int index = texture_index(ref, textured);
    const Int type = texture_uint(view, index, 0);
    const Mask chosen = follow_choice(view, index, type, point, textured, &ref);
    const Mask marble = textured & (type == integer(TEXTURE_MARBLE)), image = textured & (type == integer(TEXTURE_IMAGE));
    const Mask fresnel = textured & (type == integer(TEXTURE_FRESNEL)), region = textured & (type == integer(TEXTURE_REGION));
    const Mask vertex = textured & (type == integer(TEXTURE_VERTEX_MASK));
    if (any(marble)) {
      const Real base = marble_base(view, index, point->position);
      const Real a = table_scalar(view, marble ? texture_uint(view, index, 1) : integer(0));
      const Real b = table_scalar(view, marble ? texture_uint(view, index, 2) : integer(0));
      result = marble ? fma(base, a - b, b) : result;
    }
    if (any(image)) {
      const Int safe = image ? index : integer(0);
      result = image ? image_scalar(view, safe, point) : result;
    }
    if (any(fresnel)) {
      Real cos_t;
      const Real cos_o = min_real(abs_real(dot3(wo, point->ns)), real(1.0f));
      const Real eta = fresnel ? texture_float(view, index, 4) : real(1.5f);
      const Real reflectance = fresnel_dielectric(cos_o, eta, &cos_t);
      result = fresnel ? reflectance : result;
    }
    if (any(region)) {
      const Mask inside = is_in_region(view, index, point->position, region);
      result = region ? (inside ? real(1.0f) : real(0.0f)) : result;
    }
    if (any(vertex)) result = vertex ? vertex_mask(view, index, point, vertex) : result;
    // Lanes that have arrived at a number wait for the others.
    open = open & (chosen | !textured);
  }
  const Mask plain = open & (ref >= integer(0));
  return plain ? table_scalar(view, plain ? ref : integer(0)) : result;
}
#endif
