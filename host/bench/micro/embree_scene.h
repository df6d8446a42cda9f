// Embree as a user would call it: the measure of our traversal, in speed and in what it finds.
#pragma once

#include "bench/micro/ray_types.h"
#include "prepare/bvh.h"

#include <memory>

namespace quasilux {

/// Triangles alone: no spheres, no null primitives.
class EmbreeScene {
public:
    explicit EmbreeScene(const std::vector<BvhPrimitive>& triangles);
    EmbreeScene(EmbreeScene&&) noexcept;
    ~EmbreeScene();

    MicroHit closest(const MicroRay& ray) const;
    bool occluded(const MicroRay& ray) const;

    /// Runs of rays through rtcIntersect1, rtcOccluded1 and their forms for packets of 8 and 16 rays. `coherent` tells
    /// Embree that the rays of a packet lie close together.
    void closest(const MicroRay* rays, MicroHit* hits, size_t count) const;
    void occluded(const MicroRay* rays, unsigned* blocked, size_t count) const;
    template <unsigned size>
    void closest(const RayPacket<size>* rays, HitPacket<size>* hits, size_t packets, bool coherent) const;
    template <unsigned size>
    void occluded(const RayPacket<size>* rays, unsigned* blocked, size_t packets, bool coherent) const;

    /// Processor and clock seconds of rtcCommitScene.
    double commitProcessorSeconds() const;
    double commitSeconds() const;

private:
    struct Scene;
    std::unique_ptr<Scene> scene_;
};

} // namespace quasilux
