// A scene as its file says it: names resolved, units and defaults still to be applied by compile_scene, geometry not yet
// transformed. Every object keeps its JSON pointer, so that later stages can name the place of a fault.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "math/vec.h"
#include "mesh/mesh.h"
#include "scene/error.h"
#include "spectral/spectrum.h"

namespace stokes {

// ---- Textures ---------------------------------------------------------------------------------------------------
struct TextureDescription;
using TexturePtr = std::shared_ptr<const TextureDescription>;

/// A colour slot: a spectrum, or a texture whose leaves are spectra.
struct ColorSource {
  SpectrumPtr spectrum;
  TexturePtr texture;
  bool empty() const { return !spectrum && !texture; }
};

enum class TextureKind { Checker, Marble, Image, Wireframe, Fresnel, Region, VertexMask };

struct RegionShapeDescription {
  enum class Kind { Sphere, Box, Capsule } kind = Kind::Sphere;
  Vec3d a, b;
  double radius = 0;
};

/// An image's pixels, decoded at parse time: linear sRGB, row 0 at the top, 3 floats a pixel.
struct ImagePixels {
  int width = 0, height = 0;
  std::vector<float> rgb;
};

struct TextureDescription {
  TextureKind kind = TextureKind::Checker;
  ColorSource a, b;  ///< checker: even, odd; marble: base, veins; wireframe: base, wire
  double scale = 1;
  double parameter = 0;  ///< wireframe: thickness (fraction of barycentrics or world units as darts); fresnel: ior
  std::shared_ptr<const ImagePixels> image;
  std::string filename;
  bool clamp = false, nearest = false;
  std::vector<RegionShapeDescription> shapes;
  std::string mask_name;  ///< VertexMask: which mask of a generated mesh
  Affine transform;       ///< texture space to world
  std::string pointer;
};

// ---- Materials --------------------------------------------------------------------------------------------------
enum class MaterialKind {
  Lambertian,
  Metal,
  Conductor,
  Dielectric,
  Interface,
  Phong,
  BlinnPhong,
  DiffuseLight,
  Blend,
  DiffuseFluorescent,
  Reradiation
};

/// One dye of a fluorescent material or medium.
struct DyeDescription {
  SpectrumPtr absorption, emission;
  double yield = 1, concentration = 1;
  bool photon_yield = true, stokes = false;
  std::string pointer;
};

/// A measured matrix: value[row * columns + column] = energy out in band lo[row] per energy in at li[column]; the diagonal is
/// the albedo. Bands are equally spaced.
struct ReradiationMatrix {
  std::vector<double> li, lo, values;
  std::string filename;
};

struct MediumDescription;
using MediumPtr = std::shared_ptr<const MediumDescription>;

/// The layers under a skin's dielectric. No surface of a description that has been read still waits for them (skin_reader.h).
struct SkinDescription {
  MediumPtr epidermis, dermis;
  double thickness = 0.06;  ///< of the epidermis, mm
};

struct MaterialDescription;
using MaterialPtr = std::shared_ptr<const MaterialDescription>;
struct MaterialDescription {
  MaterialKind kind = MaterialKind::Lambertian;
  std::string name;
  ColorSource albedo;  ///< also a dielectric's scatter albedo and a fluorescent base; may be empty (the kind's default)
  SpectrumPtr ior, eta, k;
  double roughness = 0;  ///< metal
  double alpha = 0;      ///< GGX
  double exponent = 1;
  SpectrumPtr emit;              ///< diffuse_light, uv_light
  TexturePtr emit_texture;       ///< a textured diffuse_light
  std::optional<double> power;   ///< uv_light: W per m^2 leaving the surface (radiant exitance), scales `emit`
  MaterialPtr a, b;              ///< blend: a, b; painted: base, paint
  std::optional<double> amount;  ///< blend: constant amount of b
  TexturePtr amount_texture;     ///< blend: texture amount; painted: mask
  std::vector<DyeDescription> dyes;
  std::shared_ptr<const ReradiationMatrix> matrix;
  std::shared_ptr<const SkinDescription> skin;  ///< a dielectric of the type `skin`
  std::string pointer;
};

// ---- Media ------------------------------------------------------------------------------------------------------
enum class LengthUnit { None, Metre, Centimetre, Millimetre };

struct MediumDescription {
  std::string name;
  bool vacuum = false;
  SpectrumPtr sigma_t, sigma_s, sigma_a, albedo;  ///< exactly two of them, in 1/unit
  SpectrumPtr g;                                  ///< null: isotropic
  LengthUnit unit = LengthUnit::None;
  std::vector<DyeDescription> dyes;  ///< their absorption is sigma_a in 1/unit and adds to the medium's
  std::string pointer;
};

// ---- Surfaces ---------------------------------------------------------------------------------------------------
enum class SurfaceKind { Quad, Sphere, Triangle, Mesh };

/// A leaf of the surface tree: groups are flattened, their transforms multiplied in; a mesh with several `usemtl` is one
/// SurfaceDescription per material.
struct SurfaceDescription {
  SurfaceKind kind = SurfaceKind::Quad;
  std::string name;
  double width = 1, height = 1;          ///< quad: in its local xy-plane, centred, normal +z
  double radius = 1;                     ///< sphere
  std::shared_ptr<const MeshData> mesh;  ///< triangle, mesh; offsets are already applied, in local space
  Affine transform;                      ///< local to world
  MaterialPtr material;                  ///< never null
  MediumPtr outside, inside;             ///< null: vacuum
  SpectrumPtr emit;                      ///< emission beside the material's, from the front side
  bool flip = false;
  std::string pointer;
};

// ---- Camera, sampler, integrator, film --------------------------------------------------------------------------
struct CameraDescription {
  Affine transform;  ///< camera to world
  bool orthographic = false;
  double vfov = 90;   ///< degrees
  double height = 2;  ///< orthographic: scene units
  double fdist = 1, aperture = 0;
  int width = 512, height_pixels = 512;
  std::optional<MediumPtr> medium;  ///< not set: found from the scene; a null MediumPtr is vacuum
  std::string pointer;
};

enum class IntegratorKind { Mats, Nee, Mis, Normals, Ao };
enum class ColorMode { Spectral, Rgb };

struct IntegratorDescription {
  IntegratorKind kind = IntegratorKind::Mis;
  int max_bounces = 64;
  std::optional<int> russian_roulette = 5;  ///< first bounce at which it may end a path; nullopt: off
  int wavelengths_per_path = 4;
  ColorMode mode = ColorMode::Spectral;
  bool equiangular = true;  ///< sampling of light along flights through thin media
  std::string name;  ///< as the file spells it
};

struct BackgroundDescription {
  SpectrumPtr emission;  ///< null: black
  std::shared_ptr<const ImagePixels> environment;
  double rotate = 0;  ///< degrees about +y
  double scale = 1;
  std::string pointer;
};

/// Equal bins of wavelength that the image holds beside its RGB.
struct SpectralBinsDescription {
  double begin = 0, end = 0;  ///< nm
  int count = 0;
};

/// A whole scene file.
struct SceneDescription {
  SourceMap source;
  std::string directory;  ///< of the scene file
  std::vector<std::string> files;  ///< every other file that was read, as opened; the same one may be there again
  CameraDescription camera;
  IntegratorDescription integrator;
  BackgroundDescription background;
  std::optional<SpectralBinsDescription> spectral_bins;
  int samples = 16;
  std::uint32_t seed = 0;
  LengthUnit scene_unit = LengthUnit::None;
  std::vector<MaterialPtr> materials;
  std::vector<MediumPtr> media;
  std::vector<SpectrumPtr> spectra;
  std::vector<SurfaceDescription> surfaces;
  std::vector<std::string> warnings;  ///< to be printed, e.g. flipped faces of an offset mesh
};

}  // namespace stokes
