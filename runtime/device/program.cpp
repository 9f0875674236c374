// Builds programs: cached binary, else source, else source without optimisation.
#include "device/program.h"

#include <map>
#include <mutex>

#include "device/binary_cache.h"
#include "device/calls.h"
#include "device/device_list.h"

namespace stokes {

namespace {

std::string device_key(const DeviceInfo& info) {
  return info.platform_name + "\n" + info.version + "\n" + info.driver + "\n" + info.vendor + "\n" + info.name + "\n";
}

std::string fetch_log(const cl::Program& program, const cl::Device& device) {
  try {
    return program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device);
  } catch (const cl::Error&) {
    return "(the driver gives no log)";
  }
}

// The program from its cached binary, or a null program when there is none or the driver refuses it.
cl::Program load_cached(const cl::Context& context, const cl::Device& device, const std::string& key, const std::string& options) {
  const std::string bytes = read_cached(cache_folder(), key);
  if (bytes.empty()) return {};
  try {
    cl::Program program(context, {device}, cl::Program::Binaries{{bytes.begin(), bytes.end()}});
    program.build(device, options.c_str());
    return program;
  } catch (const cl::Error&) {
    return {};
  }
}

// A built program and an empty log, or the failure's log and code name.
struct Attempt {
  cl::Program program;
  bool built = false;
  std::string log, failure;
};

Attempt try_build(const cl::Context& context, const cl::Device& device, const std::string& source, const std::string& options) {
  Attempt attempt;
  attempt.program = cl::Program(context, source, false);
  try {
    attempt.program.build(device, options.c_str());
    attempt.built = true;
  } catch (const cl::Error& error) {
    attempt.failure = error_name(error.err());
    attempt.log = fetch_log(attempt.program, device);
  }
  return attempt;
}

bool run_x86_probe(const cl::Device& device) {
  // The signs of eight values that the compiler cannot know: bit i set where value i is negative.
  static const char* const kSource =
      "__kernel void probe(__global uint* word, __global const float8* value) {\n"
      "  word[0] = (uint)__builtin_ia32_movmskps256(value[0]);\n"
      "}\n";
  try {
    cl::Context context(device);
    cl::CommandQueue queue(context, device);
    cl::Program program(context, kSource, false);
    program.build(device, "-cl-std=CL1.2");
    const cl_float values[8] = {-1, 1, -2, 2, 3, -3, -0.0f, 4};
    cl_uint word = 0;
    cl::Buffer in(context, CL_MEM_READ_ONLY, sizeof values), out(context, CL_MEM_READ_WRITE, sizeof word);
    queue.enqueueWriteBuffer(in, CL_TRUE, 0, sizeof values, values);
    cl::Kernel kernel(program, "probe");
    kernel.setArg(0, out);
    kernel.setArg(1, in);
    queue.enqueueNDRangeKernel(kernel, cl::NullRange, 1, 1);
    queue.enqueueReadBuffer(out, CL_TRUE, 0, sizeof word, &word);
    return word == 0x65;
  } catch (const cl::Error&) {
    return false;
  }
}

}  // namespace

std::string build_options(const cl::Device& device, bool optimise) {
  // PoCL writes how many warnings it found to the error stream, whatever they are; lint_kernels.sh looks at them.
  std::string options = "-cl-std=CL1.2 -w";
  if (device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>() & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT)
    options += " -cl-fp32-correctly-rounded-divide-sqrt";
  if (!optimise) options += " -cl-opt-disable";
  return options;
}

BuiltProgram build_program(const cl::Context& context, const cl::Device& device, const DeviceInfo& info, const std::string& source, BuildChoices choices) {
  BuiltProgram built;
  const std::string options = build_options(device, choices.optimise);
  built.cache_key = device_key(info) + options + "\n" + source;
  if (choices.use_cache) built.program = load_cached(context, device, built.cache_key, options);
  built.from_cache = built.program() != nullptr;
  if (built.from_cache) return built;

  Attempt first = try_build(context, device, source, options);
  if (first.built) {
    built.program = first.program;
    return built;
  }
  // An optimiser may be at fault; slow kernels are better than none.
  const std::string plain_options = build_options(device, false);
  Attempt second = try_build(context, device, source, plain_options);
  if (!second.built) {
    throw KernelBuildError("clBuildProgram failed with " + first.failure + " on " + describe_device(info) + ", options " + options, first.log);
  }
  built.program = second.program;
  built.cache_key = device_key(info) + plain_options + "\n" + source;
  built.warning = "the kernels built only without optimisation on " + describe_device(info) + " (" + first.failure + "); rendering will be slow";
  return built;
}

void store_program(const BuiltProgram& built) {
  if (built.from_cache) return;
  try {
    const auto binaries = built.program.getInfo<CL_PROGRAM_BINARIES>();
    if (binaries.size() != 1 || binaries[0].empty()) return;
    write_cached(cache_folder(), built.cache_key, {reinterpret_cast<const char*>(binaries[0].data()), binaries[0].size()});
  } catch (const cl::Error&) {
    // A driver that gives no binary is asked to compile again next time.
  }
}

bool probe_x86(const cl::Device& device, const DeviceInfo& info) {
  // Only where the compiler is known to answer an unknown builtin with an error: PoCL's is clang itself.
  if (info.type != "cpu" || info.platform_name != "Portable Computing Language") return false;
  static std::mutex mutex;
  static std::map<std::string, bool> known;
  const std::lock_guard lock(mutex);
  const std::string key = "x86 probe\n" + device_key(info);
  if (const auto found = known.find(key); found != known.end()) return found->second;
  const std::string cached = read_cached(cache_folder(), key);
  const bool works = cached.empty() ? run_x86_probe(device) : cached == "1";
  if (cached.empty()) write_cached(cache_folder(), key, works ? "1" : "0");
  return known[key] = works;
}

}  // namespace stokes
