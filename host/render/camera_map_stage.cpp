#include "render/camera_map_stage.h"

#include "render/meter_sums.h"
#include "render/regions.h"
#include "util/error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace quasilux {

CameraMapStage::CameraMapStage(Device& device, const Program& pass, const GeometryBuffers& geometry, Film& film,
                               shared::CameraParams camera, shared::PhotonParams photons, unsigned classes,
                               double meanRadiance)
    : device_(device), geometry_(geometry), film_(film), traceCameraPoints_(pass.kernel("traceCameraPoints")),
      addSamples_(pass.kernel("addSamples")), splatPhotons_(pass.kernel("splatPhotons")), index_(device, pass, classes),
      cameraParams_(camera), photonParams_(photons), classes_(classes) {
    photonParams_.pathsPerRegion = photonsPerRegion(device.info());
    photonParams_.regions = regionsOf(photonParams_.paths, photonParams_.pathsPerRegion);
    photonRegions_ = Buffer<shared::RegionCount>(device, photonParams_.regions, "photon regions");

    points_.pixelsPerRegion = pixelsPerRegion(device.info());
    points_.quantaPerRadiance = quantaPerRadiance(meanRadiance, pathsPerPixel());
    points_.borderCapacity = points_.pixelsPerRegion / 2;
    index_.table().map().regionCapacity = points_.pixelsPerRegion;
    index_.table().map().media = camera.scene.media;
    index_.table().map().fluxUnit = 1 / photons.perFluxUnit;
    thinVolume({1, 1, 1, 1});
    const size_t paths = film.pixels() * pathsPerPixel();
    const unsigned regions = regionsOf(paths, points_.pixelsPerRegion);
    index_.make(paths, regions);
    regions_ = Buffer<shared::PointRegionCount>(device, regions, "camera point regions");
    samples_ = Buffer<float>(device, CAMERA_SAMPLE_FLOATS * paths, "camera samples");
    sums_ = Buffer<uint32_t>(device, splatWords(classes) * film.pixels(), "splats");
    sums_.fill(0);
    makeRegions();
}

void CameraMapStage::thinVolume(const std::array<float, LIGHT_CLASSES>& keepProbability) {
    for (unsigned c = 0; c < LIGHT_CLASSES; ++c) {
        photonParams_.keepProbability[c] = keepProbability[c];
        index_.table().map().perKept[c] = 1 / keepProbability[c];
    }
}

void CameraMapStage::makeRegions() {
    const shared::MapParams& map = index_.table().map();
    const uint64_t capacity = uint64_t(map.regions) * map.regionCapacity;
    if (capacity > UINT32_MAX)
        throw DeviceError(fmt::format("room for {} camera points in one pass, at most {} can be indexed: render a "
                                      "smaller image or use --map photons",
                                      capacity, UINT32_MAX));
    traced_ = Buffer<shared::CameraPoint>();
    traced_ = Buffer<shared::CameraPoint>(device_, capacity, "camera points as traced");
    borders_ = Buffer<shared::PointBorder>();
    borders_ = Buffer<shared::PointBorder>(device_, size_t(map.regions) * points_.borderCapacity, "camera borders");
    points_.map = map;
}

std::vector<shared::PointRegionCount> CameraMapStage::traceCameraPoints() {
    for (;;) {
        traceCameraPoints_.launchLong(points_.map.regions, geometry_.nodes, geometry_.blocks, geometry_.tables, traced_,
                                      borders_, samples_, regions_, cameraParams_, points_);
        auto counts = regions_.read();
        unsigned points = 0, borders = 0;
        for (const auto& count : counts) {
            points = std::max(points, count.wanted);
            borders = std::max(borders, count.wantedBorders);
        }
        unsigned& capacity = index_.table().map().regionCapacity;
        if (points <= capacity && borders <= points_.borderCapacity) return counts;
        if (points > capacity) capacity = points + points / 4;
        if (borders > points_.borderCapacity) points_.borderCapacity = borders + borders / 4;
        makeRegions();
    }
}

void CameraMapStage::splatPhotons(CameraMapPassCount& total) {
    splatPhotons_.launchLong(photonParams_.regions, geometry_.nodes, geometry_.blocks, geometry_.tables,
                             index_.table().cellStart(), index_.sorted(), traced_, borders_, sums_, photonRegions_,
                             photonParams_, points_);
    for (const auto& count : photonRegions_.read()) total.add(count);
}

void CameraMapStage::beginPass(unsigned pass, const std::array<float, LIGHT_CLASSES>& radius, float volumeScale) {
    std::copy(radius.begin(), radius.end(), index_.table().map().radius);
    index_.table().map().volumeScale = volumeScale;
    cameraParams_.pass = photonParams_.pass = pass;
    cameraParams_.map = points_.map = index_.table().map();
}

void CameraMapStage::makeRoom(unsigned pass, const std::array<float, LIGHT_CLASSES>& radius, float volumeScale) {
    beginPass(pass, radius, volumeScale);
    uint64_t stored = 0;
    for (const auto& count : traceCameraPoints()) stored += count.stored;
    index_.reserve(stored + stored / 32);
}

CameraMapPassCount CameraMapStage::run(unsigned pass, const std::array<float, LIGHT_CLASSES>& radius,
                                       float volumeScale) {
    beginPass(pass, radius, volumeScale);
    CameraMapPassCount total;
    uint64_t stored = 0;
    for (const auto& count : traceCameraPoints()) {
        stored += count.stored;
        total.borders += count.storedBorders;
        total.cutPaths += count.cutPaths;
        total.throughputCut += count.cutThroughput;
    }
    if (classes_ != 0) {
        index_.sort(traced_, regions_, geometry_, stored);
        total.points = index_.table().countBySlot();
        points_.map = index_.table().map();
        splatPhotons(total);
    }
    addSamples_.launch(film_.pixels(), samples_, sums_, film_.sums(), film_.counterBuffer(),
                       static_cast<unsigned>(film_.pixels()), pathsPerPixel(), sampleScale(cameraParams_.scene.meter),
                       points_.quantaPerRadiance, film_.beginPass(pass).batchWeight, film_.layout().bits());
    return total;
}

} // namespace quasilux
