// Counts what a description holds.
#include "compiled/memory_estimate.h"

#include <set>

#include "input/memory.h"
#include "layout.h"

namespace stokes {
namespace {

// A triangle's record twice while its array grows; its box, order and share of the binary tree while the BVH is built; its leaf and
// its share of the wide nodes, also twice.
constexpr std::uint64_t kPerTriangle = 2 * sizeof(layout::Triangle) + 160 + 2 * 80;
// Position, normal and uv in floats, twice while the arrays grow, and two maps of indices.
constexpr std::uint64_t kPerVertex = 2 * (2 * sizeof(layout::Vec3) + 8) + 8;
constexpr std::uint64_t kPerTexel = 2 * 16;
constexpr std::uint64_t kPerSpectrum = 16 << 10;  // tables, curves and distributions
constexpr std::uint64_t kPerSurface = 512;

void count_images(const TexturePtr& texture, std::set<const ImagePixels*>& images) {
  if (!texture) return;
  if (texture->image) images.insert(texture->image.get());
  count_images(texture->a.texture, images);
  count_images(texture->b.texture, images);
}

void count_material(const MaterialDescription* m, std::set<const void*>& seen, std::set<const ImagePixels*>& images) {
  if (!m || !seen.insert(m).second) return;
  count_images(m->albedo.texture, images);
  count_images(m->emit_texture, images);
  count_images(m->amount_texture, images);
  count_material(m->a.get(), seen, images);
  count_material(m->b.get(), seen, images);
}

}  // namespace

std::string MemoryEstimate::text() const {
  return "vertices " + gibibytes(vertices) + ", triangles and BVH " + gibibytes(triangles) + ", texels " + gibibytes(texels) + ", other " + gibibytes(other);
}

MemoryEstimate estimate_memory(const SceneDescription& scene) {
  MemoryEstimate need;
  std::set<const void*> materials;
  std::set<const ImagePixels*> images;
  for (const SurfaceDescription& s : scene.surfaces) {
    count_material(s.material.get(), materials, images);
    if (!s.mesh) continue;
    need.vertices += s.mesh->positions.size() * kPerVertex;
    need.triangles += s.mesh->triangles.size() * kPerTriangle;
  }
  for (const MaterialPtr& m : scene.materials) count_material(m.get(), materials, images);
  if (scene.background.environment) images.insert(scene.background.environment.get());
  for (const ImagePixels* image : images) need.texels += static_cast<std::uint64_t>(image->width) * static_cast<std::uint64_t>(image->height) * kPerTexel;
  need.other = scene.surfaces.size() * kPerSurface + (materials.size() + scene.media.size() + scene.spectra.size()) * 4 * kPerSpectrum;
  return need;
}

}  // namespace stokes
