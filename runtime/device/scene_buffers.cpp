// Uploads scenes. Knows their arrays' sizes, not their meaning.
#include "device/scene_buffers.h"

#include <sys/mman.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string>

#include "device/error.h"

namespace stokes {

namespace {

template <typename Item>
SceneArray array_of(const char* name, const std::vector<Item>& items) {
  return {name, items.data(), items.size() * sizeof(Item)};
}

template <typename Item>
SceneArray array_of(const char* name, const Item& item) {
  return {name, &item, sizeof item};
}

// An array's share of the block: whole cache lines at the alignment that every runtime takes memory in place at.
std::size_t padded(std::size_t bytes) {
  constexpr std::size_t kAlignment = 4096;
  return std::max<std::size_t>(1, (bytes + kAlignment - 1) / kAlignment) * kAlignment;
}

std::string mebibytes(std::uint64_t bytes) { return std::to_string((bytes + (1u << 20) - 1) >> 20) + " MiB"; }

// Zeroed memory in 2 MiB pages where the system has them.
std::shared_ptr<void> allocate_large_pages(std::size_t bytes) {
  constexpr std::size_t kPage = std::size_t(2) << 20;
  const std::size_t size = (bytes + kPage - 1) / kPage * kPage;
  std::shared_ptr<void> memory(std::aligned_alloc(kPage, size), std::free);
  if (!memory) throw DeviceError("out of memory: need " + mebibytes(size) + " of host memory for the scene", true);
#ifdef MADV_HUGEPAGE
  madvise(memory.get(), size, MADV_HUGEPAGE);  // a wish; without it the memory is merely slower
#endif
  std::memset(memory.get(), 0, bytes);
  return memory;
}

}  // namespace

std::vector<SceneArray> list_scene_arrays(const CompiledScene& scene) {
  return {array_of("scene", scene.header),
          array_of("bvh_nodes", scene.bvh_nodes),
          array_of("bvh_leaves", scene.bvh_leaves),
          array_of("quads", scene.quads),
          array_of("spheres", scene.spheres),
          array_of("ellipsoids", scene.ellipsoids),
          array_of("triangles", scene.triangles),
          array_of("positions", scene.positions),
          array_of("normals", scene.normals),
          array_of("uvs", scene.uvs),
          array_of("surfaces", scene.surfaces),
          array_of("materials", scene.materials),
          array_of("textures", scene.textures),
          array_of("regions", scene.regions),
          array_of("texels", scene.texels),
          array_of("spectra", scene.spectra),
          array_of("media", scene.media),
          array_of("dyes", scene.dyes),
          array_of("distributions", scene.distributions),
          array_of("cdfs", scene.cdfs),
          array_of("reradiations", scene.reradiations),
          array_of("reradiation_values", scene.reradiation_values),
          array_of("lights", scene.lights),
          array_of("environment", scene.environment),
          array_of("environment_cdf", scene.environment_cdf),
          array_of("camera_knots", scene.camera_knots),
          array_of("sensor", scene.sensor)};
}

std::uint64_t scene_bytes(const CompiledScene& scene) {
  std::uint64_t bytes = 0;
  for (const SceneArray& array : list_scene_arrays(scene)) bytes += array.bytes;
  return bytes;
}

SceneBuffers upload_scene(const cl::Context& context, const CompiledScene& scene, bool in_place) {
  const std::vector<SceneArray> arrays = list_scene_arrays(scene);
  SceneBuffers result;
  if (!in_place) {
    static const std::uint32_t kNothing[4] = {};
    for (const SceneArray& array : arrays) {
      const void* data = array.bytes ? array.data : kNothing;
      const std::size_t bytes = array.bytes ? array.bytes : sizeof kNothing;
      // The flag makes OpenCL copy; the bindings' signature only lacks the const.
      result.buffers.emplace_back(context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, bytes, const_cast<void*>(data));
    }
    return result;
  }

  // One block for all, so that small tables share a page: a page each would cost memory and address translation alike.
  std::size_t total = 0;
  for (const SceneArray& array : arrays) total += padded(array.bytes);
  result.memory = allocate_large_pages(total);
  char* place = static_cast<char*>(result.memory.get());
  for (const SceneArray& array : arrays) {
    if (array.bytes) std::memcpy(place, array.data, array.bytes);
    result.buffers.emplace_back(context, CL_MEM_READ_ONLY | CL_MEM_USE_HOST_PTR, padded(array.bytes), place);
    place += padded(array.bytes);
  }
  return result;
}

void require_memory(const cl::Device& device, const std::string& device_name, std::uint64_t total_bytes, std::uint64_t largest_bytes) {
  const std::uint64_t have = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>(), have_single = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
  if (total_bytes > have)
    throw DeviceError("out of memory: need " + mebibytes(total_bytes) + ", have " + mebibytes(have) + " on " + device_name, true);
  if (largest_bytes > have_single)
    throw DeviceError("out of memory: need one buffer of " + mebibytes(largest_bytes) + ", have at most " + mebibytes(have_single) + " on " + device_name, true);
}

}  // namespace stokes
