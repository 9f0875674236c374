// A scene as the integrators read it: flat arrays of layout structs, ready to upload. Made by compile_scene, read by the
// device renderer and by the reference alike.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "layout.h"
#include "scene/description.h"

namespace stokes {

/// What the kernels may leave out. Each becomes a constant SCENE_HAS_... of the build.
struct SceneFeatures {
  bool rgb = false;            ///< three colour channels instead of wavelengths
  bool triangles = false;      ///< any triangle (a BVH is there)
  bool spheres = false, ellipsoids = false, quads = false;
  bool textures = false, blends = false, environment = false, background = false;
  bool media = false;          ///< any medium that is not vacuum
  bool chromatic_media = false;///< sigma_t or g depends on the wavelength
  bool thin_media = false;     ///< any medium with MEDIUM_THIN
  bool interfaces = false;     ///< any index-matched boundary
  bool fluorescent_surfaces = false, fluorescent_media = false, reradiation = false;
  bool metal = false, conductor = false, smooth_dielectric = false, rough_dielectric = false, phong = false;
  bool dispersion = false;
  bool emission_textures = false;
  bool smooth_normals = false; ///< any mesh with shading normals
  bool lens = false;
};

struct CompileOptions {
  int bvh_width = 8;         ///< 8 (CPUs), 4 or 2
  int spectral_bins = 0;     ///< --spectral a:b:n
  double spectral_begin = 0, spectral_end = 0;
  unsigned film_channels = 0;///< FILM_*
};

struct CompiledScene {
  layout::Scene header;
  SceneFeatures features;
  int wavelengths_per_path = 4;  ///< 1, 4 or 8; 3 in RGB mode
  int samples = 16;
  std::uint32_t seed = 0;
  int bvh_width = 8;

  std::vector<float> bvh_nodes;   ///< bvh_width * 8 words a node
  std::vector<float> bvh_leaves;  ///< bvh_width * 10 words a block
  std::vector<layout::Quad> quads;
  std::vector<layout::Sphere> spheres;
  std::vector<layout::Ellipsoid> ellipsoids;
  std::vector<layout::Triangle> triangles;
  std::vector<layout::Vec3> positions;
  std::vector<layout::Vec3> normals;  ///< parallel to positions; empty when no mesh has shading normals
  std::vector<float> uvs;             ///< two a vertex; empty when no mesh has them
  std::vector<layout::Surface> surfaces;
  std::vector<layout::Material> materials;
  std::vector<layout::Texture> textures;
  std::vector<layout::Region> regions;
  std::vector<float> texels;          ///< images, scalar images, vertex masks, the environment's texels
  std::vector<float> spectra;         ///< spectrum tables, STOKES_SPECTRUM_STRIDE (RGB: STOKES_RGB_STRIDE) floats each
  std::vector<layout::Medium> media;  ///< [0] is vacuum
  std::vector<layout::Dye> dyes;
  std::vector<layout::Distribution> distributions;
  std::vector<float> cdfs;
  std::vector<layout::Reradiation> reradiations;
  std::vector<float> reradiation_values;
  std::vector<layout::Light> lights;
  layout::Environment environment{};
  std::vector<float> environment_cdf;
  std::vector<float> camera_knots;    ///< STOKES_CAMERA_KNOTS + 1 wavelengths
  std::vector<float> sensor;          ///< 500 cells x 2 ends x (r, g, b, 0)

  std::vector<std::string> surface_names;  ///< parallel to surfaces, for messages
  std::vector<std::string> warnings;       ///< the description's, then those of compiling
  double bvh_seconds = 0;
};

/// Applies units and defaults, checks energies, transforms geometry, builds the BVH, the tables and the light distribution.
/// Throws SceneError with the place in the file.
CompiledScene compile_scene(const SceneDescription& scene, const CompileOptions& options = {});

}  // namespace stokes
