// The data that host and device share: every struct, enum and table stride that crosses the border. It is the
// only file that both languages compile, so it holds nothing but float, int, uint and structs of these.
//
// Conventions. Indices are uint; STOKES_NONE says "there is none". A *spectrum reference* is an index into the spectrum tables or,
// with STOKES_TEXTURE_BIT set, an index into the textures. Lengths are in scene units, wavelengths in nm.
#ifndef STOKES_LAYOUT_H
#define STOKES_LAYOUT_H

#ifdef __OPENCL_VERSION__
#define LAYOUT_CHECK(type, bytes) \
  typedef char layout_check_##type[(sizeof(type) == (bytes)) ? 1 : -1]
#else
#include <cstdint>
namespace stokes::layout {
using uint = std::uint32_t;
#define LAYOUT_CHECK(type, bytes) static_assert(sizeof(type) == (bytes), #type)
#endif

#define STOKES_NONE 0xffffffffu
#define STOKES_TEXTURE_BIT 0x80000000u

// ---- Spectrum tables -------------------------------------------------------------------------------------------
// A spectral table covers 280-780 nm in 500 cells of 1 nm. Each cell stores the values at its own two ends and is
// linear in between, so a step at a whole nanometre is exact. Cell c of table t starts at t * 1000 + 2 c.
// In RGB mode a table is three floats (red, green, blue) with stride 3.
#define STOKES_LAMBDA_MIN 280.0f
#define STOKES_LAMBDA_MAX 780.0f
#define STOKES_SPECTRUM_CELLS 500
#define STOKES_SPECTRUM_STRIDE 1000
#define STOKES_RGB_STRIDE 3
// Camera wavelengths are drawn through a tabulated inverse CDF of STOKES_CAMERA_KNOTS segments: with x = u * KNOTS,
// i = floor(x), lambda = lerp(knot[i], knot[i+1], x - i), and 1/pdf(lambda) = KNOTS * (knot[i+1] - knot[i]), exactly.
#define STOKES_CAMERA_KNOTS 1024
// A cumulative table has four floats for each of the STOKES_SPECTRUM_CELLS cells: the cumulative probability at the cell's two ends, and the
// density there, per nm. Behind them stand STOKES_CDF_GUIDES cells, that into which i / STOKES_CDF_GUIDES falls for every i: where to look first.
#define STOKES_CDF_GUIDES 2048
#define STOKES_CDF_STRIDE (4 * STOKES_SPECTRUM_CELLS + STOKES_CDF_GUIDES)

typedef struct {
  float x, y, z;
} Vec3;
LAYOUT_CHECK(Vec3, 12);

// ---- Geometry --------------------------------------------------------------------------------------------------
// A primitive's global index counts quads first, then spheres, ellipsoids and triangles.

// A parallelogram: corner + u edge_u + v edge_v with u, v in [0, 1]. The front side is the side of `normal`.
typedef struct {
  Vec3 normal;   // unit, already reversed when the surface is flipped
  float offset;  // plane: dot(normal, p) = offset
  Vec3 dual_u;   // u(p) = dot(dual_u, p) - u0
  float u0;
  Vec3 dual_v;  // v(p) = dot(dual_v, p) - v0
  float v0;
  Vec3 corner;
  float area;
  Vec3 edge_u;
  uint surface;
  Vec3 edge_v;
  uint light;  // index of its light or STOKES_NONE
  // A hit at distance t counts where |u - 1/2| <= reach_u + growth_u t, v alike: 1/2, and what rounding may have added.
  float reach_u, growth_u, reach_v, growth_v;
} Quad;
LAYOUT_CHECK(Quad, 112);

// A true sphere (rotation, translation and uniform scale). `to_local` rotates world directions into the sphere's
// frame (rows), for texture coordinates only.
typedef struct {
  Vec3 center;
  float radius;
  float to_local[9];
  uint surface;
  uint light;
  uint flip;  // 1: the front side is the inside
} Sphere;
LAYOUT_CHECK(Sphere, 64);

// A unit sphere under any invertible affine map. 3x4 matrices, row by row, applied to (x, y, z, 1).
typedef struct {
  float to_local[12];
  float to_world[12];
  uint surface;
  uint light;
  uint flip;
  float area;
} Ellipsoid;
LAYOUT_CHECK(Ellipsoid, 112);

// Vertex indices into positions, normals and uvs alike. The geometric normal is that of the counter-clockwise winding;
// flipped surfaces have their winding reversed at compile time.
typedef struct {
  uint v0, v1, v2;
  uint surface;
  uint light;
  float area;
  uint mesh;      // index of the mesh, for per-vertex masks
  uint padding;
} Triangle;
LAYOUT_CHECK(Triangle, 32);

#define SURFACE_SMOOTH_NORMALS 1u
#define SURFACE_HAS_UV 2u
#define SURFACE_INTERFACE 4u  // its material is `interface`: shadow rays pass, and no bounce is counted
#define SURFACE_FLIPPED 8u

// What a primitive is made of, shared by all the primitives of one surface.
typedef struct {
  uint material;
  uint medium_outside;  // on the side the normal points to; 0 is vacuum
  uint medium_inside;
  uint emission;  // spectrum reference or STOKES_NONE; emits from the front side
  uint flags;     // SURFACE_*
  uint padding[3];
} Surface;
LAYOUT_CHECK(Surface, 32);

// BVH nodes have W children (W is 8, 4 or 2 and fixed per build) in W * 8 words:
// minx[W] maxx[W] miny[W] maxy[W] minz[W] maxz[W] child[W] padding[W]. A child is a node index, or with
// STOKES_LEAF_BIT set ((first block << 3) | (blocks - 1)), or STOKES_NONE for an empty slot, whose box is a point far away.
// A leaf block holds W triangles in W * 10 words: v0x[W] v0y[W] v0z[W] v1x[W] ... v2z[W] id[W], where id is the triangle's index
// (within the triangles) and STOKES_NONE in unused slots, whose vertices are all zero.
#define STOKES_LEAF_BIT 0x80000000u

// ---- Camera ----------------------------------------------------------------------------------------------------
enum CameraType { CAMERA_PERSPECTIVE = 0, CAMERA_ORTHOGRAPHIC = 1 };

// A film point (x, y) in [-1, 1]^2 (+y up) maps to the point x half_width axis_x + y half_height axis_y - axis_z on the plane at
// distance 1 (perspective), or starts the ray at x half_width axis_x + y half_height axis_y (orthographic).
typedef struct {
  Vec3 position;
  uint type;
  Vec3 axis_x;
  float half_width;
  Vec3 axis_y;
  float half_height;
  Vec3 axis_z;  // the camera looks along -axis_z; axes carry no scale
  float lens_radius;
  float focal_distance;
  uint width, height;  // of the full image in pixels
  uint medium;
} Camera;
LAYOUT_CHECK(Camera, 80);

// ---- Materials -------------------------------------------------------------------------------------------------
enum MaterialType {
  MATERIAL_BLACK = 0,        // absorbs everything (lights)
  MATERIAL_LAMBERTIAN = 1,
  MATERIAL_METAL = 2,        // darts' fuzzy mirror; parameter = roughness
  MATERIAL_CONDUCTOR = 3,    // GGX; parameter = alpha (0: mirror)
  MATERIAL_DIELECTRIC = 4,   // smooth, or GGX with parameter = alpha > 0
  MATERIAL_INTERFACE = 5,
  MATERIAL_PHONG = 6,        // parameter = exponent
  MATERIAL_BLINN_PHONG = 7,  // parameter = exponent
  MATERIAL_BLEND = 8,        // child_b with weight `amount`, child_a with the rest; also `painted`
  MATERIAL_FLUORESCENT = 9,  // lambertian base and dyes
  MATERIAL_RERADIATION = 10  // measured matrix
};

#define MATERIAL_DISPERSIVE 1u  // the index of refraction depends on the wavelength

typedef struct {
  uint type;
  uint albedo;     // spectrum reference: albedo; the scatter albedo of a dielectric
  uint eta;        // spectrum: index of refraction (dielectric: inside over outside), conductor's eta
  uint k;          // spectrum: conductor's extinction coefficient
  float parameter;
  uint child_a;    // blend: materials
  uint child_b;
  uint amount_texture;  // blend: texture index (no STOKES_TEXTURE_BIT), or STOKES_NONE for the constant
  float amount;
  uint first_dye;  // fluorescent: dyes; reradiation: index of the matrix
  uint dye_count;
  uint flags;      // MATERIAL_*
} Material;
LAYOUT_CHECK(Material, 48);

// ---- Textures --------------------------------------------------------------------------------------------------
enum TextureType {
  TEXTURE_CHECKER = 0,    // odd (b) where sin(x/s) sin(y/s) sin(z/s) < 0, else even (a)
  TEXTURE_MARBLE = 1,     // b (veins) and a (base) mixed by noise; both are spectra, not textures
  TEXTURE_IMAGE = 2,      // bilinear in the upsampled spectra of its texels
  TEXTURE_WIREFRAME = 3,  // b (wire) near a triangle's edge, else a (base)
  TEXTURE_FRESNEL = 4,    // scalar: unpolarised Fresnel reflectance from 1 into `parameter` at the angle of wo
  TEXTURE_REGION = 5,     // scalar mask: 1 inside any of its shapes
  TEXTURE_VERTEX_MASK = 6 // scalar mask interpolated from the mesh's vertices
};

// Marble's noise, so that both integrators draw the same veins: gradient noise with Hermite weights; the gradient at the lattice point
// (i, j, k) is the unit vector with z = 1 - 2 ((h & 0xffff) + 1/2) / 65536 and azimuth 2 pi ((h >> 16) + 1/2) / 65536, where
// h = i * 73856093 ^ j * 19349663 ^ k * 83492791 (modulo 2^32), then h ^= h >> 16, h *= 0x7feb352d, h ^= h >> 15, h *= 0x846ca68b, h ^= h >> 16.
// turbulence(p) = |sum over i < 7 of 2^-i noise(2^i p)|; value = veins + (base - veins) (1 + sin(scale z + 10 turbulence)) / 2.
#define TEXTURE_SCALAR_IMAGE 1u  // texels are single floats (masks, amounts), not four
#define TEXTURE_WRAP_CLAMP 2u    // default is repeat
#define TEXTURE_NEAREST 4u

// Texels of colour images are float4 (c0, c1, c2, scale): value(lambda) = scale * sigmoid((c0 t + c1) t + c2) with
// t = (lambda - 280) / 500 and sigmoid(x) = 1/2 + x / (2 sqrt(1 + x^2)). In RGB mode (r, g, b, 0).
typedef struct {
  uint type;
  uint a;           // spectrum reference (may be a texture again, except for marble); read at its first entry by scalar textures
  uint b;           // image: spectrum its texels are multiplied by (D65 for emissions), or STOKES_NONE
  float scale;
  float parameter;  // wireframe: thickness; fresnel: ior
  uint image_offset;  // first texel (in floats) of an image; vertex mask: one float for every vertex of the scene
  uint image_width;
  uint image_height;
  uint first_shape;  // region
  uint shape_count;
  uint flags;
  uint uv_wrap;      // reserved
  float to_texture[12];  // world to texture space, row by row (checker, marble, region)
} Texture;
LAYOUT_CHECK(Texture, 96);

enum RegionShape { REGION_SPHERE = 0, REGION_BOX = 1, REGION_CAPSULE = 2 };
// sphere: a = centre, radius. box: a, b = two corners. capsule: segment a-b, radius.
typedef struct {
  Vec3 a;
  float radius;
  Vec3 b;
  uint shape;
} Region;
LAYOUT_CHECK(Region, 32);

// ---- Media and fluorescence ------------------------------------------------------------------------------------
#define MEDIUM_ISOTROPIC 1u
#define MEDIUM_CHROMATIC 2u  // sigma_t or g depends on the wavelength
// Every surface that borders on it is refracting or opaque, none shines into it and at least one is a dielectric: from inside, light
// is found by hitting it and not sought. A matter of speed only: both ways are unbiased.
#define MEDIUM_SEALED 4u
// So thin against the scene, in which there are lamps, that most flights pass it: the lamps' light is sought along each flight besides.
// A matter of noise only.
#define MEDIUM_THIN 8u
// A homogeneous participating medium, coefficients per scene unit; medium 0 is vacuum (all coefficients zero).
typedef struct {
  uint sigma_t;  // spectrum tables; sigma_t includes what its dyes absorb
  uint sigma_s;
  uint g;        // spectrum: mean cosine in (-1, 1); not read when isotropic
  uint flags;    // MEDIUM_*
  uint first_dye;
  uint dye_count;
  float mean_free_path;  // at the wavelength where sigma_t is largest; 0 for vacuum
  uint padding;
} Medium;
LAYOUT_CHECK(Medium, 32);

#define DYE_PHOTON_YIELD 1u
#define DYE_STOKES 2u  // no emission at wavelengths shorter than the excitation's
// K(li, lo) = absorption(li) * yield * emission(lo) [* li / lo for a photon yield]
typedef struct {
  uint absorption;  // spectrum: c a(l) in [0, 1] for surfaces; sigma_a per scene unit for media
  uint emission;    // spectrum: e(l) in 1/nm, integrating to 1
  uint excitation;  // distribution that excitation wavelengths are drawn from
  float yield;
  float strength;   // int absorption(l) [* l for a photon yield] dl * yield
  uint flags;       // DYE_*
  uint curves;      // absorption and emission once more, for one look at both: two spectrum tables, whose cells of four floats are interleaved
  uint padding;
} Dye;
LAYOUT_CHECK(Dye, 32);

// A spectrum as a probability density: pdf(l) = table(l) / integral, cumulative table at cdf * STOKES_CDF_STRIDE, where cdf is
// the distribution's own index.
typedef struct {
  uint spectrum;
  uint cdf;
  float integral;
  float strength;  // integral of the absorption alone that it was made from
} Distribution;
LAYOUT_CHECK(Distribution, 16);

// A measured reradiation matrix on a regular grid: K(li, lo) in 1/nm at values[offset + row(lo) * columns + column(li)], bilinear between
// the grid's points and zero outside. The diagonal is apart, as the material's albedo.
typedef struct {
  uint offset;
  uint columns, rows;
  float li_min, li_step;
  float lo_min, lo_step;
  uint first_excitation;  // one Distribution per row: li given lo (nearest row; pdf mixes the light's spectrum)
} Reradiation;
LAYOUT_CHECK(Reradiation, 32);

// ---- Lights ----------------------------------------------------------------------------------------------------
enum LightType {
  LIGHT_QUAD = 0,
  LIGHT_SPHERE = 1,
  LIGHT_ELLIPSOID = 2,
  LIGHT_TRIANGLE = 3,
  LIGHT_BACKGROUND = 4,  // constant radiance from every direction
  LIGHT_ENVIRONMENT = 5  // image
};

// Lights are chosen by power over 280-780 nm with the alias method: i = floor(u n); keep i if frac < threshold, else alias.
typedef struct {
  uint type;
  uint primitive;     // index within its own kind's array
  uint emission;      // spectrum reference
  float probability;  // of being chosen
  float alias_threshold;
  uint alias;
  float area;
  uint padding;
} Light;
LAYOUT_CHECK(Light, 32);

// An equirectangular environment. For a direction (x, y, z) in the image's frame u = 1/2 + atan2(x, -z) / (2 pi) and v = acos(y) / pi from
// the top, so the image's centre lies at -z. Bilinear between texel centres, repeating in u and clamped in v. Sampled by row and column CDFs of
// (height + 1) and height * (width + 1) floats in `environment_cdf`.
typedef struct {
  uint image_offset;
  uint width, height;
  float scale;
  float to_local[9];  // world directions into the image's frame
  uint illuminant;    // spectrum table that the upsampled texels are multiplied by (D65)
  uint padding[2];
} Environment;
LAYOUT_CHECK(Environment, 64);

// ---- The whole scene -------------------------------------------------------------------------------------------
enum IntegratorType {
  INTEGRATOR_MATS = 0,     // material (and phase) sampling only
  INTEGRATOR_NEE = 1,      // next-event estimation only, beside specular hits
  INTEGRATOR_MIS = 2,
  INTEGRATOR_NORMALS = 3,
  INTEGRATOR_AO = 4
};

// Quads that are faces of one box along the axes: rays are tested against them together, as against the planes of the box.
typedef struct {
  Vec3 low, high;
  int faces[6];  // the quads at x low, x high, y low, y high, z low and z high; -1: open
} Room;
LAYOUT_CHECK(Room, 48);
#define SCENE_ROOMS 4

typedef struct {
  Camera camera;
  uint integrator;
  uint max_bounces;
  uint russian_roulette;  // first bounce at which it may end a path; STOKES_NONE: off
  uint quad_count, sphere_count, ellipsoid_count, triangle_count;
  uint light_count;
  uint background_light;  // index into lights, or STOKES_NONE
  uint background;        // spectrum reference of a constant background, or STOKES_NONE
  uint has_environment;
  float scene_radius;     // of a sphere around scene_center that holds everything
  Vec3 scene_center;
  float film_quantum;     // a power of two: the unit of the film's fixed-point sums of radiance
  float depth_quantum;
  uint spectral_bins;     // 0: none
  float spectral_begin, spectral_end;  // nm
  uint film_channels;     // FILM_* in use
  uint film_stride;       // longs per pixel
  Vec3 box_low, box_high;  // around all primitives
  uint room_quads[2];      // bit i: quad i is a face of a room
  uint room_count;
  Room rooms[SCENE_ROOMS];
} Scene;
LAYOUT_CHECK(Scene, 396);

// ---- Film ------------------------------------------------------------------------------------------------------
// Per pixel `film_stride` 64-bit words. Sums are integers in units of a quantum, so that they do not depend on the order:
//   [0..2] sum of R, G, B (linear sRGB)            signed, film_quantum
//   [3..8] sum of squares of R, G, B as 128 bits   (low, high) each, film_quantum^2
//   [9]    alpha (coverage)                        signed, 2^-24
//   [10]   samples                                 count
//   [11]   invalid samples (NaN, infinite, out of range), which are left out of every sum    count
// then, where their bit is set in film_channels and in this order, albedo (3, 2^-24), normal (3, 2^-24), depth (1, depth_quantum),
// fluorescence (4: R, G, B and the energy over all wavelengths; film_quantum), then `spectral_bins` sums of radiance per nm, then, with
// FILM_FLUORESCENT_BINS (which needs FILM_FLUORESCENCE and bins), as many of the part that went through a fluorescent event.
#define FILM_BASE_WORDS 12
#define FILM_ALBEDO 1u
#define FILM_NORMAL 2u
#define FILM_DEPTH 4u
#define FILM_FLUORESCENCE 8u
#define FILM_FLUORESCENT_BINS 16u

// One launch: the samples [sample_begin, sample_end) of the pixels [pixel_begin, pixel_end), where pixel p of the window is
// (crop_x + p % crop_width, crop_y + p / crop_width); each work-item takes `chunk` consecutive pixels.
typedef struct {
  uint seed;
  uint pixel_begin, pixel_end;
  uint sample_begin, sample_end;
  uint chunk;
  uint crop_x, crop_y, crop_width, crop_height;
  uint padding[2];
} Launch;
LAYOUT_CHECK(Launch, 48);

// Counters that a work-item adds up (64 bits each): rays, shadow rays, scattering events in media, paths.
#define COUNTER_RAYS 0
#define COUNTER_SHADOW_RAYS 1
#define COUNTER_SCATTERINGS 2
#define COUNTER_PATHS 3
#define COUNTER_FLIGHTS 4
#define COUNTER_LANE_STEPS 5  // rounds of the loop times LANES: flights, and what lanes wait for others
#define COUNTER_COUNT 6

#ifndef __OPENCL_VERSION__
}  // namespace stokes::layout
#endif
#endif
