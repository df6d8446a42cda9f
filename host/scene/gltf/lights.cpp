#include "scene/gltf/lights.h"

#include "scene/gltf/elements.h"
#include "scene/gltf/json_values.h"
#include "scene/gltf/light_profiles.h"
#include "scene/photometric_units.h"

#include <cmath>
#include <numbers>
#include <optional>

namespace quasilux {

namespace {

/// Light goes along local -z in glTF and along +z here: turned about the x-axis.
glm::dmat4 lightAxes(const glm::dmat4& toWorld, const SourceLocation& where) {
    glm::dmat4 axes = rigid(toWorld, where);
    axes[1] = -axes[1];
    axes[2] = -axes[2];
    return axes;
}

glm::dvec3 colorOf(const tinygltf::Light& light, const SourceLocation& where) {
    if (light.color.empty()) return glm::dvec3(1);
    const bool isValid = light.color.size() == 3 && light.color[0] >= 0 && light.color[1] >= 0 && light.color[2] >= 0;
    if (!isValid || !std::isfinite(light.color[0] + light.color[1] + light.color[2]))
        throw InputError(where, "the color is not three numbers of at least 0.");
    return {light.color[0], light.color[1], light.color[2]};
}

void addCone(Element& emitter, const tinygltf::SpotLight& spot, const SourceLocation& where) {
    constexpr double widest = std::numbers::pi / 2, rounding = 1e-6; // exporters write single precision
    const double inner = spot.innerConeAngle, outer = spot.outerConeAngle;
    if (!(inner >= 0 && inner <= outer && outer > 0 && outer <= widest + rounding))
        throw InputError(where, fmt::format("innerConeAngle {} and outerConeAngle {}; expected 0 <= inner <= outer <= "
                                            "1.5708 radians, outer above 0.",
                                            inner, outer));
    addNumber(emitter, "cutoff_angle", outer * gltfDegrees);
    addNumber(emitter, "beam_width", inner * gltfDegrees);
}

Element punctualLight(GltfContext& context, const tinygltf::Light& light, const std::string& name,
                      const glm::dmat4& toWorld, const SourceLocation& where) {
    const std::string id = context.newId(light.name.empty() ? name : light.name, light.type + " light");
    const glm::dvec3 amount = colorOf(light, where) * light.intensity;
    if (light.range > 0) context.withoutEffect.insert("range of lights");
    if (light.type == "point") {
        Element emitter = newObject("emitter", "point", id, where);
        addPoint(emitter, "position", glm::dvec3(toWorld[3]));
        addColor(emitter, "intensity", amount);
        return emitter;
    }
    if (light.type != "spot" && light.type != "directional")
        throw InputError(where, fmt::format("unknown light '{}'; expected point, spot or directional.", light.type));
    const bool isSpot = light.type == "spot";
    Element emitter = newObject("emitter", light.type, id, where);
    addMatrix(emitter, "to_world", lightAxes(toWorld, where));
    addColor(emitter, isSpot ? "intensity" : "irradiance", amount);
    if (isSpot) addCone(emitter, light.spot, where);
    return emitter;
}

/// Unlike a spot, what a file shines is another light where it is mirrored.
glm::dmat4 luminaireAxes(const glm::dmat4& toWorld, const SourceLocation& where) {
    glm::dmat4 axes = lightAxes(toWorld, where);
    if (glm::determinant(glm::dmat3(toWorld)) < 0) axes[1] = -axes[1];
    return axes;
}

Element luminaireOf(GltfContext& context, const std::string& filename, const std::string& name,
                    const glm::dmat4& toWorld, const SourceLocation& where) {
    Element emitter = newObject("emitter", "quasilux_ies", context.newId(name, "luminaire"), where);
    addText(emitter, "filename", filename);
    addMatrix(emitter, "to_world", luminaireAxes(toWorld, where));
    return emitter;
}

/// By a file of its intensities; what a light at the same node says of its colour counts, its intensity does not.
Element luminaire(GltfContext& context, const GltfValues& extras, const tinygltf::Light* light, const std::string& name,
                  const glm::dmat4& toWorld, const SourceLocation& where) {
    Element emitter = luminaireOf(context, extras.text("ies"), name, toWorld, where);
    for (const char* factor : {"lumens", "maintenance"})
        if (extras.find(factor)) addNumber(emitter, factor, extras.number(factor, 0));
    if (light) addColor(emitter, "tint", colorOf(*light, where));
    return emitter;
}

/// Likewise of EXT_lights_ies, whose colour is a factor: it changes lumens, which a tint does not. Nothing where it is
/// off.
std::optional<Element> luminaire(GltfContext& context, const LightProfile& profile, const tinygltf::Light* light,
                                 const std::string& name, const glm::dmat4& toWorld, const SourceLocation& where) {
    const glm::dvec3& color = profile.color;
    const glm::dvec3 tint = light ? color * colorOf(*light, where) : color;
    const double factor = profile.multiplier * luminanceOf(color.x, color.y, color.z);
    if (!(factor > 0) || tint == glm::dvec3(0)) return {};
    Element emitter = luminaireOf(context, profile.filename, name, toWorld, where);
    if (factor != 1) addNumber(emitter, "maintenance", factor);
    if (tint != glm::dvec3(1)) addColor(emitter, "tint", tint);
    return emitter;
}

} // namespace

bool addLight(GltfContext& context, const PlacedNode& placed, Element& scene) {
    const tinygltf::Node& node = context.model.nodes[placed.index];
    const SourceLocation where = context.at("nodes", placed.index);
    const int index = GltfValues(node.extensions, "KHR_lights_punctual", where).index("light");
    const tinygltf::Light* const light =
        index < 0 ? nullptr : &gltfEntry(context.model.lights, "KHR_lights_punctual.lights", index, where);
    const GltfValues extras(node.extras.IsObject() ? &node.extras : nullptr,
                            context.at(fmt::format("nodes[{}].extras", placed.index)));
    if (extras.find("ies")) {
        scene.children.push_back(luminaire(context, extras, light, node.name, placed.toWorld, where));
        return true;
    }
    if (const auto profile = lightProfileOf(context, node, where)) {
        auto emitter = luminaire(context, *profile, light, node.name, placed.toWorld, where);
        if (emitter) scene.children.push_back(std::move(*emitter));
        return emitter.has_value();
    }
    if (!light) return false;
    const SourceLocation place = context.at("KHR_lights_punctual.lights", static_cast<size_t>(index));
    if (!(light->intensity >= 0) || !std::isfinite(light->intensity))
        throw InputError(place, fmt::format("the intensity is {}; expected at least 0.", light->intensity));
    if (light->intensity == 0 || colorOf(*light, place) == glm::dvec3(0)) return false;
    scene.children.push_back(punctualLight(context, *light, node.name, placed.toWorld, place));
    return true;
}

} // namespace quasilux
