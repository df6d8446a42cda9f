// How glTF materials mix metal with what transmits light, and the colour of a body, by what their lobes come to.
#include "support/gltf_files.h"

namespace quasilux {
namespace {

using nlohmann::json;
using test::GltfFile;

constexpr double base = 0.8;

/// At normal incidence.
struct Shares {
    double diffuse = 0, metal = 0, passing = 0;
};

class GltfTransmission : public test::GltfTest {
protected:
    /// The factor on a lobe at a pixel of the textures.
    static double weightAt(const Scene& scene, const LobeDescription& lobe, size_t pixel) {
        double product = 1;
        for (const shared::LobeWeight& weight : lobe.weights)
            product *= weight.offset + weight.factor * scene.textures.at(weight.texture).texels.at(pixel).r;
        return product;
    }
    static Shares sharesAt(const Scene& scene, size_t pixel) {
        Shares shares;
        for (const LobeDescription& lobe : bsdfOf(scene).front) {
            const double weight = weightAt(scene, lobe, pixel);
            shares.passing += weight * lobe.device.transmittance.r;
            if (lobe.name == "diffuse") shares.diffuse += weight * lobe.device.reflectance.r;
            if (lobe.device.type == LOBE_GGXSCHLICK)
                shares.metal += weight * lobe.device.reflectance.r * lobe.device.eta.r;
        }
        return shares;
    }
    /// Of a clear sheet; a share that is no number is by texture.
    Scene sheet(std::optional<double> metal, std::optional<double> transmission) const {
        GltfFile file;
        std::vector<uint8_t> pixels;
        for (const auto& [transmitted, metallic] : byPixel)
            for (const double code : {255 * transmitted, 0.0, 255 * metallic, 255.0})
                pixels.push_back(static_cast<uint8_t>(std::lround(code)));
        file.addImage(png(pixels));
        file.add("textures", {{"source", 0}});
        json pbr = {
            {"baseColorFactor", {base, base, base, 1}}, {"roughnessFactor", 0}, {"metallicFactor", metal.value_or(1)}};
        if (!metal) pbr["metallicRoughnessTexture"] = {{"index", 0}};
        json passing = {{"transmissionFactor", transmission.value_or(1)}};
        if (!transmission) passing["transmissionTexture"] = {{"index", 0}};
        return load(
            squareOf({{"pbrMetallicRoughness", pbr}, {"extensions", {{"KHR_materials_transmission", passing}}}}, file));
    }
    /// Transmission and metal of the pixels.
    static constexpr std::array<std::pair<double, double>, 4> byPixel = {{{1, 0}, {0, 1}, {1, 1}, {0.4, 0.2}}};
};

// KHR_materials_transmission: a metal takes its share first, and what passes is a share of the rest.
TEST_F(GltfTransmission, MetalTransmitsNothing) {
    const std::optional<double> shares[] = {{}, 0, 0.5, 1};
    for (const auto& metal : shares)
        for (const auto& transmission : shares) {
            const Scene scene = sheet(metal, transmission);
            for (size_t pixel = 0; pixel < byPixel.size(); ++pixel) {
                const double t = transmission.value_or(byPixel[pixel].first), m = metal.value_or(byPixel[pixel].second);
                SCOPED_TRACE(fmt::format("metal {}{}, transmission {}{}", m, metal ? "" : " by texture", t,
                                         transmission ? "" : " by texture"));
                const Shares found = sharesAt(scene, pixel);
                EXPECT_NEAR(found.diffuse, base * (1 - m) * (1 - t), 1e-6);
                EXPECT_NEAR(found.passing, base * (1 - m) * t, 1e-6);
                EXPECT_NEAR(found.metal, base * m, 1e-6);
            }
        }
}

// Light enters and leaves a body: what both borders leave is the colour, once.
TEST_F(GltfTransmission, VertexColorsTintABodyOnce) {
    const auto tintOf = [&](bool isBody) {
        json extensions = {{"KHR_materials_transmission", {{"transmissionFactor", 1}}}};
        if (isBody) extensions["KHR_materials_volume"] = {{"thicknessFactor", 1}};
        GltfFile file;
        file.add("materials", {{"pbrMetallicRoughness",
                                {{"baseColorFactor", {0.5, 1, 1, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 0}}},
                               {"extensions", extensions}});
        const int colors = file.floats({0.5, 1, 1, 0.5, 1, 1, 0.5, 1, 1, 0.5, 1, 1}, "VEC3");
        file.addNode({{"mesh", file.addSquare({{"material", 0}, {"attributes", {{"COLOR_0", colors}}}})}});
        const Scene scene = load(file);
        for (const LobeDescription& lobe : bsdfOf(scene).front) {
            if (lobe.device.transmittanceTexture == 0) continue;
            const std::string& name = scene.textures.at(lobe.device.transmittanceTexture - 1).attribute;
            for (const MeshAttribute& attribute : scene.shapes.at(0).mesh.attributes)
                if (attribute.name == name) return double(attribute.values.at(2).r);
        }
        ADD_FAILURE() << "no tint by an attribute";
        return 0.0;
    };
    EXPECT_NEAR(tintOf(true) * tintOf(true), 0.25, 1e-6);
    EXPECT_NEAR(tintOf(false), 0.25, 1e-6) << "a sheet is passed once";
}

} // namespace
} // namespace quasilux
