// Meshes that were made and are still in use, by what they were made from: a scene that is read again while its former self is still shown
// (an edit under `stokes view`, a sweep in a notebook) takes them over. Knows no generator and no file.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mesh/mesh.h"

namespace stokes {

/// A mesh by the materials of its faces, and what is to be said about it.
struct MadeMesh {
  std::vector<std::shared_ptr<const MeshData>> parts;
  std::vector<std::string> materials;                            ///< parallel to `parts`; empty: the surface's own
  std::vector<std::pair<std::string, std::string>> warnings;     ///< the surface's key that each is about (empty: the surface), and its text
};

/// The part of a key that an offset by `distance` in world space depends on.
std::string offset_key(double distance, const Affine& to_world);

/// What `make` made before for this key and this very `source` (null where it was made of none), while all its parts are held by somebody; else
/// what it makes now. Throws what `make` throws.
MadeMesh recent_mesh(const std::string& key, const std::shared_ptr<const MeshData>& source, const std::function<MadeMesh()>& make);

}  // namespace stokes
