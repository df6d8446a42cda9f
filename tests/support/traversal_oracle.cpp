#include "support/traversal_oracle.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <ostream>

namespace quasilux {
namespace {

using glm::dvec3;

// Sixteen units of 2^-24: each quantity below is a product of three lengths, with about ten rounded operations behind
// it.
constexpr double rounding = 1e-6;
constexpr double sameDistance = 1e-5;

/// Distance of a condition (positive = fulfilled) from failing, in units of its rounding error.
class Conditions {
public:
    void require(double value, double error) {
        if (!(value >= -error)) failed_ = true;
        if (!(value > error)) close_ = true;
    }
    ExactHit::Verdict verdict() const {
        return failed_ ? ExactHit::Verdict::miss : close_ ? ExactHit::Verdict::undecided : ExactHit::Verdict::hit;
    }

private:
    bool failed_ = false, close_ = false;
};

ExactHit exactTriangle(const BvhPrimitive& primitive, const TestRay& ray) {
    const dvec3 d(ray.direction), c = dvec3(primitive.v0) - dvec3(ray.origin);
    const dvec3 e1 = dvec3(primitive.v1) - dvec3(primitive.v0), e2 = dvec3(primitive.v2) - dvec3(primitive.v0);
    const dvec3 normal = glm::cross(e1, e2), r = glm::cross(c, d);
    const double length1 = glm::length(e1), length2 = glm::length(e2), lengthC = glm::length(c),
                 lengthD = glm::length(d);
    const double signedDeterminant = glm::dot(normal, d), sign = signedDeterminant < 0 ? -1 : 1;
    const double determinant = sign * signedDeterminant, determinantError = rounding * length1 * length2 * lengthD;
    const double u = sign * glm::dot(e2, r), uError = rounding * length2 * lengthC * lengthD;
    const double v = -sign * glm::dot(e1, r), vError = rounding * length1 * lengthC * lengthD;
    const double scaledT = sign * glm::dot(normal, c), scaledTError = rounding * length1 * length2 * lengthC;

    ExactHit hit;
    if (determinant == 0) return hit;
    Conditions conditions;
    conditions.require(determinant, determinantError);
    conditions.require(u, uError);
    conditions.require(v, vError);
    conditions.require(determinant - u - v, determinantError + uError + vError);
    conditions.require(scaledT - ray.tMin * determinant, scaledTError + ray.tMin * determinantError);
    if (std::isfinite(ray.tMax))
        conditions.require(ray.tMax * determinant - scaledT, scaledTError + ray.tMax * determinantError);
    hit.verdict = conditions.verdict();
    hit.t = scaledT / determinant;
    hit.tError = determinant > determinantError
                     ? (scaledTError + std::abs(hit.t) * determinantError) / (determinant - determinantError)
                     : std::numeric_limits<double>::infinity();
    return hit;
}

std::array<ExactHit, 2> exactSphere(const BvhPrimitive& primitive, const TestRay& ray) {
    std::array<ExactHit, 2> hits;
    const dvec3 d(ray.direction), c = dvec3(primitive.v0) - dvec3(ray.origin);
    const double radius = primitive.v1.x, lengthD = glm::length(d);
    const double foot = glm::dot(c, d) / (lengthD * lengthD), distance = glm::length(c - foot * d);
    const double error = rounding * (glm::length(c) + radius);
    const double halfChord = std::sqrt(std::max(0.0, radius * radius - distance * distance));
    for (int i = 0; i < 2; ++i) {
        ExactHit& hit = hits[i];
        hit.t = foot + (i == 0 ? -halfChord : halfChord) / lengthD;
        // The chord moves by distance / halfChord times the error of the distance; at the rim, by its root.
        hit.tError = error * (1 + radius / std::max(halfChord, std::sqrt(error * radius))) / lengthD;
        Conditions conditions;
        conditions.require(radius - distance, error);
        conditions.require(hit.t - ray.tMin, hit.tError);
        if (std::isfinite(ray.tMax)) conditions.require(ray.tMax - hit.t, hit.tError);
        hit.verdict = conditions.verdict();
    }
    return hits;
}

bool agree(float a, float b) { return std::abs(a - b) <= sameDistance * std::max(std::abs(a), std::abs(b)); }

std::string text(const TestRay& ray) {
    return fmt::format("ray ({}, {}, {}) + t ({}, {}, {}), {} < t <= {}", ray.origin.x, ray.origin.y, ray.origin.z,
                       ray.direction.x, ray.direction.y, ray.direction.z, ray.tMin, ray.tMax);
}

} // namespace

std::array<ExactHit, 2> exactHits(const BvhPrimitive& primitive, const TestRay& ray) {
    return primitive.isSphere ? exactSphere(primitive, ray) : std::array{exactTriangle(primitive, ray), ExactHit{}};
}

std::string faultOfClosest(const std::vector<BvhPrimitive>& primitives, const TestRay& ray, const TestHit& answer,
                           bool passNull) {
    if (!answer.missed()) {
        if (answer.index() >= primitives.size())
            return fmt::format("no such primitive {}: {}", answer.index(), text(ray));
        if (passNull && primitives[answer.index()].isNull) return fmt::format("null primitive met: {}", text(ray));
        const auto hits = exactHits(primitives[answer.index()], ray);
        const bool isSound = std::any_of(hits.begin(), hits.end(), [&](const ExactHit& hit) {
            return hit.verdict != ExactHit::Verdict::miss &&
                   std::abs(answer.t - hit.t) <= std::max(hit.tError, sameDistance * std::abs(hit.t));
        });
        if (!isSound) return fmt::format("false hit of {} at {}: {}", answer.index(), answer.t, text(ray));
    }
    for (size_t i = 0; i < primitives.size(); ++i) {
        if (passNull && primitives[i].isNull) continue;
        for (const ExactHit& hit : exactHits(primitives[i], ray))
            if (hit.verdict == ExactHit::Verdict::hit &&
                (answer.missed() || hit.t + hit.tError < answer.t * (1 - sameDistance)))
                return fmt::format("passed through {} at {}: {}", i, hit.t, text(ray));
    }
    return "";
}

std::string faultOfOcclusion(const std::vector<BvhPrimitive>& primitives, const TestRay& ray, bool answer) {
    auto strongest = ExactHit::Verdict::miss;
    for (const BvhPrimitive& primitive : primitives) {
        if (primitive.isNull) continue;
        for (const ExactHit& hit : exactHits(primitive, ray)) strongest = std::max(strongest, hit.verdict);
    }
    if (answer && strongest == ExactHit::Verdict::miss) return "occluded by nothing: " + text(ray);
    if (!answer && strongest == ExactHit::Verdict::hit) return "not occluded: " + text(ray);
    return "";
}

void RayComparison::addMismatch(const std::string& what) {
    if (mismatches++ == 0) firstMismatch = what;
}

RayComparison compareClosest(const std::vector<BvhPrimitive>& triangles, const EmbreeOracle& embree,
                             const std::vector<TestRay>& rays, const std::vector<TestHit>& answers) {
    RayComparison result;
    result.rays = rays.size();
    for (size_t i = 0; i < rays.size(); ++i) {
        const TestHit& ours = answers[i];
        const TestHit theirs = embree.closest(rays[i]);
        if (!ours.missed()) ++result.hits;
        if (ours.missed() && theirs.missed()) continue;
        if (!ours.missed() && !theirs.missed() && agree(ours.t, theirs.t)) {
            if (ours.index() == theirs.index()) continue;
            const bool isSound = exactHits(triangles.at(ours.index()), rays[i])[0].verdict != ExactHit::Verdict::miss;
            if (isSound)
                ++result.equalDistance;
            else
                result.addMismatch("false hit: " + text(rays[i]));
            continue;
        }
        if (const std::string fault = faultOfClosest(triangles, rays[i], ours); !fault.empty())
            result.addMismatch(fault);
        else if (faultOfClosest(triangles, rays[i], theirs).empty())
            ++result.undecided;
        else
            ++result.embreeFaults;
    }
    return result;
}

RayComparison compareOcclusion(const std::vector<BvhPrimitive>& triangles, const EmbreeOracle& embree,
                               const std::vector<TestRay>& rays, const std::vector<unsigned>& answers) {
    RayComparison result;
    result.rays = rays.size();
    for (size_t i = 0; i < rays.size(); ++i) {
        const bool ours = answers[i] != 0, theirs = embree.occluded(rays[i]);
        if (ours) ++result.hits;
        if (ours == theirs) continue;
        if (const std::string fault = faultOfOcclusion(triangles, rays[i], ours); !fault.empty())
            result.addMismatch(fault);
        else if (faultOfOcclusion(triangles, rays[i], theirs).empty())
            ++result.undecided;
        else
            ++result.embreeFaults;
    }
    return result;
}

std::ostream& operator<<(std::ostream& stream, const RayComparison& comparison) {
    return stream << fmt::format(
               "{} rays, {} hits, {} at equal distance, {} undecided, {} Embree faults, {} mismatches {}",
               comparison.rays, comparison.hits, comparison.equalDistance, comparison.undecided,
               comparison.embreeFaults, comparison.mismatches, comparison.firstMismatch);
}

} // namespace quasilux
