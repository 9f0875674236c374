// Files of the importers: text packed or not, PLY files in, OBJ text out. Knows nothing of scenes.
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <sstream>

#include "import/imported_scene.h"
#include "input/limits.h"

namespace stokes {
namespace {

constexpr double kMostVertices = 2e9;
constexpr std::size_t kMostBytes = std::size_t{1} << 32;  // of a file when unpacked

struct Property {
  std::string name, type, count_type;  // count_type: of a list
};
struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

std::size_t size_of(const std::string& type) {
  if (type == "char" || type == "uchar" || type == "int8" || type == "uint8") return 1;
  if (type == "short" || type == "ushort" || type == "int16" || type == "uint16") return 2;
  if (type == "int" || type == "uint" || type == "int32" || type == "uint32" || type == "float" || type == "float32") return 4;
  if (type == "double" || type == "float64") return 8;
  throw std::runtime_error("a property has the unknown type " + type);
}

template <class T>
double as_number(const unsigned char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}

double decode(const std::string& type, const unsigned char* b) {
  if (type == "char" || type == "int8") return as_number<std::int8_t>(b);
  if (type == "uchar" || type == "uint8") return as_number<std::uint8_t>(b);
  if (type == "short" || type == "int16") return as_number<std::int16_t>(b);
  if (type == "ushort" || type == "uint16") return as_number<std::uint16_t>(b);
  if (type == "int" || type == "int32") return as_number<std::int32_t>(b);
  if (type == "uint" || type == "uint32") return as_number<std::uint32_t>(b);
  return size_of(type) == 4 ? as_number<float>(b) : as_number<double>(b);
}

class PlyReader {
 public:
  explicit PlyReader(const std::string& path) : file_(read_text_file(path)) { read_header(); }

  ImportedMesh read() {
    for (const Element& element : elements_)
      for (std::size_t i = 0; i < element.count && !element.properties.empty(); i++) read_row(element);
    const std::size_t vertices = mesh_.positions.size();
    if ((!mesh_.normals.empty() && mesh_.normals.size() != vertices) || (!mesh_.uvs.empty() && mesh_.uvs.size() != vertices))
      throw std::runtime_error("its vertices are of two kinds");
    for (const auto& t : mesh_.triangles)
      for (const int index : t)
        if (index < 0 || static_cast<std::size_t>(index) >= mesh_.positions.size()) throw std::runtime_error("a face refers to vertex " + std::to_string(index) + ", which is not there");
    if (mesh_.triangles.empty()) throw std::runtime_error("it holds no faces");
    return std::move(mesh_);
  }

 private:
  void read_header() {
    std::string line;
    for (int number = 1; std::getline(file_, line); number++) {
      std::istringstream words(line);
      std::string word;
      words >> word;
      if (number == 1 && word != "ply") throw std::runtime_error("it does not begin with \"ply\"");
      if (word == "end_header") return check_header();
      if (word == "format") words >> format_;
      if (word == "element") {
        Element e;
        if (!(words >> e.name >> e.count)) throw std::runtime_error("line " + std::to_string(number) + ": no element");
        elements_.push_back(e);
      }
      if (word == "property") {
        Property p;
        words >> p.type;
        if (p.type == "list") words >> p.count_type >> p.type;
        if (!(words >> p.name) || elements_.empty()) throw std::runtime_error("line " + std::to_string(number) + ": no property");
        size_of(p.type);
        elements_.back().properties.push_back(p);
      }
    }
    throw std::runtime_error("its header has no end");
  }
  void check_header() const {
    if (format_ != "ascii" && format_ != "binary_little_endian" && format_ != "binary_big_endian")
      throw std::runtime_error("its format is " + (format_.empty() ? "not named" : format_));
  }

  double number(const std::string& type) {
    if (format_ == "ascii") {
      double value = 0;
      if (!(file_ >> value)) throw std::runtime_error("it ends early, or holds what is no number");
      return value;
    }
    unsigned char bytes[8];
    const std::size_t size = size_of(type);
    if (!file_.read(reinterpret_cast<char*>(bytes), static_cast<std::streamsize>(size))) throw std::runtime_error("it ends early");
    if ((format_ == "binary_big_endian") != (std::endian::native == std::endian::big)) std::reverse(bytes, bytes + size);
    return decode(type, bytes);
  }

  void read_row(const Element& element) {
    double position[3] = {}, normal[3] = {}, uv[2] = {};
    bool has_normal = false, has_uv = false;
    for (const Property& p : element.properties) {
      if (!p.count_type.empty()) {
        const double count = number(p.count_type);
        if (!(count >= 0 && count <= 1e6)) throw std::runtime_error("a face has " + std::to_string(count) + " corners");
        std::vector<int> corners;
        for (int i = 0; i < count; i++) {
          const double corner = number(p.type);
          corners.push_back(std::abs(corner) <= kMostVertices ? static_cast<int>(corner) : -1);
        }
        const bool face = element.name == "face" && (p.name == "vertex_indices" || p.name == "vertex_index");
        for (std::size_t i = 2; face && i < corners.size(); i++) mesh_.triangles.push_back({corners[0], corners[i - 1], corners[i]});
        continue;
      }
      const double value = number(p.type);
      if (!std::isfinite(value)) throw std::runtime_error("a number is not finite");
      if (p.name.size() == 1 && p.name >= "x" && p.name <= "z") position[p.name[0] - 'x'] = value;
      if (p.name == "nx" || p.name == "ny" || p.name == "nz") normal[p.name[1] - 'x'] = value, has_normal = true;
      if (p.name == "u" || p.name == "s" || p.name == "texture_u") uv[0] = value, has_uv = true;
      if (p.name == "v" || p.name == "t" || p.name == "texture_v") uv[1] = value, has_uv = true;
    }
    if (element.name != "vertex") return;
    mesh_.positions.push_back({position[0], position[1], position[2]});
    if (has_normal) mesh_.normals.push_back({normal[0], normal[1], normal[2]});
    if (has_uv) mesh_.uvs.push_back({uv[0], uv[1]});
  }

  std::istringstream file_;
  std::string format_;
  std::vector<Element> elements_;
  ImportedMesh mesh_;
};

}  // namespace

std::string read_text_file(const std::string& path) {
  std::error_code error;
  const bool regular = std::filesystem::is_regular_file(path, error);
  const std::unique_ptr<gzFile_s, decltype(&gzclose)> file(regular ? gzopen(path.c_str(), "rb") : nullptr, &gzclose);
  if (!file) throw std::runtime_error("it cannot be read");
  std::string text;
  std::vector<char> buffer(1 << 18);
  int count = 0;
  while ((count = gzread(file.get(), buffer.data(), static_cast<unsigned>(buffer.size()))) > 0) {
    // A packed file may hold a thousand times its size; a string that grows is there twice.
    if (text.size() + static_cast<std::size_t>(count) > text.capacity()) require_memory({}, 4 * text.capacity(), path);
    text.append(buffer.data(), static_cast<std::size_t>(count));
    if (text.size() > kMostBytes) throw std::runtime_error("it is larger than 4 GiB");
  }
  int code = Z_OK;
  gzerror(file.get(), &code);
  if (count < 0 || code == Z_BUF_ERROR) throw std::runtime_error("it is packed, and damaged");
  return text;
}

bool has_image(const ImportJson& material) { return material.dump(-1, ' ', false, ImportJson::error_handler_t::replace).find("\"image\"") != std::string::npos; }

ImportedMesh read_ply(const std::string& path) { return PlyReader(path).read(); }

std::string obj_text(const ImportedMesh& mesh) {
  std::ostringstream out;
  out.precision(9);
  for (const auto& p : mesh.positions) out << "v " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  for (const auto& n : mesh.normals) out << "vn " << n[0] << ' ' << n[1] << ' ' << n[2] << '\n';
  for (const auto& uv : mesh.uvs) out << "vt " << uv[0] << ' ' << uv[1] << '\n';
  for (const auto& t : mesh.triangles) {
    out << 'f';
    for (const int index : t) {
      const std::string i = std::to_string(index + 1);
      out << ' ' << i;
      if (!mesh.uvs.empty()) out << '/' << i;
      if (!mesh.normals.empty()) out << (mesh.uvs.empty() ? "//" : "/") << i;
    }
    out << '\n';
  }
  return out.str();
}

}  // namespace stokes
