// Chooses the reader by the name's ending.
#include "scene/goniograms/eulumdat_file.h"
#include "scene/goniograms/ies_file.h"
#include "scene/xml/xml_document.h"
#include "util/file_ending.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

namespace {

bool isUtf8(const std::string& text) {
    for (size_t k = 0; k < text.size();) {
        const auto byte = static_cast<unsigned char>(text[k]);
        const size_t more = byte < 0x80       ? 0
                            : byte >> 5 == 6  ? 1
                            : byte >> 4 == 14 ? 2
                            : byte >> 3 == 30 ? 3
                                              : text.size();
        if (k + more >= text.size()) return false;
        for (size_t i = 1; i <= more; ++i)
            if (static_cast<unsigned char>(text[k + i]) >> 6 != 2) return false;
        k += more + 1;
    }
    return true;
}

/// Old files are in Latin-1. Without control characters, which no page may hold.
void makeUtf8(std::string& text) {
    const bool isLatin1 = !isUtf8(text);
    std::string out;
    for (const char letter : text) {
        const auto byte = static_cast<unsigned char>(letter);
        if (byte < 0x20 || byte == 0x7f) continue;
        if (isLatin1 && byte >= 0x80) {
            out += static_cast<char>(0xc0 | byte >> 6);
            out += static_cast<char>(0x80 | (byte & 0x3f));
        } else
            out += letter;
    }
    text = out;
}

// What no luminaire has, but factors may make of it.
constexpr double mostCandela = 1e12, leastLumens = 1e-9, mostMetres = 1e5, mostOfLamps = 1e15;

void checkMagnitudes(const Goniogram& goniogram) {
    const auto fail = [&](const std::string& what) {
        throw InputError(SourceLocation{goniogram.path, 0, 0}, what + " A factor or a unit may be wrong.");
    };
    if (!(goniogram.largest() <= mostCandela))
        fail(fmt::format("intensities up to {:.3g} cd; expected at most {:.3g}.", goniogram.largest(), mostCandela));
    if (!(goniogram.lumens() >= leastLumens))
        fail(fmt::format("a luminous flux of {:.3g} lm; expected at least {:.3g}.", goniogram.lumens(), leastLumens));
    const LuminousShape& shape = goniogram.shape;
    if (const double size = std::max({shape.sizeC0, shape.sizeC90, shape.height}); !(size <= mostMetres))
        fail(fmt::format("a luminous shape of {:.3g} m; expected at most {:.3g}.", size, mostMetres));
    for (const LampSet& set : goniogram.lampSets)
        if (!(set.lumens <= mostOfLamps && set.watts <= mostOfLamps))
            fail(fmt::format("lamps of {:.3g} lm and {:.3g} W; expected at most {:.3g}.", set.lumens, set.watts,
                             mostOfLamps));
}

Goniogram checked(Goniogram goniogram) {
    checkMagnitudes(goniogram);
    makeUtf8(goniogram.luminaire);
    for (LampSet& set : goniogram.lampSets) makeUtf8(set.name);
    return goniogram;
}

} // namespace

Goniogram readGoniogram(const std::string& path, const SourceLocation& where, size_t lampSet,
                        const FileCheck& mayRead) {
    const std::string ending = fileEnding(path);
    if (ending != ".ies" && ending != ".ldt")
        throw InputError(where,
                         fmt::format("'{}' has the ending '{}'; expected a luminaire's file, .ies (IES LM-63) or .ldt "
                                     "(EULUMDAT).",
                                     path, ending));
    const std::string content = readFile(path, where, "luminaire");
    if (ending == ".ies" && lampSet != firstLampSet)
        throw InputError(
            where, fmt::format("set of lamps number {} of '{}'; IES LM-63 files have one, remove it.", lampSet, path));
    return checked(ending == ".ldt" ? readEulumdat(path, content, where, lampSet) : readIes(path, content, mayRead));
}

Goniogram readHeldGoniogram(const std::string& name, const std::string& content) {
    return checked(readIes(name, content, [](const std::string&, const SourceLocation& where) {
        throw InputError(where, "TILT= names a file, and there is none beside this one; expected NONE or INCLUDE.");
    }));
}

} // namespace quasilux
