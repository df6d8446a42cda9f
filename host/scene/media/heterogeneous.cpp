// <medium type="heterogeneous">: extinction, and if wanted albedo, vary in space. It is grey: a path's free flight
// follows one density.
#include "scene/media/medium_plugin.h"
#include "scene/volumes/volume_plugin.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace quasilux {

namespace {

constexpr const char* greyOnly = "parameter 'sigma_t': the extinction of a heterogeneous medium has one channel here; "
                                 "give one channel, such as the mean, and colour by 'albedo', which may have three";

// A plain value is a constvolume: it fills the unit cube.
unsigned extinctionVolume(Properties& properties) {
    LoadContext& context = properties.context();
    if (const Element* element = properties.volume("sigma_t")) {
        const unsigned index = useVolume(*element, context);
        if (context.scene.volumes[index].device.channels != 1)
            throw InputError(element->where, fmt::format("{}.", greyOnly));
        return index;
    }
    const Rgb value = properties.positiveColor("sigma_t", {1, 1, 1}, ColorUse::reflectance);
    if (value.g != value.r || value.b != value.r)
        throw InputError(properties.where("sigma_t"), fmt::format("{}.", greyOnly));
    VolumeDescription volume;
    volume.where = properties.where("sigma_t");
    glm::dmat4 toWorld(1.0);
    toWorld[3] -= glm::dvec4(context.scene.origin, 0);
    setConstant(volume, value, toWorld);
    context.scene.volumes.push_back(std::move(volume));
    return static_cast<unsigned>(context.scene.volumes.size() - 1);
}

double meanOf(const std::vector<float>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

Rgb meanColor(const VolumeDescription& volume) {
    double sum[3] = {0, 0, 0};
    const size_t channels = volume.device.channels, voxels = volume.values.size() / channels;
    for (size_t i = 0; i < voxels; ++i)
        for (size_t c = 0; c < 3; ++c) sum[c] += double(volume.values[i * channels + c % channels]);
    const auto mean = [&](size_t c) { return static_cast<float>(sum[c] / static_cast<double>(voxels)); };
    return {mean(0), mean(1), mean(2)};
}

} // namespace

void readHeterogeneous(Properties& properties, MediumDescription& medium) {
    LoadContext& context = properties.context();
    medium.extinction = extinctionVolume(properties);
    medium.extinctionScale = static_cast<float>(properties.numberAbove("scale", 1, 0, false));
    const std::vector<float>& values = context.scene.volumes[*medium.extinction].values;
    const float largest = *std::max_element(values.begin(), values.end()) * medium.extinctionScale;
    if (!std::isfinite(largest))
        throw InputError(
            properties.where("scale"),
            fmt::format("sigma_t times scale of {} is out of the range of single precision.", properties.describe()));
    const auto mean = static_cast<float>(meanOf(values) * double(medium.extinctionScale));
    medium.sigmaT = {mean, mean, mean};

    const Element* albedo = properties.volume("albedo");
    if (!albedo) {
        medium.albedo = properties.reflectance("albedo", 0.75f);
        return;
    }
    const unsigned index = useVolume(*albedo, context);
    const VolumeDescription& volume = context.scene.volumes[index];
    if (*std::max_element(volume.values.begin(), volume.values.end()) > 1)
        throw InputError(albedo->where,
                         "an albedo has values above 1: more light scattered than there was. Scale them.");
    medium.albedoVolume = index;
    medium.albedo = meanColor(volume);
}

} // namespace quasilux
