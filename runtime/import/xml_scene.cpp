// XML files in Mitsuba's manner: elements with lines, includes, $defaults, and a memory of what was read.
#include "import/xml_scene.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <sstream>

#include "input/limits.h"
#include "input/read_file.h"
#include "input/text.h"
#include "scene/csv.h"

namespace stokes {
namespace {
namespace fs = std::filesystem;

constexpr int kMaxIncludes = 15;  // in one another, as Mitsuba has it

bool is(const pugi::xml_node& node, const char* tag) { return std::strcmp(node.name(), tag) == 0; }

int line_at(const std::string& content, std::ptrdiff_t offset) {
  const auto end = content.begin() + std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(content.size()));
  return static_cast<int>(std::count(content.begin(), end, '\n')) + 1;
}

/// Whether elements lie in each other deeper than the walks over them may go.
bool is_too_deep(pugi::xml_document& document) {
  struct Walk : pugi::xml_tree_walker {
    bool for_each(pugi::xml_node&) override { return depth() < kDeepestXml; }
  } walk;
  return !document.traverse(walk);
}

}  // namespace

XmlScene::XmlScene(const std::string& path, const ImportTarget& target) : target_(target) { collect(read_file(path, {}), 0); }

// The file's root element. `from` is the <include> that names it, if one does.
XmlScene::Node XmlScene::read_file(const std::string& path, const Node& from) {
  std::string text;
  try {
    text = read_regular_file(path, InputLimits{}.scene_bytes);
  } catch (const OutOfMemory&) {
    throw;
  } catch (const std::runtime_error& error) {
    if (from) fail(from, path + " cannot be read: " + error.what());
    throw ImportError(path, 1, std::string("the file cannot be read: ") + error.what());
  }
  if (files_.size() > kMostIncludes) fail(from, "files include each other too often");
  files_.push_back(std::make_unique<File>());
  File& file = *files_.back();
  file.path = path;
  file.content = std::move(text);
  const pugi::xml_parse_result result = file.document.load_buffer(file.content.data(), file.content.size());
  if (!result) throw ImportError(path, line_at(file.content, result.offset), std::string("not XML: ") + result.description());
  // Other encodings were converted, this one was believed.
  const std::size_t invalid = result.encoding == pugi::encoding_utf8 ? find_invalid_utf8(file.content) : std::string::npos;
  if (invalid != std::string::npos)
    throw ImportError(path, line_at(file.content, static_cast<std::ptrdiff_t>(invalid)), "the text is not UTF-8, as XML is where it names no encoding");
  if (is_too_deep(file.document)) throw ImportError(path, 1, "elements lie in each other more than " + std::to_string(kDeepestXml) + " deep");
  const Node root = file.document.document_element();
  if (!is(root, "scene")) throw ImportError(path, line(root), "the outermost element is no <scene>");
  return root;
}

// Elements in their order; defaults, of which the first of a name counts; ids.
void XmlScene::collect(const Node& root, int depth) {
  use(root);
  for (const Node& node : root.children()) {
    if (node.type() != pugi::node_element) continue;
    if (is(node, "default")) {
      use(node);
      defaults_.emplace(attribute(node, "name"), attribute(node, "value"));
    } else if (is(node, "path")) {
      use(node);
      folders_.push_back(file_named(node, attribute(node, "value")));
    } else if (is(node, "alias")) {
      use(node);
      const Node target = by_id(attribute(node, "id"));
      if (!target) fail(node, "nothing has the id \"" + attribute(node, "id") + "\"");
      by_id_.emplace(attribute(node, "as"), target);
    } else if (is(node, "include")) {
      use(node);
      if (depth == kMaxIncludes) fail(node, "files include each other without end");
      const std::string path = file_named(node, attribute(node, "filename"));
      require_readable(node, path);
      collect(read_file(path, node), depth + 1);
    } else {
      elements_.push_back(node);
      collect_ids(node);
    }
  }
}

void XmlScene::collect_ids(const Node& node) {
  if (node.attribute("id") && !is(node, "ref")) {
    const std::string id = attribute(node, "id");
    if (!by_id_.emplace(id, node).second) fail(node, "there is already something with the id \"" + id + "\"");
  }
  for (const Node& child : node.children())
    if (child.type() == pugi::node_element) collect_ids(child);
}

XmlScene::Node XmlScene::by_id(const std::string& id) const {
  const auto it = by_id_.find(id);
  return it == by_id_.end() ? Node() : it->second;
}

std::string XmlScene::file_named(const Node& node, const std::string& path) const {
  std::vector<fs::path> folders = {fs::path(files_.front()->path).parent_path(), fs::path(path_of(node)).parent_path()};
  folders.insert(folders.end(), folders_.begin(), folders_.end());
  std::error_code error;
  for (const fs::path& folder : folders)
    if (fs::exists(folder / path, error)) return (folder / path).string();
  return (folders.front() / path).string();
}

void XmlScene::require_readable(const Node& node, const std::string& path) const {
  try {
    stokes::require_readable(target_, fs::path(files_.front()->path).parent_path().string(), path);
  } catch (const std::runtime_error& error) {
    fail(node, path + " cannot be read: " + error.what());
  }
}

const XmlScene::File& XmlScene::file_of(const Node& node) const {
  for (const auto& file : files_)
    if (file->document.internal_object() == node.root().internal_object()) return *file;
  return *files_.front();
}

int XmlScene::line(const Node& node) const { return line_at(file_of(node).content, node.offset_debug()); }

void XmlScene::note_the_rest(ImportedScene& scene) const {
  struct Walk {
    const XmlScene& xml;
    ImportedScene& scene;
    void visit(const Node& node) const {
      if (node.type() != pugi::node_element) return;
      if (!xml.is_used(node)) {
        std::string what = std::string("<") + node.name();
        for (const char* key : {"type", "name", "id"})
          if (node.attribute(key)) what += std::string(" ") + key + "=\"" + node.attribute(key).value() + "\"";
        scene.note(xml.path_of(node), xml.line(node), what + "> has no counterpart here and was left out");
        return;
      }
      for (const Node& child : node.children()) visit(child);
    }
  };
  for (const auto& file : files_) Walk{*this, scene}.visit(file->document.document_element());
}

std::string XmlScene::attribute(const Node& node, const char* name) const {
  std::string value = node.attribute(name).value();
  for (std::size_t at = value.find('$'); at != std::string::npos; at = value.find('$', at)) {
    std::size_t end = at + 1;
    while (end < value.size() && (std::isalnum(static_cast<unsigned char>(value[end])) || value[end] == '_')) end++;
    const auto it = defaults_.find(value.substr(at + 1, end - at - 1));
    if (it == defaults_.end()) fail(node, "nothing is called " + value.substr(at, end - at));
    value.replace(at, end - at, it->second);
    at += it->second.size();
  }
  return value;
}

XmlScene::Node XmlScene::child(const Node& node, const char* name) {
  for (const Node& c : node.children())
    if (std::strcmp(c.attribute("name").value(), name) == 0 && !is(c, "default")) {
      use(c);
      return c;
    }
  return {};
}

double XmlScene::number(const Node& node, const char* name, double fallback) {
  const Node c = child(node, name);
  if (!c) return fallback;
  const std::string value = attribute(c, "value");
  if (is(c, "boolean")) return value == "true" || value == "1";
  const std::vector<double> all = numbers(c, value);
  if (all.size() != 1) fail(c, "expected a number, not \"" + value + "\"");
  return all[0];
}

int XmlScene::integer(const Node& node, const char* name, int fallback) {
  const double value = number(node, name, fallback);
  return static_cast<int>(std::clamp<double>(value, std::numeric_limits<int>::min(), std::numeric_limits<int>::max()));
}

std::string XmlScene::text(const Node& node, const char* name, const std::string& fallback) {
  const Node c = child(node, name);
  return c ? attribute(c, "value") : fallback;
}

std::vector<double> XmlScene::numbers(const Node& node, const std::string& text) const {
  std::string spaced = text;
  std::replace(spaced.begin(), spaced.end(), ',', ' ');
  std::istringstream words(spaced);
  std::vector<double> values;
  for (std::string word; words >> word;) {
    const auto value = parse_number(word);
    if (!value || !std::isfinite(*value)) fail(node, "\"" + word + "\" is no " + (value ? "finite " : "") + "number");
    values.push_back(*value);
  }
  return values;
}

}  // namespace stokes
