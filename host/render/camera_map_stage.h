// A pass in the camera map's order: camera points are stored and indexed, then photons are splatted to them on the fly.
#pragma once

#include "render/film.h"
#include "render/point_index.h"
#include "render/trace_count.h"

namespace quasilux {

/// What one pass stored and dropped.
struct CameraMapPassCount : TraceCount {
    std::array<uint64_t, PHOTON_SLOTS> points{}; ///< camera points by slot of the map
    uint64_t borders = 0;                        ///< PointBorder records
    double throughputCut = 0;                    ///< of cut camera paths
};

class CameraMapStage {
public:
    /// `pass` is camera_map_pass.cl; `classes` as PhotonStage takes them. `meanRadiance`, of the order of the scene's,
    /// W sr^-1 m^-2, decides the unit of the sums of splats.
    CameraMapStage(Device& device, const Program& pass, const GeometryBuffers& geometry, Film& film,
                   shared::CameraParams camera, shared::PhotonParams photons, unsigned classes, double meanRadiance);

    /// One path per pixel and all photons of the pass, into the film. `radius` and `volumeScale` as PhotonStage::run
    /// takes them. Buffers that prove too small are enlarged and the camera paths traced again, so no point is lost.
    CameraMapPassCount run(unsigned pass, const std::array<float, LIGHT_CLASSES>& radius, float volumeScale);

    /// From now on photons in media are splatted with these probabilities, by class, and weigh accordingly more.
    void thinVolume(const std::array<float, LIGHT_CLASSES>& keepProbability);

    /// Enlarges the buffers to what a trial pass of camera paths stores, so that their sizes are known before the
    /// first.
    void makeRoom(unsigned pass, const std::array<float, LIGHT_CLASSES>& radius, float volumeScale);

    /// Photons emitted in a pass: none where no path can use any class.
    unsigned photonsPerPass() const { return classes_ == 0 ? 0 : photonParams_.paths; }
    /// Bytes of a camera point, as traced and in the index, and of the border record that some have.
    static size_t pointBytes() { return sizeof(shared::CameraPoint) + PointIndex::pointBytes(); }
    static size_t borderBytes() { return sizeof(shared::PointBorder); }

private:
    void beginPass(unsigned pass, const std::array<float, LIGHT_CLASSES>& radius, float volumeScale);
    std::vector<shared::PointRegionCount> traceCameraPoints();
    unsigned pathsPerPixel() const { return cameraParams_.scene.meter.samples; }
    void makeRegions(); // of points as traced, for the capacity of the regions
    void splatPhotons(CameraMapPassCount& total);

    Device& device_;
    const GeometryBuffers& geometry_;
    Film& film_;
    Kernel traceCameraPoints_, addSamples_, splatPhotons_;
    PointIndex index_;
    shared::CameraParams cameraParams_;
    shared::PhotonParams photonParams_;
    shared::PointParams points_{}; // with a copy of the index's map
    unsigned classes_;             // bits 1 << slot
    Buffer<shared::CameraPoint> traced_;
    Buffer<shared::PointBorder> borders_;
    Buffer<shared::PointRegionCount> regions_;
    Buffer<shared::RegionCount> photonRegions_;
    Buffer<float> samples_;
    Buffer<uint32_t> sums_;
};

} // namespace quasilux
