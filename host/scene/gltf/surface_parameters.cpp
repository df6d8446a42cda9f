// The parameters of a material at a primitive: factors times textures or vertex colours.
#include "scene/gltf/bsdf_elements.h"
#include "scene/photometric_units.h"

#include <algorithm>
#include <cmath>

namespace quasilux {

namespace {

glm::dvec3 grey(double value) { return glm::dvec3(value); }

/// Disney's gloss goes linearly from alpha 0.1 to 0.001.
double glossOf(double roughness) { return std::clamp((0.1 - roughness * roughness) / (0.1 - 0.001), 0.0, 1.0); }

std::string colorText(const glm::dvec3& v) { return fmt::format("{:.6g},{:.6g},{:.6g}", v.x, v.y, v.z); }

class SurfaceReader {
public:
    SurfaceReader(const GltfMaterial& material, const PrimitiveSurface& primitive, GltfContext& context,
                  GltfTextures& textures)
        : material_(material), primitive_(primitive), context_(context), textures_(textures) {}

    GltfSurface read() {
        GltfSurface surface;
        const glm::dvec3 factor(material_.baseColor);
        surface.base = baseColor("base colour", vertexColorId, [=](const glm::dvec3& color) { return color * factor; });
        surface.transmitted = surface.base;
        // A body is entered and left: its colour is seen once of both.
        if (material_.hasVolume && material_.transmission > 0)
            surface.transmitted = baseColor("root of base colour", vertexRootId,
                                            [=](const glm::dvec3& color) { return glm::sqrt(color * factor); });
        const double rough = material_.roughness, metal = material_.metallic, passed = material_.transmission;
        surface.roughness = number(material_.metallicRoughnessTexture, "roughness", rough,
                                   [=](const glm::dvec4& pixel) { return pixel.y * rough; });
        surface.metallic = number(material_.metallicRoughnessTexture, "metallic", metal,
                                  [=](const glm::dvec4& pixel) { return pixel.z * metal; });
        if (passed > 0)
            surface.alpha =
                number(material_.metallicRoughnessTexture, "alpha", rough * rough,
                       [=](const glm::dvec4& pixel) { return std::max(pixel.y * rough * pixel.y * rough, 1e-4); });
        surface.transmission = passed == 0 ? GltfParameter{grey(0), {}}
                                           : number(material_.transmissionTexture, "transmission", passed,
                                                    [=](const glm::dvec4& pixel) { return pixel.x * passed; });
        readCoat(surface);
        surface.specular = specular();
        surface.opacity = opacity();
        surface.normal = normal();
        return surface;
    }

private:
    bool isShown(const tinygltf::TextureInfo& texture) const { return texture.index >= 0 && primitive_.hasUvs; }

    /// `vertexId`: of vertex colours with the same change.
    GltfParameter baseColor(const std::string& meaning, const char* vertexId,
                            const std::function<glm::dvec3(const glm::dvec3&)>& change) {
        const glm::dvec3 factor(material_.baseColor);
        if (isShown(material_.baseTexture)) {
            if (primitive_.hasColors) context_.withoutEffect.insert("vertex colours beside a base colour texture");
            return textures_.make(
                material_.baseTexture, PixelCode::srgb, meaning + " " + colorText(factor),
                [&](const glm::dvec4& pixel) { return change(glm::dvec3(pixel)); }, material_.where);
        }
        if (primitive_.hasColors) return {{}, vertexId}; // the factor is in the attribute
        return {change(glm::dvec3(1)), {}};
    }

    GltfParameter number(const tinygltf::TextureInfo& texture, const std::string& meaning, double factor,
                         const std::function<double(const glm::dvec4&)>& change) {
        if (!isShown(texture)) return {grey(factor), {}};
        return textures_.make(
            texture, PixelCode::linear, fmt::format("{} {:.6g}", meaning, factor),
            [&](const glm::dvec4& pixel) { return grey(change(pixel)); }, material_.where);
    }

    void readCoat(GltfSurface& surface) {
        const double coat = material_.clearcoat, rough = material_.clearcoatRoughness;
        surface.coat =
            number(material_.clearcoatTexture, "coat", coat, [=](const glm::dvec4& pixel) { return pixel.x * coat; });
        surface.coatGloss = number(material_.clearcoatRoughnessTexture, "gloss of coat", rough,
                                   [=](const glm::dvec4& pixel) { return glossOf(pixel.y * rough); });
        if (!surface.coatGloss.isTextured()) surface.coatGloss.value = grey(glossOf(surface.coatGloss.value.x));
    }

    /// A colour counts by its luminance.
    GltfParameter specular() {
        if (isShown(material_.specularTexture) || !isShown(material_.specularColorTexture))
            return number(material_.specularTexture, "specular", 1, [](const glm::dvec4& pixel) { return pixel.w; });
        return textures_.make(
            material_.specularColorTexture, PixelCode::srgb, "specular by colour",
            [](const glm::dvec4& pixel) { return grey(std::max(luminanceOf(pixel.x, pixel.y, pixel.z), 0.0)); },
            material_.where);
    }

    GltfParameter opacity() {
        if (material_.alphaMode == AlphaMode::opaque) return {grey(1), {}};
        const double factor = material_.baseColor.w, cutoff = material_.alphaCutoff;
        const bool cuts = material_.alphaMode == AlphaMode::mask;
        const auto seen = [=](double alpha) { return !cuts ? alpha : alpha >= cutoff ? 1.0 : 0.0; };
        if (isShown(material_.baseTexture))
            return number(material_.baseTexture, cuts ? fmt::format("alpha from {:.6g} on", cutoff) : "opacity", factor,
                          [=](const glm::dvec4& pixel) { return seen(pixel.w * factor); });
        if (primitive_.hasAlpha && !cuts) return {{}, vertexAlphaId};
        if (primitive_.hasAlpha) context_.withoutEffect.insert("alphaCutoff of vertex colours");
        return {grey(seen(factor)), {}};
    }

    /// Bent as much as the scale says.
    std::optional<GltfParameter> normal() {
        if (!isShown(material_.normalTexture)) return std::nullopt;
        const double scale = material_.normalScale;
        GltfParameter made = textures_.make(
            material_.normalTexture, PixelCode::linear, fmt::format("normals {:.6g}", scale),
            [=](const glm::dvec4& pixel) {
                const glm::dvec3 normal = (2.0 * glm::dvec3(pixel) - 1.0) * glm::dvec3(scale, scale, 1);
                const double length = glm::length(normal);
                return length > 0 ? 0.5 + 0.5 * normal / length : glm::dvec3(0.5, 0.5, 1);
            },
            material_.where);
        if (!made.isTextured()) return std::nullopt; // the same all over: as good as flat
        return made;
    }

    const GltfMaterial& material_;
    const PrimitiveSurface& primitive_;
    GltfContext& context_;
    GltfTextures& textures_;
};

} // namespace

GltfSurface surfaceOf(const GltfMaterial& material, const PrimitiveSurface& primitive, GltfContext& context,
                      GltfTextures& textures) {
    return SurfaceReader(material, primitive, context, textures).read();
}

} // namespace quasilux
