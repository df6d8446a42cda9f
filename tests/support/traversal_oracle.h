// What a traversal must answer: Embree on the host, and a slow check in double precision that decides where they
// differ.
#pragma once

#include "bench/micro/embree_scene.h"

#include <array>
#include <string>
#include <vector>

namespace quasilux {

using TestRay = MicroRay;
using TestHit = MicroHit;
using EmbreeOracle = EmbreeScene;

/// Where a ray meets a primitive, in double precision. `undecided`: no condition of the hit fails by more than what
/// single precision can err by, and at least one is within that of failing (docs/method/traversal.md, "When two answers
/// tie").
struct ExactHit {
    enum class Verdict { miss, undecided, hit };
    Verdict verdict = Verdict::miss;
    double t = 0;
    double tError = 0; ///< what single precision may make of t; infinite for a ray nearly in the plane
};

/// A triangle gives at most the first, a sphere both.
std::array<ExactHit, 2> exactHits(const BvhPrimitive& primitive, const TestRay& ray);

/// Checks an answer against all primitives; empty if it is right within rounding, else what is wrong.
/// `passNull` leaves null primitives out.
std::string faultOfClosest(const std::vector<BvhPrimitive>& primitives, const TestRay& ray, const TestHit& answer,
                           bool passNull = false);
std::string faultOfOcclusion(const std::vector<BvhPrimitive>& primitives, const TestRay& ray, bool answer);

/// Answers to many rays, sorted by how they compare with Embree's.
struct RayComparison {
    size_t rays = 0, hits = 0;
    size_t equalDistance = 0; ///< another primitive at the same distance to 1e-5: duplicates, shared edges
    size_t undecided = 0;     ///< the answers differ and both are right within rounding
    size_t embreeFaults = 0;  ///< the answers differ, only ours is right within rounding
    size_t mismatches = 0;    ///< ours is wrong
    std::string firstMismatch;

    void addMismatch(const std::string& what);
};
RayComparison compareClosest(const std::vector<BvhPrimitive>& triangles, const EmbreeOracle& embree,
                             const std::vector<TestRay>& rays, const std::vector<TestHit>& answers);
RayComparison compareOcclusion(const std::vector<BvhPrimitive>& triangles, const EmbreeOracle& embree,
                               const std::vector<TestRay>& rays, const std::vector<unsigned>& answers);
std::ostream& operator<<(std::ostream& stream, const RayComparison& comparison);

} // namespace quasilux
