#include "scene/gltf/cameras.h"

#include "scene/gltf/elements.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace quasilux {

namespace {

// Of the longer side of a film, as a film of the scene language has it if nothing is said.
constexpr int64_t defaultWidth = 768, defaultHeight = 576;

Element filmOf(std::optional<double> aspect, const SourceLocation& where) {
    Element film = newObject("film", "hdrfilm", "", where);
    const auto shorter = [](double ratio) { return std::max<int64_t>(std::llround(defaultWidth * ratio), 1); };
    addWhole(film, "width", aspect && *aspect < 1 ? shorter(*aspect) : defaultWidth);
    addWhole(film, "height", !aspect ? defaultHeight : *aspect < 1 ? defaultWidth : shorter(1 / *aspect));
    return film;
}

/// A camera looks along its local -z in glTF, along +z here with +x to the left: turned about the y-axis.
glm::dmat4 cameraAxes(const glm::dmat4& toWorld, const SourceLocation& where) {
    glm::dmat4 axes = rigid(toWorld, where);
    axes[0] = -axes[0];
    axes[2] = -axes[2];
    return axes;
}

void addClips(Element& sensor, double near, double far, const SourceLocation& where) {
    if (!(near >= 0) || !std::isfinite(near) || !std::isfinite(far) || (far != 0 && far <= near))
        throw InputError(where, fmt::format("znear {} and zfar {}; expected 0 <= znear < zfar.", near, far));
    if (near > 0) addNumber(sensor, "near_clip", near);
    if (far > 0) addNumber(sensor, "far_clip", far);
    if (far == 0) addNumber(sensor, "far_clip", std::max(1e4, 1e4 * near)); // infinite
}

Element perspective(const tinygltf::PerspectiveCamera& camera, const std::string& id, const glm::dmat4& axes,
                    const SourceLocation& where) {
    if (!(camera.yfov > 0 && camera.yfov < std::numbers::pi))
        throw InputError(where, fmt::format("yfov is {}; expected radians between 0 and 3.1416.", camera.yfov));
    if (!(camera.aspectRatio >= 0) ||
        (camera.aspectRatio != 0 && !(camera.aspectRatio > 1e-3 && camera.aspectRatio < 1e3)))
        throw InputError(where, fmt::format("aspectRatio is {}; expected 0.001 to 1000.", camera.aspectRatio));
    Element sensor = newObject("sensor", "perspective", id, where);
    addNumber(sensor, "fov", camera.yfov * gltfDegrees);
    addText(sensor, "fov_axis", "y");
    addClips(sensor, camera.znear, camera.zfar, where);
    addMatrix(sensor, "to_world", axes);
    addNested(sensor, "", filmOf(camera.aspectRatio > 0 ? std::optional(camera.aspectRatio) : std::nullopt, where));
    return sensor;
}

Element orthographic(const tinygltf::OrthographicCamera& camera, const std::string& id, glm::dmat4 axes,
                     const SourceLocation& where) {
    const double x = std::abs(camera.xmag), y = std::abs(camera.ymag);
    if (!(x > 0 && y > 0 && x / y > 1e-3 && x / y < 1e3))
        throw InputError(where, fmt::format("xmag {} and ymag {}; expected numbers that are not 0, in proportions of "
                                            "0.001 to 1000.",
                                            camera.xmag, camera.ymag));
    axes[0] *= x;
    axes[1] *= x;
    Element sensor = newObject("sensor", "orthographic", id, where);
    addClips(sensor, camera.znear, camera.zfar, where);
    addMatrix(sensor, "to_world", axes);
    addNested(sensor, "", filmOf(x / y, where));
    return sensor;
}

} // namespace

bool addCamera(GltfContext& context, const PlacedNode& placed, Element& scene) {
    const tinygltf::Node& node = context.model.nodes[placed.index];
    const SourceLocation mention = context.at("nodes", placed.index);
    if (node.camera < 0) return false;
    const tinygltf::Camera& camera = gltfEntry(context.model.cameras, "cameras", node.camera, mention);
    const SourceLocation where = context.at("cameras", static_cast<size_t>(node.camera));
    const std::string id = context.newId(node.name.empty() ? camera.name : node.name, "camera");
    const glm::dmat4 axes = cameraAxes(placed.toWorld, mention);
    if (camera.type == "perspective")
        scene.children.push_back(perspective(camera.perspective, id, axes, where));
    else if (camera.type == "orthographic")
        scene.children.push_back(orthographic(camera.orthographic, id, axes, where));
    else
        throw InputError(where, fmt::format("unknown camera '{}'; expected perspective or orthographic.", camera.type));
    return true;
}

Element viewOf(const glm::dvec3& lower, const glm::dvec3& upper, const SourceLocation& where) {
    constexpr double fov = 40, margin = 1.05;
    const glm::dvec3 back = glm::normalize(glm::dvec3(0.6, 0.5, 1)), middle = (lower + upper) / 2.0;
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), back)), up = glm::cross(back, right);
    const double tangentX = std::tan(fov / 2 / gltfDegrees), tangentY = tangentX * defaultHeight / defaultWidth;
    double distance = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 at((corner & 1) ? upper.x : lower.x, (corner & 2) ? upper.y : lower.y,
                            (corner & 4) ? upper.z : lower.z);
        const glm::dvec3 from = at - middle;
        distance = std::max({distance, glm::dot(from, back) + std::abs(glm::dot(from, right)) / tangentX,
                             glm::dot(from, back) + std::abs(glm::dot(from, up)) / tangentY});
    }
    distance = distance > 0 ? distance * margin : 1;
    Element sensor = newObject("sensor", "perspective", "view", where);
    addNumber(sensor, "fov", fov);
    addNumber(sensor, "near_clip", distance * 1e-3);
    addNumber(sensor, "far_clip", distance * 1e3);
    glm::dmat4 axes(1);
    axes[0] = glm::dvec4(-right, 0);
    axes[1] = glm::dvec4(up, 0);
    axes[2] = glm::dvec4(-back, 0);
    axes[3] = glm::dvec4(middle + distance * back, 1);
    addMatrix(sensor, "to_world", axes);
    addNested(sensor, "", filmOf(std::nullopt, where));
    return sensor;
}

} // namespace quasilux
