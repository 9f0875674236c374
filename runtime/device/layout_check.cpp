// The layout probe: a generated kernel that writes each member's offset and size, and the comparison.
#include "device/layout_check.h"

#include "device/calls.h"
#include "device/device_list.h"
#include "device/kernel_files.h"
#include "device/layout_fields.h"
#include "device/program.h"
#include "layout.h"

namespace stokes {

namespace {

// A member forgotten in the list would go unchecked: the sizes must add up, since the structs have no gaps.
#define F(member) +sizeof(T::member)
#define S(type, members)                                                               \
  static_assert([] {                                                                   \
    using T = layout::type;                                                            \
    return sizeof(T) == (0 members);                                                   \
  }(), "layout_fields.h does not list every member of " #type);
STOKES_LAYOUT_STRUCTS(S)
#undef S
#undef F

// One line per number, in the order of layout_structs(): each struct's size, then offset and size of its members.
std::string make_probe(const std::vector<LayoutStruct>& structs) {
  std::string text = "#include \"layout.h\"\n__kernel void probe_layout(__global uint* out, const __global char* base) {\n";
  std::size_t index = 0;
  const auto write = [&](const std::string& value) { text += "  out[" + std::to_string(index++) + "] = (uint)(" + value + ");\n"; };
  for (const LayoutStruct& type : structs) {
    write("sizeof(" + type.name + ")");
    for (const LayoutField& field : type.fields) {
      const std::string member = "((const __global " + type.name + "*)base)->" + field.name;
      write("(const __global char*)&" + member + " - base");
      write("sizeof(" + member + ")");
    }
  }
  return text + "}\n";
}

std::vector<cl_uint> run_probe(const DeviceInfo& info, const std::string& source, std::size_t count) {
  const cl::Device device = find_device(info);
  return checked(describe_device(info), [&] {
    const cl::Context context(device);
    const cl::CommandQueue queue(context, device);
    const BuiltProgram built = build_program(context, device, info, source, {});
    const cl::Buffer out(context, CL_MEM_READ_WRITE, count * sizeof(cl_uint)), base(context, CL_MEM_READ_WRITE, 4096);
    cl::Kernel kernel(built.program, "probe_layout");
    kernel.setArg(0, out);
    kernel.setArg(1, base);
    queue.enqueueNDRangeKernel(kernel, cl::NullRange, 1, 1);
    std::vector<cl_uint> numbers(count);
    queue.enqueueReadBuffer(out, CL_TRUE, 0, count * sizeof(cl_uint), numbers.data());
    return numbers;
  });
}

}  // namespace

const std::vector<LayoutStruct>& layout_structs() {
  static const std::vector<LayoutStruct> structs = [] {
    std::vector<LayoutStruct> list;
#define F(member) {#member, offsetof(T, member), sizeof(T::member)},
#define S(type, members)                            \
  {                                                 \
    using T = layout::type;                         \
    list.push_back({#type, sizeof(T), {members}});  \
  }
    STOKES_LAYOUT_STRUCTS(S)
#undef S
#undef F
    return list;
  }();
  return structs;
}

std::vector<std::string> check_layout(const DeviceInfo& device, const std::string& layout_text) {
  const std::vector<LayoutStruct>& structs = layout_structs();
  std::size_t count = 0;
  for (const LayoutStruct& type : structs) count += 1 + 2 * type.fields.size();
  const KernelFiles files = {{"layout.h", layout_text}, {"probe_layout.cl", make_probe(structs)}};
  const std::vector<cl_uint> found = run_probe(device, assemble_program(files, "probe_layout.cl", ""), count);

  std::vector<std::string> differences;
  std::size_t index = 0;
  const auto compare = [&](const std::string& what, std::size_t here) {
    const std::size_t there = found[index++];
    if (here != there) differences.push_back(what + " is " + std::to_string(here) + " on the host, " + std::to_string(there) + " on the device");
  };
  for (const LayoutStruct& type : structs) {
    compare("sizeof(" + type.name + ")", type.size);
    for (const LayoutField& field : type.fields) {
      compare("offset of " + type.name + "." + field.name, field.offset);
      compare("size of " + type.name + "." + field.name, field.size);
    }
  }
  return differences;
}

std::vector<std::string> check_layout(const DeviceInfo& device) { return check_layout(device, embedded_kernels().at("layout.h")); }

}  // namespace stokes
