#include "learn/openings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
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
constexpr double aroundBall = 2.5;      // radii of a ball within which rays may come through the same opening
constexpr int rectangleFits = 2;        // the second one to rays about the first
constexpr double nearestOpening = 1e-3; // to where rays begin, or from outside end, relative to coordinates
constexpr double leastSlope = 0.1;      // of rays on a rectangle: flatter ones say too much of it
constexpr double leastBeyond = 0.1;     // behind a rectangle, to its size: nearer rays end at it
// Shares of the weight that bounds leave out on either side: where all rays come through the opening, and where some do
// not. The likeliest is taken.
constexpr std::array outliers{0.01, 0.04, 0.12};
constexpr int shifts = 4;   // of a plane along its normal, each half as far
constexpr int turns = 16;   // of axes in a quarter
constexpr int normals = 48; // tried on a hemisphere, beside the world's axes
// Most windows are upright. A sample of rays fills an upright rectangle but roughly, and one that is turned about them
// is often a little smaller, by less than this: photons through the corners that it cuts off would be heavy.
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
    const double away = glm::distance(centre, ray.position);
    if (away <= nearestOpening * (glm::length(centre) + glm::length(ray.position))) return 1;
    return std::min(1.0, r * r / (ray.isScattered ? 4 * away * away : radius * radius));
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

// Where rays come through a plane, along one axis of it, and their weights.
class Crossings {
public:
    void add(double place, double weight) { all_.emplace_back(place, weight); }
    void sort() { std::sort(all_.begin(), all_.end()); }
    bool empty() const { return all_.empty(); }

    // But for this share of the weight on either side.
    std::pair<double, double> bounds(double outside) const {
        double all = 0, below = 0;
        for (const auto& [place, weight] : all_) all += weight;
        std::pair<double, double> found{all_.front().first, all_.back().first};
        for (const auto& [place, weight] : all_) {
            if (below <= outside * all) found.first = place;
            found.second = place;
            below += weight;
            if (below >= (1 - outside) * all) break;
        }
        return found;
    }

private:
    std::vector<std::pair<double, double>> all_;
};

// What rays come through on the plane through `centre` with these axes: a rectangle for each of `outliers`, or none.
// Light from outside that comes through what is left out would be rare and bright, so of that no more is left out.
std::vector<Opening> bounded(const std::vector<UsefulRay>& rays, const glm::dvec3& centre, const glm::dvec3& axisU,
                             const glm::dvec3& axisV) {
    Crossings u, v;
    for (const auto& ray : rays) {
        const auto place = placeOnPlane(ray, centre, glm::cross(axisU, axisV));
        if (!place) continue;
        u.add(glm::dot(*place, axisU), ray.weight);
        v.add(glm::dot(*place, axisV), ray.weight);
    }
    std::vector<Opening> openings;
    if (u.empty()) return openings;
    u.sort();
    v.sort();
    for (const double outside : outliers) {
        const auto [lowerU, upperU] = u.bounds(outside);
        const auto [lowerV, upperV] = v.bounds(outside);
        openings.push_back({centre + 0.5 * (lowerU + upperU) * axisU + 0.5 * (lowerV + upperV) * axisV, axisU, axisV,
                            0.5 * (upperU - lowerU), 0.5 * (upperV - lowerV)});
        if (!rays.front().isScattered) break;
    }
    return openings;
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

// Density of scattered rays that are aimed at the opening, along `ray`, over that of those spread over all directions.
double densityAlong(const UsefulRay& ray, const Opening& opening) {
    if (!opening.holds(ray)) return 0;
    const glm::dvec3 offset = opening.centre - ray.position;
    const glm::dvec3 normal = opening.faces ? glm::normalize(offset) : glm::cross(opening.axisU, opening.axisV);
    const double slope = glm::dot(ray.direction, normal), away = glm::dot(offset, normal) / slope;
    const double across = std::max(std::abs(slope), leastSlope) * opening.halfU * opening.halfV;
    return std::numbers::pi * away * away / std::max(across, 1e-300);
}

// Of scattered rays, as ballAbout has it.
double gainOf(const Opening& opening, const std::vector<UsefulRay>& rays) {
    double gain = 0;
    for (const auto& ray : rays) gain += ray.weight * std::log(0.5 + 0.5 * densityAlong(ray, opening));
    return gain;
}

// How much better than others the rectangle is: by the likelihood of scattered rays, and for those from outside by the
// flux that they had through it, were they as bright everywhere.
double scoreOf(const Opening& rectangle, const std::vector<UsefulRay>& rays) {
    if (rays.front().isScattered) return gainOf(rectangle, rays);
    const glm::dvec3 normal = glm::cross(rectangle.axisU, rectangle.axisV);
    double flux = 0;
    for (const auto& ray : rays) flux += ray.weight * std::abs(glm::dot(ray.direction, normal));
    return -weightOf(rays) * std::log(std::max(flux * rectangle.halfU * rectangle.halfV, 1e-300));
}

// Looks for the best rectangle.
class RectangleSearch {
public:
    explicit RectangleSearch(const std::vector<UsefulRay>& rays)
        : rays_(rays), handicap_(std::log(uprightAdvantage) * weightOf(rays)) {}

    // On planes through `centre`.
    void tryPlanes(const glm::dvec3& centre) {
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 normal(0);
            normal[axis] = 1;
            tryPlane(centre, normal, 0, 0);
        }
        for (const auto& normal : slantedNormals()) tryPlane(centre, normal, 0, handicap_);
        if (!best_) return;
        const glm::dvec3 normal = glm::cross(best_->axisU, best_->axisV);
        for (int k = 1; k < turns; ++k) tryPlane(centre, normal, k * std::numbers::pi / 2 / turns, handicap_);
    }

    // On planes before and behind the best one.
    void shift(double step) {
        for (int k = 0; best_ && k < shifts; ++k, step /= 2) {
            const Opening from = *best_;
            for (const double side : {-step, step})
                tryAxes(from.centre + side * glm::cross(from.axisU, from.axisV), from.axisU, from.axisV,
                        handicapOfBest_);
        }
    }

    const std::optional<Opening>& found() const { return best_; }

private:
    void tryPlane(const glm::dvec3& centre, const glm::dvec3& normal, double turn, double handicap) {
        const glm::dvec3 s = anyAcross(normal), t = glm::cross(normal, s);
        const glm::dvec3 axisU = std::cos(turn) * s + std::sin(turn) * t;
        tryAxes(centre, axisU, glm::cross(normal, axisU), handicap);
    }

    void tryAxes(const glm::dvec3& centre, const glm::dvec3& axisU, const glm::dvec3& axisV, double handicap) {
        for (const Opening& opening : bounded(rays_, centre, axisU, axisV)) {
            const double score = scoreOf(opening, rays_) - handicap;
            if (!(score > most_)) continue;
            most_ = score;
            best_ = opening;
            handicapOfBest_ = handicap;
        }
    }

    const std::vector<UsefulRay>& rays_;
    double handicap_, handicapOfBest_ = 0, most_ = -std::numeric_limits<double>::infinity();
    std::optional<Opening> best_;
};

Opening facingSquare(const glm::dvec3& centre, double half) { return {centre, {1, 0, 0}, {0, 1, 0}, half, half, true}; }

// The square about the ball's centre that all but outliers of its rays pass.
Opening fitSquare(const std::vector<UsefulRay>& rays, const Ball& ball) {
    std::vector<double> distances;
    for (const auto& ray : rays)
        if (const double away = distance(ray, ball.centre); away <= ball.radius) distances.push_back(away);
    const auto last =
        distances.begin() + static_cast<std::ptrdiff_t>((1 - outliers[0]) * (double(distances.size()) - 1));
    std::nth_element(distances.begin(), last, distances.end());
    return facingSquare(ball.centre, *last);
}

// Of scattered rays it may reach beyond the ball, as of those through a ball alone all planes hold much the same.
Opening fitRectangle(const std::vector<UsefulRay>& rays, const Ball& ball) {
    const bool isScattered = rays.front().isScattered;
    Opening best = facingSquare(ball.centre, ball.radius);
    for (int k = 0; k < (isScattered ? rectangleFits : 1); ++k) {
        best.halfU *= aroundBall;
        best.halfV *= aroundBall;
        std::vector<UsefulRay> held;
        std::ranges::copy_if(rays, std::back_inserter(held), [&](const auto& ray) {
            return isScattered ? best.holds(ray) : distance(ray, ball.centre) <= ball.radius;
        });
        if (held.size() < fewestRays) break; // others lead away from it, or end there
        RectangleSearch search(held);
        search.tryPlanes(best.centre);
        if (isScattered) search.shift(ball.radius / 2);
        if (!search.found()) break;
        best = *search.found();
    }
    return best;
}

Opening fitOpening(const std::vector<UsefulRay>& rays, const Ball& ball, OpeningShape shape, double radius) {
    const bool maybeSquare = rays.front().isScattered && shape != OpeningShape::rectangle;
    Opening opening;
    if (maybeSquare) opening = fitSquare(rays, ball);
    if (!maybeSquare || shape == OpeningShape::either) {
        const Opening rectangle = fitRectangle(rays, ball);
        if (!maybeSquare || gainOf(rectangle, rays) > gainOf(opening, rays)) opening = rectangle;
    }
    opening.halfU = std::max(margin * opening.halfU, 1e-5 * radius);
    opening.halfV = std::max(margin * opening.halfV, 1e-5 * radius);
    return opening;
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
    const glm::dvec3 normal = glm::cross(axisU, axisV);
    const auto place = placeOnPlane(ray, centre, normal);
    if (!place || std::abs(glm::dot(*place, axisU)) > halfU || std::abs(glm::dot(*place, axisV)) > halfV) return false;
    if (!ray.isScattered) return true;
    const double slope = glm::dot(ray.direction, normal), away = glm::dot(centre - ray.position, normal) / slope;
    return away > 0 && (ray.length - away) * std::abs(slope) > leastBeyond * std::sqrt(halfU * halfV);
}

std::vector<Opening> findOpenings(std::vector<UsefulRay> rays, double radius, const std::vector<Opening>& known,
                                  size_t most, OpeningShape shape, double leastGain) {
    std::vector<Opening> openings;
    const double all = weightOf(rays);
    for (const Opening& opening : known) std::erase_if(rays, [&](const UsefulRay& ray) { return opening.holds(ray); });
    while (openings.size() < most && rays.size() >= fewestRays) {
        const auto some = resampled(rays);
        if (some.size() < fewestRays) break;                        // a few of them have all the weight
        const double share = weightOf(some) * all / weightOf(rays); // of the weight of all rays that `some` stand for
        const Ball ball = bestBall(some, share, radius);
        if (ball.gain < leastGain) break;
        const Opening opening = fitOpening(some, ball, shape, radius);
        const size_t before = rays.size();
        std::erase_if(rays, [&](const UsefulRay& ray) { return opening.holds(ray); });
        if (rays.size() == before) break;
        openings.push_back(opening);
    }
    return openings;
}

} // namespace quasilux
