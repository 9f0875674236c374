// compile_scene: the order of the steps. What each does stands in its own file.
#include <chrono>

#include "compiled/bvh.h"
#include "compiled/compilation.h"

namespace stokes {
namespace {

using compiled::Compilation;

// Materials and media that no surface uses are still checked, in a compilation that is thrown away.
void check_unused(const Compilation& c) {
  Compilation scratch(c.scene, c.options);
  for (const MaterialPtr& m : c.scene.materials)
    if (m && !c.materials.contains(m.get())) compile_material(scratch, *m);
  for (const MediumPtr& m : c.scene.media)
    if (m && !c.media.contains(m.get())) compile_medium(scratch, m.get());
}

}  // namespace

CompiledScene compile_scene(const SceneDescription& scene, const CompileOptions& options) {
  Compilation c(scene, options);
  c.out.header = {};  // the scene's hash covers also what a scene leaves unused, such as rooms
  c.out.features.rgb = c.spectra.rgb();
  c.out.warnings = scene.warnings;

  // Geometry first: it names the materials and media that are in use.
  compile_medium(c, nullptr);
  compile_surfaces(c);
  append_vertex_masks(c);
  compile_camera(c);  // may bring a medium of its own

  // The lights' spectrum completes the dyes' excitations.
  compile_lights(c);
  seal_media(c);
  mark_thin_media(c);
  complete_excitations(c);
  check_unused(c);

  // The BVH, and the numbers about the whole.
  const auto start = std::chrono::steady_clock::now();
  if (!c.out.triangles.empty()) {
    compiled::Bvh bvh = compiled::build_bvh(c.out.positions, c.out.triangles, options.bvh_width);
    c.out.bvh_nodes = std::move(bvh.nodes);
    c.out.bvh_leaves = std::move(bvh.leaves);
  }
  c.out.bvh_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  c.out.spectra = std::move(c.spectra.tables);
  compile_header(c);
  return std::move(c.out);
}

}  // namespace stokes
