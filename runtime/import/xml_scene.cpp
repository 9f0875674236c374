// An XML file in Mitsuba's manner: elements with lines, $defaults, and a memory of what was read.
#include "import/xml_scene.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "scene/csv.h"

namespace stokes {

XmlScene::XmlScene(const std::string& path) : path_(path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  if (!file || std::filesystem::is_directory(path)) throw ImportError(path, 1, "the file cannot be read");
  text << file.rdbuf();
  content_ = text.str();
  const pugi::xml_parse_result result = document_.load_buffer(content_.data(), content_.size());
  const auto begin = content_.begin();
  if (!result) {
    const auto end = begin + std::clamp<std::ptrdiff_t>(result.offset, 0, static_cast<std::ptrdiff_t>(content_.size()));
    throw ImportError(path, static_cast<int>(std::count(begin, end, '\n')) + 1, std::string("not XML: ") + result.description());
  }
  if (std::strcmp(root().name(), "scene") != 0) throw ImportError(path, line(root()), "the outermost element is no <scene>");
  use(root());
  for (const pugi::xml_node& node : root().children("default")) {
    defaults_[node.attribute("name").value()] = node.attribute("value").value();
    use(node);
  }
}

int XmlScene::line(const pugi::xml_node& node) const {
  const std::ptrdiff_t offset = std::clamp<std::ptrdiff_t>(node.offset_debug(), 0, static_cast<std::ptrdiff_t>(content_.size()));
  return static_cast<int>(std::count(content_.begin(), content_.begin() + offset, '\n')) + 1;
}

void XmlScene::note_the_rest(ImportedScene& scene) const {
  struct Walk {
    const XmlScene& xml;
    ImportedScene& scene;
    void visit(const pugi::xml_node& node) const {
      if (node.type() != pugi::node_element) return;
      if (!xml.is_used(node)) {
        std::string what = std::string("<") + node.name();
        for (const char* key : {"type", "name", "id"})
          if (node.attribute(key)) what += std::string(" ") + key + "=\"" + node.attribute(key).value() + "\"";
        scene.note(xml.path(), xml.line(node), what + "> has no counterpart here and was left out");
        return;
      }
      for (const pugi::xml_node& child : node.children()) visit(child);
    }
  };
  Walk{*this, scene}.visit(root());
}

std::string XmlScene::attribute(const pugi::xml_node& node, const char* name) const {
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

pugi::xml_node XmlScene::child(const pugi::xml_node& node, const char* name) {
  for (const pugi::xml_node& c : node.children())
    if (std::strcmp(c.attribute("name").value(), name) == 0 && std::strcmp(c.name(), "default") != 0) {
      use(c);
      return c;
    }
  return {};
}

double XmlScene::number(const pugi::xml_node& node, const char* name, double fallback) {
  const pugi::xml_node c = child(node, name);
  if (!c) return fallback;
  const std::string value = attribute(c, "value");
  if (std::strcmp(c.name(), "boolean") == 0) return value == "true" || value == "1";
  const std::vector<double> all = numbers(c, value);
  if (all.size() != 1) fail(c, "expected a number, not \"" + value + "\"");
  return all[0];
}

std::string XmlScene::text(const pugi::xml_node& node, const char* name, const std::string& fallback) {
  const pugi::xml_node c = child(node, name);
  return c ? attribute(c, "value") : fallback;
}

std::vector<double> XmlScene::numbers(const pugi::xml_node& node, const std::string& text) const {
  std::string spaced = text;
  std::replace(spaced.begin(), spaced.end(), ',', ' ');
  std::istringstream words(spaced);
  std::vector<double> values;
  for (std::string word; words >> word;) {
    const auto value = parse_number(word);
    if (!value) fail(node, "\"" + word + "\" is not a number");
    values.push_back(*value);
  }
  return values;
}

}  // namespace stokes
