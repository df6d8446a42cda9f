#include "render/photon_stage.h"

#include "util/error.h"

#include <algorithm>
#include <bit>
#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr unsigned pathsPerRegion = 256;
constexpr unsigned scanBlocksMax = 64;
constexpr unsigned pilotPass = UINT32_MAX; // no render gets there
constexpr size_t vectorWidth = 8; // photons are read eight at a time: the last group may reach beyond the last photon

// A few cells per disc's worth of photons: collisions only cost tests.
unsigned cellsPerClass(unsigned photons) { return std::max(4096u, std::bit_ceil(photons / 4)); }

} // namespace

PhotonStage::PhotonStage(Device& device, const std::string& options, const GeometryBuffers& geometry,
                         shared::PhotonParams params, unsigned classes, bool storesDepth)
    : device_(device), geometry_(geometry), tracing_(device, "photon_trace.cl", options),
      indexing_(device, "photon_map.cl", options), tracePhotons_(tracing_.kernel("tracePhotons")),
      countPhotons_(indexing_.kernel("countPhotons")), sumBlocks_(indexing_.kernel("sumBlocks")),
      scanCells_(indexing_.kernel("scanCells")), scatterPhotons_(indexing_.kernel("scatterPhotons")), params_(params),
      classes_(classes), classSlots_(static_cast<unsigned>(std::popcount(classes))), storesDepth_(storesDepth) {
    params_.pathsPerRegion = pathsPerRegion;
    params_.regions = (params_.paths + pathsPerRegion - 1) / pathsPerRegion;
    params_.regionCapacity = pathsPerRegion;
    std::fill_n(params_.keepProbability, LIGHT_CLASSES, 1.f);
    photons_ = Buffer<shared::Photon>(device, size_t(params_.regions) * params_.regionCapacity, "photons as traced");
    regions_ = Buffer<shared::RegionCount>(device, params_.regions, "photon regions");

    map_.cellMask = cellsPerClass(params_.paths) - 1;
    // On a CPU a few long chunks; on a GPU enough of them to occupy it.
    map_.chunks = std::min(params_.regions, device.info().isCpu ? 2 * device.info().computeUnits : 256u);
    const size_t cells = size_t(classSlots_) * (map_.cellMask + 1);
    map_.scanBlocks = static_cast<unsigned>(std::clamp<size_t>(cells / 256, 1, scanBlocksMax));
    map_.regions = params_.regions;
    map_.media = params_.scene.media;
    counts_ = Buffer<uint32_t>(device, cells * map_.chunks, "photon cell counts");
    blockSums_ = Buffer<uint32_t>(device, map_.scanBlocks, "photon scan blocks");
    cellStart_ = Buffer<uint32_t>(device, cells + 1, "photon cells");
    makeRoom(params_.paths);
}

std::vector<shared::RegionCount> PhotonStage::trace() {
    for (;;) {
        tracePhotons_.launch(params_.regions, geometry_.nodes, geometry_.blocks, geometry_.tables, photons_, regions_,
                             params_);
        auto counts = regions_.read(0, params_.regions);
        unsigned wanted = 0;
        for (const auto& count : counts) wanted = std::max(wanted, count.wanted);
        if (wanted <= params_.regionCapacity) return counts;
        makeRegions(wanted + wanted / 4);
    }
}

void PhotonStage::makeRegions(unsigned capacity) {
    params_.regionCapacity = capacity;
    photons_ = Buffer<shared::Photon>();
    photons_ = Buffer<shared::Photon>(device_, size_t(params_.regions) * capacity, "photons as traced");
}

void PhotonStage::makeRoom(uint64_t photons) {
    const uint64_t stride = photons + vectorWidth;
    if (stride > UINT32_MAX)
        throw DeviceError(
            fmt::format("{} photons in one pass, at most {} can be indexed: use fewer --photons", photons, UINT32_MAX));
    map_.photonStride = static_cast<unsigned>(stride);
    sorted_ = Buffer<uint32_t>();
    sorted_ = Buffer<uint32_t>(device_, fields() * map_.photonStride, "photons sorted");
    sorted_.fill(0); // lanes beyond the last photon are read, with weight 0: they must be finite
}

void PhotonStage::index(uint64_t photons) {
    if (photons + vectorWidth > map_.photonStride) makeRoom(photons + photons / 4);
    map_.regionCapacity = params_.regionCapacity;
    countPhotons_.launchFew(map_.chunks, photons_, regions_, geometry_.tables, counts_, map_);
    sumBlocks_.launchFew(map_.scanBlocks, counts_, blockSums_, map_);
    scanCells_.launchFew(map_.scanBlocks, counts_, blockSums_, cellStart_, map_);
    scatterPhotons_.launchFew(map_.chunks, photons_, regions_, geometry_.tables, counts_, sorted_, map_);
}

std::array<uint64_t, PHOTON_SLOTS> PhotonStage::pilot(unsigned paths, const std::array<float, LIGHT_CLASSES>& radius) {
    const unsigned paramsPaths = params_.paths, regions = params_.regions;
    params_.paths = std::min(paths, paramsPaths);
    params_.regions = (params_.paths + pathsPerRegion - 1) / pathsPerRegion;
    map_.regions = params_.regions;
    const unsigned chunks = map_.chunks;
    map_.chunks = std::min(chunks, params_.regions);
    const auto counted = run(pilotPass, radius, 1).stored;
    params_.paths = paramsPaths;
    params_.regions = map_.regions = regions;
    map_.chunks = chunks;
    makeRegions(pathsPerRegion);
    return counted;
}

void PhotonStage::thinVolume(const std::array<float, LIGHT_CLASSES>& keepProbability, double expectedPhotons) {
    std::copy(keepProbability.begin(), keepProbability.end(), params_.keepProbability);
    makeRegions(std::max(pathsPerRegion, static_cast<unsigned>(1.5 * expectedPhotons / params_.regions)));
}

PhotonPassCount PhotonStage::run(unsigned pass, const std::array<float, LIGHT_CLASSES>& radius, float volumeScale) {
    std::copy(radius.begin(), radius.end(), map_.radius);
    map_.volumeScale = volumeScale;
    params_.pass = pass;
    PhotonPassCount total;
    if (classes_ == 0) return total;
    uint64_t stored = 0;
    for (const auto& count : trace()) {
        stored += count.stored;
        total.cutPaths += count.cutPaths;
        total.nonFinite += count.nonFinite;
        total.fluxCut += count.fluxCut;
    }
    index(stored);
    total.stored = storedBySlot();
    return total;
}

std::array<uint64_t, PHOTON_SLOTS> PhotonStage::storedBySlot() const {
    std::array<uint64_t, PHOTON_SLOTS> stored{};
    size_t first = 0; // cell where the slot begins; its photons stand between the starts of two slots
    for (unsigned c = 0; c < PHOTON_SLOTS; ++c) {
        if (!(classes_ >> c & 1)) continue;
        const size_t end = first + map_.cellMask + 1;
        stored[c] = cellStart_.read(end, 1).front() - cellStart_.read(first, 1).front();
        first = end;
    }
    return stored;
}

} // namespace quasilux
