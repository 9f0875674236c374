# Writes a C++ file that holds text files as string constants, by name. Run at build time:
#   cmake -DOUTPUT=file.cpp "-DFILES=a,b" -P embed_texts.cmake
set(text "// Generated from scenes/ by embed_texts.cmake.\n#include \"cli/starters.h\"\n\nnamespace stokes {\n\n")
string(APPEND text "const std::map<std::string, std::string>& starter_files() {\n  static const std::map<std::string, std::string> files = {\n")
file(WRITE ${OUTPUT}.part "${text}")
string(REPLACE "," ";" files "${FILES}")
foreach(path IN LISTS files)
  get_filename_component(name ${path} NAME_WE)
  file(READ ${path} contents)
  file(APPEND ${OUTPUT}.part "{\"${name}\", R\"stokes_text(${contents})stokes_text\"},\n")
endforeach()
file(APPEND ${OUTPUT}.part "  };\n  return files;\n}\n\n}  // namespace stokes\n")
file(RENAME ${OUTPUT}.part ${OUTPUT})
