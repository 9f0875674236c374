// Faults of shells, found and mended locally by trial: a vertex tries a handful of places and keeps the best.
#include "mesh/shell_repair.h"

#include <algorithm>
#include <set>

#include "mesh/self_intersection.h"

namespace stokes {
namespace {

constexpr double kTolerance = 0.05;  // of the distance
constexpr double kGoal = 0.04;       // repairs aim a little better, so that rounding to float leaves them within
constexpr int kSweeps = 20;
constexpr int kRounds = 8;
constexpr int kUndos = 8;
constexpr int kAttempts = 1500;     // vertices tried in all: some seconds; a mesh that folds on every side is not to be mended

// A face's middle that is off counts 1 at most: it may be traded for a vertex on the distance, and either for a face the right way round.
constexpr double kVertexCost = 40, kFlipCost = 400;

using Triangle = std::array<std::uint32_t, 3>;

class Repair {
 public:
  Repair(MeshData& shell, const MeshDistance& distance, double d, bool guarded = false) : shell_(shell), distance_(distance), d_(d), guarded_(guarded), began_(shell.positions), faces_of_(shell.positions.size()) {
    for (std::uint32_t f = 0; f < shell.triangles.size(); f++)
      for (const std::uint32_t v : shell.triangles[f]) faces_of_[v].push_back(f);
  }

  ShellFaults faults() const {
    ShellFaults found;
    found.crossed = self_intersections(shell_).size();
    for (const Triangle& t : shell_.triangles) {
      double off;
      found.flipped += facing(t, &off) <= 0;
      found.off_faces += off > kTolerance;
    }
    for (const Vec3d& p : shell_.positions) found.off_vertices += vertex_off(p) > kTolerance;
    return found;
  }

  void run() {
    // First what is grave, by ever stronger means; then, as long as the trials last, faces' middles.
    const bool guarded = guarded_;
    mend_middles_ = false;
    for (int round = 0; round < kRounds; round++) {
      relax();
      for (int i = 0; i < kUndos && swap_edges(); i++) continue;
      guarded_ = guarded && round % 2 == 0;
      if (attempts_ > kAttempts || !split_faulty_faces()) break;
    }
    guarded_ = guarded;
    mend_middles_ = true;
    for (int round = 0; round < kRounds; round++) {
      relax();
      if (attempts_ > kAttempts || !split_faulty_faces()) break;
    }
    for (int i = 0; i < kUndos && undo_crossings(); i++) continue;
  }

 private:
  // Puts the vertices of crossing faces, and of their neighbours, back to where they began; false when nothing crosses or none had moved.
  bool undo_crossings() {
    bool undone = false;
    for (const std::uint32_t f : self_intersections(shell_))
      for (const std::uint32_t v : shell_.triangles[f])
        for (const std::uint32_t g : faces_of_[v])
          for (const std::uint32_t w : shell_.triangles[g]) {
            undone |= length_squared(shell_.positions[w] - began_[w]) > 0;
            shell_.positions[w] = began_[w];
          }
    return undone;
  }

  void relax() {
    std::set<std::uint32_t> bad;
    for (std::uint32_t v = 0; v < shell_.positions.size(); v++)
      if (vertex_off(shell_.positions[v]) > kGoal) bad.insert(v);
    for (const Triangle& t : shell_.triangles)
      if (faulty(t)) bad.insert(t.begin(), t.end());
    for (int sweep = 0; sweep < kSweeps && !bad.empty(); sweep++) {
      std::set<std::uint32_t> next;
      for (const std::uint32_t v : bad) {
        if (++attempts_ > kAttempts) return;
        const bool moved = improve(v, sweep);
        for (const std::uint32_t f : faces_of_[v]) {
          const Triangle& t = shell_.triangles[f];
          if (moved ? faulty(t) : facing(t) <= 0) next.insert(t.begin(), t.end());
        }
        if (moved && vertex_off(shell_.positions[v]) > kGoal) next.insert(v);
      }
      bad = std::move(next);
    }
  }

  // Gives each face that is turned over the other diagonal with one of its neighbours where that costs less; false when nothing changes.
  bool swap_edges() {
    bool swapped = false;
    for (std::uint32_t f = 0; f < shell_.triangles.size(); f++)
      for (int i = 0; i < 3 && facing(shell_.triangles[f]) <= 0; i++) swapped |= swap_edge(f, i);
    return swapped;
  }

  bool swap_edge(std::uint32_t f, int i) {
    const Triangle t = shell_.triangles[f];
    const std::uint32_t a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
    for (const std::uint32_t g : faces_of_[a]) {
      const Triangle u = shell_.triangles[g];
      if (g == f || std::find(u.begin(), u.end(), b) == u.end()) continue;
      const std::uint32_t e = u[0] + u[1] + u[2] - a - b;
      for (const std::uint32_t h : faces_of_[c])
        for (const std::uint32_t w : shell_.triangles[h])
          if (w == e) return false;  // they are neighbours already
      const Triangle one = {a, e, c}, other = {e, b, c};
      if (face_cost(one) + face_cost(other) >= face_cost(t) + face_cost(u)) return false;
      shell_.triangles[f] = one, shell_.triangles[g] = other;
      std::erase(faces_of_[b], f), std::erase(faces_of_[a], g);
      faces_of_[e].push_back(f), faces_of_[c].push_back(g);
      return true;
    }
    return false;
  }

  // Where a crease is too sharp for the faces that there are, the longest edge of each is divided; false when nothing is wrong.
  bool split_faulty_faces() {
    std::vector<std::uint32_t> wrong;
    for (std::uint32_t f = 0; f < shell_.triangles.size(); f++)
      if (faulty(shell_.triangles[f])) wrong.push_back(f);
    for (const std::uint32_t f : wrong) {
      if (faulty(shell_.triangles[f])) split_longest(f);
    }
    return !wrong.empty();
  }

  void split_longest(std::uint32_t f) {
    const Triangle t = shell_.triangles[f];
    int longest = 0;
    const auto edge = [&](int i) { return length(shell_.positions[t[(i + 1) % 3]] - shell_.positions[t[i]]); };
    for (int i = 1; i < 3; i++)
      if (edge(i) > edge(longest)) longest = i;
    split(t[longest], t[(longest + 1) % 3]);
  }

  void split(std::uint32_t a, std::uint32_t b) {
    const auto m = static_cast<std::uint32_t>(shell_.positions.size());
    shell_.positions.push_back(project((shell_.positions[a] + shell_.positions[b]) * 0.5, 1));
    if (!shell_.uvs.empty()) shell_.uvs.push_back({(shell_.uvs[a][0] + shell_.uvs[b][0]) / 2, (shell_.uvs[a][1] + shell_.uvs[b][1]) / 2});
    for (auto& mask : shell_.masks) mask.second.push_back((mask.second[a] + mask.second[b]) / 2);
    faces_of_.emplace_back();
    began_.push_back(shell_.positions[m]);
    const std::vector<std::uint32_t> around = faces_of_[a];
    for (const std::uint32_t f : around) {
      Triangle& t = shell_.triangles[f];
      if (std::find(t.begin(), t.end(), b) == t.end()) continue;
      // This face keeps a and gets m for b; its other half is new.
      Triangle other = t;
      std::replace(t.begin(), t.end(), b, m);
      std::replace(other.begin(), other.end(), a, m);
      const auto added = static_cast<std::uint32_t>(shell_.triangles.size());
      std::erase(faces_of_[b], f);
      for (const std::uint32_t v : other)
        if (v != m) faces_of_[v].push_back(added);
      faces_of_[m].insert(faces_of_[m].end(), {f, added});
      shell_.triangles.push_back(other);
    }
  }

  // The cosine between the face's normal and the distance's gradient at its middle; how far off the middle is.
  double facing(const Triangle& t, double* off = nullptr) const {
    const Vec3d corners[3] = {shell_.positions[t[0]], shell_.positions[t[1]], shell_.positions[t[2]]};
    return facing(corners, off);
  }
  double facing(const Vec3d (&corners)[3], double* off = nullptr) const {
    const auto& [a, b, c] = corners;
    const Vec3d middle = (a + b + c) / 3;
    Vec3d nearest;
    const double s = distance_(middle, &nearest);
    if (off) *off = std::abs(s / d_ - 1);
    const Vec3d n = cross(b - a, c - a), g = (middle - nearest) * (s < 0 ? -1.0 : 1.0);
    const double norm = length(n) * length(g);
    return norm > 0 ? dot(n, g) / norm : 0;
  }
  double vertex_off(Vec3d p) const { return std::abs(distance_(p) / d_ - 1); }

  static double excess(double off) { return std::min(std::max(off - kGoal, 0.0), 1.0); }
  double face_cost(const Triangle& t) const {
    double off;
    const double cosine = facing(t, &off);
    return (cosine < 0.1 ? kFlipCost - cosine : 0) + excess(off);
  }
  bool faulty(const Triangle& t) const { return face_cost(t) > (mend_middles_ ? 0 : 2); }
  // What is wrong around a vertex; counting ends at `limit`.
  double cost(std::uint32_t v, double limit) const {
    double sum = kVertexCost * excess(vertex_off(shell_.positions[v]));
    for (std::size_t i = 0; i < faces_of_[v].size() && sum < limit; i++) sum += face_cost(shell_.triangles[faces_of_[v][i]]);
    return sum;
  }

  // The nearest place at `part` of the wanted distance, by a few steps along the line from the nearest point of the parent.
  Vec3d project(Vec3d p, double part) const {
    for (int i = 0; i < 3; i++) {
      Vec3d nearest;
      const double s = distance_(p, &nearest);
      if (s == 0 || std::abs(s - part * d_) < 1e-6 * std::abs(d_)) break;
      p += (p - nearest) * ((part * d_ - s) / s);
    }
    return p;
  }

  // Whether a face of the vertex, which looks the right way while that is at `from`, turns by more than some 80 degrees with it.
  bool turns_over(std::uint32_t v, Vec3d from) const {
    for (const std::uint32_t f : faces_of_[v]) {
      Vec3d before[3], after[3];
      for (int i = 0; i < 3; i++) {
        const std::uint32_t w = shell_.triangles[f][i];
        after[i] = shell_.positions[w];
        before[i] = w == v ? from : after[i];
      }
      const Vec3d n = cross(before[1] - before[0], before[2] - before[0]), m = cross(after[1] - after[0], after[2] - after[0]);
      if (dot(n, m) < 0.2 * length(n) * length(m) && facing(before) > 0) return true;
    }
    return false;
  }

  Vec3d neighbours_middle(std::uint32_t v, double* reach) const {
    Vec3d sum;
    double weight = 0, longest = 0;
    for (const std::uint32_t f : faces_of_[v])
      for (const std::uint32_t w : shell_.triangles[f])
        if (w != v) {
          sum += shell_.positions[w];
          weight += 1;
          longest = std::max(longest, length(shell_.positions[w] - shell_.positions[v]));
        }
    *reach = longest;
    return sum / weight;
  }

  // Tries places for one vertex; true when one is better than where it is.
  bool improve(std::uint32_t v, int sweep) {
    const Vec3d start = shell_.positions[v];
    const double before = cost(v, 1e30);
    if (before == 0) return false;
    double reach, best = before;
    Vec3d place = start;
    const Vec3d middle = neighbours_middle(v, &reach);
    const auto attempt = [&](Vec3d p, double part) {
      if (best <= 0) return;
      shell_.positions[v] = project(p, part);
      if (guarded_ && turns_over(v, start)) return;
      const double c = cost(v, best);
      if (c < best - 1e-9) best = c, place = shell_.positions[v];
    };
    for (const double part : {1.0, 1.035, 0.965})
      for (const double t : {0.5, 1.0, 0.0}) attempt(start + (middle - start) * t, part);
    // Around in a ring, turned a little further each sweep.
    for (int i = 0; i < 6; i++) {
      const double a = 1.0472 * i + 0.7 * sweep, r = reach * (0.1 + 0.2 * (sweep % 3));
      attempt(place + Vec3d{std::cos(a), std::sin(a), 0} * r, 1);
      attempt(place + Vec3d{0, std::cos(a), std::sin(a)} * r, 1);
    }
    shell_.positions[v] = place;
    return best < before - 1e-9;
  }

  MeshData& shell_;
  const MeshDistance& distance_;
  double d_;
  bool guarded_, mend_middles_ = true;
  int attempts_ = 0;
  std::vector<Vec3d> began_;  // where each vertex was before the repair
  std::vector<std::vector<std::uint32_t>> faces_of_;
};

}  // namespace

bool worse(const ShellFaults& a, const ShellFaults& b) {
  const auto grave = [](const ShellFaults& f) { return f.flipped + f.crossed + f.off_vertices; };
  return grave(a) != grave(b) ? grave(a) > grave(b) : a.off_faces > b.off_faces;
}

ShellFaults shell_faults(const MeshData& shell, const MeshDistance& distance, double d) {
  return Repair(const_cast<MeshData&>(shell), distance, d).faults();
}

ShellFaults repair_shell(MeshData& shell, const MeshDistance& distance, double d, bool guarded) {
  Repair repair(shell, distance, d, guarded);
  repair.run();
  return repair.faults();
}

}  // namespace stokes
