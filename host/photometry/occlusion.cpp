// By Embree's own tree and traversal.
#include "photometry/occlusion.h"

#include "prepare/device_scene.h"

#include <embree3/rtcore.h>

namespace quasilux {

namespace {

// Of the distance, at both ends.
constexpr float endShare = 1e-4F;

template <typename Element>
Element* newBuffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, size_t count) {
    return static_cast<Element*>(rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Element), count));
}

void attach(RTCGeometry geometry, RTCScene scene) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
}

void attachPrimitives(const std::vector<BvhPrimitive>& primitives, RTCDevice device, RTCScene scene) {
    std::vector<glm::vec3> corners;
    std::vector<glm::vec4> spheres;
    for (const BvhPrimitive& primitive : primitives) {
        if (primitive.isNull) continue;
        if (primitive.isSphere)
            spheres.emplace_back(primitive.v0, primitive.v1.x);
        else
            corners.insert(corners.end(), {primitive.v0, primitive.v1, primitive.v2});
    }
    if (!corners.empty()) {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        std::copy(corners.begin(), corners.end(),
                  newBuffer<glm::vec3>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, corners.size()));
        auto* indices = newBuffer<glm::uvec3>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, corners.size() / 3);
        for (unsigned k = 0; k < corners.size() / 3; ++k) indices[k] = {3 * k, 3 * k + 1, 3 * k + 2};
        attach(geometry, scene);
    }
    if (!spheres.empty()) {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
        std::copy(spheres.begin(), spheres.end(),
                  newBuffer<glm::vec4>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, spheres.size()));
        attach(geometry, scene);
    }
    rtcCommitScene(scene);
}

} // namespace

struct Occlusion::Tree {
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene scene = rtcNewScene(device);
    std::vector<RTCScene> groups;
    Tree() = default;
    Tree(const Tree&) = delete;
    Tree& operator=(const Tree&) = delete;
    ~Tree() {
        rtcReleaseScene(scene);
        for (RTCScene group : groups) rtcReleaseScene(group);
        rtcReleaseDevice(device);
    }

    void attachInstance(const Instance& instance) {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(geometry, groups[instance.group]);
        rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &instance.toWorld);
        attach(geometry, scene);
    }
};

Occlusion::Occlusion(const Scene& scene) : tree_(std::make_unique<Tree>()) {
    for (const ShapeGroup& group : scene.groups) {
        tree_->groups.push_back(rtcNewScene(tree_->device));
        attachPrimitives(flattenPrimitives(scene, scene.shapesOf(group)), tree_->device, tree_->groups.back());
    }
    for (const Instance& instance : scene.instances) tree_->attachInstance(instance);
    attachPrimitives(flattenPrimitives(scene, scene.worldShapes()), tree_->device, tree_->scene);
}

Occlusion::~Occlusion() = default;

bool Occlusion::isHidden(const glm::dvec3& from, const glm::dvec3& to) const {
    const glm::dvec3 way = to - from;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray{};
    ray.org_x = static_cast<float>(from.x), ray.org_y = static_cast<float>(from.y),
    ray.org_z = static_cast<float>(from.z);
    ray.dir_x = static_cast<float>(way.x), ray.dir_y = static_cast<float>(way.y), ray.dir_z = static_cast<float>(way.z);
    ray.tnear = endShare, ray.tfar = 1 - endShare;
    ray.mask = ~0u;
    rtcOccluded1(tree_->scene, &context, &ray);
    return ray.tfar < 0;
}

} // namespace quasilux
