#include "support/placed_scenes.h"

#include "support/scene_files.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

void replaceAll(std::string& text, const std::string& from, const std::string& to) {
    for (size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
}

void divideLengths(std::string& text, double scale) {
    const std::string mark = "1/L:";
    for (size_t at = 0; (at = text.find(mark, at)) != std::string::npos;) {
        size_t digits = 0;
        const double number = std::stod(text.substr(at + mark.size(), 20), &digits);
        text.replace(at, mark.size() + digits, fmt::format("{:.17g}", number / scale));
    }
}

} // namespace

Scene placedScene(const std::string& text, const Placement& placement) {
    const char* turn = placement.turned ? R"(<rotate x="1" y="2" z="3" angle="37"/>)" : "";
    std::string placed = "<scene version=\"3.0.0\">\n" + text + "\n</scene>\n";
    replaceAll(placed, "</transform>",
               fmt::format(R"({}<scale value="{}"/><translate value="{}"/></transform>)", turn, placement.scale,
                           placement.offset));
    divideLengths(placed, placement.scale);
    const test::SceneFiles files;
    return loadScene(files.write("scene.xml", placed));
}

std::string orthographicSensor(const std::string& origin, const std::string& target, double window,
                               unsigned resolution) {
    return fmt::format(
        R"(<sensor type="orthographic">
    <float name="near_clip" value="1e-9"/><float name="far_clip" value="1e9"/>
    <transform name="to_world"><scale x="{2}" y="{2}"/><lookat origin="{0}" target="{1}" up="0.1,1,0.2"/></transform>
    <film type="hdrfilm"><integer name="width" value="{3}"/><integer name="height" value="{3}"/><rfilter type="box"/></film>
</sensor>
)",
        origin, target, window, resolution);
}

std::string roomText(const std::string& ballBsdf, const std::string& extra) {
    return orthographicSensor("0,0,0.9", "0,0,0", 0.9, 16) + R"(
<shape type="cube"><boolean name="flip_normals" value="true"/><transform name="to_world"></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="0.6,0.5,0.4"/></bsdf></shape>
<shape type="rectangle"><transform name="to_world"><scale value="0.4"/><rotate x="1" angle="90"/><translate y="0.95"/></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf>
    <emitter type="area"><rgb name="radiance" value="10"/></emitter></shape>
<shape type="sphere"><float name="radius" value="0.3"/><point name="center" x="-0.5" y="-0.6" z="-0.4"/>
    <transform name="to_world"></transform>)" +
           ballBsdf + R"(</shape>
<shape type="sphere"><float name="radius" value="0.25"/><point name="center" x="0.5" y="-0.7" z="0"/>
    <transform name="to_world"></transform><bsdf type="dielectric"/></shape>
<shape type="cube"><transform name="to_world"><scale value="0.2"/><rotate y="1" angle="25"/><translate x="0.3" y="0.2" z="-0.5"/></transform>
    <bsdf type="dielectric"/>
    <medium name="interior" type="homogeneous"><rgb name="sigma_t" value="1/L:5"/><float name="albedo" value="0.9"/>
        <phase type="hg"><float name="g" value="0.8"/></phase></medium></shape>
)" + extra;
}

void moveInSinglePrecision(Scene& scene, const glm::vec3& offset) {
    for (auto& shape : scene.shapes) {
        for (auto& position : shape.mesh.positions) position += offset;
        if (shape.sphere) shape.sphere->center += offset;
        if (shape.rectangle) shape.rectangle->corner += offset;
    }
    for (auto& emitter : scene.pointEmitters) emitter.position += offset;
    scene.sensor.toWorld[3] += glm::dvec4(offset, 0);
}

} // namespace quasilux
