// Embree behind Traversal: one user geometry whose primitives are the scene's, by global index. See traverse.h.
#include "reference/traverse.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace stokes::reference {
namespace {

/// A query in double that travels with Embree's float ray.
struct Query {
  RTCIntersectContext context;  // first, so that Embree's pointer to it is a pointer to the query
  const CompiledScene* scene;
  const Ray* ray;
  std::uint32_t skip;
  double t_min;
  Hit hit;
};

constexpr double kFarthest = 1e18;  // of a coordinate, in scene units

/// The least float that is not below x.
float round_up(double x) {
  const auto f = static_cast<float>(x);
  return double(f) < x ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

struct Bounded {
  const CompiledScene* scene;
  double padding;
};

// Boxes are padded by more than the rounding of a ray's origin to float, so that no primitive is missed.
void bounds(const RTCBoundsFunctionArguments* args) {
  const auto* bounded = static_cast<const Bounded*>(args->geometryUserPtr);
  const Box box = primitive_bounds(*bounded->scene, args->primID);
  const Vec3d pad = {bounded->padding, bounded->padding, bounded->padding};
  const Vec3d low = box.low - pad, high = box.high + pad;
  *args->bounds_o = {static_cast<float>(low.x),  static_cast<float>(low.y),  static_cast<float>(low.z),  0,
                     static_cast<float>(high.x), static_cast<float>(high.y), static_cast<float>(high.z), 0};
}

void intersect(const RTCIntersectFunctionNArguments* args) {
  auto* query = reinterpret_cast<Query*>(args->context);
  if (!args->valid[0] || args->primID == query->skip) return;
  const double before = query->hit.t;
  intersect_primitive(*query->scene, args->primID, *query->ray, query->t_min, query->hit);
  if (!(query->hit.t < before)) return;
  auto* rayhit = reinterpret_cast<RTCRayHit*>(args->rayhit);
  rayhit->ray.tfar = round_up(query->hit.t);
  rayhit->hit.primID = args->primID;
  rayhit->hit.geomID = args->geomID;
}

double largest_coordinate(const CompiledScene& scene) {
  double largest = 0;
  const auto include = [&](Vec3d p) { largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)}); };
  for (std::uint32_t i = 0; i < primitive_count(scene); i++) {
    const Box box = primitive_bounds(scene, i);
    include(box.low);
    include(box.high);
  }
  include(vec(scene.header.camera.position));
  return largest;
}

}  // namespace

struct Traversal::State {
  const CompiledScene* scene = nullptr;
  Bounded bounded{};
  double t_min = 0;
  RTCDevice device = nullptr;
  RTCScene embree = nullptr;
  ~State() {
    if (embree) rtcReleaseScene(embree);
    if (device) rtcReleaseDevice(device);
  }
};

Traversal::Traversal(const CompiledScene& scene) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.scene = &scene;
  const double extent = largest_coordinate(scene);
  s.bounded = {&scene, 1e-6 * extent};
  // Far below any distance that means something, far above a double's rounding.
  s.t_min = 1e-12 * extent;
  s.device = rtcNewDevice("threads=1");
  if (!s.device) throw std::runtime_error("Embree: no device, error " + std::to_string(rtcGetDeviceError(nullptr)));
  s.embree = rtcNewScene(s.device);
  rtcSetSceneFlags(s.embree, RTC_SCENE_FLAG_ROBUST);
  const RTCGeometry geometry = rtcNewGeometry(s.device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, primitive_count(scene));
  rtcSetGeometryUserData(geometry, &s.bounded);
  rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(s.embree, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(s.embree);
  if (const RTCError error = rtcGetDeviceError(s.device); error != RTC_ERROR_NONE)
    throw std::runtime_error("Embree: building the BVH failed, error " + std::to_string(error));
}

Traversal::~Traversal() = default;

Hit Traversal::closest_hit(const Ray& ray, double t_max, std::uint32_t skip) const {
  Query query{};
  query.hit.t = t_max;
  // Embree ends the program (an assertion) for rays that begin farther away than this, as in a fog of 1e-20 per unit: they meet nothing.
  if (!(std::max({std::abs(ray.o.x), std::abs(ray.o.y), std::abs(ray.o.z)}) < kFarthest)) return query.hit;
  rtcInitIntersectContext(&query.context);
  query.scene = state_->scene;
  query.ray = &ray;
  query.skip = skip;
  query.t_min = state_->t_min;

  RTCRayHit rayhit{};
  rayhit.ray.org_x = static_cast<float>(ray.o.x), rayhit.ray.org_y = static_cast<float>(ray.o.y), rayhit.ray.org_z = static_cast<float>(ray.o.z);
  rayhit.ray.dir_x = static_cast<float>(ray.d.x), rayhit.ray.dir_y = static_cast<float>(ray.d.y), rayhit.ray.dir_z = static_cast<float>(ray.d.z);
  rayhit.ray.tfar = round_up(t_max * (1 + 1e-6));
  rayhit.ray.mask = ~0u;
  rayhit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rayhit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(state_->embree, &query.context, &rayhit);
  return query.hit;
}

}  // namespace stokes::reference
