// The list of build constants: each member of SceneFeatures appears here once.
#include "device/build_constants.h"

namespace stokes {

std::string build_constants(const CompiledScene& scene, const DeviceConstants& device) {
  std::string text;
  const auto define = [&text](const char* name, long value) { text += std::string("#define ") + name + " " + std::to_string(value) + "\n"; };
  define("LANES", device.lanes);
  define("STOKES_X86", device.x86);
  define("BVH_WIDTH", scene.bvh_width);
  define("WAVELENGTHS", scene.wavelengths_per_path);
  define("INTEGRATOR", scene.header.integrator);
  define("FILM_CHANNELS", scene.header.film_channels);
  define("FILM_SPECTRAL", scene.header.spectral_bins > 0);
  // A structured binding must name every member: a new feature that is forgotten here does not compile.
  const auto& [rgb, triangles, spheres, ellipsoids, quads, textures, blends, environment, background, media, chromatic_media, thin_media, interfaces,
               fluorescent_surfaces, fluorescent_media, reradiation, metal, conductor, smooth_dielectric, rough_dielectric, phong,
               dispersion, emission_textures, smooth_normals, lens] = scene.features;
  define("SCENE_RGB", rgb);
  define("SCENE_HAS_TRIANGLES", triangles);
  define("SCENE_HAS_SPHERES", spheres);
  define("SCENE_HAS_ELLIPSOIDS", ellipsoids);
  define("SCENE_HAS_QUADS", quads);
  define("SCENE_HAS_TEXTURES", textures);
  define("SCENE_HAS_BLENDS", blends);
  define("SCENE_HAS_ENVIRONMENT", environment);
  define("SCENE_HAS_BACKGROUND", background);
  define("SCENE_HAS_MEDIA", media);
  define("SCENE_HAS_CHROMATIC_MEDIA", chromatic_media);
  define("SCENE_HAS_THIN_MEDIA", thin_media);
  define("SCENE_HAS_INTERFACES", interfaces);
  define("SCENE_HAS_FLUORESCENT_SURFACES", fluorescent_surfaces);
  define("SCENE_HAS_FLUORESCENT_MEDIA", fluorescent_media);
  define("SCENE_HAS_RERADIATION", reradiation);
  define("SCENE_HAS_METAL", metal);
  define("SCENE_HAS_CONDUCTOR", conductor);
  define("SCENE_HAS_SMOOTH_DIELECTRIC", smooth_dielectric);
  define("SCENE_HAS_ROUGH_DIELECTRIC", rough_dielectric);
  define("SCENE_HAS_PHONG", phong);
  define("SCENE_HAS_DISPERSION", dispersion);
  define("SCENE_HAS_EMISSION_TEXTURES", emission_textures);
  define("SCENE_HAS_SMOOTH_NORMALS", smooth_normals);
  define("SCENE_HAS_LENS", lens);
  return text;
}

}  // namespace stokes
