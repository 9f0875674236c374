// Marching cubes on the exact distance, then evened out under guard: the level has ridges along the medial axis, where a step along the
// gradient may land on the other side, so that a vertex moves only when all its faces keep looking along the gradients at their corners.
#include "mesh/shell_level.h"

#include "mesh/isosurface.h"

namespace stokes {
namespace {

constexpr int kRounds = 2;
constexpr double kSmooth = 0.8;    // the least cosine between a vertex's gradient and its neighbours' for it to be moved
constexpr double kFacing = 0.3;    // the least cosine between a face's normal and the gradients at its corners that a move may leave
constexpr double kResidual = 1e-3; // of the distance: how far off the level a moved vertex may lie

class Evening {
 public:
  Evening(MeshData& mesh, const MeshDistance& distance, double d)
      : mesh_(mesh), distance_(distance), d_(d), faces_of_(mesh.positions.size()), gradients_(mesh.positions.size()) {
    for (std::uint32_t f = 0; f < mesh.triangles.size(); f++)
      for (const std::uint32_t v : mesh.triangles[f]) faces_of_[v].push_back(f);
    for (std::size_t v = 0; v < gradients_.size(); v++) distance_at(mesh.positions[v], gradients_[v]);
  }

  void run() {
    for (int round = 0; round < kRounds; round++)
      for (std::uint32_t v = 0; v < gradients_.size(); v++) slide(v);
  }

 private:
  double distance_at(Vec3d p, Vec3d& gradient) const {
    Vec3d nearest;
    const double s = distance_(p, &nearest);
    gradient = s != 0 ? (p - nearest) / s : Vec3d{};
    return s;
  }

  // Moves a vertex along the level towards the middle of its neighbours, where the level is smooth.
  void slide(std::uint32_t v) {
    const Vec3d old_place = mesh_.positions[v], old_gradient = gradients_[v];
    Vec3d middle;
    double count = 0;
    for (const std::uint32_t f : faces_of_[v])
      for (const std::uint32_t w : mesh_.triangles[f]) {
        if (w == v) continue;
        if (dot(gradients_[w], old_gradient) < kSmooth) return;
        middle += mesh_.positions[w];
        count += 1;
      }
    const Vec3d step = middle / count - old_place;
    Vec3d p = old_place + (step - old_gradient * dot(step, old_gradient)) * 0.7, gradient;
    double s = distance_at(p, gradient);
    for (int i = 0; i < 3 && std::abs(s - d_) > kResidual * std::abs(d_); i++) {
      p += gradient * (d_ - s);
      s = distance_at(p, gradient);
    }
    if (std::abs(s - d_) > kResidual * std::abs(d_) || dot(gradient, old_gradient) < kSmooth) return;
    mesh_.positions[v] = p;
    gradients_[v] = gradient;
    for (const std::uint32_t f : faces_of_[v])
      if (facing(mesh_.triangles[f]) < kFacing) {
        mesh_.positions[v] = old_place;
        gradients_[v] = old_gradient;
        return;
      }
  }

  // The least cosine between a face's normal and the gradients at its corners.
  double facing(const std::array<std::uint32_t, 3>& t) const {
    const Vec3d a = mesh_.positions[t[0]], n = cross(mesh_.positions[t[1]] - a, mesh_.positions[t[2]] - a);
    const double size = length(n);
    double least = 1;
    for (const std::uint32_t v : t) least = std::min(least, size > 0 ? dot(n, gradients_[v]) / size : -1.0);
    return least;
  }

  MeshData& mesh_;
  const MeshDistance& distance_;
  double d_;
  std::vector<std::vector<std::uint32_t>> faces_of_;
  std::vector<Vec3d> gradients_;
};

}  // namespace

MeshData distance_level(const MeshDistance& distance, Vec3d lo, Vec3d hi, double d, double step) {
  const Vec3d margin = Vec3d{1, 1, 1} * (std::max(d, 0.0) + 2.5 * step);
  const Field field = [&](Vec3d p) { return distance(p); };
  MeshData mesh = isosurface(sample_field(field, lo - margin, hi + margin, step, d, 1.01), d, &field, false);
  Evening(mesh, distance, d).run();
  return mesh;
}

}  // namespace stokes
