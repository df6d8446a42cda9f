#include "bench/micro/embree_scene.h"

#include "bench/micro/stopwatch.h"

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

/// RTCRay8 begins with the fields of a RayPacket, but for tfar.
void fill(const RayPacket& packet, RTCRay8& ray) {
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

alignas(32) constexpr int allLanes[packetSize] = {-1, -1, -1, -1, -1, -1, -1, -1};

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

void EmbreeScene::closest(const RayPacket* rays, HitPacket* hits, size_t packets, bool coherent) const {
    RTCIntersectContext context = contextFor(coherent);
    RTCRayHit8 query;
    for (size_t i = 0; i < packets; ++i) {
        fill(rays[i], query.ray);
        std::memset(query.hit.geomID, 0xff, sizeof query.hit.geomID);
        std::memset(query.hit.primID, 0xff, sizeof query.hit.primID); // of a miss: QL_NONE
        rtcIntersect8(allLanes, scene_->scene, &context, &query);
        std::memcpy(hits[i].t, query.ray.tfar, sizeof hits[i].t);
        std::memcpy(hits[i].u, query.hit.u, sizeof hits[i].u);
        std::memcpy(hits[i].v, query.hit.v, sizeof hits[i].v);
        std::memcpy(hits[i].primitive, query.hit.primID, sizeof hits[i].primitive);
    }
}

void EmbreeScene::occluded(const RayPacket* rays, unsigned* blocked, size_t packets, bool coherent) const {
    RTCIntersectContext context = contextFor(coherent);
    RTCRay8 query;
    for (size_t i = 0; i < packets; ++i) {
        fill(rays[i], query);
        rtcOccluded8(allLanes, scene_->scene, &context, &query);
        for (size_t lane = 0; lane < packetSize; ++lane) blocked[packetSize * i + lane] = query.tfar[lane] < 0 ? 1 : 0;
    }
}

std::vector<RayPacket> packetsOf(const std::vector<MicroRay>& rays) {
    std::vector<RayPacket> packets(rays.size() / packetSize);
    for (size_t i = 0; i < packetSize * packets.size(); ++i) {
        RayPacket& packet = packets[i / packetSize];
        const size_t lane = i % packetSize;
        for (int axis = 0; axis < 3; ++axis) {
            packet.origin[axis][lane] = rays[i].origin[axis];
            packet.direction[axis][lane] = rays[i].direction[axis];
        }
        packet.tMin[lane] = rays[i].tMin;
        packet.tMax[lane] = rays[i].tMax;
    }
    return packets;
}

} // namespace quasilux
