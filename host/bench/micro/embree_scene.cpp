#include "bench/micro/embree_scene.h"

#include "util/stopwatch.h"

#include <algorithm>
#include <cstring>
#include <embree3/rtcore.h>

namespace quasilux {

struct EmbreeScene::Scene {
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene scene = rtcNewScene(device);
    double processorSeconds = 0, seconds = 0;
    ~Scene() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
};

namespace {

RTCRay embreeRay(const MicroRay& ray) {
    RTCRay result{};
    result.org_x = ray.origin.x, result.org_y = ray.origin.y, result.org_z = ray.origin.z;
    result.dir_x = ray.direction.x, result.dir_y = ray.direction.y, result.dir_z = ray.direction.z;
    result.tnear = ray.tMin, result.tfar = ray.tMax;
    result.mask = ~0u;
    return result;
}

template <unsigned size>
struct EmbreePacket;
template <>
struct EmbreePacket<8> {
    using Ray = RTCRay8;
    using RayHit = RTCRayHit8;
    static constexpr auto intersect = rtcIntersect8;
    static constexpr auto occluded = rtcOccluded8;
};
template <>
struct EmbreePacket<16> {
    using Ray = RTCRay16;
    using RayHit = RTCRayHit16;
    static constexpr auto intersect = rtcIntersect16;
    static constexpr auto occluded = rtcOccluded16;
};

/// RTCRay8 and RTCRay16 begin with the fields of a RayPacket, but for tfar.
template <unsigned size>
void fill(const RayPacket<size>& packet, typename EmbreePacket<size>::Ray& ray) {
    std::memcpy(ray.org_x, packet.origin, sizeof packet.origin);
    std::memcpy(ray.tnear, packet.tMin, sizeof packet.tMin);
    std::memcpy(ray.dir_x, packet.direction, sizeof packet.direction);
    std::memset(ray.time, 0, sizeof ray.time);
    std::memcpy(ray.tfar, packet.tMax, sizeof packet.tMax);
    std::memset(ray.mask, 0xff, sizeof ray.mask);
    std::memset(ray.id, 0, sizeof ray.id);
    std::memset(ray.flags, 0, sizeof ray.flags);
}

RTCIntersectContext contextFor(bool coherent) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    return context;
}

alignas(64) constexpr int allLanes[16] = {-1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1};

MicroHit intersect(RTCScene scene, RTCIntersectContext& context, const MicroRay& ray) {
    RTCRayHit query;
    query.ray = embreeRay(ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {ray.tMax, 0, 0, QL_NONE, QL_NONE};
    return {query.ray.tfar, query.hit.u, query.hit.v, QL_NONE, query.hit.primID};
}

bool occlude(RTCScene scene, RTCIntersectContext& context, const MicroRay& ray) {
    RTCRay query = embreeRay(ray);
    rtcOccluded1(scene, &context, &query);
    return query.tfar < 0;
}

} // namespace

EmbreeScene::EmbreeScene(const std::vector<BvhPrimitive>& triangles) : scene_(std::make_unique<Scene>()) {
    RTCGeometry geometry = rtcNewGeometry(scene_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), 3 * triangles.size()));
    auto* indices = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), triangles.size()));
    for (unsigned i = 0; i < triangles.size(); ++i) {
        vertices[3 * i] = triangles[i].v0;
        vertices[3 * i + 1] = triangles[i].v1;
        vertices[3 * i + 2] = triangles[i].v2;
        indices[i] = {3 * i, 3 * i + 1, 3 * i + 2};
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_->scene, geometry);
    rtcReleaseGeometry(geometry);
    const Stopwatch watch;
    rtcCommitScene(scene_->scene);
    scene_->processorSeconds = watch.processorSeconds();
    scene_->seconds = watch.seconds();
}

EmbreeScene::EmbreeScene(EmbreeScene&&) noexcept = default;
EmbreeScene::~EmbreeScene() = default;

double EmbreeScene::commitProcessorSeconds() const { return scene_->processorSeconds; }
double EmbreeScene::commitSeconds() const { return scene_->seconds; }

MicroHit EmbreeScene::closest(const MicroRay& ray) const {
    MicroHit hit;
    closest(&ray, &hit, 1);
    return hit;
}

bool EmbreeScene::occluded(const MicroRay& ray) const {
    unsigned blocked;
    occluded(&ray, &blocked, 1);
    return blocked != 0;
}

void EmbreeScene::closest(const MicroRay* rays, MicroHit* hits, size_t count) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (size_t i = 0; i < count; ++i) hits[i] = intersect(scene_->scene, context, rays[i]);
}

void EmbreeScene::occluded(const MicroRay* rays, unsigned* blocked, size_t count) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (size_t i = 0; i < count; ++i) blocked[i] = occlude(scene_->scene, context, rays[i]) ? 1 : 0;
}

template <unsigned size>
void EmbreeScene::closest(const RayPacket<size>* rays, HitPacket<size>* hits, size_t packets, bool coherent) const {
    RTCIntersectContext context = contextFor(coherent);
    typename EmbreePacket<size>::RayHit query;
    for (size_t i = 0; i < packets; ++i) {
        fill(rays[i], query.ray);
        std::memset(query.hit.geomID, 0xff, sizeof query.hit.geomID);
        std::memset(query.hit.primID, 0xff, sizeof query.hit.primID); // of a miss: QL_NONE
        EmbreePacket<size>::intersect(allLanes, scene_->scene, &context, &query);
        std::memcpy(hits[i].t, query.ray.tfar, sizeof hits[i].t);
        std::memcpy(hits[i].u, query.hit.u, sizeof hits[i].u);
        std::memcpy(hits[i].v, query.hit.v, sizeof hits[i].v);
        std::memcpy(hits[i].primitive, query.hit.primID, sizeof hits[i].primitive);
    }
}

template <unsigned size>
void EmbreeScene::occluded(const RayPacket<size>* rays, unsigned* blocked, size_t packets, bool coherent) const {
    RTCIntersectContext context = contextFor(coherent);
    typename EmbreePacket<size>::Ray query;
    for (size_t i = 0; i < packets; ++i) {
        fill(rays[i], query);
        EmbreePacket<size>::occluded(allLanes, scene_->scene, &context, &query);
        for (size_t lane = 0; lane < size; ++lane) blocked[size * i + lane] = query.tfar[lane] < 0 ? 1 : 0;
    }
}

template void EmbreeScene::closest(const RayPacket<8>*, HitPacket<8>*, size_t, bool) const;
template void EmbreeScene::closest(const RayPacket<16>*, HitPacket<16>*, size_t, bool) const;
template void EmbreeScene::occluded(const RayPacket<8>*, unsigned*, size_t, bool) const;
template void EmbreeScene::occluded(const RayPacket<16>*, unsigned*, size_t, bool) const;

} // namespace quasilux
