#include "prepare/roughness_levels.h"

#include <algorithm>
#include <cmath>

namespace quasilux {

namespace {

// Alpha is within 0.6 % of what the texture says above 0.01, and 2 % above 0.0001; by textures of their own along u and v, four times that.
constexpr unsigned mostLevels = 1024, mostLevelsOfTwo = 256;
// As in Mitsuba.
constexpr double leastAlpha = 1e-4;

struct Range {
    double least = 1, most = 0;

    void add(double alpha) {
        least = std::min(least, alpha);
        most = std::max(most, alpha);
    }
};

void addValues(const Scene& scene, unsigned index, Range& range) {
    const TextureDescription& texture = scene.textures[index];
    if (!texture.attribute.empty()) { // any share
        range.add(0);
        range.add(1);
    }
    if (texture.volume)
        for (const float value : texture.volume->values) range.add(value);
    for (const Rgb& texel : texture.texels) range.add(texel.r);
    if (texture.device.type != TEXTURE_CHECKERBOARD) return;
    const auto addSquares = [&](const Rgb& color, unsigned number) {
        if (number > 0)
            addValues(scene, number - 1, range);
        else
            range.add(color.r);
    };
    addSquares(texture.device.color0, texture.device.texture0);
    addSquares(texture.device.color1, texture.device.texture1);
}

double rootOf(double alpha) { return std::pow(std::max(alpha, leastAlpha), 0.25); }

/// Levels of one axis.
void setLevels(const Scene& scene, unsigned texture, unsigned most, unsigned& number, unsigned& levels, float& least,
               float& perUnit) {
    Range range;
    addValues(scene, texture, range);
    const double lower = rootOf(range.least), upper = rootOf(range.most);
    number = texture + 1;
    levels = upper > lower ? most : 1;
    least = static_cast<float>(lower);
    perUnit = upper > lower ? static_cast<float>((levels - 1) / (upper - lower)) : 0;
}

float alphaAt(float least, float perUnit, unsigned level) {
    return static_cast<float>(std::pow(double(least) + (perUnit > 0 ? level / double(perUnit) : 0), 4));
}

} // namespace

std::optional<shared::RoughnessLevels> roughnessLevels(const Scene& scene, const Bsdf& bsdf,
                                                       const std::vector<LobeDescription>& side) {
    const LobeDescription* first = nullptr;
    for (const LobeDescription& lobe : side) {
        if (!lobe.alphaTextureU && !lobe.alphaTextureV) continue;
        if (first && (first->alphaTextureU != lobe.alphaTextureU || first->alphaTextureV != lobe.alphaTextureV))
            throw InputError(bsdf.where,
                             "the roughness of this bsdf's parts goes by different textures; use one for all of them.");
        first = &lobe;
    }
    if (!first) return std::nullopt;
    shared::RoughnessLevels levels{};
    levels.levelsU = levels.levelsV = 1;
    const bool areTwo = first->alphaTextureU && first->alphaTextureV && first->alphaTextureU != first->alphaTextureV;
    const unsigned most = areTwo ? mostLevelsOfTwo : mostLevels;
    if (first->alphaTextureU)
        setLevels(scene, *first->alphaTextureU, most, levels.textureU, levels.levelsU, levels.leastU,
                  levels.levelsPerUnitU);
    if (first->alphaTextureV && first->alphaTextureV != first->alphaTextureU)
        setLevels(scene, *first->alphaTextureV, most, levels.textureV, levels.levelsV, levels.leastV,
                  levels.levelsPerUnitV);
    return levels;
}

shared::Lobe lobeAtLevel(shared::Lobe lobe, const LobeDescription& description, const shared::RoughnessLevels& levels,
                         unsigned levelU, unsigned levelV) {
    const float u = alphaAt(levels.leastU, levels.levelsPerUnitU, levelU);
    if (description.alphaTextureU) lobe.alphaU = u;
    if (description.alphaTextureV)
        lobe.alphaV = description.alphaTextureV == description.alphaTextureU
                          ? u
                          : alphaAt(levels.leastV, levels.levelsPerUnitV, levelV);
    return lobe;
}

} // namespace quasilux
