// A pbrt-v4 file as a list of directives with typed parameters.
#include "import/pbrt_file.h"

#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "scene/csv.h"

namespace stokes {
namespace {

constexpr int kMaxIncludes = 32;

struct Token {
  std::string text;
  int line = 0;
  bool quoted = false;
};

std::vector<Token> tokens_of(const std::string& path, const std::string& text) {
  std::vector<Token> tokens;
  int line = 1;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '\n') line++;
    if (std::isspace(static_cast<unsigned char>(c))) {
      i++;
    } else if (c == '#') {
      while (i < text.size() && text[i] != '\n') i++;
    } else if (c == '"') {
      const std::size_t end = text.find_first_of("\"\n", i + 1);
      if (end == std::string::npos || text[end] == '\n') throw ImportError(path, line, "a string has no end");
      tokens.push_back({text.substr(i + 1, end - i - 1), line, true});
      i = end + 1;
    } else if (c == '[' || c == ']') {
      tokens.push_back({std::string(1, c), line, false});
      i++;
    } else {
      const std::size_t end = std::min(text.find_first_of(" \t\r\n\"[]#", i), text.size());
      tokens.push_back({text.substr(i, end - i), line, false});
      i = end;
    }
  }
  return tokens;
}

class PbrtReader {
 public:
  std::vector<PbrtDirective> all;

  /// Names of files are relative to the scene's folder, also in files that it includes from elsewhere.
  explicit PbrtReader(std::filesystem::path folder) : folder_(std::move(folder)) {}

  void read(const std::string& path, int depth) {
    std::ifstream file(path, std::ios::binary);
    std::stringstream text;
    if (!file || std::filesystem::is_directory(path)) throw ImportError(path, 1, "the file cannot be read");
    if (depth > kMaxIncludes) throw ImportError(path, 1, "files include each other without end");
    text << file.rdbuf();
    const std::vector<Token> tokens = tokens_of(path, text.str());
    for (std::size_t i = 0; i < tokens.size();) {
      if (tokens[i].quoted || !std::isalpha(static_cast<unsigned char>(tokens[i].text[0])))
        throw ImportError(path, tokens[i].line, "expected a directive, not " + tokens[i].text);
      PbrtDirective directive;
      directive.name = tokens[i].text;
      directive.file = path;
      directive.line = tokens[i].line;
      if (directive.name == "ActiveTransform" && i + 1 < tokens.size()) directive.words.push_back(tokens[++i].text);  // the one word without quotes
      i = arguments(path, tokens, i + 1, directive);
      if (directive.name == "Include" || directive.name == "Import") {
        if (directive.words.size() != 1) throw ImportError(path, directive.line, directive.name + " needs the name of a file");
        // What an imported file sets ends with it.
        const bool bracket = directive.name == "Import";
        if (bracket) all.push_back(named(directive, "AttributeBegin"));
        read((folder_ / directive.words[0]).string(), depth + 1);
        if (bracket) all.push_back(named(directive, "AttributeEnd"));
      } else {
        all.push_back(directive);
      }
    }
  }

 private:
  std::filesystem::path folder_;

  static PbrtDirective named(const PbrtDirective& at, const char* name) {
    PbrtDirective directive;
    directive.name = name;
    directive.file = at.file;
    directive.line = at.line;
    return directive;
  }

  static std::size_t arguments(const std::string& path, const std::vector<Token>& tokens, std::size_t i, PbrtDirective& d) {
    while (i < tokens.size()) {
      const Token& t = tokens[i];
      if (t.quoted && t.text.find(' ') != std::string::npos) {
        i = parameter(path, tokens, i, d);
      } else if (t.quoted) {
        d.words.push_back(t.text);
        i++;
      } else if (t.text == "[" || t.text == "]") {
        i++;
      } else if (const auto value = parse_number(t.text)) {
        d.numbers.push_back(*value);
        i++;
      } else {
        return i;
      }
    }
    return i;
  }

  // "type name" and a value, or values in brackets.
  static std::size_t parameter(const std::string& path, const std::vector<Token>& tokens, std::size_t i, PbrtDirective& d) {
    PbrtParameter p;
    std::istringstream(tokens[i].text) >> p.type >> p.name;
    p.line = tokens[i].line;
    const bool list = i + 1 < tokens.size() && tokens[i + 1].text == "[" && !tokens[i + 1].quoted;
    i += list ? 2 : 1;
    for (; i < tokens.size(); i++) {
      const Token& t = tokens[i];
      if (list && !t.quoted && t.text == "]") break;
      if (t.quoted || t.text == "true" || t.text == "false") {
        p.words.push_back(t.text);
      } else if (const auto value = parse_number(t.text); value && std::isfinite(*value)) {
        p.numbers.push_back(*value);
      } else {
        throw ImportError(path, t.line, "\"" + p.type + " " + p.name + "\" has the value " + t.text);
      }
      if (!list) break;
    }
    if (i == tokens.size()) throw ImportError(path, p.line, "\"" + p.type + " " + p.name + "\" has no value, or its list no end");
    d.parameters.push_back(p);
    return i + 1;
  }
};

}  // namespace

const PbrtParameter* PbrtDirective::find(const std::string& wanted) const {
  for (const PbrtParameter& p : parameters)
    if (p.name == wanted) {
      p.used = true;
      return &p;
    }
  return nullptr;
}

double PbrtDirective::number(const std::string& wanted, double fallback) const {
  const PbrtParameter* p = find(wanted);
  if (!p) return fallback;
  if (p->numbers.size() != 1) throw ImportError(file, p->line, "\"" + p->name + "\" needs a number");
  return p->numbers[0];
}

std::string PbrtDirective::text(const std::string& wanted, const std::string& fallback) const {
  const PbrtParameter* p = find(wanted);
  return p && p->words.size() == 1 ? p->words[0] : fallback;
}

std::vector<PbrtDirective> read_pbrt(const std::string& path) {
  PbrtReader reader(std::filesystem::path(path).parent_path());
  reader.read(path, 0);
  return std::move(reader.all);
}

}  // namespace stokes
