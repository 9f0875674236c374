// See kernel_program.h.
#include "support/kernel_program.h"

#include <algorithm>
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
                                 "CHROMATIC_MEDIA", "INTERFACES", "FLUORESCENT_SURFACES", "FLUORESCENT_MEDIA", "RERADIATION", "METAL",
                                 "CONDUCTOR", "SMOOTH_DIELECTRIC", "ROUGH_DIELECTRIC", "PHONG", "DISPERSION", "EMISSION_TEXTURES",
                                 "SMOOTH_NORMALS", "LENS"};

std::string build_options(const KernelVariant& v) {
  const auto define = [](const std::string& name, int value) { return " -D" + name + "=" + std::to_string(value); };
  std::string text = "-cl-std=CL1.2 -I" STOKES_SOURCE_DIR "/kernels";
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

KernelProgram::KernelProgram(const std::string& path, const KernelVariant& variant)
    : variant_(variant), device_(first_cpu()), context_(device_), queue_(context_, device_) {
  program_ = cl::Program(context_, "#include \"" STOKES_SOURCE_DIR "/" + path + "\"\n");
  try {
    program_.build({device_}, build_options(variant).c_str());
  } catch (const cl::Error&) {
    throw std::runtime_error(path + ":\n" + program_.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device_));
  }
}

cl::Buffer KernelProgram::upload(const void* data, std::size_t bytes) {
  // A buffer must not be empty.
  cl::Buffer buffer(context_, CL_MEM_READ_WRITE, std::max<std::size_t>(bytes, 64));
  if (bytes) queue_.enqueueWriteBuffer(buffer, CL_TRUE, 0, bytes, data);
  return buffer;
}

void KernelProgram::enqueue(cl::Kernel& kernel, std::size_t work_items) {
  const double begin = cpu_seconds();
  queue_.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(work_items), cl::NDRange(1));
  queue_.finish();
  seconds_ = cpu_seconds() - begin;
}

void KernelProgram::set_scene(const CompiledScene& s) {
  scene_.clear();
  const auto add = [this](const auto& v) { scene_.push_back(upload(v.data(), v.size() * sizeof(v[0]))); };
  const std::vector<layout::Scene> header{s.header};
  const std::vector<layout::Environment> environment{s.environment};
  add(header), add(s.bvh_nodes), add(s.bvh_leaves), add(s.quads), add(s.spheres), add(s.ellipsoids), add(s.triangles);
  add(s.positions), add(s.normals), add(s.uvs), add(s.surfaces), add(s.materials), add(s.textures), add(s.regions), add(s.texels);
  add(s.spectra), add(s.media), add(s.dyes), add(s.distributions), add(s.cdfs), add(s.reradiations), add(s.reradiation_values);
  add(s.lights), add(environment), add(s.environment_cdf), add(s.camera_knots), add(s.sensor);
}

}  // namespace stokes::testing
