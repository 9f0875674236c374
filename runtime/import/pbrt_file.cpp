// A pbrt-v4 file as a list of directives with typed parameters.
#include "import/pbrt_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>
#include <sstream>
#include <string_view>

#include "input/limits.h"
#include "input/text.h"
#include "scene/csv.h"

namespace stokes {
namespace {

constexpr int kMaxIncludes = 32;
// Of parameters.
constexpr std::string_view kTypes[] = {"integer", "float", "point", "point2", "point3", "vector", "vector2", "vector3", "normal", "normal3", "bool", "string", "texture", "rgb", "spectrum", "blackbody"};

struct Token {
  std::string text;
  int line = 0;
  bool quoted = false;
};

// Reads a string from behind its first quote; returns where it is over, npos where it is none.
std::size_t string_at(const std::string& text, std::size_t i, std::string& word) {
  for (; i < text.size() && text[i] != '\n'; i++) {
    if (text[i] == '"') return i + 1;
    if (text[i] != '\\') {
      word += text[i];
      continue;
    }
    constexpr std::string_view kEscapes = "bfnrt\\\'\"", kMeant = "\b\f\n\r\t\\\'\"";
    const std::size_t which = ++i < text.size() ? kEscapes.find(text[i]) : std::string::npos;
    if (which == std::string::npos) break;
    word += kMeant[which];
  }
  return std::string::npos;
}

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
      std::string word;
      i = string_at(text, i + 1, word);
      if (i == std::string::npos) throw ImportError(path, line, "a string has no end, or an unknown escape");
      if (find_invalid_utf8(word) != std::string::npos) throw ImportError(path, line, "a string is not UTF-8");
      tokens.push_back({word, line, true});
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
  PbrtReader(const ImportTarget& target, std::filesystem::path folder) : target_(target), folder_(std::move(folder)) {}

  void read(const std::string& path, int depth) {
    std::string text;
    try {
      text = read_text_file(path);
    } catch (const OutOfMemory&) {
      throw;
    } catch (const std::runtime_error& error) {
      throw ImportError(path, 1, std::string("the file cannot be read: ") + error.what());
    }
    const std::vector<Token> tokens = tokens_of(path, text);
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
        // Two includes of the next file in each of thirty files are a thousand million.
        if (depth == kMaxIncludes || ++includes_ > kMostIncludes) throw ImportError(path, directive.line, "files include each other without end, or too often");
        const std::string included = included_by(directive);
        // What an imported file sets ends with it.
        const bool bracket = directive.name == "Import";
        if (bracket) all.push_back(named(directive, "AttributeBegin"));
        read(included, depth + 1);
        if (bracket) all.push_back(named(directive, "AttributeEnd"));
      } else {
        all.push_back(directive);
      }
    }
  }

 private:
  const ImportTarget& target_;
  std::filesystem::path folder_;
  std::size_t includes_ = 0;

  std::string included_by(const PbrtDirective& directive) const {
    try {
      return path_beside(target_, folder_.string(), directive.words[0]);
    } catch (const std::runtime_error& error) {
      throw ImportError(directive.file, directive.line, "the file \"" + directive.words[0] + "\" cannot be read: " + error.what());
    }
  }

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
    if (std::find(std::begin(kTypes), std::end(kTypes), p.type) == std::end(kTypes)) throw ImportError(path, p.line, "\"" + tokens[i].text + "\": nothing has the type " + p.type);
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

int PbrtDirective::integer(const std::string& wanted, int fallback) const {
  return static_cast<int>(std::clamp<double>(number(wanted, fallback), std::numeric_limits<int>::min(), std::numeric_limits<int>::max()));
}

std::string PbrtDirective::text(const std::string& wanted, const std::string& fallback) const {
  const PbrtParameter* p = find(wanted);
  return p && p->words.size() == 1 ? p->words[0] : fallback;
}

std::vector<PbrtDirective> read_pbrt(const std::string& path, const ImportTarget& target) {
  PbrtReader reader(target, std::filesystem::path(path).parent_path());
  reader.read(path, 0);
  return std::move(reader.all);
}

}  // namespace stokes
