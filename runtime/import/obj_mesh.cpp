// OBJ files by tinyobjloader, which takes indices out of range and infinities for success: both are looked for here. Knows nothing of
// scenes.
#include <tiny_obj_loader.h>

#include <cmath>
#include <map>
#include <sstream>
#include <tuple>

#include "import/imported_scene.h"

namespace stokes {
namespace {

struct Numbers {
  const std::vector<tinyobj::real_t>& all;
  std::size_t each;

  double at(int index, std::size_t k) const {
    const std::size_t place = static_cast<std::size_t>(index) * each + k;
    if (index < 0 || place >= all.size()) throw std::runtime_error("a face refers to what is not there");
    if (!std::isfinite(all[place])) throw std::runtime_error("a coordinate is not finite");
    return static_cast<double>(all[place]);
  }
};

// Keeps a mesh parallel: corners that differ in anything become positions of their own.
class CornerMerger {
 public:
  explicit CornerMerger(const tinyobj::attrib_t& attributes)
      : positions_{attributes.vertices, 3}, normals_{attributes.normals, 3}, uvs_{attributes.texcoords, 2} {}

  int index_of(const tinyobj::index_t& corner, bool with_normals, bool with_uvs) {
    const auto [known, fresh] =
        known_.try_emplace({corner.vertex_index, corner.texcoord_index, corner.normal_index}, static_cast<int>(mesh.positions.size()));
    if (!fresh) return known->second;
    const int v = corner.vertex_index, n = corner.normal_index, t = corner.texcoord_index;
    mesh.positions.push_back({positions_.at(v, 0), positions_.at(v, 1), positions_.at(v, 2)});
    if (with_normals) mesh.normals.push_back({normals_.at(n, 0), normals_.at(n, 1), normals_.at(n, 2)});
    if (with_uvs) mesh.uvs.push_back(t < 0 ? std::array{0.0, 0.0} : std::array{uvs_.at(t, 0), uvs_.at(t, 1)});
    return known->second;
  }

  ImportedMesh mesh;

 private:
  Numbers positions_, normals_, uvs_;
  std::map<std::tuple<int, int, int>, int> known_;
};

}  // namespace

ImportedMesh read_obj_mesh(const std::string& path) {
  std::istringstream stream(read_text_file(path));
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warning, error;
  if (!tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, &stream, nullptr, true) || !error.empty())
    throw std::runtime_error(error.empty() ? "it is no OBJ file" : error.substr(0, error.find('\n')));
  // Normals are kept where every corner has one.
  bool normals = true, uvs = false;
  for (const tinyobj::shape_t& shape : shapes)
    for (const tinyobj::index_t& corner : shape.mesh.indices) {
      normals &= corner.normal_index >= 0;
      uvs |= corner.texcoord_index >= 0;
    }
  CornerMerger merger(attributes);
  for (const tinyobj::shape_t& shape : shapes)
    for (std::size_t i = 0; i + 2 < shape.mesh.indices.size(); i += 3) {
      const auto corner = [&](std::size_t k) { return merger.index_of(shape.mesh.indices[i + k], normals, uvs); };
      const int a = corner(0), b = corner(1), c = corner(2);
      merger.mesh.triangles.push_back({a, b, c});
    }
  if (merger.mesh.triangles.empty()) throw std::runtime_error("it holds no faces");
  return std::move(merger.mesh);
}

}  // namespace stokes
