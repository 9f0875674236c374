// Nearest points by Embree's point queries, refined in double; signs by pseudo-normals.
#include "mesh/mesh_distance.h"

#include <embree3/rtcore.h>

#include <map>

namespace stokes {

struct MeshDistance::State {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<Vec3d> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Vec3d> face_normals, vertex_normals;
  std::vector<std::array<Vec3d, 3>> edge_normals;  // of the edge from corner s to s + 1
  struct Ball {
    Vec3d middle;
    double radius;
  };
  std::vector<Ball> balls;  // around each triangle

  ~State() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

namespace {

enum class Feature { Corner0, Corner1, Corner2, Edge0, Edge1, Edge2, Face };

// The nearest point of a triangle to p, and which feature it lies on (Ericson, Real-Time Collision Detection, 5.1.5).
Vec3d nearest_on_triangle(Vec3d p, Vec3d a, Vec3d b, Vec3d c, Feature& feature) {
  const Vec3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d1 <= 0 && d2 <= 0) return feature = Feature::Corner0, a;
  if (d3 >= 0 && d4 <= d3) return feature = Feature::Corner1, b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return feature = Feature::Edge0, a + ab * (d1 / (d1 - d3));
  if (d6 >= 0 && d5 <= d6) return feature = Feature::Corner2, c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return feature = Feature::Edge2, a + ac * (d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return feature = Feature::Edge1, b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const double inv = 1 / (va + vb + vc);
  return feature = Feature::Face, a + ab * (vb * inv) + ac * (vc * inv);
}

constexpr std::uint32_t kNone = ~0u;
constexpr double kFar = 1e30;

struct Query {
  const MeshDistance::State* state;
  Vec3d p;
  double best;
  std::uint32_t triangle = kNone;
};

}  // namespace

MeshDistance::MeshDistance(const MeshData& mesh) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.positions = mesh.positions;
  s.triangles = mesh.triangles;
  s.vertex_normals.resize(s.positions.size());
  s.edge_normals.resize(s.triangles.size());
  std::map<std::pair<std::uint32_t, std::uint32_t>, Vec3d> edges;
  auto key = [](std::uint32_t a, std::uint32_t b) { return std::pair{std::min(a, b), std::max(a, b)}; };
  for (const auto& t : s.triangles) {
    const Vec3d v[3] = {s.positions[t[0]], s.positions[t[1]], s.positions[t[2]]};
    Vec3d n = cross(v[1] - v[0], v[2] - v[0]);
    if (length(n) > 0) n = normalize(n);
    s.face_normals.push_back(n);
    const Vec3d middle = (v[0] + v[1] + v[2]) / 3;
    s.balls.push_back({middle, std::sqrt(std::max({length_squared(v[0] - middle), length_squared(v[1] - middle), length_squared(v[2] - middle)}))});
    for (int i = 0; i < 3; i++) {
      const Vec3d u = v[(i + 1) % 3] - v[i], w = v[(i + 2) % 3] - v[i];
      s.vertex_normals[t[i]] += n * std::atan2(length(cross(u, w)), dot(u, w));
      edges[key(t[i], t[(i + 1) % 3])] += n;
    }
  }
  for (std::size_t f = 0; f < s.triangles.size(); f++)
    for (int i = 0; i < 3; i++) s.edge_normals[f][i] = edges[key(s.triangles[f][i], s.triangles[f][(i + 1) % 3])];

  s.device = rtcNewDevice(nullptr);
  s.scene = rtcNewScene(s.device);
  rtcSetSceneFlags(s.scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry g = rtcNewGeometry(s.device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* v = static_cast<float*>(rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, s.positions.size()));
  auto* t = static_cast<unsigned*>(rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, s.triangles.size()));
  for (std::size_t i = 0; i < s.positions.size(); i++)
    for (int c = 0; c < 3; c++) v[3 * i + c] = static_cast<float>(s.positions[i][c]);
  for (std::size_t i = 0; i < s.triangles.size(); i++) std::copy(s.triangles[i].begin(), s.triangles[i].end(), t + 3 * i);
  rtcCommitGeometry(g);
  rtcAttachGeometry(s.scene, g);
  rtcReleaseGeometry(g);
  rtcCommitScene(s.scene);
}

MeshDistance::~MeshDistance() = default;

double MeshDistance::operator()(Vec3d p, Vec3d* nearest, std::uint32_t* triangle, double expected) const {
  Query q{state_.get(), p, expected};
  RTCPointQuery query{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z), 0, static_cast<float>(expected)};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(state_->scene, &query, &context,
                [](RTCPointQueryFunctionArguments* args) {
                  auto& q = *static_cast<Query*>(args->userPtr);
                  const auto& ball = q.state->balls[args->primID];
                  const double reach = q.best + ball.radius;
                  if (length_squared(q.p - ball.middle) > reach * reach) return false;
                  const auto& t = q.state->triangles[args->primID];
                  Feature f;
                  const double d = length(q.p - nearest_on_triangle(q.p, q.state->positions[t[0]], q.state->positions[t[1]], q.state->positions[t[2]], f));
                  if (d >= q.best) return false;
                  q.best = d;
                  q.triangle = args->primID;
                  args->query->radius = static_cast<float>(d * 1.00001);  // the next may be as near; float must not cut it off
                  return true;
                },
                &q);
  if (q.triangle == kNone && expected < kFar) return (*this)(p, nearest, triangle);
  if (q.triangle == kNone) q.triangle = 0;  // a place that is not a number
  const auto& t = state_->triangles[q.triangle];
  Feature f;
  const Vec3d c = nearest_on_triangle(p, state_->positions[t[0]], state_->positions[t[1]], state_->positions[t[2]], f);
  if (nearest) *nearest = c;
  if (triangle) *triangle = q.triangle;
  const int i = static_cast<int>(f);
  const Vec3d n = i < 3 ? state_->vertex_normals[t[i]] : i < 6 ? state_->edge_normals[q.triangle][i - 3] : state_->face_normals[q.triangle];
  return dot(p - c, n) < 0 ? -q.best : q.best;
}

MeshPoint MeshDistance::nearest(Vec3d p) const {
  MeshPoint found;
  Vec3d c;
  (*this)(p, &c, &found.triangle);
  found.weights = weights(found.triangle, c);
  return found;
}

std::array<double, 3> MeshDistance::weights(std::uint32_t triangle, Vec3d p) const {
  const auto& t = state_->triangles[triangle];
  const Vec3d v[3] = {state_->positions[t[0]], state_->positions[t[1]], state_->positions[t[2]]}, n = cross(v[1] - v[0], v[2] - v[0]);
  const double area = dot(n, n);
  std::array<double, 3> w = {1, 0, 0};
  for (int i = 0; i < 3 && area > 0; i++) w[i] = dot(n, cross(v[(i + 2) % 3] - v[(i + 1) % 3], p - v[(i + 1) % 3])) / area;
  return w;
}

}  // namespace stokes
