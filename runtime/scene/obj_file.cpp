// OBJ files by tinyobjloader. That library takes garbage, infinities and indices out of range for success, so the text is checked
// before it and the indices after it.
#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "scene/csv.h"
#include "scene/mesh_reader.h"

namespace stokes {
namespace {

constexpr double kLargest = 1e15;  // coordinates beyond this overflow when squared in single precision

struct Loader {
  RawMesh mesh;
  int material = 0;
  std::string error;
};

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

// A face's corner: v, v/t, v//n or v/t/n with whole numbers other than 0.
bool is_corner(const std::string& word) {
  int parts = 1;
  std::string part;
  const auto ok = [&] {
    if (part.empty()) return parts == 2;
    const auto value = parse_number(part);
    return value && *value != 0 && *value == std::floor(*value) && std::abs(*value) < 2e9;
  };
  for (const char c : word) {
    if (c != '/') {
      part += c;
      continue;
    }
    if (!ok()) return false;
    part.clear();
    if (++parts > 3) return false;
  }
  return !part.empty() && ok();
}

// Checks the lines of numbers, and returns the text without comments behind them, which tinyobjloader would read as indices.
std::string checked_text(const JsonNode& node, const std::string& path, std::istream& stream) {
  std::string line, text;
  for (int number = 1; std::getline(stream, line); number++) {
    const auto fail = [&](const std::string& message) { node.fail(path + ":" + std::to_string(number) + ": " + message); };
    auto words = words_of(line);
    if (words.empty()) continue;
    const std::string kind = words[0];
    if (kind == "v" || kind == "vn" || kind == "vt" || kind == "f") {
      line.resize(std::min(line.find('#'), line.size()));
      words = words_of(line);
    }
    text += line + "\n";
    if (kind == "v" || kind == "vn" || kind == "vt") {
      const std::size_t needed = kind == "vt" ? 1 : 3;
      for (std::size_t i = 1; i < words.size(); i++) {
        const auto value = parse_number(words[i]);
        if (!value) fail("\"" + words[i] + "\" is not a number");
        if (!(std::abs(*value) <= kLargest)) fail("the coordinate " + words[i] + " is not finite or too large");
      }
      if (words.size() <= needed) fail("\"" + kind + "\" needs " + std::to_string(needed) + " numbers");
    } else if (kind == "f") {
      for (std::size_t i = 1; i < words.size(); i++)
        if (!is_corner(words[i])) fail("\"" + words[i] + "\" is no corner of a face");
      if (words.size() < 4) fail("a face needs at least three corners");
    }
  }
  return text;
}

// 1-based from the start, or negative from the end so far; 0 means that there is none.
int resolve(int raw, std::size_t count) { return raw > 0 ? raw - 1 : raw < 0 ? static_cast<int>(count) + raw : -1; }

void add_face(void* data, tinyobj::index_t* indices, int count) {
  auto& loader = *static_cast<Loader*>(data);
  RawMesh& mesh = loader.mesh;
  const auto corner = [&](int i) {
    RawMesh::Corner c;
    c.position = resolve(indices[i].vertex_index, mesh.positions.size());
    c.normal = resolve(indices[i].normal_index, mesh.normals.size());
    c.uv = resolve(indices[i].texcoord_index, mesh.uvs.size());
    const bool below = c.position < 0 || (indices[i].normal_index != 0 && c.normal < 0) || (indices[i].texcoord_index != 0 && c.uv < 0);
    if (below && loader.error.empty()) loader.error = "a face refers to a vertex before the first";
    return c;
  };
  for (int i = 2; i < count; i++) mesh.faces.push_back({{corner(0), corner(i - 1), corner(i)}, loader.material});
}

void use_material(void* data, const char* name, int) {
  auto& loader = *static_cast<Loader*>(data);
  auto& names = loader.mesh.materials;
  for (loader.material = 0; loader.material < static_cast<int>(names.size()); loader.material++)
    if (names[loader.material] == name) return;
  names.push_back(name);
}

void check_indices(const JsonNode& node, const std::string& path, const RawMesh& mesh) {
  const auto check = [&](int index, std::size_t count, const char* what) {
    if (index >= static_cast<int>(count))
      node.fail(path + ": a face refers to " + what + " " + std::to_string(index + 1) + " of " + std::to_string(count));
  };
  for (const RawMesh::Face& face : mesh.faces)
    for (const RawMesh::Corner& c : face.corners) {
      check(c.position, mesh.positions.size(), "vertex");
      check(c.normal, mesh.normals.size(), "normal");
      check(c.uv, mesh.uvs.size(), "texture coordinate");
    }
}

}  // namespace

RawMesh read_obj(const JsonNode& node, const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::istringstream stream(checked_text(node, path, file));

  Loader loader;
  tinyobj::callback_t callbacks;
  callbacks.vertex_cb = [](void* data, float x, float y, float z, float) {
    static_cast<Loader*>(data)->mesh.positions.push_back({x, y, z});
  };
  callbacks.normal_cb = [](void* data, float x, float y, float z) { static_cast<Loader*>(data)->mesh.normals.push_back({x, y, z}); };
  callbacks.texcoord_cb = [](void* data, float x, float y, float) { static_cast<Loader*>(data)->mesh.uvs.push_back({x, y}); };
  callbacks.index_cb = add_face;
  callbacks.usemtl_cb = use_material;
  std::string warning, error;
  const bool loaded = tinyobj::LoadObjWithCallback(stream, callbacks, &loader, nullptr, &warning, &error);
  if (!loaded || !error.empty()) node.fail(path + " cannot be read as OBJ: " + error);
  if (!loader.error.empty()) node.fail(path + ": " + loader.error);
  check_indices(node, path, loader.mesh);
  if (loader.mesh.faces.empty()) node.fail(path + " holds no faces");
  return std::move(loader.mesh);
}

}  // namespace stokes
