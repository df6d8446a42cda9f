#include "render/memory_plan.h"

#include "render/adaptive_radius.h"
#include "render/film.h"
#include "render/geometry_buffers.h"
#include "render/meter_stage.h"
#include "render/method.h"
#include "render/noise_probe.h"
#include "render/pass_part.h"
#include "render/photon_stage.h"
#include "render/shared_samples.h"
#include "util/error.h"

#include <algorithm>
#include <fmt/format.h>
#include <vector>

namespace quasilux {

namespace {

uint64_t pixelsOf(const DeviceScene& scene) { return uint64_t(scene.camera.width) * scene.camera.height; }

std::string mebibytes(uint64_t bytes) { return fmt::format("{:.1f} MiB", static_cast<double>(bytes) / (1024 * 1024)); }

// `photons`: of a pass, that fit.
std::string advice(const DeviceScene& scene, const RenderSettings& settings, std::optional<uint64_t> photons) {
    const FilmLayout layout = filmLayout(scene.features, settings);
    std::string parts = layout.components ? "components" : "";
    if (layout.bias) parts += parts.empty() ? "bias" : ",bias";
    const std::string without = parts.empty() ? "" : fmt::format(" or --without {}", parts);
    const std::string fewer =
        photons ? fmt::format("at most {} --photons (now {}; more passes make up for them) or --map camera, which "
                              "stores none, ",
                              *photons, photonsPerPass(settings, scene.camera))
                : "";
    return fmt::format("use {}a smaller film (now {} x {}){}, simpler meshes (now {} triangles), "
                       "or a device with more memory",
                       fewer, scene.camera.width, scene.camera.height, without, scene.triangles);
}

/// The three largest, for the user to see what it is.
std::string largest(const BufferSizes& sizes) {
    std::vector<std::pair<uint64_t, std::string>> sorted;
    for (const auto& [label, bytes] : sizes) sorted.emplace_back(bytes, label);
    std::sort(sorted.rbegin(), sorted.rend());
    std::string text;
    for (size_t k = 0; k < std::min<size_t>(3, sorted.size()); ++k)
        text += fmt::format("{}{} {}", k ? ", " : "", sorted[k].second, mebibytes(sorted[k].first));
    return text;
}

bool fits(const BufferSizes& sizes, const DeviceInfo& device) {
    return sumOf(sizes) <= device.globalMemory && std::all_of(sizes.begin(), sizes.end(), [&](const auto& size) {
               return size.second <= device.maximumAllocation;
           });
}

} // namespace

uint64_t sumOf(const BufferSizes& sizes) {
    uint64_t sum = 0;
    for (const auto& [label, bytes] : sizes) sum += bytes;
    return sum;
}

BufferSizes planScene(const DeviceScene& scene, const RenderSettings& settings, const DeviceInfo& device) {
    BufferSizes sizes = GeometryBuffers::plan(scene);
    sizes.merge(Film::plan(pixelsOf(scene), filmLayout(scene.features, settings),
                           largestFilmBuffer(scene.features, settings, device)));
    return sizes;
}

BufferSizes planPass(const DeviceScene& scene, const RenderSettings& settings, uint64_t photons,
                     const DeviceInfo& device, unsigned parts) {
    BufferSizes sizes = planScene(scene, settings, device);
    const unsigned classes = compiledClasses(scene.features, settings);
    const unsigned paths = PassPart{0, parts}.share(photonsPerPass(settings, scene.camera));
    sizes.merge(PhotonStage::plan(paths, photons, classes, storesDepth(scene, settings), device));
    if (const unsigned floats = SharedSamples::floatsPerSample(scene, settings))
        sizes.merge(SharedSamples::plan(scene.camera, floats, device));
    const bool isMeter = scene.offsets.meter.kind != METER_NONE,
               isAdaptive = settings.cameraSampling == CameraSampling::adaptive;
    if (mayHaveCameraPaths(isMeter, settings)) sizes.merge(CameraStage::plan(scene.camera, isAdaptive));
    if (isAdaptive) sizes.merge(NoiseProbe::plan(scene.camera));
    if (adaptsRadius(scene.features, settings)) sizes.merge(AdaptiveRadius::plan(scene.camera, classes));
    if (isMeter) sizes.merge(MeterStage::plan(pixelsOf(scene), scene.offsets.meter.samples, classes));
    return sizes;
}

uint64_t imageBytes(const DeviceScene& scene, const RenderSettings& settings) {
    const FilmLayout layout = filmLayout(scene.features, settings);
    const uint64_t ofBias = layout.bias ? 2 : 0, ofClass = layout.components ? 1 + ofBias : 0;
    const uint64_t layers = 2 + ofBias + (layout.components ? FILM_COMPONENTS : 0) + LIGHT_CLASSES * ofClass;
    return pixelsOf(scene) * 3 * layers * sizeof(float);
}

uint64_t developBytes(const DeviceScene& scene, const RenderSettings& settings) {
    constexpr uint64_t ofEstimate =
        3 * sizeof(float) + sizeof(double); // error_estimate.cpp: weights, squares of one layer
    return imageBytes(scene, settings) + pixelsOf(scene) * ofEstimate;
}

namespace {

bool partsFit(const DeviceScene& scene, const RenderSettings& settings, const StoredPhotons& stored,
              const DeviceInfo& device, unsigned parts) {
    const unsigned paths = PassPart{0, parts}.share(photonsPerPass(settings, scene.camera));
    return fits(planPass(scene, settings, stored(paths), device, parts), device);
}

/// Photons of a pass for which the device has room; none if it has no room even for the rest.
std::optional<uint64_t> photonsThatFit(const DeviceScene& scene, const RenderSettings& settings,
                                       const StoredPhotons& stored, const DeviceInfo& device) {
    RenderSettings fewer = settings;
    const auto fit = [&](unsigned photons) {
        fewer.photonsPerPass = photons;
        return partsFit(scene, fewer, stored, device, mostParts);
    };
    uint64_t least = 0, most = photonsPerPass(settings, scene.camera); // least fits, or nothing is known of it
    while (most - least > most / 1000 + 1) {
        const uint64_t middle = (least + most) / 2;
        (fit(static_cast<unsigned>(middle)) ? least : most) = middle;
    }
    if (least == 0) return {};
    uint64_t unit = 1; // of two digits
    while (least / unit >= 100) unit *= 10;
    return least / unit * unit;
}

} // namespace

unsigned partsThatFit(const DeviceScene& scene, const RenderSettings& settings, const StoredPhotons& stored,
                      const DeviceInfo& device) {
    for (unsigned parts = 1; parts <= mostParts; ++parts)
        if (partsFit(scene, settings, stored, device, parts)) return parts;
    return mostParts;
}

void checkFits(const BufferSizes& sizes, const DeviceInfo& device, const DeviceScene& scene,
               const RenderSettings& settings, const StoredPhotons& stored) {
    if (fits(sizes, device)) return;
    const auto photons = stored ? photonsThatFit(scene, settings, stored, device) : std::nullopt;
    for (const auto& [label, bytes] : sizes)
        if (bytes > device.maximumAllocation)
            throw InputError(
                fmt::format("buffer '{}' needs {}, but device {} allows {} in one buffer, {} too little: {}", label,
                            mebibytes(bytes), device.name, mebibytes(device.maximumAllocation),
                            mebibytes(bytes - device.maximumAllocation), advice(scene, settings, photons)));
    const uint64_t sum = sumOf(sizes);
    if (sum > device.globalMemory)
        throw InputError(
            fmt::format("the render needs {} of device memory, but device {} has {}, {} too little (largest: {}): {}",
                        mebibytes(sum), device.name, mebibytes(device.globalMemory),
                        mebibytes(sum - device.globalMemory), largest(sizes), advice(scene, settings, photons)));
}

} // namespace quasilux
