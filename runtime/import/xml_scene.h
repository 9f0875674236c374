// An XML file in Mitsuba's manner, with the files it includes: elements with lines, $defaults substituted, and a memory of what was read, so
// that the rest can be named. Knows nothing of what the elements mean.
#pragma once
#include <map>
#include <memory>
#include <pugixml.hpp>
#include <set>
#include <string>
#include <vector>

#include "import/imported_scene.h"

namespace stokes {

class XmlScene {
 public:
  using Node = pugi::xml_node;

  /// Throws ImportError, OutOfMemory.
  XmlScene(const std::string& path, const ImportTarget& target);

  Node root() const { return files_.front()->document.document_element(); }
  /// The scene's elements, those of included files in the place of their <include>.
  const std::vector<Node>& elements() const { return elements_; }
  /// The element of an id, or of one of its aliases; null when there is none.
  Node by_id(const std::string& id) const;
  /// `path` as a file's name for us: relative to the scene's folder, the including file's, or a <path>'s, where it is there.
  std::string file_named(const Node& node, const std::string& path) const;

  const std::string& path_of(const Node& node) const { return file_of(node).path; }
  /// Fails where `path` must not be read: no regular file, or none of a place where a scene's files may lie.
  void require_readable(const Node& node, const std::string& path) const;
  int line(const Node& node) const;
  [[noreturn]] void fail(const Node& node, const std::string& message) const { throw ImportError(path_of(node), line(node), message); }

  /// Elements that were understood; the others are noted at the end.
  void use(const Node& node) { used_.insert(node.internal_object()); }
  bool is_used(const Node& node) const { return used_.count(node.internal_object()) > 0; }
  /// Notes every element that was not used; what lies in one is not looked at.
  void note_the_rest(ImportedScene& scene) const;

  /// An attribute with `$name`s replaced by the scene's defaults; empty when it is not there.
  std::string attribute(const Node& node, const char* name) const;
  /// The child element with this `name` attribute, marked as used; null when there is none.
  Node child(const Node& node, const char* name);
  /// The number of a child's value; a boolean's is 0 or 1.
  double number(const Node& node, const char* name, double fallback);
  /// The same of a whole number within the range of int; what is beyond becomes its end.
  int integer(const Node& node, const char* name, int fallback);
  std::string text(const Node& node, const char* name, const std::string& fallback);
  /// Finite numbers separated by spaces or commas.
  std::vector<double> numbers(const Node& node, const std::string& text) const;

 private:
  struct File {
    std::string path, content;
    pugi::xml_document document;
  };
  Node read_file(const std::string& path, const Node& from);
  void collect(const Node& root, int depth);
  void collect_ids(const Node& node);
  const File& file_of(const Node& node) const;

  ImportTarget target_;
  std::vector<std::unique_ptr<File>> files_;  // the scene's first
  std::vector<Node> elements_;
  std::vector<std::string> folders_;  // of <path>
  std::map<std::string, Node> by_id_;
  std::map<std::string, std::string> defaults_;
  std::set<const void*> used_;
};

}  // namespace stokes
