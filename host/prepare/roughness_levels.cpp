#include "prepare/roughness_levels.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace quasilux {

namespace {

// Of one texture alpha is within 0.6 % of what it says above 0.01, and 2 % above 0.0001; of two within four times that,
// of three within 25 times.
constexpr unsigned mostLevels[ROUGHNESS_TEXTURES] = {1024, 256, 40};
// As in Mitsuba.
constexpr double leastAlpha = 1e-4;

struct Range {
    double least = std::numeric_limits<double>::max(), most = 0;

    bool isEmpty() const { return least > most; }
    void add(double alpha) {
        least = std::min(least, alpha);
        most = std::max(most, alpha);
    }
};

/// Any share, or of an index what the meshes have.
void addAttribute(const Scene& scene, const TextureDescription& texture, Range& range) {
    if (texture.use != TextureUse::index) {
        range.add(0);
        range.add(1);
        return;
    }
    for (const ShapeDescription& shape : scene.shapes)
        for (const MeshAttribute& attribute : shape.mesh.attributes) {
            if (attribute.name != texture.attribute) continue;
            for (const Rgb& value : attribute.values) range.add(double(texture.attributeScale * value.r));
        }
}

void addValues(const Scene& scene, unsigned index, Range& range) {
    const TextureDescription& texture = scene.textures[index];
    if (!texture.attribute.empty()) addAttribute(scene, texture, range);
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

/// Levels of one of `textures` textures.
void setLevels(const Scene& scene, const LevelTexture& level, size_t k, size_t textures,
               shared::RoughnessLevels& levels) {
    Range range;
    addValues(scene, level.texture, range);
    if (range.isEmpty()) range.add(1);
    const double ends[] = {level.offset + level.factor * range.least, level.offset + level.factor * range.most};
    const double lower = rootOf(std::min(ends[0], ends[1])), upper = rootOf(std::max(ends[0], ends[1]));
    levels.texture[k] = level.texture + 1;
    levels.offset[k] = static_cast<float>(level.offset);
    levels.factor[k] = static_cast<float>(level.factor);
    levels.levels[k] = upper > lower ? mostLevels[textures - 1] : 1;
    levels.least[k] = static_cast<float>(lower);
    levels.levelsPerUnit[k] = upper > lower ? static_cast<float>((levels.levels[k] - 1) / (upper - lower)) : 0;
}

double valueAt(const shared::RoughnessLevels& levels, size_t k, unsigned level) {
    const double perUnit = levels.levelsPerUnit[k];
    return std::pow(double(levels.least[k]) + (perUnit > 0 ? level / perUnit : 0), 4);
}

} // namespace

std::optional<SideLevels> roughnessLevels(const Scene& scene, const Bsdf& bsdf,
                                          const std::vector<LobeDescription>& side) {
    SideLevels levels;
    for (const LobeDescription& lobe : side)
        for (const LevelTexture& level : lobe.levelTextures)
            if (std::find(levels.textures.begin(), levels.textures.end(), level) == levels.textures.end())
                levels.textures.push_back(level);
    const size_t count = levels.textures.size();
    if (count == 0) return std::nullopt;
    if (count > ROUGHNESS_TEXTURES)
        throw InputError(
            bsdf.where,
            fmt::format("the roughness of this bsdf's parts goes by {} different textures (alpha, or "
                        "roughness, anisotropic, clearcoat_gloss and eta); expected at most {}: use the same "
                        "ones for several parts.",
                        count, ROUGHNESS_TEXTURES));
    std::fill(std::begin(levels.device.levels), std::end(levels.device.levels), 1u);
    for (size_t k = 0; k < count; ++k) setLevels(scene, levels.textures[k], k, count, levels.device);
    return levels;
}

shared::Lobe SideLevels::lobeAt(unsigned combination, shared::Lobe lobe, const LobeDescription& description) const {
    if (description.levelTextures.empty()) return lobe;
    double values[ROUGHNESS_TEXTURES] = {};
    for (size_t k = ROUGHNESS_TEXTURES; k-- > 0; combination /= device.levels[k])
        values[k] = valueAt(device, k, combination % device.levels[k]);
    std::vector<double> ofLobe;
    for (const LevelTexture& level : description.levelTextures)
        ofLobe.push_back(values[std::find(textures.begin(), textures.end(), level) - textures.begin()]);
    description.setLevel(lobe, ofLobe);
    return lobe;
}

} // namespace quasilux
