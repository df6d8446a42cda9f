#include "learn/ray_plane.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace quasilux {

namespace {

constexpr size_t raysLookedAt = 1000;
constexpr double outliers = 0.02; // share of the weight on either side that bounds leave out
constexpr double nearMedians = 2; // rays that pass the centre further away than so many medians come through elsewhere
constexpr int reweightings = 20;
constexpr int turns = 16;         // of axes in a quarter
constexpr int normals = 48;       // tried on a hemisphere, beside the world's axes and the mean direction

// At most raysLookedAt of them, evenly chosen.
std::vector<UsefulRay> thinned(const std::vector<UsefulRay>& rays) {
    const size_t step = rays.size() / raysLookedAt + 1;
    std::vector<UsefulRay> some;
    for (size_t k = 0; k < rays.size(); k += step) some.push_back(rays[k]);
    return some;
}

glm::dvec3 weightedMean(const std::vector<UsefulRay>& rays, glm::dvec3 UsefulRay::*what) {
    glm::dvec3 sum{0};
    double weight = 0;
    for (const auto& ray : rays) {
        sum += ray.weight * (ray.*what);
        weight += ray.weight;
    }
    return sum / weight;
}

glm::dvec3 across(const UsefulRay& ray, const glm::dvec3& v) { return v - glm::dot(ray.direction, v) * ray.direction; }

// Where the sum of distances to the rays is least (by least squares, reweighted), so that rays which come through elsewhere do not
// count much; along directions that they leave open, next to where they begin.
glm::dvec3 nearestPlace(const std::vector<UsefulRay>& rays) {
    const glm::dvec3 middle = weightedMean(rays, &UsefulRay::position);
    glm::dvec3 place(0);
    for (int k = 0; k < reweightings; ++k) {
        glm::dmat3 matrix(0);
        glm::dvec3 right(0);
        double all = 0;
        for (const auto& ray : rays) {
            const double distance = glm::length(across(ray, place + middle - ray.position));
            const double weight = k == 0 ? ray.weight : ray.weight / std::max(distance, 1e-9);
            matrix += weight * (glm::dmat3(1) - glm::outerProduct(ray.direction, ray.direction));
            right += weight * across(ray, ray.position - middle);
            all += weight;
        }
        matrix += glm::dmat3(1e-6 * all);
        place = glm::inverse(matrix) * right;
    }
    return middle + place;
}

std::vector<UsefulRay> raysNear(const std::vector<UsefulRay>& rays, const glm::dvec3& centre) {
    std::vector<std::pair<double, double>> distances;
    double all = 0, below = 0, median = 0;
    for (const auto& ray : rays) {
        distances.emplace_back(glm::length(across(ray, ray.position - centre)), ray.weight);
        all += ray.weight;
    }
    auto sorted = distances;
    std::sort(sorted.begin(), sorted.end());
    for (const auto& [distance, weight] : sorted) {
        median = distance;
        below += weight;
        if (below >= all / 2) break;
    }
    std::vector<UsefulRay> some;
    for (size_t k = 0; k < rays.size(); ++k)
        if (distances[k].first <= nearMedians * median) some.push_back(rays[k]);
    return some;
}

glm::dvec3 anyAcross(const glm::dvec3& n) {
    return glm::normalize(glm::cross(n, std::abs(n.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
}

struct Bounds {
    double lower = 0, upper = 0;
    double half() const { return (upper - lower) / 2; }
};

// Between quantiles of the weight.
Bounds boundsOf(std::vector<std::pair<double, double>>& placesAndWeights) {
    std::sort(placesAndWeights.begin(), placesAndWeights.end());
    double all = 0, below = 0;
    for (const auto& [place, weight] : placesAndWeights) all += weight;
    Bounds bounds{placesAndWeights.front().first, placesAndWeights.back().first};
    for (const auto& [place, weight] : placesAndWeights) {
        if (below <= outliers * all) bounds.lower = place;
        bounds.upper = place;
        below += weight;
        if (below >= (1 - outliers) * all) break;
    }
    return bounds;
}

// The rays' places on the plane through `centre` across `normal`, with axes turned by `turn`.
RayPlane boundedPlane(const std::vector<UsefulRay>& rays, const glm::dvec3& centre, const glm::dvec3& normal,
                      double turn) {
    const glm::dvec3 s = anyAcross(normal), t = glm::cross(normal, s);
    RayPlane plane;
    plane.axisU = std::cos(turn) * s + std::sin(turn) * t;
    plane.axisV = glm::cross(normal, plane.axisU);
    std::vector<std::pair<double, double>> u, v;
    for (const auto& ray : rays) {
        const double slope = glm::dot(ray.direction, normal);
        if (std::abs(slope) < 1e-3) continue;
        const glm::dvec3 offset = ray.position - centre;
        const glm::dvec3 place = offset - glm::dot(offset, normal) / slope * ray.direction;
        u.emplace_back(glm::dot(place, plane.axisU), ray.weight);
        v.emplace_back(glm::dot(place, plane.axisV), ray.weight);
    }
    if (u.empty()) {
        plane.centre = centre;
        plane.halfU = plane.halfV = std::numeric_limits<double>::infinity();
        return plane;
    }
    const Bounds alongU = boundsOf(u), alongV = boundsOf(v);
    plane.centre = centre + (alongU.lower + alongU.half()) * plane.axisU + (alongV.lower + alongV.half()) * plane.axisV;
    plane.halfU = alongU.half();
    plane.halfV = alongV.half();
    return plane;
}

double meanCosine(const std::vector<UsefulRay>& rays, const glm::dvec3& normal) {
    double sum = 0, weight = 0;
    for (const auto& ray : rays) {
        sum += ray.weight * std::abs(glm::dot(ray.direction, normal));
        weight += ray.weight;
    }
    return sum / weight;
}

std::vector<glm::dvec3> candidateNormals(const std::vector<UsefulRay>& rays) {
    std::vector<glm::dvec3> candidates = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const glm::dvec3 mean = weightedMean(rays, &UsefulRay::direction);
    if (glm::length(mean) > 1e-3) candidates.push_back(glm::normalize(mean));
    for (int k = 0; k < normals; ++k) { // a spiral with even steps in z
        const double z = (k + 0.5) / normals, phi = k * std::numbers::pi * (3 - std::sqrt(5.0));
        const double r = std::sqrt(1 - z * z);
        candidates.emplace_back(r * std::cos(phi), r * std::sin(phi), z);
    }
    return candidates;
}

} // namespace

RayPlane fitRayPlane(const std::vector<UsefulRay>& rays) {
    const auto thin = thinned(rays);
    const glm::dvec3 centre = nearestPlace(thin);
    const auto some = raysNear(thin, centre);
    RayPlane best;
    double least = std::numeric_limits<double>::infinity();
    const auto consider = [&](const glm::dvec3& normal, double turn) {
        const RayPlane plane = boundedPlane(some, centre, normal, turn);
        const double flux = plane.area() * meanCosine(some, normal);
        if (flux >= least) return;
        least = flux;
        best = plane;
    };
    for (const auto& normal : candidateNormals(some)) consider(normal, 0);
    const glm::dvec3 normal = glm::cross(best.axisU, best.axisV);
    for (int k = 1; k < turns; ++k) consider(normal, k * std::numbers::pi / 2 / turns);
    // The world's axes may lie in it.
    for (const glm::dvec3 axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)}) {
        const glm::dvec3 s = anyAcross(normal), t = glm::cross(normal, s);
        if (std::abs(glm::dot(axis, normal)) < 0.9) consider(normal, std::atan2(glm::dot(axis, t), glm::dot(axis, s)));
    }
    return best;
}

} // namespace quasilux
