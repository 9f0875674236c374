// Weak references by key; who has gone is forgotten at the next call.
#include "scene/recent_meshes.h"

#include <map>
#include <mutex>
#include <optional>

#include "scene/json_node.h"

namespace stokes {
namespace {

struct Remembered {
  std::weak_ptr<const MeshData> source;
  std::vector<std::weak_ptr<const MeshData>> parts;
  MadeMesh rest;  // without parts
};

std::mutex mutex;
std::multimap<std::string, Remembered> memory;

std::optional<MadeMesh> recall(const Remembered& remembered) {
  MadeMesh made = remembered.rest;
  for (const auto& part : remembered.parts) {
    made.parts.push_back(part.lock());
    if (!made.parts.back()) return std::nullopt;
  }
  return made;
}

}  // namespace

std::string offset_key(double distance, const Affine& to_world) {
  std::string key = " " + show(distance);
  for (const double number : to_world.m) key += " " + show(number);
  return key;
}

MadeMesh recent_mesh(const std::string& key, const std::shared_ptr<const MeshData>& source, const std::function<MadeMesh()>& make) {
  {
    const std::lock_guard lock(mutex);
    const auto [first, last] = memory.equal_range(key);
    for (auto it = first; it != last; ++it)
      if (it->second.source.lock() == source)
        if (auto made = recall(it->second)) return *made;
  }
  const MadeMesh made = make();
  const std::lock_guard lock(mutex);
  std::erase_if(memory, [](const auto& entry) { return !recall(entry.second); });
  memory.insert({key, {source, {made.parts.begin(), made.parts.end()}, {{}, made.materials, made.warnings}}});
  return made;
}

}  // namespace stokes
