// A library for LD_PRELOAD that makes OpenCL calls fail, hang or crash on demand, because faulty hardware is hard to come by. Knows the calls'
// names, nothing of Stokes.
//
// OPENCL_FAULTS holds rules CALL@N=ACTION, separated by spaces: what happens at the Nth call of that name (N+: at it and all later ones).
// An ACTION is an OpenCL error code (-5), "hang", "segv", "abort", "exit" (with code 0), "kill" or "truncate", which cuts every library in the
// driver's cache folder in half and goes on with the call. With OPENCL_FAULTS_ONCE=FILE, a rule acts only where FILE does not exist yet, and makes
// it: one fault for a process and those that replace it. With OPENCL_FAULTS_SHARED_CACHE=1, POCL_CACHE_DIR cannot be changed, so that runs share one.
#include <CL/cl.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <mutex>
#include <sstream>
#include <string>

namespace {

void* volatile nowhere = nullptr;

/// The rule's action for this call, or the empty string.
std::string find_action(const std::string& call) {
  static std::mutex mutex;
  static std::map<std::string, int> counts;
  const std::lock_guard lock(mutex);
  const int count = ++counts[call];
  const char* rules = std::getenv("OPENCL_FAULTS");
  std::istringstream words(rules ? rules : "");
  for (std::string rule; words >> rule;) {
    const std::size_t at = rule.find('@'), equals = rule.find('=');
    if (at == std::string::npos || equals == std::string::npos || rule.substr(0, at) != call) continue;
    const int first = std::atoi(rule.c_str() + at + 1);
    const bool and_later = rule[equals - 1] == '+';
    if (count != first && !(and_later && count > first)) continue;
    if (const char* once = std::getenv("OPENCL_FAULTS_ONCE")) {
      const int fd = open(once, O_CREAT | O_EXCL | O_WRONLY, 0666);
      if (fd < 0) continue;
      close(fd);
    }
    return rule.substr(equals + 1);
  }
  return {};
}

void truncate_libraries() {
  namespace fs = std::filesystem;
  const char* folder = std::getenv("POCL_CACHE_DIR");
  std::error_code ec;
  for (fs::recursive_directory_iterator i(folder ? folder : "", ec), end; i != end; i.increment(ec))
    if (i->path().extension() == ".so") fs::resize_file(i->path(), fs::file_size(i->path()) / 2, ec);
}

/// What the call shall return instead of going through; 0: let it through.
cl_int fault(const char* call) {
  const std::string action = find_action(call);
  if (action.empty()) return 0;
  std::fprintf(stderr, "fault: %s: %s\n", call, action.c_str());
  if (action == "hang")
    for (;;) pause();
  if (action == "segv") *static_cast<volatile int*>(nowhere) = 1;  // raise() would not do: PoCL handles what is not a true fault
  if (action == "abort") abort();
  if (action == "exit") exit(0);
  if (action == "kill") raise(SIGKILL);
  if (action == "truncate") truncate_libraries();
  return std::atoi(action.c_str());
}

template <typename Function>
Function real(const char* name, Function) {
  void* found = dlsym(RTLD_NEXT, name);
  if (!found) abort();
  return reinterpret_cast<Function>(found);
}

#define REAL(name) real(#name, &name)

}  // namespace

extern "C" {

cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions, const size_t* offset, const size_t* global, const size_t* local,
                              cl_uint waits, const cl_event* wait_list, cl_event* event) {
  if (const cl_int code = fault("clEnqueueNDRangeKernel")) return code;
  static const auto next = REAL(clEnqueueNDRangeKernel);
  return next(queue, kernel, dimensions, offset, global, local, waits, wait_list, event);
}

cl_int clFinish(cl_command_queue queue) {
  if (const cl_int code = fault("clFinish")) return code;
  static const auto next = REAL(clFinish);
  return next(queue);
}

cl_int clBuildProgram(cl_program program, cl_uint devices, const cl_device_id* list, const char* options, void (*notify)(cl_program, void*), void* data) {
  if (const cl_int code = fault("clBuildProgram")) return code;
  // An optimiser at fault is one that fails where it is not switched off.
  if (!options || !std::strstr(options, "-cl-opt-disable"))
    if (const cl_int code = fault("clBuildProgram:optimised")) return code;
  static const auto next = REAL(clBuildProgram);
  return next(program, devices, list, options, notify, data);
}

cl_mem clCreateBuffer(cl_context context, cl_mem_flags flags, size_t size, void* host, cl_int* error) {
  if (const cl_int code = fault("clCreateBuffer")) {
    if (error) *error = code;
    return nullptr;
  }
  static const auto next = REAL(clCreateBuffer);
  return next(context, flags, size, host, error);
}

cl_int clGetDeviceIDs(cl_platform_id platform, cl_device_type type, cl_uint entries, cl_device_id* devices, cl_uint* count) {
  if (const cl_int code = fault("clGetDeviceIDs")) return code;
  static const auto next = REAL(clGetDeviceIDs);
  return next(platform, type, entries, devices, count);
}

int setenv(const char* name, const char* value, int overwrite) {
  if (std::strcmp(name, "POCL_CACHE_DIR") == 0 && std::getenv("OPENCL_FAULTS_SHARED_CACHE")) return 0;
  static const auto next = reinterpret_cast<int (*)(const char*, const char*, int)>(dlsym(RTLD_NEXT, "setenv"));
  return next(name, value, overwrite);
}

}  // extern "C"
