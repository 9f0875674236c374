// Closest hits per CPU second: the kernels' BVH walk against Embree's rtcIntersect1, on the same meshes and rays, one thread.
// Usage: bench_traversal [triangles] [rays] [rounds] [width]. Prints medians of interleaved rounds and their ratio.
#include <embree3/rtcore.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

#include "compiled/bvh.h"
#include "support/kernel_program.h"
#include "support/test_meshes.h"

namespace {
using namespace stokes;
using namespace stokes::testing;

/// CPU seconds of this thread, or, for what may have threads of its own, of the process.
double cpu_seconds(clockid_t clock = CLOCK_THREAD_CPUTIME_ID) {
  timespec t;
  clock_gettime(clock, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

/// Eight bumpy balls over a bumpy ground.
Mesh bench_mesh(std::size_t triangles) {
  Mesh m;
  const int n = int(std::sqrt(double(triangles) / 18));
  std::mt19937 g(7);
  std::uniform_real_distribution<double> u(0, 1);
  for (int k = 0; k < 8; k++)
    append(m, sphere_mesh(n, n, {float(3 * u(g) - 1.5), float(1.6 * u(g) - 0.6), float(3 * u(g) - 1.5)}, 0.35 + 0.35 * u(g), 0.06));
  const auto base = layout::uint(m.positions.size());
  for (int i = 0; i <= n; i++)
    for (int j = 0; j <= n; j++) {
      const double x = 2.4 * (2.0 * i / n - 1), z = 2.4 * (2.0 * j / n - 1);
      m.positions.push_back({float(x), float(-1.3 + 0.1 * std::sin(5 * x) * std::cos(4 * z) + 0.03 * std::sin(31 * x + z) * std::sin(27 * z)), float(z)});
    }
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++) {
      const auto a = base + layout::uint(i * (n + 1) + j), b = a + layout::uint(n + 1);
      m.add(a, a + 1, b), m.add(a + 1, b + 1, b);
    }
  return m;
}

/// Uniform origins in the bounds, uniform directions.
std::vector<Ray> incoherent_rays(std::size_t n) {
  std::vector<Ray> rays;
  std::mt19937 g(5);
  std::uniform_real_distribution<double> u(-1, 1);
  for (std::size_t i = 0; i < n; i++) {
    const double z = u(g), phi = M_PI * u(g), r = std::sqrt(1 - z * z);
    rays.push_back(make_ray(2.4 * u(g), -0.1 + 1.3 * u(g), 2.4 * u(g), r * std::cos(phi), z, r * std::sin(phi)));
  }
  return rays;
}

/// A camera's rays in tiles of 8 x 8 pixels.
std::vector<Ray> coherent_rays(std::size_t n) {
  std::vector<Ray> rays;
  const int side = int(std::sqrt(double(n)));
  for (int ty = 0; ty < side; ty += 8)
    for (int tx = 0; tx < side; tx += 8)
      for (int y = ty; y < ty + 8; y++)
        for (int x = tx; x < tx + 8; x++)
          rays.push_back(make_ray(0, 1.3, 5, (2 * (x + 0.5) / side - 1) * 0.55, (1 - 2 * (y + 0.5) / side) * 0.55 - 0.3, -1));
  return rays;
}

class Embree {
 public:
  Embree(const Mesh& mesh, RTCSceneFlags flags) {
    device_ = rtcNewDevice("threads=1,set_affinity=0");
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, flags);
    RTCGeometry g = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* v = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, mesh.positions.size());
    std::memcpy(v, mesh.positions.data(), mesh.positions.size() * 12);
    auto* f = static_cast<unsigned*>(rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, mesh.triangles.size()));
    for (const auto& t : mesh.triangles) *f++ = t.v0, *f++ = t.v1, *f++ = t.v2;
    rtcCommitGeometry(g);
    rtcAttachGeometry(scene_, g);
    rtcReleaseGeometry(g);
    const double begin = cpu_seconds(CLOCK_PROCESS_CPUTIME_ID);
    rtcCommitScene(scene_);
    build_seconds = cpu_seconds(CLOCK_PROCESS_CPUTIME_ID) - begin;
  }
  ~Embree() { rtcReleaseScene(scene_), rtcReleaseDevice(device_); }
  double build_seconds;

  double trace(const std::vector<Ray>& rays, bool coherent, std::vector<float>& distances) const {
    const double begin = cpu_seconds();
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    if (coherent) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (std::size_t i = 0; i < rays.size(); i++) {
      const Ray& r = rays[i];
      RTCRayHit h;
      h.ray = {r.o[0], r.o[1], r.o[2], 0, r.d[0], r.d[1], r.d[2], 0, r.tmax, ~0u, 0, 0};
      h.hit.geomID = h.hit.primID = h.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene_, &context, &h);
      distances[i] = h.hit.geomID == RTC_INVALID_GEOMETRY_ID ? -1.0f : h.ray.tfar;
    }
    return cpu_seconds() - begin;
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v[v.size() / 2];
}
}  // namespace

int main(int argc, char** argv) {
  const std::size_t triangles = argc > 1 ? std::size_t(std::atol(argv[1])) : 100000, count = argc > 2 ? std::size_t(std::atol(argv[2])) : 1 << 20;
  const int rounds = argc > 3 ? std::atoi(argv[3]) : 5, width = argc > 4 ? std::atoi(argv[4]) : 8;
  const Mesh mesh = bench_mesh(triangles);
  const CompiledScene scene = mesh_scene(mesh, width);
  std::vector<double> builds[2];
  for (int k = 0; k < std::min(rounds, 5); k++) {
    const double begin = cpu_seconds(CLOCK_PROCESS_CPUTIME_ID);
    compiled::build_bvh(mesh.positions, mesh.triangles, width);
    builds[0].push_back(cpu_seconds(CLOCK_PROCESS_CPUTIME_ID) - begin);
    builds[1].push_back(Embree(mesh, RTC_SCENE_FLAG_NONE).build_seconds);
  }
  const Embree fast(mesh, RTC_SCENE_FLAG_NONE), robust(mesh, RTC_SCENE_FLAG_ROBUST);
  std::printf("%zu triangles; build: ours %.3f s, Embree %.3f s\n", mesh.triangles.size(), median(builds[0]), median(builds[1]));
  KernelVariant variant;
  variant.bvh_width = width;
  variant.x86 = !std::getenv("STOKES_PORTABLE");
  KernelProgram program("bench/traversal/trace.cl", variant);
  for (bool coherent : {false, true}) {
    const std::vector<Ray> rays = coherent ? coherent_rays(count) : incoherent_rays(count);
    const std::vector<float> floats = ray_floats(rays);
    std::vector<float> a(rays.size()), b(rays.size());
    std::vector<std::uint32_t> ids(rays.size());
    const auto ours = [&] {
      program.run("trace", rays.size() / 1024, scene.bvh_nodes, scene.bvh_leaves, 1024u, floats, Out{a}, Out{ids});
      return program.seconds();
    };
    ours();
    std::vector<double> times[3];
    for (int k = 0; k < rounds; k++) {
      times[0].push_back(ours());
      times[1].push_back(fast.trace(rays, coherent, b));
      times[2].push_back(robust.trace(rays, coherent, b));
    }
    std::size_t hits = 0, different = 0;
    for (std::size_t i = 0; i < rays.size(); i++) hits += a[i] >= 0, different += std::abs(a[i] - b[i]) > 1e-4f * (1 + std::abs(b[i]));
    const double n = double(rays.size()) * 1e-6, o = n / median(times[0]), e = n / median(times[1]), r = n / median(times[2]);
    std::printf("%-10s ours %6.2f  Embree %6.2f  Embree robust %6.2f Mrays/s   ratio %.2f (robust %.2f)   hits %zu, different %zu\n",
                coherent ? "coherent" : "incoherent", o, e, r, o / e, o / r, hits, different);
  }
}
