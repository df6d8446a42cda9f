#include "render/aovs.h"

#include "aov_types.h"
#include "device/program.h"
#include "prepare/device_scene.h"
#include "render/method.h"
#include "render/pass_params.h"
#include "scene/integrator.h"
#include "util/process_memory.h"

#include <algorithm>

namespace quasilux {

namespace {

struct Channels {
    unsigned first; ///< of AOV_FLOATS
    std::string_view names;
};

unsigned firstFloatOf(AovQuantity quantity) {
    switch (quantity) {
    case AovQuantity::albedo:
        return AOV_ALBEDO;
    case AovQuantity::depth:
        return AOV_DEPTH;
    case AovQuantity::position:
        return AOV_POSITION;
    case AovQuantity::geo_normal:
        return AOV_GEO_NORMAL;
    case AovQuantity::sh_normal:
        return AOV_SH_NORMAL;
    case AovQuantity::uv:
        return AOV_UV;
    case AovQuantity::dp_du:
        return AOV_DP_DU;
    case AovQuantity::dp_dv:
        return AOV_DP_DV;
    case AovQuantity::duv_dx:
        return AOV_DUV_DX;
    case AovQuantity::duv_dy:
        return AOV_DUV_DY;
    case AovQuantity::prim_index:
        return AOV_PRIM_INDEX;
    default:
        return AOV_SHAPE_INDEX;
    }
}

Channels channelsOf(AovQuantity quantity) { return {firstFloatOf(quantity), aovChannels(quantity)}; }

// Pixels that are traced at once, of so many floats each: all launches alike, as runtimes compile small ones apart.
size_t tileOf(size_t pixels, unsigned floats, const DeviceInfo& device) {
    constexpr uint64_t mostBytes = 16u << 20, shareOfAllocation = 8;
    const uint64_t bytes = std::min(mostBytes, device.maximumAllocation / shareOfAllocation);
    const size_t most = std::max<size_t>(bytes / (floats * sizeof(float)), 1), tiles = (pixels + most - 1) / most;
    return (pixels + tiles - 1) / tiles;
}

bool hasLayers(const Scene& scene) {
    return scene.sensor.meter == MeterKind::none && (!scene.aovs.empty() || scene.sensor.pixelFormat.alpha);
}

unsigned floatsOf(const Scene& scene) { return hasUvLayers(scene) ? AOV_ALL_FLOATS : AOV_PLAIN_FLOATS; }

size_t pixelsOf(const DeviceScene& flat) { return size_t(flat.camera.width) * flat.camera.height; }

// Sums of the pixels of a tile.
PlannedBuffer<float> sumsOf(size_t tile, size_t floats) { return {"aovs", tile * floats}; }

// The layers that are asked for, alpha first, filled pixel by pixel.
class Layers {
public:
    Layers(const Scene& scene, size_t pixels)
        : origin_(scene.origin), isBeforeSurroundings_(scene.surroundings && !hidesEmitters(scene)) {
        if (scene.sensor.pixelFormat.alpha) add({AOV_ALPHA, "A"}, "", pixels);
        for (const AovLayer& wanted : scene.aovs) add(channelsOf(wanted.quantity), wanted.name + ".", pixels);
    }

    // Sums of the pixels that follow, `floats` each.
    void append(const std::vector<float>& sums, size_t floats) {
        for (size_t k = 0; k < images_.size(); ++k)
            for (size_t at = 0; at < sums.size(); at += floats) appendPixel(k, &sums[at]);
    }

    std::vector<AovImage> take() { return std::move(images_); }

private:
    void add(const Channels& channels, const std::string& prefix, size_t pixels) {
        AovImage image;
        for (const char name : channels.names) image.channels.push_back(prefix + name);
        image.values.reserve(pixels * channels.names.size());
        images_.push_back(std::move(image));
        channels_.push_back(channels);
    }

    // Positions are those of the file.
    void appendPixel(size_t layer, const float* sums) {
        const Channels& channels = channels_[layer];
        std::vector<float>& values = images_[layer].values;
        if (channels.first == AOV_ALPHA && isBeforeSurroundings_) return values.push_back(1);
        for (unsigned c = 0; c < channels.names.size(); ++c) {
            const double moved =
                channels.first == AOV_POSITION ? double(sums[AOV_COVERAGE]) * origin_[static_cast<int>(c)] : 0;
            values.push_back(static_cast<float>(sums[channels.first + c] + moved));
        }
    }

    glm::dvec3 origin_;
    bool isBeforeSurroundings_;
    std::vector<AovImage> images_;
    std::vector<Channels> channels_;
};

} // namespace

BufferSizes planAovs(const Scene& scene, const DeviceScene& flat, const DeviceInfo& device) {
    if (!hasLayers(scene)) return {};
    BufferSizes sizes = GeometryBuffers::plan(flat);
    const unsigned floats = floatsOf(scene);
    sizes.merge(sizesOf(sumsOf(tileOf(pixelsOf(flat), floats, device), floats)));
    return sizes;
}

MemoryForecast withLayers(MemoryForecast forecast, const Scene& scene, const DeviceScene& flat,
                          const RenderSettings& settings, const DeviceInfo& device) {
    const PixelFormat& format = scene.sensor.pixelFormat;
    uint64_t floats = (format.luminance ? 1 : 0) + (format.xyz ? 3 : 0) + (format.alpha ? 1 : 0);
    for (const AovLayer& wanted : scene.aovs) floats += channelsOf(wanted.quantity).names.size();
    if (floats == 0) return forecast;
    const BufferSizes sizes = planAovs(scene, flat, device);
    uint64_t bytes = residentBytes() + imageBytes(flat, settings) + pixelsOf(flat) * floats * sizeof(float);
    if (device.isCpu) { // the film is in this process until then, and its memory is used anew
        const BufferSizes passes = planScene(flat, settings, device);
        bytes -= std::min(bytes, sumOf(passes) - std::min(sumOf(passes), sumOf(sizes)));
    }
    forecast.deviceBytes = std::max(forecast.deviceBytes, sumOf(sizes));
    forecast.hostPeakBytes = std::max(forecast.hostPeakBytes, bytes);
    return forecast;
}

std::vector<AovImage> renderAovs(Device& device, const Scene& scene, const RenderSettings& settings, unsigned samples) {
    if (!hasLayers(scene)) return {};
    const DeviceScene flat = flattenFor(scene, settings);
    return renderAovs(device, scene, flat, GeometryBuffers(device, flat), settings, samples);
}

std::vector<AovImage> renderAovs(Device& device, const Scene& scene, const DeviceScene& flat,
                                 const GeometryBuffers& geometry, const RenderSettings& settings, unsigned samples) {
    if (!hasLayers(scene)) return {};
    Program program(device, "aovs.cl", kernelOptions(flat, settings) + (hasUvLayers(scene) ? " -DHAS_UV_LAYERS" : ""));
    const size_t pixels = pixelsOf(flat), floats = floatsOf(scene),
                 tile = tileOf(pixels, floatsOf(scene), device.info());
    const Buffer<float> sums = sumsOf(tile, floats).make(device);
    Kernel trace = program.kernel("traceAovs");
    shared::CameraParams params = cameraParams(flat, settings, QL_NONE);
    Layers layers(scene, pixels);
    for (size_t first = 0; first < pixels; first += tile) {
        params.firstPixel = static_cast<unsigned>(first);
        params.pixels = static_cast<unsigned>(std::min(tile, pixels - first));
        trace.launch(params.pixels, geometry.nodes, geometry.blocks, geometry.tables, sums, params, samples);
        layers.append(sums.read(0, params.pixels * floats), floats);
    }
    return layers.take();
}

unsigned aovSamples(unsigned passes) { return std::min(passes, 256u); }

} // namespace quasilux
