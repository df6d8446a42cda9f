# Run by EmbedKernels.cmake: FILES (comma-separated) below FOLDER become raw string literals in OUTPUT.
string(REPLACE "," ";" FILES "${FILES}")
set(out "// Made from kernels/ by cmake/WriteKernelSources.cmake.\n#include \"device/kernel_sources.h\"\n\nnamespace quasilux {\n\nconst std::map<std::string, std::string>& kernelSources() {\n    static const std::map<std::string, std::string> sources = {\n")
foreach(file IN LISTS FILES)
    file(READ ${FOLDER}/${file} text)
    # A literal is limited to 64 KiB in the standard; every kernel file is far below that.
    string(APPEND out "        {\"${file}\", R\"QUASILUX(${text})QUASILUX\"},\n")
endforeach()
string(APPEND out "    };\n    return sources;\n}\n\n} // namespace quasilux\n")
file(WRITE ${OUTPUT} "${out}")
