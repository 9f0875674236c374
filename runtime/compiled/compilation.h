// The state that compile_scene's steps share: what is being read, what has been written so far, and which descriptions have
// been compiled already. Each step's functions are declared here; each lives in the file that its comment names.
#pragma once
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "compiled/compiled_scene.h"
#include "compiled/spectra.h"

namespace stokes::compiled {

/// What a texture is read for.
enum class TextureUse { Reflectance, Emission, Scalar };

/// The excitation of a dye or of a row of a matrix is drawn from a table that needs the lights, which are compiled last.
struct PendingExcitation {
  std::uint32_t distribution;  ///< to be filled in
  Curve absorption;            ///< what the wavelength is drawn from, before the lights' spectrum
};

/// A vertex mask that a texture asks for; its floats are appended when all vertices are known.
struct PendingMask {
  std::uint32_t texture;
  std::string mask_name, pointer;
};
/// A range of the scene's vertices that came from one mesh.
struct MeshRange {
  std::shared_ptr<const MeshData> mesh;
  std::uint32_t first_vertex;
  std::vector<std::uint32_t> source;  ///< the mesh's vertex of each vertex of the range
};

struct Compilation {
  Compilation(const SceneDescription& s, const CompileOptions& o)
      : scene(s), options(o), spectra(s.integrator.mode == ColorMode::Rgb, s.source) {}

  const SceneDescription& scene;
  const CompileOptions& options;
  CompiledScene out;
  Spectra spectra;

  std::map<const MaterialDescription*, std::uint32_t> materials;
  std::map<const MediumDescription*, std::uint32_t> media;
  std::map<std::pair<const TextureDescription*, TextureUse>, std::uint32_t> textures;
  std::map<std::uint32_t, Curve> mean_curves;  ///< textures by index: their mean over the surface
  std::map<std::uint32_t, Curve> peak_curves;  ///< textures by index: an upper bound of their values
  std::vector<PendingExcitation> excitations;
  std::vector<PendingMask> masks;
  std::vector<MeshRange> meshes;
  Curve light_spectrum;      ///< all lights' emitted power over wavelength; filled by compile_lights
  double peak_radiance = 0;  ///< an upper bound of what the film sees of any emission

  [[noreturn]] void fail(const std::string& pointer, const std::string& message) const {
    throw SceneError(scene.source, pointer, message);
  }
  void warn(const std::string& message) { out.warnings.push_back(message); }
};

// textures.cpp, texels.cpp
/// The spectrum reference of a colour slot, `fallback` at every wavelength when it is empty.
std::uint32_t compile_color(Compilation& c, const ColorSource& source, SpectrumRole role, double fallback);
/// The index of a texture (no STOKES_TEXTURE_BIT).
std::uint32_t compile_texture(Compilation& c, const TextureDescription& texture, TextureUse use);
/// Mean and upper bound of a spectrum reference over the surface.
Curve mean_curve(const Compilation& c, std::uint32_t reference);
Curve peak_curve(const Compilation& c, std::uint32_t reference);
/// Appends an image's texels; the mean and the largest of its colours.
struct Texels {
  std::uint32_t offset;
  Vec3d mean, peak;
};
Texels append_texels(Compilation& c, const ImagePixels& image, TextureUse use);
/// Appends the masks that textures asked for; call when all vertices are there.
void append_vertex_masks(Compilation& c);

// materials.cpp
std::uint32_t compile_material(Compilation& c, const MaterialDescription& material);
/// The emission that a material gives to its surfaces, or STOKES_NONE.
std::uint32_t compile_emission(Compilation& c, const MaterialDescription& material);

// media.cpp
/// The index of a medium; null and `vacuum` are 0.
std::uint32_t compile_medium(Compilation& c, const MediumDescription* medium);

// fluorescence.cpp, reradiation.cpp
/// Appends dyes; absorptions are scaled by `factor` (media: the unit) and their concentrations. Returns the first dye's index.
std::uint32_t compile_dyes(Compilation& c, const std::vector<DyeDescription>& dyes, double factor, bool surface);
/// SceneError when the dyes and the base together give off more energy than they take at some wavelength.
void check_energy(const Compilation& c, std::uint32_t first_dye, std::uint32_t count, const Curve& base, const std::string& pointer);
/// Appends a matrix; `albedo` receives its diagonal.
std::uint32_t compile_reradiation(Compilation& c, const ReradiationMatrix& matrix, const std::string& pointer, Curve& albedo);
/// An index for a distribution that complete_excitations will fill in.
std::uint32_t reserve_excitation(Compilation& c, Curve absorption);
/// Fills in every reserved distribution from its absorption and the lights' spectrum.
void complete_excitations(Compilation& c);

// surfaces.cpp, meshes.cpp
/// All primitives in world space, with their surfaces, materials and media.
void compile_surfaces(Compilation& c);
void append_mesh(Compilation& c, const SurfaceDescription& surface, std::uint32_t index);

// lights.cpp, environment.cpp, sealed.cpp, airlight.cpp
/// Every emissive primitive, the background and the environment; powers, probabilities, the alias table.
void compile_lights(Compilation& c);
/// Marks the media that light enters by refraction alone. Needs the surfaces and the camera.
void seal_media(Compilation& c);
/// Marks the media in which lamps' light is sought along flights. Needs the lights and what seal_media found.
void mark_thin_media(Compilation& c);
/// Texels and CDFs of the environment; returns the mean radiance over the sphere.
Curve compile_environment(Compilation& c);

// camera.cpp, header.cpp
void compile_camera(Compilation& c);
/// The film's unit of depth, from the scene's bounds and the camera's place.
float depth_quantum(const layout::Scene& header);
/// Bounds, quanta, counts, options; everything else must be there.
void compile_header(Compilation& c);

}  // namespace stokes::compiled
