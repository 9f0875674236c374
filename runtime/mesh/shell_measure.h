// What is asked of a shell: how far it is from where it should be, and which way its faces look. Knows nothing of how shells are made.
#pragma once
#include "mesh/mesh.h"
#include "mesh/mesh_distance.h"

namespace stokes {

/// What is wrong with a mesh that should lie at a signed distance d from another.
struct ShellFaults {
  std::size_t flipped = 0;  ///< faces that look against the distance's gradient at their middle, or have next to no height
  std::size_t crossed = 0;  ///< faces that pass through one another
  std::size_t off_vertices = 0, off_faces = 0;  ///< vertices more than 5 % off the distance; faces with such a place among the middle and those of its edges
  std::size_t sum() const { return flipped + crossed + off_vertices + off_faces; }
};
/// How bad faults are: whatever is more than a face's middle comes first.
bool worse(const ShellFaults& a, const ShellFaults& b);
ShellFaults shell_faults(const MeshData& shell, const MeshDistance& distance, double d);

/// Measures places and faces of a shell at signed distance d.
class ShellMeasure {
 public:
  static constexpr double kTolerance = 0.05;  ///< of the distance
  static constexpr double kThin = 1e-3;       ///< height over longest edge, below which a face's normal is not to be trusted

  ShellMeasure(const MeshDistance& distance, double d) : distance_(distance), d_(d) {}

  struct Place {
    double s = 0;    ///< the signed distance
    double off = 1;  ///< |s / d - 1|
    Vec3d gradient;  ///< of the signed distance: unit length, away from the inside
  };
  struct Face {
    double facing = 0;  ///< cosine between the normal and the gradient at the middle; -1 when the face is thinner than kThin
    double off = 1;     ///< the largest |s / d - 1| of the middle and of the edges' middles
  };
  struct Corner {
    Vec3d position, gradient;
  };

  double d() const { return d_; }
  Place at(Vec3d p) const;
  /// Edges' middles are only looked at where the gradients at the corners say that the edge leaves the level, or, with `all`, always.
  Face face(const Corner& a, const Corner& b, const Corner& c, bool all = false) const;
  /// Onto the level, by a few steps along the gradient.
  Vec3d project(Vec3d p) const;

 private:
  const MeshDistance& distance_;
  double d_;
};

}  // namespace stokes
