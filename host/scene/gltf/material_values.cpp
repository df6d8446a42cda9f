#include "scene/gltf/material_values.h"

#include "scene/gltf/json_values.h"
#include "scene/photometric_units.h"

#include <cmath>

namespace quasilux {

namespace {

double within(double value, double least, double most, const char* name, const SourceLocation& where) {
    if (!(value >= least && value <= most))
        throw InputError(where, fmt::format("{} is {}; expected {} to {}.", name, value, least, most));
    return value;
}

template <int N>
glm::vec<N, double> factorOf(const std::vector<double>& numbers, double missing, double most, const char* name,
                             const SourceLocation& where) {
    glm::vec<N, double> factor(missing);
    if (numbers.empty()) return factor;
    if (numbers.size() != N)
        throw InputError(where, fmt::format("{} has {} numbers; expected {}.", name, numbers.size(), N));
    for (int c = 0; c < N; ++c) factor[c] = within(numbers[static_cast<size_t>(c)], 0, most, name, where);
    return factor;
}

AlphaMode alphaModeOf(const std::string& mode, const SourceLocation& where) {
    if (mode.empty() || mode == "OPAQUE") return AlphaMode::opaque;
    if (mode == "MASK") return AlphaMode::mask;
    if (mode == "BLEND") return AlphaMode::blend;
    throw InputError(where, fmt::format("unknown alphaMode '{}'; expected OPAQUE, MASK or BLEND.", mode));
}

class ExtensionReader {
public:
    ExtensionReader(GltfContext& context, const tinygltf::Material& source, GltfMaterial& material)
        : context_(context), source_(source), material_(material) {}

    void read() {
        material_.emission *=
            values("KHR_materials_emissive_strength").numberWithin("emissiveStrength", 1, 0, HUGE_VAL);
        readIndex();
        readTransmission();
        readVolume();
        readClearcoat();
        readSpecular();
    }

private:
    GltfValues values(const std::string& name) const {
        return {source_.extensions, name, {fmt::format("{}.{}", material_.where.file, name)}};
    }

    void readIndex() const {
        const double ior = values("KHR_materials_ior").number("ior", 1.5);
        // 0 stands for a reflectance of 1 at all angles, which exporters of an older workflow ask for.
        if (ior == 0)
            context_.withoutEffect.insert("ior 0");
        else
            material_.ior = within(ior, 1, 100, "ior", material_.where);
    }

    void readTransmission() const {
        const GltfValues transmission = values("KHR_materials_transmission");
        material_.transmission = transmission.numberWithin("transmissionFactor", 0, 0, 1);
        material_.transmissionTexture = transmission.texture("transmissionTexture");
    }

    void readVolume() const {
        const GltfValues volume = values("KHR_materials_volume");
        material_.hasVolume = volume.numberWithin("thicknessFactor", 0, 0, HUGE_VAL) > 0;
        material_.attenuationColor = volume.triple("attenuationColor", glm::dvec3(1));
        for (int c = 0; c < 3; ++c) within(material_.attenuationColor[c], 0, 1, "attenuationColor", material_.where);
        if (!volume.find("attenuationDistance")) return;
        material_.attenuationDistance = volume.number("attenuationDistance", 1);
        if (!(material_.attenuationDistance > 0))
            throw InputError(material_.where, fmt::format("attenuationDistance is {}; expected metres above 0.",
                                                          material_.attenuationDistance));
    }

    void readClearcoat() const {
        const GltfValues coat = values("KHR_materials_clearcoat");
        material_.clearcoat = coat.numberWithin("clearcoatFactor", 0, 0, 1);
        material_.clearcoatRoughness = coat.numberWithin("clearcoatRoughnessFactor", 0, 0, 1);
        if (material_.clearcoat > 0) {
            material_.clearcoatTexture = coat.texture("clearcoatTexture");
            material_.clearcoatRoughnessTexture = coat.texture("clearcoatRoughnessTexture");
        }
        if (coat.find("clearcoatNormalTexture")) context_.withoutEffect.insert("clearcoatNormalTexture");
    }

    /// A colour counts by its luminance.
    void readSpecular() const {
        const GltfValues specular = values("KHR_materials_specular");
        const glm::dvec3 color = specular.triple("specularColorFactor", glm::dvec3(1));
        if (color.x != color.y || color.x != color.z) context_.withoutEffect.insert("colours of specularColorFactor");
        material_.specular =
            specular.numberWithin("specularFactor", 1, 0, 1) * std::max(luminanceOf(color.x, color.y, color.z), 0.0);
        if (material_.specular == 0) return;
        material_.specularTexture = specular.texture("specularTexture");
        material_.specularColorTexture = specular.texture("specularColorTexture");
        if (material_.specularColorTexture.index < 0) return;
        context_.withoutEffect.insert(material_.specularTexture.index < 0
                                          ? "colours of specularColorTexture"
                                          : "specularColorTexture beside specularTexture");
    }

    GltfContext& context_;
    const tinygltf::Material& source_;
    GltfMaterial& material_;
};

} // namespace

std::vector<const tinygltf::TextureInfo*> GltfMaterial::textures() const {
    std::vector<const tinygltf::TextureInfo*> all;
    for (const tinygltf::TextureInfo* texture :
         {&baseTexture, &metallicRoughnessTexture, &normalTexture, &emissiveTexture, &transmissionTexture,
          &clearcoatTexture, &clearcoatRoughnessTexture, &specularTexture, &specularColorTexture})
        if (texture->index >= 0) all.push_back(texture);
    return all;
}

GltfMaterial readGltfMaterial(GltfContext& context, int index, const SourceLocation& where) {
    GltfMaterial material;
    material.where = where;
    material.name = "default";
    if (index < 0) return material;
    const tinygltf::Material& source = gltfEntry(context.model.materials, "materials", index, where);
    material.where = context.at("materials", static_cast<size_t>(index));
    material.name = source.name.empty() ? fmt::format("materials[{}]", index) : source.name;
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    material.baseColor = factorOf<4>(pbr.baseColorFactor, 1, 1, "baseColorFactor", material.where);
    material.baseTexture = pbr.baseColorTexture;
    material.metallic = within(pbr.metallicFactor, 0, 1, "metallicFactor", material.where);
    material.roughness = within(pbr.roughnessFactor, 0, 1, "roughnessFactor", material.where);
    material.metallicRoughnessTexture = pbr.metallicRoughnessTexture;
    material.normalTexture.index = source.normalTexture.index;
    material.normalTexture.texCoord = source.normalTexture.texCoord;
    material.normalTexture.extensions = source.normalTexture.extensions;
    material.normalScale = source.normalTexture.scale;
    material.emission = factorOf<3>(source.emissiveFactor, 0, 1, "emissiveFactor", material.where);
    material.emissiveTexture = source.emissiveTexture;
    material.alphaMode = alphaModeOf(source.alphaMode, material.where);
    material.alphaCutoff = source.alphaCutoff;
    material.doubleSided = source.doubleSided;
    if (!std::isfinite(material.normalScale) || !std::isfinite(material.alphaCutoff))
        throw InputError(material.where, "the normal scale or alphaCutoff is no finite number.");
    ExtensionReader(context, source, material).read();
    return material;
}

} // namespace quasilux
