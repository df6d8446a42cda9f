// Scenes with one irradiance meter whose reading is known in closed form.
#pragma once

#include "scene/scene.h"
#include "support/scene_files.h"

#include <fmt/format.h>

namespace quasilux::test {

/// A scene of `body`, which holds the sensor.
inline Scene meterScene(const std::string& body) {
    SceneFiles files;
    return loadScene(files.write("scene.xml", "<scene version=\"3.0.0\">\n" + body + "\n</scene>\n"));
}

inline std::string film(unsigned width, unsigned height) {
    return fmt::format("<film type=\"hdrfilm\"><rfilter type=\"box\"/><integer name=\"width\" value=\"{}\"/>"
                       "<integer name=\"height\" value=\"{}\"/></film>",
                       width, height);
}

inline std::string irradiancemeter(unsigned width = 1, unsigned height = 1) {
    return "<sensor type=\"irradiancemeter\">" + film(width, height) + "</sensor>";
}

inline std::string diffuse(double reflectance) {
    return fmt::format("<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"{}\"/></bsdf>", reflectance);
}

inline std::string areaLight(double radiance) {
    return fmt::format("<emitter type=\"area\"><rgb name=\"radiance\" value=\"{}\"/></emitter>", radiance);
}

/// Six inward rectangles of a cube of side 1 about the origin, in the order z0, z1, x0, x1, y0, y1. `parts` of each follow
/// its transform.
inline std::string unitRoom(const std::array<std::string, 6>& parts) {
    const char* turns[6] = {"",
                            "<rotate x=\"1\" angle=\"180\"/>",
                            "<rotate y=\"1\" angle=\"90\"/>",
                            "<rotate y=\"1\" angle=\"-90\"/>",
                            "<rotate x=\"1\" angle=\"-90\"/>",
                            "<rotate x=\"1\" angle=\"90\"/>"};
    const char* places[6] = {"z=\"-0.5\"", "z=\"0.5\"", "x=\"-0.5\"", "x=\"0.5\"", "y=\"-0.5\"", "y=\"0.5\""};
    std::string body;
    for (int k = 0; k < 6; ++k)
        body += fmt::format("<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"0.5\"/>{}"
                            "<translate {}/></transform>{}</shape>\n",
                            turns[k], places[k], parts[k]);
    return body;
}

} // namespace quasilux::test
