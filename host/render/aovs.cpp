#include "render/aovs.h"

#include "aov_types.h"
#include "device/program.h"
#include "render/geometry_buffers.h"
#include "render/method.h"
#include "render/pass_params.h"

#include <algorithm>

namespace quasilux {

namespace {

struct Channels {
    unsigned first, count; ///< of AOV_FLOATS
    const char* names;     ///< one letter each
};

Channels channelsOf(AovQuantity quantity) {
    switch (quantity) {
    case AovQuantity::albedo:
        return {AOV_ALBEDO, 3, "RGB"};
    case AovQuantity::depth:
        return {AOV_DEPTH, 1, "T"};
    case AovQuantity::position:
        return {AOV_POSITION, 3, "XYZ"};
    case AovQuantity::geo_normal:
        return {AOV_GEO_NORMAL, 3, "XYZ"};
    case AovQuantity::sh_normal:
        return {AOV_SH_NORMAL, 3, "XYZ"};
    case AovQuantity::uv:
        return {AOV_UV, 2, "UV"};
    case AovQuantity::dp_du:
        return {AOV_DP_DU, 3, "XYZ"};
    case AovQuantity::dp_dv:
        return {AOV_DP_DV, 3, "XYZ"};
    case AovQuantity::duv_dx:
        return {AOV_DUV_DX, 2, "UV"};
    case AovQuantity::duv_dy:
        return {AOV_DUV_DY, 2, "UV"};
    case AovQuantity::prim_index:
        return {AOV_PRIM_INDEX, 1, "I"};
    default:
        return {AOV_SHAPE_INDEX, 1, "I"};
    }
}

// Of all pixels, `floats` each.
struct Sums {
    std::vector<float> values;
    size_t floats = 0;
};

// One layer out of all sums; positions are those of the file.
AovImage layerOf(const Sums& all, const Channels& channels, const glm::dvec3& origin) {
    AovImage layer;
    const std::vector<float>& sums = all.values;
    const bool isPosition = channels.first == AOV_POSITION;
    for (size_t at = 0; at < sums.size(); at += all.floats)
        for (unsigned c = 0; c < channels.count; ++c) {
            const double moved = isPosition ? double(sums[at + AOV_COVERAGE]) * origin[static_cast<int>(c)] : 0;
            layer.values.push_back(static_cast<float>(sums[at + channels.first + c] + moved));
        }
    return layer;
}

} // namespace

std::vector<AovImage> renderAovs(Device& device, const Scene& scene, const RenderSettings& settings, unsigned samples) {
    if (scene.sensor.meter != MeterKind::none || (scene.aovs.empty() && !scene.sensor.pixelFormat.alpha)) return {};
    const DeviceScene flat = flattenFor(scene, settings);
    const bool goByUv = hasUvLayers(scene);
    const size_t floats = goByUv ? AOV_ALL_FLOATS : AOV_PLAIN_FLOATS;
    Program program(device, "aovs.cl", kernelOptions(flat, settings) + (goByUv ? " -DHAS_UV_LAYERS" : ""));
    const GeometryBuffers geometry(device, flat);
    const size_t pixels = size_t(flat.camera.width) * flat.camera.height;
    Buffer<float> buffer(device, pixels * floats, "aovs");
    program.kernel("traceAovs")
        .launch(pixels, geometry.nodes, geometry.blocks, geometry.tables, buffer, cameraParams(flat, settings, QL_NONE),
                samples);
    const Sums sums{buffer.read(), floats};
    std::vector<AovImage> layers;
    if (scene.sensor.pixelFormat.alpha) {
        layers.push_back(layerOf(sums, {AOV_ALPHA, 1, "A"}, {}));
        layers.back().channels = {"A"};
        if (scene.surroundings) std::fill(layers.back().values.begin(), layers.back().values.end(), 1.f);
    }
    for (const AovLayer& wanted : scene.aovs) {
        const Channels channels = channelsOf(wanted.quantity);
        layers.push_back(layerOf(sums, channels, scene.origin));
        for (unsigned c = 0; c < channels.count; ++c)
            layers.back().channels.push_back(wanted.name + "." + channels.names[c]);
    }
    return layers;
}

} // namespace quasilux
