// A pbrt-v4 file as a list of directives with typed parameters. Knows the file's grammar, not what directives mean.
#pragma once
#include <string>
#include <vector>

#include "import/imported_scene.h"

namespace stokes {

struct PbrtParameter {
  std::string type, name;  ///< "rgb", "L"
  std::vector<double> numbers;
  std::vector<std::string> words;  ///< strings; booleans as "true" and "false"
  int line = 0;
  mutable bool used = false;
};

struct PbrtDirective {
  std::string name;                  ///< "Shape"
  std::string file;
  int line = 0;
  std::vector<std::string> words;    ///< strings that stand before the parameters
  std::vector<double> numbers;       ///< numbers that stand there
  std::vector<PbrtParameter> parameters;

  /// The parameter of this name, marked as used; null when there is none.
  const PbrtParameter* find(const std::string& name) const;
  double number(const std::string& name, double fallback) const;
  /// The same of a whole number within the range of int; what is beyond becomes its end.
  int integer(const std::string& name, int fallback) const;
  std::string text(const std::string& name, const std::string& fallback) const;
};

/// Reads the file and those it includes, from where the target lets them be. Throws ImportError, OutOfMemory.
std::vector<PbrtDirective> read_pbrt(const std::string& path, const ImportTarget& target);

}  // namespace stokes
