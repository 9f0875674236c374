// Reads and assembles kernel sources. Knows nothing of what they say.
#include "device/kernel_files.h"

#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>

#include "device/error.h"

namespace stokes {

namespace {

// The name in a line `#include "name"`; nothing for any other line.
std::optional<std::string> included_name(const std::string& line) {
  std::size_t at = line.find_first_not_of(" \t");
  if (at == std::string::npos || line[at] != '#') return {};
  at = line.find_first_not_of(" \t", at + 1);
  if (at == std::string::npos || line.compare(at, 7, "include") != 0) return {};
  const std::size_t open = line.find_first_not_of(" \t", at + 7);
  if (open == std::string::npos || line[open] != '"') return {};
  const std::size_t close = line.find('"', open + 1);
  if (close == std::string::npos) return {};
  return line.substr(open + 1, close - open - 1);
}

std::string line_directive(int line, const std::string& file) { return "#line " + std::to_string(line) + " \"" + file + "\"\n"; }

struct Assembly {
  const KernelFiles& files;
  std::set<std::string> done;
  std::string text;

  void append(const std::string& name, const std::string& contents) {
    done.insert(name);
    text += line_directive(1, name);
    std::istringstream lines(contents);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
      const std::optional<std::string> included = included_name(line);
      if (!included) {
        text += line + "\n";
        continue;
      }
      // A second inclusion leaves an empty line, so that the numbering goes on.
      if (done.count(*included)) {
        text += "\n";
        continue;
      }
      const auto found = files.find(*included);
      if (found == files.end()) {
        const std::string place = name + ":" + std::to_string(number) + ": error: there is no kernel file \"" + *included + "\"";
        throw KernelBuildError("kernels do not assemble: " + place, place + "\n");
      }
      append(*included, found->second);
      text += line_directive(number + 1, name);
    }
  }
};

}  // namespace

KernelFiles read_kernel_dir(const std::string& folder) {
  KernelFiles files;
  std::error_code failure;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failure)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".cl" && extension != ".h") continue;
    std::ifstream stream(entry.path(), std::ios::binary);
    std::ostringstream contents;
    contents << stream.rdbuf();
    if (!stream) throw DeviceError("cannot read kernel file " + entry.path().string());
    files[entry.path().filename().string()] = contents.str();
  }
  if (failure) throw DeviceError("cannot read kernel folder " + folder + ": " + failure.message());
  if (files.empty()) throw DeviceError("kernel folder " + folder + " holds no .cl or .h file");
  return files;
}

std::string assemble_program(const KernelFiles& files, const std::string& root, const std::string& prologue) {
  const auto found = files.find(root);
  if (found == files.end()) throw KernelBuildError("there is no kernel file \"" + root + "\"", "");
  Assembly assembly{files, {}, {}};
  assembly.text = line_directive(1, "build constants") + prologue;
  if (!prologue.empty() && prologue.back() != '\n') assembly.text += "\n";
  assembly.append(root, found->second);
  return assembly.text;
}

}  // namespace stokes
