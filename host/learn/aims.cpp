#include "learn/aims.h"

#include "learn/guide.h"
#include "prepare/pack.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace quasilux {

namespace {

// By which the log likelihood of all scattered rays must grow; and by an opening that no light from outside is known to
// come through.
constexpr double leastAimGain = 0.03, leastFoundGain = 0.2;
// Squares about one place: each twice as wide as the one before. Those that would get less of the photons are left out.
constexpr int innerSquares = 2, outerSquares = 6;
constexpr double leastShare = 0.01;
// What matters about one place has no wall around it: photons that are not aimed may come there, too, and are not to be
// heavy.
constexpr double surestAtPlace = 0.5;
// Where aimed photons are less dense than this many times those spread over all directions there is little to be
// gained.
constexpr double leastDensity = 10;

// Enough of the rays to tell what is gained by aiming.
constexpr size_t mostRays = 65536;

// Share of all directions that an opening takes from there, over a quarter of its area.
double directionsOfArea(const glm::dvec3& centre, const glm::dvec3& from) {
    const glm::dvec3 offset = centre - from;
    return 1 / (std::numbers::pi * std::max(glm::dot(offset, offset), 1e-12));
}

double quarterOfArea(const Opening& opening) { return opening.halfU * opening.halfV; }

// At most mostRays of them, drawn by weight, with the weight of all.
std::vector<UsefulRay> thinnedByWeight(std::vector<UsefulRay> rays) {
    if (rays.size() <= mostRays) return rays;
    double all = 0;
    for (const auto& ray : rays) all += ray.weight;
    const auto drawn = drawnByWeight(rays, mostRays);
    std::vector<UsefulRay> some;
    some.reserve(drawn.size());
    for (size_t d = 0; d < drawn.size(); ++d) {
        if (d == 0 || drawn[d] != drawn[d - 1]) {
            some.push_back(rays[drawn[d]]);
            some.back().weight = 0;
        }
        some.back().weight += all / mostRays;
    }
    return some;
}

// By which the rays' log likelihood grows where those that come this way are aimed.
double gainOf(const AimSet& set, const std::vector<UsefulRay>& rays) {
    double gain = 0;
    for (const auto& ray : rays)
        if (const double density = set.density(ray); density > leastDensity)
            gain += ray.weight * std::log(1 - set.surest + set.surest * density);
    return gain;
}

// Squares about the centre of `opening` whose mixture is as dense as the rays are in each ring between two of them, as
// far as they get thinner outwards: of the square k, of area S_k, the share S_k (D_k - D_k+1), D being the rings'
// densities.
AimSet nestedSquares(const Opening& opening, const std::vector<UsefulRay>& rays) {
    const int count = innerSquares + 1 + outerSquares;
    std::vector<double> half, weight(static_cast<size_t>(count)), density(static_cast<size_t>(count) + 1);
    for (int k = 0; k < count; ++k) half.push_back(std::ldexp(opening.halfU, k - innerSquares));
    for (const auto& ray : rays) {
        if (glm::dot(opening.centre - ray.position, ray.direction) <= 0) continue; // it lies behind
        const double away = distance(ray, opening.centre);
        const auto ring = std::lower_bound(half.begin(), half.end(), away) - half.begin();
        if (ring < count) weight[static_cast<size_t>(ring)] += ray.weight;
    }
    double inner = 0;
    for (size_t k = 0; k < half.size(); ++k) {
        density[k] = weight[k] / (half[k] * half[k] - inner * inner);
        inner = half[k];
    }
    for (size_t k = half.size(); k-- > 0;) density[k] = std::max(density[k], density[k + 1]);
    double all = 0;
    for (size_t k = 0; k < half.size(); ++k) all += half[k] * half[k] * (density[k] - density[k + 1]);
    AimSet set;
    set.surest = surestAtPlace;
    double kept = 0;
    for (size_t k = 0; k < half.size(); ++k) {
        const double share = half[k] * half[k] * (density[k] - density[k + 1]) / all;
        if (!(share > leastShare)) continue;
        Opening square = opening;
        square.halfU = square.halfV = half[k];
        set.openings.push_back(square);
        set.shares.push_back(share);
        kept += share;
    }
    for (double& share : set.shares) share /= kept;
    return set;
}

AimSet setAbout(const Opening& opening, const std::vector<UsefulRay>& rays) {
    return opening.faces ? nestedSquares(opening, rays) : AimSet{{opening}, {1}};
}

} // namespace

double AimSet::density(const UsefulRay& ray) const {
    double sum = 0;
    if (openings.empty()) return 0; // of a place that no ray passes by
    if (openings.front().faces) {   // squares about one place
        const glm::dvec3& centre = openings.front().centre;
        if (!(glm::dot(centre - ray.position, ray.direction) > 0)) return 0;
        const double away = distance(ray, centre);
        for (size_t k = 0; k < openings.size(); ++k)
            if (away <= openings[k].halfU) sum += shares[k] / quarterOfArea(openings[k]);
        return sum > 0 ? sum / directionsOfArea(centre, ray.position) : 0;
    }
    for (size_t k = 0; k < openings.size(); ++k)
        if (openings[k].holds(ray))
            sum += shares[k] / (quarterOfArea(openings[k]) * directionsOfArea(openings[k].centre, ray.position));
    return sum;
}

double AimSet::claim(const UsefulRay& ray) const {
    const double aimed = density(ray);
    if (openings.size() == 1) return aimed > leastDensity;
    return aimed / (aimed + 2); // half of all directions are those of a hemisphere
}

std::optional<UsefulRay> scatteredRay(const shared::ImportancePath& path, size_t v) {
    const auto& from = path.vertices[v];
    if (!(from.weight > 0) || !std::isfinite(from.weight)) return std::nullopt;
    UsefulRay ray;
    ray.position = unpack(from.position);
    const glm::dvec3 offset = unpack(path.vertices[v - 1].position) - ray.position;
    const double distance = glm::length(offset);
    if (!(distance > 0)) return std::nullopt;
    ray.direction = offset / distance;
    ray.weight = from.weight;
    ray.length = distance;
    ray.isScattered = true;
    return ray;
}

namespace {

// The ways of photons between the vertices of importance paths, by the light that comes to the image along them: what
// was found from there on.
struct Ways {
    std::vector<UsefulRay> all, ofWasted; // those that lead out of where most of what is scattered is wasted
};

Ways usefulRays(const std::vector<shared::ImportancePath>& paths, const std::vector<double>& pathWeights,
                const std::vector<bool>& isWasted) {
    Ways rays;
    for (size_t k = 0; k < paths.size(); ++k) {
        double found = 0;
        for (size_t v = IMPORTANCE_VERTICES - 1; v > 0; --v) {
            const double here = paths[k].vertices[v].found;
            if (std::isfinite(here)) found += here;
            auto ray = scatteredRay(paths[k], v);
            if (!ray || !(found > 0)) continue;
            ray->weight = pathWeights[k] * found;
            rays.all.push_back(*ray);
            const size_t at = k * IMPORTANCE_VERTICES + v;
            if (isWasted[at] && !isWasted[at - 1]) rays.ofWasted.push_back(*ray);
        }
    }
    return {thinnedByWeight(std::move(rays.all)), thinnedByWeight(std::move(rays.ofWasted))};
}

struct Candidate {
    Opening opening;
    double leastGain;
    AimSet set{};
    double gain = 0;
};

// The set by which most is gained, which is then no candidate any more, as little as those by which too little is: rays
// only become fewer.
std::optional<AimSet> takeBest(std::vector<Candidate>& candidates, const std::vector<UsefulRay>& rays) {
    for (Candidate& candidate : candidates) {
        candidate.set = setAbout(candidate.opening, rays);
        candidate.gain = gainOf(candidate.set, rays);
    }
    std::erase_if(candidates, [](const Candidate& candidate) {
        return !(candidate.gain > 0) || candidate.gain < candidate.leastGain;
    });
    const auto best = std::ranges::max_element(candidates, {}, &Candidate::gain);
    if (best == candidates.end()) return std::nullopt;
    AimSet set = std::move(best->set);
    candidates.erase(best);
    return set;
}

} // namespace

std::vector<AimSet> findAims(const std::vector<shared::ImportancePath>& paths, const std::vector<double>& pathWeights,
                             const std::vector<bool>& isWasted, const std::vector<Opening>& fromOutside,
                             double radius) {
    Ways ways = usefulRays(paths, pathWeights, isWasted);
    std::vector<UsefulRay>& rays = ways.all;
    double all = 0;
    for (const auto& ray : rays) all += ray.weight;
    std::vector<AimSet> sets;
    // From `among`, which `rays` have, too. Openings alone: until a place would be better.
    const auto take = [&](std::vector<UsefulRay> among, bool openingsAlone) {
        std::vector<Candidate> candidates;
        const auto consider = [&](const std::vector<Opening>& openings, double leastGain) {
            for (const Opening& opening : openings) candidates.push_back({opening, all * leastGain});
        };
        consider(fromOutside, leastAimGain);
        if (openingsAlone)
            consider(findOpenings(among, radius, {}, mostAimSets, OpeningShape::rectangle), leastAimGain);
        consider(findOpenings(among, radius, {}, mostAimSets, OpeningShape::square), leastFoundGain);
        while (sets.size() < mostAimSets) {
            const auto set = takeBest(candidates, among);
            if (!set || (openingsAlone && set->openings.front().faces)) break;
            const auto isTaken = [&](const UsefulRay& ray) { return set->claim(ray) > 0.5; };
            std::erase_if(among, isTaken);
            std::erase_if(rays, isTaken);
            sets.push_back(*set);
        }
    };
    take(std::move(ways.ofWasted), true);
    take(rays, false);
    return sets;
}

std::vector<shared::AimSource> aimTable(const std::vector<AimSet>& sets) {
    std::vector<shared::AimSource> table;
    for (const auto& set : sets)
        for (size_t k = 0; k < set.openings.size(); ++k)
            table.push_back({openingSource(QL_NONE, 0, set.openings[k]), static_cast<float>(set.shares[k]),
                             k == 0 ? static_cast<unsigned>(set.openings.size()) : 0u});
    return table;
}

size_t firstOf(const std::vector<AimSet>& sets, size_t set) {
    size_t first = 0;
    for (size_t k = 0; k < set; ++k) first += sets[k].openings.size();
    return first;
}

} // namespace quasilux
