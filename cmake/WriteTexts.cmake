# Run by EmbedTexts.cmake: FILES (comma-separated) below FOLDER become raw string literals in OUTPUT, which FUNCTION of HEADER returns.
string(REPLACE "," ";" FILES "${FILES}")
set(out "// Made by cmake/WriteTexts.cmake.\n#include \"${HEADER}\"\n\nnamespace quasilux {\n\nconst std::map<std::string, std::string>& ${FUNCTION}() {\n    static const std::map<std::string, std::string> texts = {\n")
foreach(file IN LISTS FILES)
    file(READ ${FOLDER}/${file} text)
    # A literal is limited to 64 KiB in the standard; every file is far below that.
    string(APPEND out "        {\"${file}\", R\"QUASILUX(${text})QUASILUX\"},\n")
endforeach()
string(APPEND out "    };\n    return texts;\n}\n\n} // namespace quasilux\n")
file(WRITE ${OUTPUT} "${out}")
