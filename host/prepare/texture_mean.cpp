#include "prepare/texture_mean.h"

#include "scene/color.h"

#include <algorithm>
#include <cmath>

namespace quasilux {

namespace {

glm::dvec3 wide(const Rgb& color) { return {color.r, color.g, color.b}; }
Rgb narrow(const glm::dvec3& v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

double fold(double x, unsigned wrap) {
    if (wrap == WRAP_REPEAT) return x - std::floor(x);
    if (wrap == WRAP_MIRROR) return x - 2 * std::floor(0.5 * x);
    return std::clamp(x, -1.0, 2.0);
}

size_t wrapIndex(int i, int size, unsigned wrap) {
    if (wrap == WRAP_REPEAT) i += i < 0 ? size : i >= size ? -size : 0;
    if (wrap == WRAP_MIRROR) {
        i = i < 0 ? -1 - i : i;
        i = i >= size ? 2 * size - 1 - i : i;
    }
    return static_cast<size_t>(std::clamp(i, 0, size - 1));
}

glm::dvec3 texel(const TextureDescription& texture, int x, int y) {
    const shared::Texture& t = texture.device;
    return wide(texture.texels[wrapIndex(y, int(t.height), t.wrap) * t.width + wrapIndex(x, int(t.width), t.wrap)]);
}

glm::dvec3 bitmapValue(const TextureDescription& texture, glm::dvec2 uv) {
    const shared::Texture& t = texture.device;
    const double x = fold(uv.x, t.wrap) * t.width, y = fold(uv.y, t.wrap) * t.height;
    if (t.filter == TEXTURE_NEAREST) return texel(texture, int(std::floor(x)), int(std::floor(y)));
    const int i = int(std::floor(x - 0.5)), j = int(std::floor(y - 0.5));
    const double fx = x - 0.5 - i, fy = y - 0.5 - j;
    return (1 - fy) * ((1 - fx) * texel(texture, i, j) + fx * texel(texture, i + 1, j)) +
           fy * ((1 - fx) * texel(texture, i, j + 1) + fx * texel(texture, i + 1, j + 1));
}

// Of one sum; a picture of more pixels is looked up at some of them only.
constexpr unsigned leastSamples = 64, mostSamples = 1024;

unsigned samplesAlong(unsigned pixels) { return std::clamp(2 * pixels, leastSamples, mostSamples); }

/// Of all voxels.
glm::dvec3 meanOfVolume(const VolumeDescription& volume) {
    const size_t channels = volume.device.channels;
    glm::dvec3 sum(0);
    for (size_t k = 0; k < volume.values.size(); k += channels)
        sum += channels == 1 ? glm::dvec3(volume.values[k])
                             : glm::dvec3(volume.values[k], volume.values[k + 1], volume.values[k + 2]);
    return sum * (double(channels) / double(volume.values.size()));
}

/// Of all pixels, or both colours.
glm::dvec3 meanOfAll(const TextureDescription& texture) {
    if (texture.volume) return meanOfVolume(*texture.volume);
    if (texture.texels.empty()) return 0.5 * (wide(texture.device.color0) + wide(texture.device.color1));
    glm::dvec3 sum(0);
    for (const Rgb& value : texture.texels) sum += wide(value);
    return sum / double(texture.texels.size());
}

class WeightedMean {
public:
    WeightedMean(const TextureDescription& texture, const std::vector<TextureDescription>& all)
        : texture_(texture), all_(all) {}

    void add(const TexturePlace& place) {
        if (!(place.weight > 0) || !std::isfinite(place.uv.x) || !std::isfinite(place.uv.y)) return;
        sum_ += place.weight * textureValue(texture_, all_, place.uv);
        weights_ += place.weight;
    }
    Rgb mean() const {
        const glm::dvec3 mean = weights_ > 0 ? sum_ / weights_ : glm::dvec3(0);
        // What all samples have missed may shine all the same: it is to be chosen now and then.
        return narrow(glm::max(mean, 1e-3 * meanOfAll(texture_)));
    }

private:
    const TextureDescription& texture_;
    const std::vector<TextureDescription>& all_;
    glm::dvec3 sum_{0};
    double weights_ = 0;
};

/// Mean by area of what the mesh file says.
Rgb meanOfAttribute(const TextureDescription& texture, const Mesh& mesh) {
    const auto shown = std::find_if(mesh.attributes.begin(), mesh.attributes.end(),
                                    [&](const MeshAttribute& known) { return known.name == texture.attribute; });
    glm::dvec3 sum(0);
    double areas = 0;
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        const glm::uvec3& corners = mesh.triangles[t];
        const auto at = [&](unsigned k) { return wide(shown->values.at(k)); };
        const glm::dvec3 p0 = mesh.positions[corners.x], e1 = glm::dvec3(mesh.positions[corners.y]) - p0,
                         e2 = glm::dvec3(mesh.positions[corners.z]) - p0;
        const double area = glm::length(glm::cross(e1, e2));
        sum += area * (shown->isOfFaces() ? at(unsigned(t)) : (at(corners.x) + at(corners.y) + at(corners.z)) / 3.0);
        areas += area;
    }
    return narrow(areas > 0 ? double(texture.attributeScale) * sum / areas : sum);
}

/// The unit square onto a triangle, keeping shares of area; weights of its second and third corner.
glm::dvec2 onTriangle(double x, double y) {
    return y > x ? glm::dvec2(x / 2, y - x / 2) : glm::dvec2(x - y / 2, y / 2);
}

} // namespace

glm::dvec3 textureValue(const TextureDescription& texture, const std::vector<TextureDescription>& all, glm::dvec2 uv) {
    const shared::Texture& t = texture.device;
    if (texture.volume || !texture.attribute.empty()) return meanOfAll(texture);
    const glm::dvec2 at(t.toU[0] * uv.x + t.toU[1] * uv.y + t.toU[2], t.toV[0] * uv.x + t.toV[1] * uv.y + t.toV[2]);
    if (t.type == TEXTURE_BITMAP) return bitmapValue(texture, at);
    const bool same = (at.x - std::floor(at.x) > 0.5) == (at.y - std::floor(at.y) > 0.5);
    const unsigned within = same ? t.texture0 : t.texture1;
    return within > 0 ? textureValue(all[within - 1], all, uv) : wide(same ? t.color0 : t.color1);
}

Rgb meanOfTexture(const TextureDescription& texture, const std::vector<TextureDescription>& all,
                  const std::function<TexturePlace(double x, double y)>& placeAt) {
    const unsigned columns = samplesAlong(texture.device.width), rows = samplesAlong(texture.device.height);
    WeightedMean mean(texture, all);
    for (unsigned j = 0; j < rows; ++j)
        for (unsigned i = 0; i < columns; ++i) mean.add(placeAt((i + 0.5) / columns, (j + 0.5) / rows));
    return mean.mean();
}

Rgb meanOfTexture(const TextureDescription& texture, const std::vector<TextureDescription>& all, const Mesh& mesh) {
    if (!texture.attribute.empty()) return meanOfAttribute(texture, mesh);
    if (mesh.cornerUvs.empty()) return narrow(meanOfAll(texture)); // it shows attributes or volumes only
    const double samples = double(samplesAlong(texture.device.width)) * samplesAlong(texture.device.height);
    const auto side = static_cast<unsigned>(std::ceil(std::sqrt(samples / double(mesh.triangles.size()))));
    WeightedMean mean(texture, all);
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        const glm::uvec3& triangle = mesh.triangles[t];
        const glm::dvec3 p0 = mesh.positions[triangle.x], e1 = glm::dvec3(mesh.positions[triangle.y]) - p0,
                         e2 = glm::dvec3(mesh.positions[triangle.z]) - p0;
        const double area = glm::length(glm::cross(e1, e2));
        const glm::dvec2 uv0 = mesh.cornerUvs[3 * t], uv1 = mesh.cornerUvs[3 * t + 1], uv2 = mesh.cornerUvs[3 * t + 2];
        for (unsigned j = 0; j < side; ++j)
            for (unsigned i = 0; i < side; ++i) {
                const glm::dvec2 b = onTriangle((i + 0.5) / side, (j + 0.5) / side);
                mean.add({(1 - b.x - b.y) * uv0 + b.x * uv1 + b.y * uv2, area / (double(side) * side)});
            }
    }
    return mean.mean();
}

} // namespace quasilux
