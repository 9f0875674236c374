// OBJ files by tinyobjloader. That library takes garbage, infinities and indices out of range for success, so the text is checked
// before it and the numbers after it. It is given only the lines that are meant for it.
#include <tiny_obj_loader.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string_view>
#include <unordered_map>

#include "scene/csv.h"
#include "scene/mesh_reader.h"

namespace stokes {
namespace {

constexpr double kLargest = 1e15;  // coordinates beyond this overflow when squared in single precision
constexpr std::string_view kBlank = " \t\r\v\f";

struct Loader {
  RawMesh mesh;
  std::unordered_map<std::string, int> materials = {{"", 0}};
  int material = 0;
  std::string error;

  void check(float x, float y, float z) {
    // An exponent that the checks of the text forgive, as of a zero, may still overflow there.
    if (!(std::abs(x) <= kLargest && std::abs(y) <= kLargest && std::abs(z) <= kLargest) && error.empty())
      error = "a coordinate is not finite or too large";
  }
};

// What the text holds, counted before anything is kept of it.
struct Counts {
  std::uint64_t vertices = 0, normals = 0, uvs = 0, faces = 0, materials = 0;
};

// Takes the next word off the front; empty at the end.
std::string_view next_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(kBlank), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kBlank));
  line.remove_prefix(word.size());
  return word;
}

// A face's corner: v, v/t, v//n or v/t/n with whole numbers other than 0.
bool is_corner(std::string_view word) {
  for (int part = 1; part <= 3; part++) {
    const std::size_t slash = word.find('/');
    const std::string_view number = word.substr(0, slash);
    const bool last = slash == std::string_view::npos;
    if (!(number.empty() && part == 2 && !last)) {
      const auto value = parse_number(std::string(number));
      if (!value || *value == 0 || *value != std::floor(*value) || !(std::abs(*value) < 2e9)) return false;
    }
    if (last) return true;
    word.remove_prefix(slash + 1);
  }
  return false;
}

// Copies the lines that matter to `out`, word by word, and counts.
class ObjChecker {
 public:
  ObjChecker(const JsonNode& node, const std::string& path) : node_(node), path_(path) {}

  void line(std::string_view text) {
    number_++;
    const std::string_view kind = next_word(text);
    if (kind == "v" || kind == "vn" || kind == "vt") {
      coordinates(kind, text);
    } else if (kind == "f") {
      face(text);
    } else if (kind == "usemtl") {
      counts.materials++;
      use_material(text);
    }
  }

  std::string out;
  Counts counts;

 private:
  [[noreturn]] void fail(const std::string& message) const { node_.fail(path_ + ":" + std::to_string(number_) + ": " + message); }

  void coordinates(std::string_view kind, std::string_view text) {
    (kind == "v" ? counts.vertices : kind == "vn" ? counts.normals : counts.uvs)++;
    out += kind;
    std::size_t count = 0;
    text = text.substr(0, text.find('#'));
    for (std::string_view word = next_word(text); !word.empty(); word = next_word(text), count++) {
      const auto value = parse_number(std::string(word));
      if (!value) fail("\"" + std::string(word) + "\" is not a number");
      if (!(std::abs(*value) <= kLargest)) fail("the coordinate " + std::string(word) + " is not finite or too large");
      (out += ' ') += word;
    }
    const std::size_t needed = kind == "vt" ? 1 : 3;
    if (count < needed) fail("\"" + std::string(kind) + "\" needs " + std::to_string(needed) + " numbers");
    out += '\n';
  }

  void face(std::string_view text) {
    out += 'f';
    std::size_t count = 0;
    text = text.substr(0, text.find('#'));
    for (std::string_view word = next_word(text); !word.empty(); word = next_word(text), count++) {
      if (!is_corner(word)) fail("\"" + std::string(word) + "\" is no corner of a face");
      (out += ' ') += word;
    }
    if (count < 3) fail("a face needs at least three corners");
    counts.faces += count - 2;
    out += '\n';
  }

  // The name is the rest of the line, which may hold blanks.
  void use_material(std::string_view text) {
    text = text.substr(std::min(text.find_first_not_of(kBlank), text.size()));
    text = text.substr(0, text.find_last_not_of(kBlank) + 1);
    if (text.find('\0') != std::string_view::npos || text.find('\r') != std::string_view::npos) fail("a material's name has a control character");
    ((out += "usemtl ") += text) += '\n';
  }

  const JsonNode& node_;
  const std::string& path_;
  int number_ = 0;
};

std::string read_text(const ReadContext& context, const JsonNode& node, const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const auto size = static_cast<std::uint64_t>(std::max<std::streamoff>(0, file.tellg()));
  context.require_within(node, size, &InputLimits::mesh_bytes);
  context.require_memory(node, 2 * size, path);  // the text and what is kept of it
  std::string text(size, '\0');
  file.seekg(0);
  file.read(text.data(), static_cast<std::streamsize>(size));
  if (!file) node.fail(path + " cannot be read");
  return text;
}

// The text for tinyobjloader. Fails when the mesh would be too large.
std::string checked_text(const ReadContext& context, const JsonNode& node, const std::string& path) {
  const std::string text = read_text(context, node, path);
  ObjChecker checker(node, path);
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t end = rest.find('\n');
    checker.line(rest.substr(0, end));
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  }
  const Counts& counts = checker.counts;
  context.require_within(node, std::max({counts.vertices, counts.normals, counts.uvs}), &InputLimits::vertices);
  context.require_within(node, counts.faces, &InputLimits::faces);
  // The mesh as it is read; then by material, where corners that differ get vertices of their own (with a map's node each).
  constexpr std::uint64_t kPerCorner = 160;
  const std::uint64_t raw = counts.vertices * sizeof(Vec3d) + counts.normals * sizeof(Vec3d) + counts.uvs * 16 + counts.faces * sizeof(RawMesh::Face);
  const std::uint64_t corners = std::min(3 * counts.faces, counts.vertices + counts.normals + counts.uvs);
  context.require_memory(node, text.size() + checker.out.size() + 2 * raw + corners * kPerCorner, path);
  return std::move(checker.out);
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
  const auto [known, fresh] = loader.materials.try_emplace(name, static_cast<int>(loader.mesh.materials.size()));
  if (fresh) loader.mesh.materials.push_back(name);
  loader.material = known->second;
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

tinyobj::callback_t callbacks() {
  tinyobj::callback_t callbacks;
  callbacks.vertex_cb = [](void* data, float x, float y, float z, float) {
    static_cast<Loader*>(data)->check(x, y, z);
    static_cast<Loader*>(data)->mesh.positions.push_back({x, y, z});
  };
  callbacks.normal_cb = [](void* data, float x, float y, float z) {
    static_cast<Loader*>(data)->check(x, y, z);
    static_cast<Loader*>(data)->mesh.normals.push_back({x, y, z});
  };
  callbacks.texcoord_cb = [](void* data, float x, float y, float) {
    static_cast<Loader*>(data)->check(x, y, 0);
    static_cast<Loader*>(data)->mesh.uvs.push_back({x, y});
  };
  callbacks.index_cb = add_face;
  callbacks.usemtl_cb = use_material;
  return callbacks;
}

}  // namespace

RawMesh read_obj(const ReadContext& context, const JsonNode& node, const std::string& path) {
  std::istringstream stream(checked_text(context, node, path));
  Loader loader;
  std::string warning, error;
  const bool loaded = tinyobj::LoadObjWithCallback(stream, callbacks(), &loader, nullptr, &warning, &error);
  if (!loaded || !error.empty()) node.fail(path + " cannot be read as OBJ: " + error);
  if (!loader.error.empty()) node.fail(path + ": " + loader.error);
  check_indices(node, path, loader.mesh);
  if (loader.mesh.faces.empty()) node.fail(path + " holds no faces");
  context.require_within(node, loader.mesh.materials.size(), &InputLimits::materials);
  return std::move(loader.mesh);
}

}  // namespace stokes
