// See kernel_program.h.
#include "support/kernel_program.h"

#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_HPP_ENABLE_EXCEPTIONS
#include <CL/opencl.hpp>
#include <sys/mman.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <stdexcept>

namespace stokes::testing {
namespace {

// PoCL where it is there: the runtime that the project's figures are measured on.
cl::Device first_cpu() {
  std::vector<cl::Platform> platforms;
  cl::Platform::get(&platforms);
  std::stable_partition(platforms.begin(), platforms.end(), [](const cl::Platform& p) {
    return p.getInfo<CL_PLATFORM_NAME>().find("Portable Computing") != std::string::npos;
  });
  for (const cl::Platform& platform : platforms) {
    std::vector<cl::Device> devices;
    try {
      platform.getDevices(CL_DEVICE_TYPE_CPU, &devices);
    } catch (const cl::Error&) {
      continue;  // a platform may have none
    }
    if (!devices.empty()) return devices.front();
  }
  throw std::runtime_error("no OpenCL CPU device");
}

const char* const kFeatures[] = {"TRIANGLES", "SPHERES", "ELLIPSOIDS", "QUADS", "TEXTURES", "BLENDS", "ENVIRONMENT", "BACKGROUND", "MEDIA",
                                 "CHROMATIC_MEDIA", "THIN_MEDIA", "INTERFACES", "FLUORESCENT_SURFACES", "FLUORESCENT_MEDIA", "RERADIATION", "METAL",
                                 "CONDUCTOR", "SMOOTH_DIELECTRIC", "ROUGH_DIELECTRIC", "PHONG", "DISPERSION", "EMISSION_TEXTURES",
                                 "SMOOTH_NORMALS", "LENS"};

std::string build_options(const KernelVariant& v) {
  const auto define = [](const std::string& name, int value) { return " -D" + name + "=" + std::to_string(value); };
  std::string text = "-cl-std=CL1.2 -I" STOKES_SOURCE_DIR "/kernels -I" STOKES_SOURCE_DIR "/tests/differential";
  text += define("LANES", v.lanes) + define("BVH_WIDTH", v.bvh_width) + define("WAVELENGTHS", v.wavelengths);
  text += define("SCENE_RGB", v.rgb) + define("STOKES_X86", v.x86);
  for (const char* feature : kFeatures)
    text += define(std::string("SCENE_HAS_") + feature, std::find(v.without.begin(), v.without.end(), feature) == v.without.end());
  return text + " " + v.extra;
}

double cpu_seconds() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

}  // namespace

// A buffer over memory of our own in 2 MiB pages, as Embree's is: walks through large trees are a quarter faster with it.
struct PagedBuffer {
  std::shared_ptr<void> memory;
  cl::Buffer buffer;

  PagedBuffer(const cl::Context& context, const void* data, std::size_t bytes) {
    constexpr std::size_t kPage = std::size_t(2) << 20;
    // A buffer must not be empty.
    const std::size_t size = (std::max<std::size_t>(bytes, 64) + kPage - 1) / kPage * kPage;
    memory.reset(std::aligned_alloc(kPage, size), std::free);
    if (!memory) throw std::bad_alloc();
    madvise(memory.get(), size, MADV_HUGEPAGE);
    if (bytes) std::memcpy(memory.get(), data, bytes);
    buffer = cl::Buffer(context, CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR, std::max<std::size_t>(bytes, 64), memory.get());
  }
};

struct KernelProgram::Device {
  cl::Device device = first_cpu();
  cl::Context context{device};
  cl::CommandQueue queue{context, device};
  cl::Program program;
  std::vector<PagedBuffer> scene;
};

KernelProgram::~KernelProgram() = default;
KernelProgram::KernelProgram(KernelProgram&&) noexcept = default;

KernelProgram::KernelProgram(const std::string& path, const KernelVariant& variant) : variant_(variant), device_(std::make_unique<Device>()) {
  device_->program = cl::Program(device_->context, "#include \"" STOKES_SOURCE_DIR "/" + path + "\"\n");
  try {
    device_->program.build({device_->device}, build_options(variant).c_str());
  } catch (const cl::Error&) {
    throw std::runtime_error(path + ":\n" + device_->program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device_->device));
  }
}

void KernelProgram::launch(const std::string& name, std::size_t work_items, bool with_scene, const std::vector<Argument>& arguments) {
  cl::Kernel kernel(device_->program, name.c_str());
  cl_uint index = 0;
  if (with_scene)
    for (const PagedBuffer& b : device_->scene) kernel.setArg(index++, b.buffer);
  std::vector<PagedBuffer> buffers;
  for (const Argument& a : arguments) {
    if (a.kind == Argument::Kind::Value) {
      kernel.setArg(index++, a.bytes, a.data);
      continue;
    }
    buffers.emplace_back(device_->context, a.data, a.bytes);
    kernel.setArg(index++, buffers.back().buffer);
  }
  const double begin = cpu_seconds();
  device_->queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(work_items), cl::NDRange(1));
  device_->queue.finish();
  seconds_ = cpu_seconds() - begin;
  std::size_t next = 0;
  for (const Argument& a : arguments) {
    if (a.kind == Argument::Kind::Value) continue;
    if (a.kind == Argument::Kind::Output) device_->queue.enqueueReadBuffer(buffers[next].buffer, CL_TRUE, 0, a.bytes, a.data);
    next++;
  }
}

void KernelProgram::set_scene(const CompiledScene& s) {
  std::vector<PagedBuffer>& scene = device_->scene;
  scene.clear();
  const auto add = [&](const auto& v) { scene.emplace_back(device_->context, v.data(), v.size() * sizeof(v[0])); };
  const std::vector<layout::Scene> header{s.header};
  const std::vector<layout::Environment> environment{s.environment};
  add(header), add(s.bvh_nodes), add(s.bvh_leaves), add(s.quads), add(s.spheres), add(s.ellipsoids), add(s.triangles);
  add(s.positions), add(s.normals), add(s.uvs), add(s.surfaces), add(s.materials), add(s.textures), add(s.regions), add(s.texels);
  add(s.spectra), add(s.media), add(s.dyes), add(s.distributions), add(s.cdfs), add(s.reradiations), add(s.reradiation_values);
  add(s.lights), add(environment), add(s.environment_cdf), add(s.camera_knots), add(s.sensor);
}

}  // namespace stokes::testing
