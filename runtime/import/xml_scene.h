// An XML file in Mitsuba's manner: elements with lines, $defaults substituted, and a memory of what was read, so that the rest can be
// named. Knows nothing of what the elements mean.
#pragma once
#include <map>
#include <pugixml.hpp>
#include <set>
#include <string>
#include <vector>

#include "import/imported_scene.h"

namespace stokes {

class XmlScene {
 public:
  /// Throws ImportError.
  explicit XmlScene(const std::string& path);

  const std::string& path() const { return path_; }
  pugi::xml_node root() const { return document_.document_element(); }
  int line(const pugi::xml_node& node) const;
  [[noreturn]] void fail(const pugi::xml_node& node, const std::string& message) const { throw ImportError(path_, line(node), message); }

  /// Elements that were understood; the others are noted at the end.
  void use(const pugi::xml_node& node) { used_.insert(node.internal_object()); }
  bool is_used(const pugi::xml_node& node) const { return used_.count(node.internal_object()) > 0; }
  /// Notes every element that was not used; what lies in one is not looked at.
  void note_the_rest(ImportedScene& scene) const;

  /// An attribute with `$name`s replaced by the file's defaults; empty when it is not there.
  std::string attribute(const pugi::xml_node& node, const char* name) const;
  /// The child element with this `name` attribute, marked as used; null when there is none.
  pugi::xml_node child(const pugi::xml_node& node, const char* name);
  /// The number of a child's value; a boolean's is 0 or 1.
  double number(const pugi::xml_node& node, const char* name, double fallback);
  std::string text(const pugi::xml_node& node, const char* name, const std::string& fallback);
  /// Numbers separated by spaces or commas.
  std::vector<double> numbers(const pugi::xml_node& node, const std::string& text) const;

 private:
  std::string path_, content_;
  pugi::xml_document document_;
  std::map<std::string, std::string> defaults_;
  std::set<const void*> used_;
};

}  // namespace stokes
