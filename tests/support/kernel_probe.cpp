// The probe's OpenCL calls.
#include "support/kernel_probe.h"

#include <cstdlib>

#include "device/build_constants.h"
#include "device/calls.h"
#include "device/device_list.h"
#include "device/kernel_files.h"
#include "device/program.h"
#include "device/scene_buffers.h"

namespace stokes::test {

namespace {

DeviceInfo probe_device() {
  const char* spec = std::getenv("STOKES_DEVICE");
  return choose_device(spec ? spec : "auto");
}

}  // namespace

struct KernelProbe::State {
  DeviceInfo info = probe_device();
  cl::Device device = find_device(info);
  cl::Context context{device};
  cl::CommandQueue queue{context, device};
  cl::Kernel kernel;
  cl_uint arguments = 0;
  std::vector<cl::Buffer> inputs, outputs;

  void build(const std::string& source, const std::string& name, const std::string& constants) {
    KernelFiles files = embedded_kernels();
    files["probe.cl"] = source;
    kernel = cl::Kernel(build_program(context, device, info, assemble_program(files, "probe.cl", constants), true).program, name.c_str());
  }
};

KernelProbe::KernelProbe(const std::string& source, const std::string& kernel, const std::string& constants)
    : state_(checked("the probe's device", [] { return std::make_unique<State>(); })) {
  checked(describe_device(state_->info), [&] { state_->build(source, kernel, constants); });
}

KernelProbe::KernelProbe(const std::string& source, const std::string& kernel, const CompiledScene& scene, int lanes, const std::string& constants)
    : state_(checked("the probe's device", [] { return std::make_unique<State>(); })) {
  checked(describe_device(state_->info), [&] {
    const DeviceConstants device_constants{lanes, probe_x86(state_->device, state_->info)};
    state_->build(source, kernel, build_constants(scene, device_constants) + constants);
    for (cl::Buffer& buffer : upload_scene(state_->context, scene)) {
      state_->kernel.setArg(state_->arguments++, buffer);
      state_->inputs.push_back(buffer);
    }
  });
}

KernelProbe::~KernelProbe() = default;

void KernelProbe::add_buffer(const void* data, std::size_t bytes, bool is_output) {
  checked(describe_device(state_->info), [&] {
    cl::Buffer buffer(state_->context, CL_MEM_READ_WRITE, bytes ? bytes : 16);
    if (bytes) state_->queue.enqueueWriteBuffer(buffer, CL_TRUE, 0, bytes, data);
    state_->kernel.setArg(state_->arguments++, buffer);
    (is_output ? state_->outputs : state_->inputs).push_back(buffer);
  });
}

void KernelProbe::add_value(const void* data, std::size_t bytes) {
  checked(describe_device(state_->info), [&] { state_->kernel.setArg(state_->arguments++, bytes, data); });
}

KernelProbe& KernelProbe::run(std::size_t work_items) {
  checked(describe_device(state_->info), [&] {
    state_->queue.enqueueNDRangeKernel(state_->kernel, cl::NullRange, work_items, 1);
    state_->queue.finish();
  });
  return *this;
}

std::size_t KernelProbe::output_bytes(std::size_t index) const { return state_->outputs.at(index).getInfo<CL_MEM_SIZE>(); }

void KernelProbe::read_output(std::size_t index, void* data) const {
  checked(describe_device(state_->info), [&] { state_->queue.enqueueReadBuffer(state_->outputs.at(index), CL_TRUE, 0, output_bytes(index), data); });
}

}  // namespace stokes::test
