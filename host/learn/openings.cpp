#include "learn/openings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <utility>

namespace quasilux {

namespace {

constexpr size_t raysLookedAt = 600;
constexpr size_t candidates = 150;      // places that are tried for an opening's centre
constexpr size_t fewestRays = 32;       // about a place that may be one
constexpr double widestBall = 0.01;     // chance of passing it above which little is to be gained by aiming
constexpr double mostCopies = 4;        // of a ray in a sample: a single one is no opening
constexpr int refinements = 4;          // of the best place
constexpr double margin = 1.25;         // of an opening's region to what its rays come through
constexpr double muchNarrower = 0.5;    // flux of a rectangle to that of a square that faces its rays
constexpr double nearestOpening = 1e-3; // to where rays begin, relative to coordinates
constexpr double outliers = 0.01;       // share of the weight on either side that bounds leave out
constexpr int turns = 16;               // of axes in a quarter
constexpr int normals = 48;             // tried on a hemisphere, beside the world's axes
// Most windows are upright. A sample of rays fills an upright rectangle but roughly, and one that is turned about them
// is often a little smaller: photons through the corners that it cuts off would be heavy.
constexpr double uprightAdvantage = 1.1;

glm::dvec3 across(const UsefulRay& ray, const glm::dvec3& v) { return v - glm::dot(ray.direction, v) * ray.direction; }

double weightOf(const std::vector<UsefulRay>& rays) {
    double sum = 0;
    for (const auto& ray : rays) sum += ray.weight;
    return sum;
}

// So many of them as raysLookedAt, each as often as it weighs, of equal weight.
std::vector<UsefulRay> resampled(const std::vector<UsefulRay>& rays) {
    std::vector<UsefulRay> some;
    for (const size_t k : drawnByWeight(rays, raysLookedAt, mostCopies)) {
        some.push_back(rays[k]);
        some.back().weight = 1;
    }
    return some;
}

// Where two rays come closest; of parallel ones a place of the first.
glm::dvec3 meetingPlace(const UsefulRay& a, const UsefulRay& b) {
    const double cosine = glm::dot(a.direction, b.direction), sine2 = 1 - cosine * cosine;
    if (sine2 < 1e-6) return a.position;
    const glm::dvec3 offset = b.position - a.position;
    const double onA = (glm::dot(offset, a.direction) - cosine * glm::dot(offset, b.direction)) / sine2;
    const double onB = (cosine * glm::dot(offset, a.direction) - glm::dot(offset, b.direction)) / sine2;
    return 0.5 * (a.position + onA * a.direction + b.position + onB * b.direction);
}

// A ball that many rays pass.
struct Ball {
    glm::dvec3 centre{};
    double radius = 0, gain = 0;
};

// Probability with which a ray passes a ball by chance. All rays of a point pass it, however small a ball; but so near a
// ray's beginning kernels, which compute in floats, could not tell where it passes.
double byChance(const UsefulRay& ray, const glm::dvec3& centre, double r, double radius) {
    if (!ray.isScattered) return std::min(1.0, r * r / (radius * radius));
    const double away = glm::distance(centre, ray.position);
    if (away <= nearestOpening * (glm::length(centre) + glm::length(ray.position))) return 1;
    return std::min(1.0, r * r / (4 * away * away));
}

// The best radius about a place.
Ball ballAbout(const std::vector<UsefulRay>& rays, double all, const glm::dvec3& centre, double radius) {
    std::vector<std::pair<double, const UsefulRay*>> passing;
    passing.reserve(rays.size());
    for (const auto& ray : rays) passing.emplace_back(distance(ray, centre), &ray);
    std::sort(passing.begin(), passing.end());
    Ball best{centre, 0, 0};
    for (size_t count = fewestRays; count <= passing.size(); count += count / 2) {
        const double r = std::max(passing[count - 1].first, 1e-6 * radius);
        double gain = 0;
        for (size_t k = 0; k < count; ++k) {
            const UsefulRay& ray = *passing[k].second;
            const double chance = byChance(ray, centre, r, radius);
            if (chance < widestBall) gain += ray.weight / all * std::log(0.5 + 0.5 / chance);
        }
        if (gain > best.gain) best = {centre, r, gain};
    }
    return best;
}

// Median by coordinate of where pairs of the rays that pass the ball meet.
glm::dvec3 middleOf(const std::vector<UsefulRay>& rays, const Ball& ball, std::mt19937& random) {
    std::vector<const UsefulRay*> passing;
    for (const auto& ray : rays)
        if (distance(ray, ball.centre) <= ball.radius) passing.push_back(&ray);
    std::array<std::vector<double>, 3> places;
    for (size_t k = 0; k < candidates; ++k) {
        const glm::dvec3 place = meetingPlace(*passing[random() % passing.size()], *passing[random() % passing.size()]);
        for (int axis = 0; axis < 3; ++axis) places[static_cast<size_t>(axis)].push_back(place[axis]);
    }
    glm::dvec3 middle(0);
    for (int axis = 0; axis < 3; ++axis) {
        auto& values = places[static_cast<size_t>(axis)];
        std::nth_element(values.begin(), values.begin() + candidates / 2, values.end());
        middle[axis] = values[candidates / 2];
    }
    return middle;
}

Ball bestBall(const std::vector<UsefulRay>& rays, double all, double radius) {
    std::mt19937 random(1); // a function of the rays alone
    Ball best;
    const auto consider = [&](const glm::dvec3& place) {
        const Ball ball = ballAbout(rays, all, place, radius);
        if (ball.gain > best.gain) best = ball;
    };
    for (size_t k = 0; k < candidates; ++k)
        consider(meetingPlace(rays[random() % rays.size()], rays[random() % rays.size()]));
    for (int k = 0; k < refinements && best.gain > 0; ++k) consider(middleOf(rays, best, random));
    return best;
}

glm::dvec3 anyAcross(const glm::dvec3& n) {
    return glm::normalize(glm::cross(n, std::abs(n.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
}

// Place of the ray on the plane across `normal`, as an offset from `centre`.
std::optional<glm::dvec3> placeOnPlane(const UsefulRay& ray, const glm::dvec3& centre, const glm::dvec3& normal) {
    const double slope = glm::dot(ray.direction, normal);
    if (std::abs(slope) < 1e-3) return std::nullopt;
    const glm::dvec3 offset = ray.position - centre;
    return offset - glm::dot(offset, normal) / slope * ray.direction;
}

// Lower and upper quantile of the weight.
std::pair<double, double> bounds(std::vector<std::pair<double, double>>& placesAndWeights) {
    std::sort(placesAndWeights.begin(), placesAndWeights.end());
    double all = 0, below = 0;
    for (const auto& [place, weight] : placesAndWeights) all += weight;
    std::pair<double, double> found{placesAndWeights.front().first, placesAndWeights.back().first};
    for (const auto& [place, weight] : placesAndWeights) {
        if (below <= outliers * all) found.first = place;
        found.second = place;
        below += weight;
        if (below >= (1 - outliers) * all) break;
    }
    return found;
}

// What the rays come through on the plane through `centre`, with these axes.
Opening bounded(const std::vector<UsefulRay>& rays, const glm::dvec3& centre, const glm::dvec3& axisU,
                const glm::dvec3& axisV) {
    Opening opening{centre, axisU, axisV, std::numeric_limits<double>::infinity(),
                    std::numeric_limits<double>::infinity()};
    std::vector<std::pair<double, double>> u, v;
    for (const auto& ray : rays) {
        const auto place = placeOnPlane(ray, centre, glm::cross(axisU, axisV));
        if (!place) continue;
        u.emplace_back(glm::dot(*place, axisU), ray.weight);
        v.emplace_back(glm::dot(*place, axisV), ray.weight);
    }
    if (u.empty()) return opening;
    const auto [lowerU, upperU] = bounds(u);
    const auto [lowerV, upperV] = bounds(v);
    opening.centre += 0.5 * (lowerU + upperU) * axisU + 0.5 * (lowerV + upperV) * axisV;
    opening.halfU = 0.5 * (upperU - lowerU);
    opening.halfV = 0.5 * (upperV - lowerV);
    return opening;
}

double meanCosine(const std::vector<UsefulRay>& rays, const glm::dvec3& normal) {
    double sum = 0;
    for (const auto& ray : rays) sum += ray.weight * std::abs(glm::dot(ray.direction, normal));
    return sum / weightOf(rays);
}

// Beside the world's axes.
std::vector<glm::dvec3> slantedNormals() {
    std::vector<glm::dvec3> all;
    for (int k = 0; k < normals; ++k) { // a spiral with even steps in z
        const double z = (k + 0.5) / normals, phi = k * std::numbers::pi * (3 - std::sqrt(5.0));
        const double r = std::sqrt(1 - z * z);
        all.emplace_back(r * std::cos(phi), r * std::sin(phi), z);
    }
    return all;
}

// The square about `centre`, facing them, that all but outliers of the rays pass.
Opening facingOpening(const std::vector<UsefulRay>& rays, const glm::dvec3& centre) {
    std::vector<double> distances;
    distances.reserve(rays.size());
    for (const auto& ray : rays) distances.push_back(distance(ray, centre));
    const auto last = distances.begin() + static_cast<std::ptrdiff_t>((1 - outliers) * (double(distances.size()) - 1));
    std::nth_element(distances.begin(), last, distances.end());
    Opening opening{centre, {1, 0, 0}, {0, 1, 0}, *last, *last};
    opening.faces = true;
    return opening;
}

// The rectangle that the rays have least flux through, were they as bright everywhere.
Opening fitRectangle(const std::vector<UsefulRay>& rays, const glm::dvec3& centre) {
    Opening best;
    double least = std::numeric_limits<double>::infinity();
    const auto consider = [&](const glm::dvec3& normal, double turn, double disadvantage) {
        const glm::dvec3 s = anyAcross(normal), t = glm::cross(normal, s);
        const glm::dvec3 axisU = std::cos(turn) * s + std::sin(turn) * t;
        const Opening opening = bounded(rays, centre, axisU, glm::cross(normal, axisU));
        const double flux = opening.halfU * opening.halfV * meanCosine(rays, normal) * disadvantage;
        if (!(flux < least)) return;
        least = flux;
        best = opening;
    };
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 normal(0);
        normal[axis] = 1;
        consider(normal, 0, 1);
    }
    for (const auto& normal : slantedNormals()) consider(normal, 0, uprightAdvantage);
    const glm::dvec3 normal = glm::cross(best.axisU, best.axisV);
    for (int k = 1; k < turns; ++k) consider(normal, k * std::numbers::pi / 2 / turns, uprightAdvantage);
    return best;
}

// Rays that are scattered towards a region, not through a plane opening, come from all sides: no rectangle is much
// narrower then.
Opening fitOpening(const std::vector<UsefulRay>& rays, const glm::dvec3& centre) {
    const Opening rectangle = fitRectangle(rays, centre);
    if (!rays.front().isScattered) return rectangle;
    const Opening facing = facingOpening(rays, centre);
    const double flux =
        rectangle.halfU * rectangle.halfV * meanCosine(rays, glm::cross(rectangle.axisU, rectangle.axisV));
    return flux < muchNarrower * facing.halfU * facing.halfV ? rectangle : facing;
}

} // namespace

std::vector<size_t> drawnByWeight(const std::vector<UsefulRay>& rays, size_t count, double mostCopies) {
    const double step = weightOf(rays) / static_cast<double>(count);
    std::vector<size_t> drawn;
    drawn.reserve(count);
    double below = 0;
    for (size_t k = 0; k < rays.size(); ++k) {
        below += std::min(rays[k].weight, mostCopies * step);
        while (below > (static_cast<double>(drawn.size()) + 0.5) * step && drawn.size() < count) drawn.push_back(k);
    }
    return drawn;
}

double distance(const UsefulRay& ray, const glm::dvec3& place) {
    return glm::length(across(ray, place - ray.position));
}

bool Opening::holds(const UsefulRay& ray) const {
    if (faces) return distance(ray, centre) <= halfU && glm::dot(centre - ray.position, ray.direction) > 0;
    const auto place = placeOnPlane(ray, centre, glm::cross(axisU, axisV));
    return place && std::abs(glm::dot(*place, axisU)) <= halfU && std::abs(glm::dot(*place, axisV)) <= halfV;
}

std::vector<Opening> findOpenings(std::vector<UsefulRay> rays, double radius, const std::vector<Opening>& known,
                                  size_t most, double leastGain) {
    std::vector<Opening> openings;
    const double all = weightOf(rays);
    for (const Opening& opening : known) std::erase_if(rays, [&](const UsefulRay& ray) { return opening.holds(ray); });
    while (openings.size() < most && rays.size() >= fewestRays) {
        const auto some = resampled(rays);
        if (some.size() < fewestRays) break;                        // a few of them have all the weight
        const double share = weightOf(some) * all / weightOf(rays); // of the weight of all rays that `some` stand for
        const Ball ball = bestBall(some, share, radius);
        if (ball.gain < leastGain) break;
        std::vector<UsefulRay> near;
        for (const auto& ray : some)
            if (distance(ray, ball.centre) <= ball.radius) near.push_back(ray);
        Opening opening = fitOpening(near, ball.centre);
        opening.halfU = std::max(margin * opening.halfU, 1e-5 * radius);
        opening.halfV = std::max(margin * opening.halfV, 1e-5 * radius);
        const size_t before = rays.size();
        std::erase_if(rays, [&](const UsefulRay& ray) { return opening.holds(ray); });
        if (rays.size() == before) break;
        openings.push_back(opening);
    }
    return openings;
}

} // namespace quasilux
