// A closed mesh under local edits, each weighed by the faults it would leave before it is made. Decides nothing about which edits are tried.
#pragma once
#include "mesh/self_intersection.h"
#include "mesh/shell_measure.h"

namespace stokes {

/// Faces that give way to others around one vertex, which may be new (index: the number of vertices) and may have moved.
struct ShellEdit {
  static constexpr std::uint32_t kNone = ~0u;
  std::vector<std::uint32_t> removed;
  std::vector<std::array<std::uint32_t, 3>> added;
  std::uint32_t vertex = kNone, gone = kNone;  ///< placed; taken away
  Vec3d place;
  bool possible() const { return !removed.empty(); }
};

class ShellEditor {
 public:
  using Triangle = std::array<std::uint32_t, 3>;

  ShellEditor(const MeshData& shell, const ShellMeasure& measure);

  // The edits; one that would leave no closed surface has no faces (possible() is false).
  ShellEdit move(std::uint32_t v, Vec3d to) const;
  ShellEdit flip(std::uint32_t a, std::uint32_t b) const;
  ShellEdit split(std::uint32_t a, std::uint32_t b, Vec3d at) const;
  ShellEdit collapse(std::uint32_t a, std::uint32_t b, Vec3d to) const;
  /// Other faces between the corners on the boundary of these.
  ShellEdit replace(std::vector<std::uint32_t> faces) const;

  /// The faults there are now where the edit would be made, and those it would leave; counting of the latter ends at `limit`.
  double cost_before(const ShellEdit& edit) const;
  double cost_after(const ShellEdit& edit, double limit) const;
  void apply(const ShellEdit& edit);
  /// Counts a face's crossings anew: what it crossed may have moved.
  void refresh(std::uint32_t f);

  /// Whether something is wrong with a face or its corners that counts.
  bool faulty(std::uint32_t f) const;
  bool alive(std::uint32_t f) const { return triangles_[f][0] != triangles_[f][1]; }
  std::size_t faces() const { return triangles_.size(); }
  const Triangle& triangle(std::uint32_t f) const { return triangles_[f]; }
  const std::vector<std::uint32_t>& faces_of(std::uint32_t v) const { return faces_of_[v]; }
  Vec3d position(std::uint32_t v) const { return positions_[v]; }
  Vec3d gradient(std::uint32_t v) const { return gradients_[v]; }
  double edge(std::uint32_t a, std::uint32_t b) const { return length(positions_[a] - positions_[b]); }
  /// The corner of face f that is neither a nor b.
  std::uint32_t opposite(std::uint32_t f, std::uint32_t a, std::uint32_t b) const { return triangles_[f][0] + triangles_[f][1] + triangles_[f][2] - a - b; }
  /// The two faces on an edge, the first the one that goes from a to b; none where the edge has not exactly two.
  std::vector<std::uint32_t> faces_on(std::uint32_t a, std::uint32_t b) const;

  /// What is wrong now.
  ShellFaults faults() const;
  /// The mesh as edited: positions and triangles alone.
  MeshData mesh() const;

 private:
  ShellMeasure::Corner corner(std::uint32_t v) const { return {positions_[v], gradients_[v]}; }
  std::vector<std::uint32_t> neighbours(std::uint32_t v) const;

  ShellMeasure measure_;
  std::vector<Vec3d> positions_, gradients_;
  std::vector<Triangle> triangles_;
  std::vector<std::vector<std::uint32_t>> faces_of_;
  struct FaceState {
    ShellMeasure::Face face;
    std::size_t crossed = 0;
    double cost() const;
  };
  std::vector<FaceState> states_;
  std::vector<double> vertex_off_;
  std::unique_ptr<FaceGrid> grid_;
};

}  // namespace stokes
