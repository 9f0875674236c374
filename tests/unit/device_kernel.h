// A stand-in for kernels/render.cl: integer sums that the host can predict, with the real kernel's arguments. For tests of the machinery
// around the kernel only.
#pragma once
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "compiled/compiled_scene.h"
#include "device/kernel_files.h"
#include "device/renderer.h"

namespace stokes::test {

/// A folder of its own that is gone at the end.
struct TemporaryFolder {
  std::filesystem::path path;
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "stokes-XXXXXX").string();
    path = mkdtemp(pattern.data());
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(path / name, std::ios::binary) << text; }
};

struct ViewMember {
  std::string type, name;
};

/// The members of SceneView as kernels/view.cl declares them.
inline std::vector<ViewMember> view_members() {
  std::vector<ViewMember> members;
  const std::string& text = embedded_kernels().at("view.cl");
  const std::regex member("const __global (\\w+)\\* (\\w+);");
  for (std::sregex_iterator i(text.begin(), text.end(), member), end; i != end; ++i) members.push_back({(*i)[1], (*i)[2]});
  return members;
}

/// A sample's value in the stand-in kernel, below 2^32, so that its square reaches the 64th bit.
inline std::uint64_t stand_in_value(std::uint32_t seed, std::uint32_t pixel, std::uint32_t sample) {
  std::uint32_t x = seed * 747796405u + pixel * 2891336453u + sample * 277803737u + 1u;
  x ^= x >> 16;
  x *= 2246822519u;
  x ^= x >> 13;
  return x;
}

/// The kernel's text; `spin` turns of busy work per sample make it slow.
inline std::string stand_in_kernel(int spin = 0) {
  std::string text = "#include \"view.cl\"\n__kernel void render(";
  for (const ViewMember& member : view_members()) text += "const __global " + member.type + "* " + member.name + ", ";
  text += "const __global Launch* launch, __global long* film, __global ulong* counters) {\n";
  text += "  const uint spin = " + std::to_string(spin) + "u;\n";
  return text + R"(
  const uint g = (uint)get_global_id(0);
  const uint begin = launch->pixel_begin + g * launch->chunk;
  const uint end = min(begin + launch->chunk, launch->pixel_end);
  for (uint p = begin; p < end; p++) {
    __global long* words = film + (ulong)p * scene->film_stride;
    for (uint s = launch->sample_begin; s < launch->sample_end; s++) {
      uint x = launch->seed * 747796405u + p * 2891336453u + s * 277803737u + 1u;
      x ^= x >> 16; x *= 2246822519u; x ^= x >> 13;
      uint y = x;
      for (uint i = 0; i < spin; i++) { y ^= y << 13; y ^= y >> 17; y ^= y << 5; }
      if (spin && y == 0u && x != 0u) words[11] += 1;  // never: a xorshift has no way to zero
      const ulong square = (ulong)x * x, before = (ulong)words[3];
      words[0] += x;
      words[3] = (long)(before + square);
      words[4] += before + square < before ? 1 : 0;
      words[9] += launch->crop_x + p % launch->crop_width;
      words[10] += 1;
      counters[g * COUNTER_COUNT + COUNTER_PATHS] += 1;
      counters[g * COUNTER_COUNT + COUNTER_RAYS] += 2;
    }
  }
}
)";
}

/// A kernel folder with layout.h, view.cl and the stand-in.
inline void write_kernel_dir(const TemporaryFolder& folder, int spin = 0) {
  folder.write("layout.h", embedded_kernels().at("layout.h"));
  folder.write("view.cl", embedded_kernels().at("view.cl"));
  folder.write("render.cl", stand_in_kernel(spin));
}

inline CompiledScene empty_scene() {
  CompiledScene scene{};
  scene.header.film_stride = FILM_BASE_WORDS;
  return scene;
}

}  // namespace stokes::test
