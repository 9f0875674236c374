# Writes a C++ file that holds kernel sources as string constants. Run at build time:
#   cmake -DOUTPUT=file.cpp "-DFILES=a;b" -P embed_kernels.cmake
set(text "// Generated from kernels/ by embed_kernels.cmake.\n#include \"device/kernel_files.h\"\n\nnamespace stokes {\n\n")
string(APPEND text "const KernelFiles& embedded_kernels() {\n  static const KernelFiles files = {\n")
file(WRITE ${OUTPUT}.part "${text}")
foreach(path IN LISTS FILES)
  get_filename_component(name ${path} NAME)
  file(READ ${path} contents)
  file(APPEND ${OUTPUT}.part "{\"${name}\", R\"stokes_kernel(${contents})stokes_kernel\"},\n")
endforeach()
file(APPEND ${OUTPUT}.part "  };\n  return files;\n}\n\n}  // namespace stokes\n")
file(RENAME ${OUTPUT}.part ${OUTPUT})
