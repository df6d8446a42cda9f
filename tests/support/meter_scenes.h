// Scenes with one irradiance meter whose reading is known in closed form.
#pragma once

#include "scene/scene.h"
#include "support/scene_files.h"

#include <fmt/format.h>
#include <map>

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

/// A small black rectangle at the origin, normal turned by `tilt` degrees from +z about `axis` ("x" or "y").
inline std::string meterAt(double tilt, const char* axis = "y", double half = 0.002,
                           const std::string& bsdf = diffuse(0)) {
    return fmt::format("<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"{}\"/>"
                       "<rotate {}=\"1\" angle=\"{}\"/></transform>{}{}</shape>",
                       half, axis, tilt, bsdf, irradiancemeter());
}

/// Faces down.
inline std::string squareLight(double side, const std::string& place, double radiance = 1) {
    return fmt::format("<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"{}\"/>"
                       "<rotate x=\"1\" angle=\"180\"/><translate {}/></transform>{}</shape>",
                       side / 2, place, areaLight(radiance));
}

/// Half of the reflectance genuine diffuse, half declared quasi-specular.
inline std::string splitWall(double reflectance) {
    return fmt::format("<bsdf type=\"blendbsdf\"><float name=\"weight\" value=\"0.5\"/>{}<bsdf type=\"diffuse\"><rgb "
                       "name=\"reflectance\" value=\"{}\"/><?quasilux quasi-specular=\"yes\"?></bsdf></bsdf>",
                       diffuse(reflectance), reflectance);
}

/// A small rectangle at `place` ("x,y,z") that measures what comes from the side of an axis: "+x", "-x", "+y" to "-z".
inline std::string meterFacing(const std::string& axis, const std::string& place, double half = 0.005,
                               const std::string& bsdf = diffuse(0)) {
    static const std::map<std::string, std::string> turns{{"+x", "<rotate y=\"1\" angle=\"90\"/>"},
                                                          {"-x", "<rotate y=\"1\" angle=\"-90\"/>"},
                                                          {"+y", "<rotate x=\"1\" angle=\"-90\"/>"},
                                                          {"-y", "<rotate x=\"1\" angle=\"90\"/>"},
                                                          {"+z", ""},
                                                          {"-z", "<rotate x=\"1\" angle=\"180\"/>"}};
    return fmt::format("<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"{}\"/>{}"
                       "<translate value=\"{}\"/></transform>{}{}</shape>",
                       half, turns.at(axis), place, bsdf, irradiancemeter());
}

/// Smooth glass in air of index 1.
inline std::string glass(double index) {
    return fmt::format("<bsdf type=\"dielectric\"><float name=\"int_ior\" value=\"{}\"/>"
                       "<float name=\"ext_ior\" value=\"1\"/></bsdf>",
                       index);
}

/// Parallel light of irradiance 1 along "x,y,z".
inline std::string beam(const std::string& direction) {
    return fmt::format("<emitter type=\"directional\"><vector name=\"direction\" value=\"{}\"/></emitter>", direction);
}

/// A rectangle of `scale` ("x,y,z", from -1 to 1 each), turned by `turn` and moved to `place`.
inline std::string rectangle(const std::string& scale, const std::string& turn, const std::string& place,
                             const std::string& parts) {
    return fmt::format("<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"{}\"/>{}"
                       "<translate value=\"{}\"/></transform>{}</shape>",
                       scale, turn, place, parts);
}

/// Six inward rectangles of a cube of side 1 about the origin, in the order z0, z1, x0, x1, y0, y1. `parts` of each
/// follow its transform.
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
