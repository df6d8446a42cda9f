// Luminaire files for tests: the text of IES and EULUMDAT files from a few numbers.
#pragma once

#include "scene/goniograms/goniogram.h"
#include "support/scene_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <functional>
#include <string>
#include <vector>

namespace quasilux::test {

/// Folder of files whose intensities have a closed form: isotropic100 100, lambert1000 1000 cos, spot_cos40 5000
/// cos^40, asym_cosphi 500 (2 + cos C) cos, quadrant 2000 (1 - C / 180) cos in the first quadrant, mirrored.
inline const std::string luminaireFolder = std::string(QUASILUX_SOURCE_DIR) + "/tests/data/luminaires/";

struct IesText {
    std::string header = "IES:LM-63-2019";
    std::string tilt = "NONE\n";
    std::string lamps = "1 -1 1"; ///< their number, lumens of one, multiplier
    int type = 1, units = 2;
    std::string size = "0 0 0";
    std::string factors = "1 1 50";
    std::vector<double> vertical{0, 45, 90}, horizontal{0};
    std::function<double(double vertical, double horizontal)> candela = [](double, double) { return 100; };

    std::string text() const {
        std::string out = fmt::format("{}\n[LUMINAIRE] of a test\nTILT={}{} {} {} {} {} {}\n{}\n{}\n{}\n", header, tilt,
                                      lamps, vertical.size(), horizontal.size(), type, units, size, factors,
                                      fmt::join(vertical, " "), fmt::join(horizontal, " "));
        for (const double h : horizontal) {
            for (const double v : vertical) out += fmt::format("{} ", candela(v, h));
            out += "\n";
        }
        return out;
    }
};

struct LdtText {
    unsigned symmetry = 1, planes = 4;
    std::vector<double> gamma{0, 45, 90};
    std::string area = "0\n0\n0\n0\n0\n0\n"; ///< length, width, four heights, mm
    std::string factor = "1", tilt = "0";
    std::string lampSets = "1\n1\nlamp\n1000\nwhite\n1A\n20\n";
    std::vector<double> listed{0}; ///< azimuths of the half planes with intensities
    std::function<double(double c, double gamma)> intensity = [](double, double) { return 100; }; ///< cd/klm

    std::string text() const {
        std::string out =
            fmt::format("company\n1\n{}\n{}\n{}\n{}\n45\nreport\nluminaire\nnumber\nfile\ndate\n1200\n600\n50\n{}"
                        "100\n80\n{}\n{}\n{}0.1\n0.2\n0.3\n0.4\n0.5\n0.6\n0.7\n0.8\n0.9\n1\n",
                        symmetry, planes, 360.0 / planes, gamma.size(), area, factor, tilt, lampSets);
        for (unsigned k = 0; k < planes; ++k) out += fmt::format("{}\n", 360.0 * k / planes);
        for (const double angle : gamma) out += fmt::format("{}\n", angle);
        for (const double c : listed)
            for (const double angle : gamma) out += fmt::format("{}\n", intensity(c, angle));
        return out;
    }
};

/// Such a text, as the loader reads it from a file of this name.
inline Goniogram luminaireOf(const std::string& text, const std::string& name = "lamp.ies",
                             size_t lampSet = firstLampSet) {
    const SceneFiles files;
    return readGoniogram(files.write(name, text), {}, lampSet);
}
inline Goniogram luminaireOf(const IesText& ies) { return luminaireOf(ies.text()); }
inline Goniogram luminaireOf(const LdtText& ldt, size_t lampSet = firstLampSet) {
    return luminaireOf(ldt.text(), "lamp.ldt", lampSet);
}

/// Emitter of that file.
inline std::string luminaireXml(const std::string& file, const std::string& more = "") {
    return "<emitter type=\"quasilux_ies\">\n<string name=\"filename\" value=\"" + file + "\"/>" + more + "</emitter>";
}
inline const std::string askewPlace =
    R"(<transform name="to_world"><lookat origin="1,-2,3" target="2,0,4" up="0,0,1"/></transform>)";

} // namespace quasilux::test
