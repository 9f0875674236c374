// Edits of closed meshes. Costs are squares of the excess, so that a fault that is halved counts a quarter and dividing a face pays.
#include "mesh/shell_edit.h"

#include <algorithm>

#include "mesh/in_parallel.h"
#include "mesh/refill.h"

namespace stokes {
namespace {

constexpr double kGoal = 0.04;    // of the distance: where edits cost nothing
constexpr double kLimit = 0.049;  // where faults begin: rounding to float must leave places within the tolerance
constexpr double kMost = 300;    // what one place that is off may cost
constexpr double kFlip = 600, kCross = 600;
constexpr double kVertex = 4;    // a vertex is worth this many faces
constexpr double kFacing = 0.05; // the least cosine that is aimed at
constexpr double kFace = 0.01;   // so that faces are not added for nothing

double off_cost(double off) { return off > kGoal ? std::min((off / kGoal) * (off / kGoal) - 1, kMost) : 0; }
double vertex_cost(double off) { return kVertex * off_cost(off); }
double face_cost(const ShellMeasure::Face& face) {
  return off_cost(face.off) + (face.facing < kFacing ? kFlip + 100 * (kFacing - face.facing) : 0);
}

}  // namespace

double ShellEditor::FaceState::cost() const { return face_cost(face) + kCross * static_cast<double>(crossed); }

ShellEditor::ShellEditor(const MeshData& shell, const ShellMeasure& measure)
    : measure_(measure), positions_(shell.positions), gradients_(positions_.size()), triangles_(shell.triangles), faces_of_(positions_.size()),
      states_(triangles_.size()), vertex_off_(positions_.size()) {
  in_parallel(positions_.size(), [&](std::size_t v) {
    const ShellMeasure::Place place = measure_.at(positions_[v]);
    gradients_[v] = place.gradient;
    vertex_off_[v] = place.off;
  });
  in_parallel(triangles_.size(), [&](std::size_t f) {
    const Triangle& t = triangles_[f];
    states_[f].face = measure_.face(corner(t[0]), corner(t[1]), corner(t[2]));
  });
  double size = 0;
  for (const Triangle& t : triangles_) size += 1.5 * edge(t[0], t[1]) / static_cast<double>(triangles_.size());
  grid_ = std::make_unique<FaceGrid>(positions_, triangles_, size);
  for (std::uint32_t f = 0; f < triangles_.size(); f++) {
    std::vector<std::uint32_t> crossed;
    grid_->crossings(triangles_[f], ShellEdit::kNone, {}, {}, crossed);
    for (const std::uint32_t g : crossed) states_[f].crossed++, states_[g].crossed++;
    grid_->insert(f);
    for (const std::uint32_t v : triangles_[f]) faces_of_[v].push_back(f);
  }
}

std::vector<std::uint32_t> ShellEditor::neighbours(std::uint32_t v) const {
  std::vector<std::uint32_t> found;
  for (const std::uint32_t f : faces_of_[v])
    for (const std::uint32_t w : triangles_[f])
      if (w != v && std::find(found.begin(), found.end(), w) == found.end()) found.push_back(w);
  return found;
}

std::vector<std::uint32_t> ShellEditor::faces_on(std::uint32_t a, std::uint32_t b) const {
  std::vector<std::uint32_t> found;
  for (const std::uint32_t f : faces_of_[a]) {
    const Triangle& t = triangles_[f];
    for (int i = 0; i < 3; i++)
      if (t[i] == a && t[(i + 1) % 3] == b) found.insert(found.begin(), f);
      else if (t[i] == b && t[(i + 1) % 3] == a) found.push_back(f);
  }
  if (found.size() != 2) found.clear();
  return found;
}

ShellEdit ShellEditor::move(std::uint32_t v, Vec3d to) const {
  ShellEdit edit;
  edit.removed = faces_of_[v];
  for (const std::uint32_t f : edit.removed) edit.added.push_back(triangles_[f]);
  edit.vertex = v, edit.place = to;
  return edit;
}

ShellEdit ShellEditor::flip(std::uint32_t a, std::uint32_t b) const {
  ShellEdit edit;
  const std::vector<std::uint32_t> on = faces_on(a, b);
  if (on.empty()) return edit;
  const std::uint32_t c = opposite(on[0], a, b), e = opposite(on[1], a, b);
  if (c == e || !faces_on(c, e).empty()) return edit;  // they are neighbours already
  for (const std::uint32_t f : faces_of_[c])
    for (const std::uint32_t w : triangles_[f])
      if (w == e) return edit;
  edit.removed = on;
  edit.added = {{a, e, c}, {e, b, c}};
  return edit;
}

ShellEdit ShellEditor::split(std::uint32_t a, std::uint32_t b, Vec3d at) const {
  ShellEdit edit;
  edit.removed = faces_on(a, b);
  edit.vertex = static_cast<std::uint32_t>(positions_.size()), edit.place = at;
  for (const std::uint32_t f : edit.removed) {
    Triangle one = triangles_[f], other = one;
    std::replace(one.begin(), one.end(), b, edit.vertex);
    std::replace(other.begin(), other.end(), a, edit.vertex);
    edit.added.insert(edit.added.end(), {one, other});
  }
  return edit;
}

ShellEdit ShellEditor::collapse(std::uint32_t a, std::uint32_t b, Vec3d to) const {
  ShellEdit edit;
  const std::vector<std::uint32_t> on = faces_on(a, b);
  if (on.empty()) return edit;
  // The link condition: a and b have no common neighbours but the corners opposite to their edge.
  const std::vector<std::uint32_t> one = neighbours(a), other = neighbours(b);
  const auto common = std::count_if(one.begin(), one.end(), [&](std::uint32_t v) { return std::find(other.begin(), other.end(), v) != other.end(); });
  const std::uint32_t c = opposite(on[0], a, b), e = opposite(on[1], a, b);
  if (common != 2 || c == e || faces_of_[c].size() <= 3 || faces_of_[e].size() <= 3) return edit;
  edit.removed = faces_of_[a];
  for (const std::uint32_t f : faces_of_[b])
    if (f != on[0] && f != on[1]) edit.removed.push_back(f);
  for (const std::uint32_t f : edit.removed) {
    if (f == on[0] || f == on[1]) continue;
    edit.added.push_back(triangles_[f]);
    std::replace(edit.added.back().begin(), edit.added.back().end(), b, a);
  }
  edit.vertex = a, edit.gone = b, edit.place = to;
  return edit;
}

ShellEdit ShellEditor::replace(std::vector<std::uint32_t> faces) const {
  constexpr std::size_t kLongest = 60;
  ShellEdit edit;
  std::vector<Triangle> old;
  for (const std::uint32_t f : faces) old.push_back(triangles_[f]);
  std::sort(faces.begin(), faces.end());
  const auto free = [&](std::uint32_t a, std::uint32_t b) {
    for (const std::uint32_t f : faces_of_[a])
      if (std::find(triangles_[f].begin(), triangles_[f].end(), b) != triangles_[f].end() && !std::binary_search(faces.begin(), faces.end(), f)) return false;
    return true;
  };
  // The smallest surface: where the level has a ridge it comes near that.
  const auto weight = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return length(cross(positions_[b] - positions_[a], positions_[c] - positions_[a])) + 1e-9;
  };
  edit.added = refill(old, kLongest, weight, free);
  if (!edit.added.empty()) edit.removed = std::move(faces);
  return edit;
}

double ShellEditor::cost_before(const ShellEdit& edit) const {
  double sum = kFace * static_cast<double>(edit.removed.size());
  for (const std::uint32_t f : edit.removed) sum += states_[f].cost();
  if (edit.vertex < positions_.size()) sum += vertex_cost(vertex_off_[edit.vertex]);
  return edit.gone != ShellEdit::kNone ? sum + vertex_cost(vertex_off_[edit.gone]) : sum;
}

double ShellEditor::cost_after(const ShellEdit& edit, double limit) const {
  double sum = kFace * static_cast<double>(edit.added.size());
  ShellMeasure::Place place;
  if (edit.vertex != ShellEdit::kNone) {
    place = measure_.at(edit.place);
    sum += vertex_cost(place.off);
  }
  const auto placed = [&](std::uint32_t v) { return v == edit.vertex ? ShellMeasure::Corner{edit.place, place.gradient} : corner(v); };
  for (std::size_t i = 0; i < edit.added.size() && sum < limit; i++)
    sum += face_cost(measure_.face(placed(edit.added[i][0]), placed(edit.added[i][1]), placed(edit.added[i][2])));
  std::vector<std::uint32_t> crossed;
  for (std::size_t i = 0; i < edit.added.size() && sum < limit; i++) {
    crossed.clear();
    grid_->crossings(edit.added[i], edit.vertex, edit.place, edit.removed, crossed);
    sum += kCross * static_cast<double>(crossed.size());
  }
  return sum;
}

bool ShellEditor::faulty(std::uint32_t f) const {
  if (!alive(f)) return false;
  bool found = states_[f].face.facing < kFacing || states_[f].crossed > 0 || states_[f].face.off > kLimit;
  for (const std::uint32_t v : triangles_[f]) found |= vertex_off_[v] > kLimit;
  return found;
}

void ShellEditor::apply(const ShellEdit& edit) {
  for (const std::uint32_t f : edit.removed)
    for (const std::uint32_t v : triangles_[f]) std::erase(faces_of_[v], f);
  if (edit.vertex != ShellEdit::kNone) {
    if (edit.vertex == positions_.size()) positions_.emplace_back(), gradients_.emplace_back(), vertex_off_.push_back(0), faces_of_.emplace_back();
    const ShellMeasure::Place place = measure_.at(edit.place);
    positions_[edit.vertex] = edit.place;
    gradients_[edit.vertex] = place.gradient;
    vertex_off_[edit.vertex] = place.off;
  }
  if (edit.gone != ShellEdit::kNone) vertex_off_[edit.gone] = 0;
  for (const std::uint32_t f : edit.removed) triangles_[f] = {0, 0, 0}, states_[f] = {{1, 0}, 0};
  for (std::size_t i = 0; i < edit.added.size(); i++) {
    std::uint32_t f = i < edit.removed.size() ? edit.removed[i] : static_cast<std::uint32_t>(triangles_.size());
    if (f == triangles_.size()) triangles_.emplace_back(), states_.emplace_back();
    triangles_[f] = edit.added[i];
    refresh(f);
    for (const std::uint32_t v : triangles_[f]) faces_of_[v].push_back(f);
    grid_->insert(f);
  }
}

void ShellEditor::refresh(std::uint32_t f) {
  const Triangle& t = triangles_[f];
  std::vector<std::uint32_t> crossed;
  grid_->crossings(t, ShellEdit::kNone, {}, {f}, crossed);
  states_[f] = {measure_.face(corner(t[0]), corner(t[1]), corner(t[2])), crossed.size()};
}

ShellFaults ShellEditor::faults() const {
  ShellFaults found;
  for (std::uint32_t f = 0; f < triangles_.size(); f++) {
    if (!alive(f)) continue;
    found.flipped += states_[f].face.facing <= 0;
    found.crossed += states_[f].crossed > 0;
    found.off_faces += states_[f].face.off > ShellMeasure::kTolerance;
  }
  for (std::size_t v = 0; v < vertex_off_.size(); v++) found.off_vertices += !faces_of_[v].empty() && vertex_off_[v] > ShellMeasure::kTolerance;
  return found;
}

MeshData ShellEditor::mesh() const {
  MeshData out;
  std::vector<std::uint32_t> index(positions_.size(), ShellEdit::kNone);
  for (std::uint32_t f = 0; f < triangles_.size(); f++) {
    if (!alive(f)) continue;
    Triangle t = triangles_[f];
    for (std::uint32_t& v : t) {
      if (index[v] == ShellEdit::kNone) {
        index[v] = static_cast<std::uint32_t>(out.positions.size());
        out.positions.push_back(positions_[v]);
      }
      v = index[v];
    }
    out.triangles.push_back(t);
  }
  return out;
}

}  // namespace stokes
