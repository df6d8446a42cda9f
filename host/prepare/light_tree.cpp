#include "prepare/light_tree.h"

#include "prepare/pack.h"
#include "scene/box.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace quasilux {

namespace {

// What one emitter has of a node.
struct Light {
    Box bounds;
    glm::dvec3 axis{0, 0, 1};
    double spread = 0, power = 0;
};

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
}

glm::dvec3 directionOf(const glm::dvec3& v) { return glm::length(v) > 0 ? glm::normalize(v) : glm::dvec3(0, 0, 1); }

Light lightOfTriangles(const shared::Emitter& emitter, const std::vector<shared::EmitterTriangle>& triangles) {
    Light light;
    std::vector<glm::dvec3> normals;
    glm::dvec3 sum(0);
    for (unsigned k = 0; k < emitter.triangleCount; ++k) {
        const auto& triangle = triangles[emitter.firstTriangle + k];
        const glm::dvec3 p0 = unpack(triangle.p0), e1 = unpack(triangle.e1), e2 = unpack(triangle.e2);
        for (const glm::dvec3& corner : {p0, p0 + e1, p0 + e2}) light.bounds.add(corner);
        normals.push_back(glm::cross(e1, e2));
        sum += normals.back();
    }
    light.axis = directionOf(sum);
    for (const glm::dvec3& normal : normals)
        if (glm::length(normal) > 0)
            light.spread = std::max(light.spread, angleBetween(light.axis, glm::normalize(normal)));
    return light;
}

Light lightOf(const shared::Emitter& emitter, const std::vector<shared::EmitterTriangle>& triangles) {
    if (emitter.type == EMITTER_TRIANGLES || emitter.type == EMITTER_DIRECTIONALAREA)
        return lightOfTriangles(emitter, triangles);
    Light light;
    const glm::dvec3 origin = unpack(emitter.origin);
    if (emitter.type == EMITTER_RECTANGLE) {
        const glm::dvec3 u = unpack(emitter.edgeU), v = unpack(emitter.edgeV);
        for (const glm::dvec3& corner : {origin, origin + u, origin + v, origin + u + v}) light.bounds.add(corner);
        light.axis = unpack(emitter.normal);
    } else { // a sphere, a point
        light.bounds.add(origin - double(emitter.radius));
        light.bounds.add(origin + double(emitter.radius));
        light.spread = std::numbers::pi;
        if (emitter.type == EMITTER_PROJECTOR) {
            light.axis = unpack(emitter.normal);
            light.spread = 0;
        } else if (emitter.type == EMITTER_GONIOGRAM) {
            light.axis = unpack(emitter.normal);
            light.spread = emitter.cutoffAngle;
        } else if (emitter.type == EMITTER_SPOT) { // as a surface that looks along the axis
            light.axis = unpack(emitter.normal);
            light.spread = std::max(0.0, emitter.cutoffAngle - std::numbers::pi / 2);
        }
    }
    return light;
}

class Builder {
public:
    explicit Builder(const EmitterTables& emitters) : order_(emitters.emitters.size()) {
        for (size_t k = 0; k < order_.size(); ++k) {
            lights_.push_back(lightOf(emitters.emitters[k], emitters.triangles));
            lights_.back().power = emitters.power[k];
        }
        std::iota(order_.begin(), order_.end(), 0u);
        if (!order_.empty()) build(order_.begin(), order_.end());
    }

    LightTree take() { return {std::move(order_), std::move(nodes_)}; }

private:
    using At = std::vector<unsigned>::iterator;

    void build(At first, At end) {
        nodes_.push_back(nodeOf(first, end));
        if (end - first == 1) return;
        Box centres;
        for (At k = first; k != end; ++k) centres.add(lights_[*k].bounds.center());
        const int axis = longestAxis(centres.extent());
        const At middle = first + (end - first) / 2;
        std::nth_element(first, middle, end, [&](unsigned a, unsigned b) {
            return std::pair(lights_[a].bounds.center()[axis], a) < std::pair(lights_[b].bounds.center()[axis], b);
        });
        build(first, middle);
        build(middle, end);
    }

    shared::LightNode nodeOf(At first, At end) const {
        Light all;
        glm::dvec3 axes(0);
        for (At k = first; k != end; ++k) {
            const Light& light = lights_[*k];
            all.bounds.add(light.bounds);
            all.power += light.power;
            axes += light.power * light.axis;
        }
        all.axis = directionOf(axes);
        for (At k = first; k != end; ++k)
            all.spread = std::max(all.spread, angleBetween(lights_[*k].axis, all.axis) + lights_[*k].spread);
        const double spread = std::min(all.spread, std::numbers::pi);
        return {pack(all.bounds.lower),
                pack(all.bounds.upper),
                pack(all.axis),
                static_cast<float>(std::cos(spread)),
                static_cast<float>(std::sin(spread)),
                static_cast<float>(all.power)};
    }

    std::vector<Light> lights_;
    std::vector<unsigned> order_;
    std::vector<shared::LightNode> nodes_;
};

} // namespace

LightTree buildLightTree(const EmitterTables& emitters) { return Builder(emitters).take(); }

} // namespace quasilux
