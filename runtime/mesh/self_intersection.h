// Where a mesh passes through itself.
#pragma once
#include "mesh/mesh.h"

namespace stokes {

/// The faces, in order, that an edge of another face passes through, and the faces of these edges. Faces may share a corner and still cross
/// elsewhere; two with an edge in common can only lie on each other, which is not seen, as no coplanar overlap is.
std::vector<std::uint32_t> self_intersections(const MeshData& mesh);

/// The faces of a changing mesh by the cells of a grid: those that a given triangle crosses.
class FaceGrid {
 public:
  using Triangle = std::array<std::uint32_t, 3>;

  /// `size`: about the extent of a face. Neither vector may be replaced while the grid lives; both may grow and change.
  FaceGrid(const std::vector<Vec3d>& positions, const std::vector<Triangle>& triangles, double size);
  /// Must be called again whenever face f changes; a face of three equal corners is no longer there.
  void insert(std::uint32_t f);
  /// Appends the faces inserted so far that triangle t crosses, with `moved` in place of its corner `vertex`; faces in `without` are passed over.
  void crossings(const Triangle& t, std::uint32_t vertex, Vec3d moved, const std::vector<std::uint32_t>& without, std::vector<std::uint32_t>& found) const;

 private:
  struct Node {
    std::uint32_t face;
    std::int32_t next;
  };
  template <class Visit>
  void visit_cells(Vec3d lo, Vec3d hi, const Visit& visit) const;
  const std::vector<Vec3d>& positions_;
  const std::vector<Triangle>& triangles_;
  double size_;
  std::vector<std::int32_t> heads_;
  std::vector<Node> nodes_;
};

}  // namespace stokes
