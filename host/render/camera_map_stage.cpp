#include "render/camera_map_stage.h"

#include "util/error.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr unsigned photonsPerRegion = 256;
constexpr unsigned pixelsPerRegion = 64;
constexpr unsigned scanBlocksMax = 64;
constexpr size_t vectorWidth = 8;  // points are read eight at a time: the last group may reach beyond the last point
constexpr size_t pointFields = 5;  // POINT_FIELDS of kernels/photon_grid.clh
constexpr size_t sampleFloats = 6; // SAMPLE_FLOATS of kernels/camera_paths.cl

// Of the mean radiance one splat may be 2^-37 and the sum of a pixel 2^27 before anything is lost: photons bring about
// 2^-5 of it each, at a caustic's focus or in a narrow lobe up to 2^15 of that.
constexpr int quantumBits = 36;

float quantaPerRadiance(double meanRadiance) {
    const int exponent = meanRadiance > 0 && std::isfinite(meanRadiance) ? std::ilogb(meanRadiance) + 1 : 0;
    return static_cast<float>(std::ldexp(1.0, std::clamp(quantumBits - exponent, -100, 100)));
}

unsigned splatClasses(unsigned slots) {
    return static_cast<unsigned>(std::popcount((slots | slots >> LIGHT_CLASSES) & ((1u << LIGHT_CLASSES) - 1)));
}

unsigned divideUp(size_t count, unsigned by) { return static_cast<unsigned>((count + by - 1) / by); }

} // namespace

CameraMapStage::CameraMapStage(Device& device, const std::string& options, const GeometryBuffers& geometry, Film& film,
                               shared::CameraParams camera, shared::PhotonParams photons, unsigned classes,
                               double meanRadiance)
    : device_(device), geometry_(geometry), film_(film),
      cameraTracing_(device, "camera_paths.cl", options + " -DMAP_CAMERA"),
      photonTracing_(device, "photon_trace.cl", options + " -DMAP_CAMERA"),
      indexing_(device, "camera_point_map.cl", options), traceCameraPoints_(cameraTracing_.kernel("traceCameraPoints")),
      addSamples_(cameraTracing_.kernel("addSamples")), splatPhotons_(photonTracing_.kernel("splatPhotons")),
      countPoints_(indexing_.kernel("countPoints")), sumBlocks_(indexing_.kernel("sumBlocks")),
      scanCells_(indexing_.kernel("scanCells")), scatterPoints_(indexing_.kernel("scatterPoints")),
      cameraParams_(camera), photonParams_(photons), classes_(classes) {
    photonParams_.pathsPerRegion = photonsPerRegion;
    photonParams_.regions = divideUp(photonParams_.paths, photonsPerRegion);
    std::fill_n(photonParams_.keepProbability, LIGHT_CLASSES, 1.f);
    photonRegions_ = Buffer<shared::RegionCount>(device, photonParams_.regions, "photon regions");

    points_.pixelsPerRegion = pixelsPerRegion;
    points_.quantaPerRadiance = quantaPerRadiance(meanRadiance);
    points_.map.regions = divideUp(film.pixels(), pixelsPerRegion);
    points_.map.regionCapacity = pixelsPerRegion;
    points_.borderCapacity = pixelsPerRegion / 2;
    points_.map.media = camera.scene.media;
    regions_ = Buffer<shared::PointRegionCount>(device, points_.map.regions, "camera point regions");
    samples_ = Buffer<float>(device, sampleFloats * film.pixels(), "camera samples");
    sums_ = Buffer<uint32_t>(device, 6 * splatClasses(classes) * film.pixels(), "splats");
    sums_.fill(0);
    makeIndex();
    makeRoom(film.pixels());
}

size_t CameraMapStage::pointBytes() { return sizeof(shared::CameraPoint) + pointFields * sizeof(uint32_t); }

void CameraMapStage::thinVolume(const std::array<float, LIGHT_CLASSES>& keepProbability) {
    std::copy(keepProbability.begin(), keepProbability.end(), photonParams_.keepProbability);
}

void CameraMapStage::makeIndex() {
    auto& map = points_.map;
    const uint64_t capacity = uint64_t(map.regions) * map.regionCapacity;
    if (capacity > UINT32_MAX)
        throw DeviceError(fmt::format("room for {} camera points in one pass, at most {} can be indexed: render a "
                                      "smaller image or use --map photons",
                                      capacity, UINT32_MAX));
    traced_ = Buffer<shared::CameraPoint>();
    traced_ = Buffer<shared::CameraPoint>(device_, capacity, "camera points as traced");
    borders_ = Buffer<shared::PointBorder>();
    borders_ = Buffer<shared::PointBorder>(device_, size_t(map.regions) * points_.borderCapacity, "camera borders");

    map.cellMask = std::max(4096u, std::bit_ceil(static_cast<unsigned>(film_.pixels() / 4))) - 1;
    map.chunks = std::min(map.regions, device_.info().isCpu ? 2 * device_.info().computeUnits : 256u);
    const size_t cells = size_t(std::popcount(classes_)) * (map.cellMask + 1);
    map.scanBlocks = static_cast<unsigned>(std::clamp<size_t>(cells / 256, 1, scanBlocksMax));
    counts_ = Buffer<uint32_t>(device_, cells * map.chunks, "camera cell counts");
    blockSums_ = Buffer<uint32_t>(device_, map.scanBlocks, "camera scan blocks");
    cellStart_ = Buffer<uint32_t>(device_, cells + 1, "camera cells");
}

void CameraMapStage::makeRoom(uint64_t points) {
    points_.map.photonStride = static_cast<unsigned>(points + vectorWidth);
    sorted_ = Buffer<uint32_t>();
    sorted_ = Buffer<uint32_t>(device_, pointFields * points_.map.photonStride, "camera points sorted");
    sorted_.fill(0); // lanes beyond the last point are read, with weight 0: they must be finite
}

std::vector<shared::PointRegionCount> CameraMapStage::traceCameraPoints() {
    for (;;) {
        traceCameraPoints_.launch(points_.map.regions, geometry_.nodes, geometry_.blocks, geometry_.tables, traced_,
                                  borders_, samples_, regions_, cameraParams_, points_);
        auto counts = regions_.read();
        unsigned points = 0, borders = 0;
        for (const auto& count : counts) {
            points = std::max(points, count.wanted);
            borders = std::max(borders, count.wantedBorders);
        }
        if (points <= points_.map.regionCapacity && borders <= points_.borderCapacity) return counts;
        if (points > points_.map.regionCapacity) points_.map.regionCapacity = points + points / 4;
        if (borders > points_.borderCapacity) points_.borderCapacity = borders + borders / 4;
        makeIndex();
    }
}

void CameraMapStage::index(uint64_t points) {
    auto& map = points_.map;
    if (points + vectorWidth > map.photonStride) makeRoom(points + points / 4);
    countPoints_.launchFew(map.chunks, traced_, regions_, geometry_.tables, counts_, map);
    sumBlocks_.launchFew(map.scanBlocks, counts_, blockSums_, map);
    scanCells_.launchFew(map.scanBlocks, counts_, blockSums_, cellStart_, map);
    scatterPoints_.launchFew(map.chunks, traced_, regions_, geometry_.tables, counts_, sorted_, map);
}

void CameraMapStage::splatPhotons(CameraMapPassCount& total) {
    splatPhotons_.launch(photonParams_.regions, geometry_.nodes, geometry_.blocks, geometry_.tables, cellStart_,
                         sorted_, traced_, borders_, sums_, photonRegions_, photonParams_, points_);
    for (const auto& count : photonRegions_.read()) {
        total.cutPaths += count.cutPaths;
        total.nonFinite += count.nonFinite;
        total.overflows += count.overflows;
        total.fluxCut += count.fluxCut;
    }
}

CameraMapPassCount CameraMapStage::run(unsigned pass, const std::array<float, LIGHT_CLASSES>& radius,
                                       float volumeScale) {
    std::copy(radius.begin(), radius.end(), points_.map.radius);
    points_.map.volumeScale = volumeScale;
    cameraParams_.pass = photonParams_.pass = pass;
    cameraParams_.map = points_.map;
    CameraMapPassCount total;
    uint64_t stored = 0;
    for (const auto& count : traceCameraPoints()) {
        stored += count.stored;
        total.borders += count.storedBorders;
        total.cutPaths += count.cutPaths;
        total.throughputCut += count.cutThroughput;
    }
    if (classes_ != 0) {
        index(stored);
        total.points = pointsBySlot();
        splatPhotons(total);
    }
    addSamples_.launch(film_.pixels(), samples_, sums_, film_.sums(), film_.counterBuffer(),
                       static_cast<unsigned>(film_.pixels()), points_.quantaPerRadiance);
    return total;
}

std::array<uint64_t, PHOTON_SLOTS> CameraMapStage::pointsBySlot() const {
    std::array<uint64_t, PHOTON_SLOTS> points{};
    size_t first = 0; // cell where the slot begins; its points stand between the starts of two slots
    for (unsigned slot = 0; slot < PHOTON_SLOTS; ++slot) {
        if (!(classes_ >> slot & 1)) continue;
        const size_t end = first + points_.map.cellMask + 1;
        points[slot] = cellStart_.read(end, 1).front() - cellStart_.read(first, 1).front();
        first = end;
    }
    return points;
}

} // namespace quasilux
