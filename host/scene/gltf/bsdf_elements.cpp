#include "scene/gltf/bsdf_elements.h"

#include "scene/gltf/elements.h"

#include <algorithm>
#include <cmath>

namespace quasilux {

namespace {

// Below it a transmitting surface is clear.
constexpr double clearRoughness = 0.02;
// An index of 1 bends nothing and reflects nothing, which the dielectrics refuse.
constexpr double leastIndex = 1.0001;

void addColorOrTexture(Element& bsdf, const std::string& name, const GltfParameter& parameter) {
    if (parameter.isTextured())
        addReference(bsdf, name, parameter.texture);
    else
        addColor(bsdf, name, parameter.value);
}

/// A number or a texture of numbers.
void addShare(Element& bsdf, const std::string& name, const GltfParameter& parameter) {
    if (parameter.isTextured())
        addReference(bsdf, name, parameter.texture);
    else
        addNumber(bsdf, name, parameter.value.x);
}

bool isAllOver(const GltfParameter& parameter, double value) {
    return !parameter.isTextured() && parameter.value.x == value;
}

/// That whose reflectance at normal incidence is the material's index's, times its specular factor and a share.
double indexOf(const GltfMaterial& material, double share) {
    const double amplitude = (material.ior - 1) / (material.ior + 1);
    const double root = std::sqrt(std::clamp(amplitude * amplitude * material.specular * share, 0.0, 0.98));
    return (1 + root) / (1 - root);
}

/// Of a dielectric that reflects nothing at its surface the specification leaves Lambert's law: what has a stated
/// reflectance is made so.
bool isMatt(const GltfMaterial& material, double metallic, double specular) {
    return metallic == 0 && indexOf(material, specular) == 1 && material.clearcoat == 0;
}

Element principled(const GltfMaterial& material, const GltfSurface& surface, double metallic, double specular) {
    if (isMatt(material, metallic, specular)) {
        Element matt = newObject("bsdf", "diffuse", "", material.where);
        addColorOrTexture(matt, "reflectance", surface.base);
        return matt;
    }
    Element bsdf = newObject("bsdf", "principled", "", material.where);
    addColorOrTexture(bsdf, "base_color", surface.base);
    addShare(bsdf, "roughness", surface.roughness);
    addNumber(bsdf, "metallic", metallic);
    addNumber(bsdf, "eta", std::max(indexOf(material, specular), leastIndex)); // at 1 there would be no metal either
    if (material.clearcoat > 0) {
        addShare(bsdf, "clearcoat", surface.coat);
        addShare(bsdf, "clearcoat_gloss", surface.coatGloss);
    }
    return bsdf;
}

Element blendOf(const GltfParameter& weight, Element first, Element second, const SourceLocation& where) {
    Element blend = newObject("bsdf", "blendbsdf", "", where);
    addShare(blend, "weight", weight);
    addNested(blend, "", std::move(first));
    addNested(blend, "", std::move(second));
    return blend;
}

Element wrapped(const char* plugin, Element nested) {
    Element outer = newObject("bsdf", plugin, "", nested.where);
    addNested(outer, "", std::move(nested));
    return outer;
}

/// Of one share of metal. The index is no texture: between none of the reflectance and all of it.
Element ofOneMetal(const GltfMaterial& material, const GltfSurface& surface, double metallic) {
    if (!surface.specular.isTextured()) return principled(material, surface, metallic, surface.specular.value.x);
    if (metallic == 1) return principled(material, surface, metallic, 1);
    return blendOf(surface.specular, principled(material, surface, metallic, 0),
                   principled(material, surface, metallic, 1), material.where);
}

/// What reflects alone.
Element reflecting(const GltfMaterial& material, const GltfSurface& surface) {
    if (!surface.metallic.isTextured()) return ofOneMetal(material, surface, surface.metallic.value.x);
    return blendOf(surface.metallic, ofOneMetal(material, surface, 0), ofOneMetal(material, surface, 1),
                   material.where);
}

bool isClear(const GltfSurface& surface) {
    return !surface.roughness.isTextured() && surface.roughness.value.x < clearRoughness;
}

/// A sheet whose sides are one surface: light passes unbent.
Element thinSheet(const GltfMaterial& material, const GltfSurface& surface) {
    const double index = std::max(material.ior, leastIndex);
    if (isClear(surface)) {
        Element pane = newObject("bsdf", "thindielectric", "", material.where);
        addNumber(pane, "int_ior", index);
        addNumber(pane, "ext_ior", 1);
        addColorOrTexture(pane, "specular_transmittance", surface.transmitted);
        return pane;
    }
    Element sheet = newObject("bsdf", "principledthin", "", material.where);
    addColorOrTexture(sheet, "base_color", surface.transmitted);
    addShare(sheet, "roughness", surface.roughness);
    addNumber(sheet, "spec_trans", 1);
    addNumber(sheet, "eta", index);
    return sheet;
}

/// The border of a body.
Element border(const GltfMaterial& material, const GltfSurface& surface) {
    Element bsdf = newObject("bsdf", isClear(surface) ? "dielectric" : "roughdielectric", "", material.where);
    addNumber(bsdf, "int_ior", std::max(material.ior, leastIndex));
    addNumber(bsdf, "ext_ior", 1);
    addColorOrTexture(bsdf, "specular_transmittance", surface.transmitted);
    if (!isClear(surface)) {
        addText(bsdf, "distribution", "ggx");
        addShare(bsdf, "alpha", surface.alpha);
    }
    return bsdf;
}

Element normalMapOf(const GltfParameter& normals, Element nested) {
    Element map = newObject("bsdf", "normalmap", "", nested.where);
    addReference(map, "normalmap", normals.texture);
    addNested(map, "", std::move(nested));
    return map;
}

/// What is no metal, where light passes: a sheet is seen from both sides in any case.
Element passingDielectric(const GltfMaterial& material, const GltfSurface& surface) {
    Element passing = material.hasVolume ? border(material, surface) : thinSheet(material, surface);
    if (isAllOver(surface.transmission, 1)) return passing;
    return blendOf(surface.transmission, wrapped("twosided", ofOneMetal(material, surface, 0)), std::move(passing),
                   material.where);
}

/// As KHR_materials_transmission mixes them: metal takes its share first, as nothing passes it, and transmission is a
/// share of the rest.
Element transmitting(const GltfMaterial& material, const GltfSurface& surface) {
    Element dielectric = passingDielectric(material, surface);
    if (isAllOver(surface.metallic, 0)) return dielectric;
    return blendOf(surface.metallic, std::move(dielectric), wrapped("twosided", ofOneMetal(material, surface, 1)),
                   material.where);
}

Element scattering(const GltfMaterial& material, const GltfSurface& surface) {
    const bool isOpaque = isAllOver(surface.transmission, 0) || isAllOver(surface.metallic, 1);
    Element all = isOpaque ? reflecting(material, surface) : transmitting(material, surface);
    if (surface.normal) all = normalMapOf(*surface.normal, std::move(all));
    return isOpaque && material.doubleSided ? wrapped("twosided", std::move(all)) : all;
}

} // namespace

Element bsdfOf(const GltfMaterial& material, const GltfSurface& surface, const std::string& id) {
    Element bsdf = scattering(material, surface);
    if (surface.opacity.isTextured() || surface.opacity.value.x < 1) {
        Element mask = newObject("bsdf", "mask", "", material.where);
        addShare(mask, "opacity", surface.opacity);
        addNested(mask, "", std::move(bsdf));
        bsdf = std::move(mask);
    }
    bsdf.attributes.push_back({"id", id});
    return bsdf;
}

std::optional<Element> mediumOf(const GltfMaterial& material, const std::string& id) {
    if (!material.hasVolume || material.transmission == 0 || !std::isfinite(material.attenuationDistance))
        return std::nullopt;
    // Of light the colour is left after the distance; what would be nothing is very little.
    const glm::dvec3 left = glm::max(material.attenuationColor, glm::dvec3(1e-6));
    const glm::dvec3 absorbed = -glm::log(left) / material.attenuationDistance;
    if (absorbed == glm::dvec3(0)) return std::nullopt;
    Element medium = newObject("medium", "homogeneous", id, material.where);
    addColor(medium, "sigma_t", glm::max(absorbed, glm::dvec3(0)));
    addColor(medium, "albedo", glm::dvec3(0));
    return medium;
}

} // namespace quasilux
