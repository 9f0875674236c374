// Finds boxes among quads. See rooms.h.
#include "compiled/rooms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "compiled/shapes.h"

namespace stokes::compiled {
namespace {

constexpr double kTolerance = 1e-6;  // of the size

struct Box {
  std::array<float, 3> low, high;
};

// A quad that is a rectangle along the axes: its box is flat along `axis`.
struct Face {
  int quad;
  std::size_t axis;
  Box box;
};

double extent(const Box& b) {
  double e = 0;
  for (std::size_t k = 0; k < 3; k++) e = std::max(e, double(b.high[k]) - double(b.low[k]));
  return e;
}

Box bounds_of(const layout::Quad& q) {
  const Vec3d p = to_double(q.corner), u = to_double(q.edge_u), v = to_double(q.edge_v);
  Box b;
  b.low.fill(INFINITY), b.high.fill(-INFINITY);
  for (const Vec3d& corner : {p, p + u, p + v, p + u + v}) {
    const layout::Vec3 c = to_float(corner);
    const float x[] = {c.x, c.y, c.z};
    for (std::size_t k = 0; k < 3; k++) b.low[k] = std::min(b.low[k], x[k]), b.high[k] = std::max(b.high[k], x[k]);
  }
  return b;
}

std::optional<Face> face_of(const layout::Quad& q, int index) {
  const Box b = bounds_of(q);
  for (std::size_t axis = 0; axis < 3; axis++) {
    if (b.low[axis] != b.high[axis]) continue;
    const std::size_t s = (axis + 1) % 3, t = (axis + 2) % 3;
    const double filled = (double(b.high[s]) - double(b.low[s])) * (double(b.high[t]) - double(b.low[t]));
    if (!(filled > 0) || std::abs(double(q.area) - filled) > kTolerance * filled) return std::nullopt;
    return Face{index, axis, b};
  }
  return std::nullopt;
}

bool close(float a, float b, double tolerance) { return std::abs(double(a) - double(b)) <= tolerance; }

bool touch_in_one_plane(const Box& face, std::size_t axis, const Box& other) {
  const double slack = 1e-4 * std::max(extent(face), extent(other));
  if (!close(other.low[axis], face.low[axis], slack) || !close(other.high[axis], face.low[axis], slack)) return false;
  for (std::size_t k = 0; k < 3; k++)
    if (k != axis && (other.low[k] >= face.high[k] - slack || other.high[k] <= face.low[k] + slack)) return false;
  return true;
}

std::vector<Face> faces_of(const std::vector<layout::Quad>& quads) {
  const std::size_t count = std::min(quads.size(), kMaxAnalyticQuads);
  std::vector<Face> faces;
  for (std::size_t i = 0; i < count; i++) {
    const std::optional<Face> face = face_of(quads[i], int(i));
    if (!face) continue;
    bool alone = true;
    for (std::size_t j = 0; j < quads.size() && alone; j++) alone = i == j || !touch_in_one_plane(face->box, face->axis, bounds_of(quads[j]));
    if (alone) faces.push_back(*face);
  }
  return faces;
}

// Whether the face is the side of the box at `at` along its axis.
bool fills(const Face& face, const Box& box, float at, double tolerance) {
  if (!close(face.box.low[face.axis], at, tolerance)) return false;
  for (std::size_t k = 0; k < 3; k++)
    if (k != face.axis && !(close(face.box.low[k], box.low[k], tolerance) && close(face.box.high[k], box.high[k], tolerance))) return false;
  return true;
}

// The box between two opposite faces, with all the faces that it has.
std::optional<layout::Room> room_between(const std::vector<Face>& faces, const Face& a, const Face& b, int* count) {
  if (a.axis != b.axis || !(a.box.low[a.axis] < b.box.low[a.axis])) return std::nullopt;
  Box box = a.box;
  box.high[a.axis] = b.box.high[a.axis];
  const double tolerance = kTolerance * extent(box);
  if (!fills(b, box, b.box.low[b.axis], tolerance)) return std::nullopt;
  layout::Room room{};
  std::fill(std::begin(room.faces), std::end(room.faces), -1);
  *count = 0;
  const Box sides = box;
  for (const Face& f : faces)
    for (const bool upper : {false, true}) {
      int& place = room.faces[2 * f.axis + (upper ? 1 : 0)];
      float& plane = (upper ? box.high : box.low)[f.axis];
      if (place != -1 || !fills(f, sides, plane, tolerance)) continue;
      place = f.quad;
      plane = f.box.low[f.axis];
      ++*count;
    }
  room.low = {box.low[0], box.low[1], box.low[2]};
  room.high = {box.high[0], box.high[1], box.high[2]};
  return room;
}

}  // namespace

std::vector<layout::Room> find_rooms(const std::vector<layout::Quad>& quads) {
  std::vector<Face> faces = faces_of(quads);
  std::vector<layout::Room> rooms;
  while (rooms.size() < SCENE_ROOMS) {
    std::optional<layout::Room> best;
    int most = 2;
    for (const Face& a : faces)
      for (const Face& b : faces) {
        int count = 0;
        const std::optional<layout::Room> room = room_between(faces, a, b, &count);
        if (!room || count <= most) continue;
        best = room;
        most = count;
      }
    if (!best) break;
    rooms.push_back(*best);
    std::erase_if(faces, [&](const Face& f) { return std::find(std::begin(best->faces), std::end(best->faces), f.quad) != std::end(best->faces); });
  }
  return rooms;
}

}  // namespace stokes::compiled
