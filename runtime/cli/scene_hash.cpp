// A compiled scene's fingerprint.
#include "cli/scene_hash.h"

#include <cstdio>

#include "image/film_file.h"

namespace stokes {
namespace {

/// Hashes arrays with their lengths, so that an element moving from one to the next counts.
class Hash {
 public:
  template <class T>
  void add(const std::vector<T>& values) {
    const std::uint64_t count = values.size();
    value_ = fnv1a(&count, sizeof count, value_);
    value_ = fnv1a(values.data(), values.size() * sizeof(T), value_);
  }
  template <class T>
  void add_object(const T& value) {
    value_ = fnv1a(&value, sizeof value, value_);
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = fnv1a("stokes", 6);
};

}  // namespace

std::string scene_hash(const CompiledScene& scene) {
  layout::Scene header = scene.header;
  header.film_channels = 0;
  header.film_stride = 0;
  Hash hash;
  hash.add_object(header);
  const std::int32_t colors[2] = {scene.features.rgb, scene.wavelengths_per_path};
  hash.add_object(colors);
  hash.add(scene.quads);
  hash.add(scene.spheres);
  hash.add(scene.ellipsoids);
  hash.add(scene.triangles);
  hash.add(scene.positions);
  hash.add(scene.normals);
  hash.add(scene.uvs);
  hash.add(scene.surfaces);
  hash.add(scene.materials);
  hash.add(scene.textures);
  hash.add(scene.regions);
  hash.add(scene.texels);
  hash.add(scene.spectra);
  hash.add(scene.media);
  hash.add(scene.dyes);
  hash.add(scene.distributions);
  hash.add(scene.cdfs);
  hash.add(scene.reradiations);
  hash.add(scene.reradiation_values);
  hash.add(scene.lights);
  hash.add_object(scene.environment);
  hash.add(scene.environment_cdf);
  hash.add(scene.camera_knots);
  char text[20];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash.value()));
  return text;
}

}  // namespace stokes
