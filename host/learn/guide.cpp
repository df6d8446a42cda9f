#include "learn/guide.h"

#include "learn/ray_plane.h"
#include "prepare/pack.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace quasilux {

namespace {

// Share of all photons that emitters get by their power, whatever was learned.
constexpr double plainShare = 0.1;
// An emitter is guided where photons by plain emission would have this many times the second moment at least: below, evenly
// spread numbers (kernels/lattice.clh) do as much.
constexpr double leastGain = 1.5;
constexpr size_t fewestRecords = 64;
// A record counts at most this many times the median: a single rare one opens a box, but does not take all photons.
constexpr double heaviest = 200;
// Directions are split into cells of planes of their own while that halves the area that rays come through.
constexpr size_t fewestRaysOfCell = 512;
constexpr int deepestCell = 5;
constexpr double planeMargin = 1.5; // of the scale of a plane to half of what rays come through

glm::dvec3 unpack(const shared::Packed3& p) { return {p.x, p.y, p.z}; }

bool isDistant(const shared::Emitter& emitter) {
    return emitter.type == EMITTER_CONSTANT || emitter.type == EMITTER_DIRECTIONAL;
}

// Of directions, in the emitter's numbers.
struct DirectionCell {
    std::array<double, 2> lower{0, 0}, size{1, 1};
};

// u of sampleUniformSphere: places of a few rays, to split cells; kernels have the exact inverse.
std::array<double, 2> directionNumbers(const glm::dvec3& direction) {
    const double turns = std::atan2(direction.y, direction.x) / (2 * std::numbers::pi);
    return {0.5 - 0.5 * direction.z, turns < 0 ? turns + 1 : turns};
}

struct PlaneCell {
    DirectionCell cell;
    RayPlane plane;
};

// Two halves of the rays at the weighted middle of a direction number.
struct Halves {
    double at = 0;
    std::array<std::vector<UsefulRay>, 2> rays;
};

double weightOf(const std::vector<UsefulRay>& rays) {
    double sum = 0;
    for (const auto& ray : rays) sum += ray.weight;
    return sum;
}

Halves halved(std::vector<UsefulRay> rays, size_t dimension) {
    std::sort(rays.begin(), rays.end(), [&](const UsefulRay& a, const UsefulRay& b) {
        return directionNumbers(a.direction)[dimension] < directionNumbers(b.direction)[dimension];
    });
    const double half = weightOf(rays) / 2;
    double below = 0;
    size_t k = 0;
    while (k + 1 < rays.size() && below + rays[k].weight < half) below += rays[k++].weight;
    Halves halves;
    halves.at = directionNumbers(rays[k].direction)[dimension];
    for (const auto& ray : rays) halves.rays[directionNumbers(ray.direction)[dimension] < halves.at ? 0 : 1].push_back(ray);
    return halves;
}

void addCells(const DirectionCell& cell, const std::vector<UsefulRay>& rays, int depth, std::vector<PlaneCell>& cells) {
    const RayPlane plane = fitRayPlane(rays);
    double least = std::log(plane.area()) - std::log(2.0); // mean logarithm of the area that is worth a split
    std::optional<std::pair<size_t, Halves>> best;
    for (size_t d = 0; d < 2 && depth < deepestCell; ++d) {
        Halves halves = halved(rays, d);
        if (std::min(halves.rays[0].size(), halves.rays[1].size()) < fewestRaysOfCell) continue;
        if (halves.at <= cell.lower[d] || halves.at >= cell.lower[d] + cell.size[d]) continue;
        double mean = 0;
        for (const auto& half : halves.rays)
            mean += weightOf(half) / weightOf(rays) * std::log(fitRayPlane(half).area());
        if (mean >= least) continue;
        least = mean;
        best.emplace(d, std::move(halves));
    }
    if (!best) {
        cells.push_back({cell, plane});
        return;
    }
    const auto& [d, halves] = *best;
    for (size_t side = 0; side < 2; ++side) {
        DirectionCell child = cell;
        if (side == 1) child.lower[d] = halves.at;
        child.size[d] = side == 0 ? halves.at - cell.lower[d] : cell.lower[d] + cell.size[d] - halves.at;
        addCells(child, halves.rays[side], depth + 1, cells);
    }
}

shared::GuideSource planeSource(unsigned emitter, const RayPlane& plane, double smallest) {
    shared::GuideSource source{};
    source.emitter = emitter;
    source.centre = pack(plane.centre);
    source.axisU = pack(plane.axisU);
    source.axisV = pack(plane.axisV);
    source.scaleU = static_cast<float>(planeMargin * std::max(plane.halfU, smallest));
    source.scaleV = static_cast<float>(planeMargin * std::max(plane.halfV, smallest));
    return source;
}

shared::GuideSource plainSource(unsigned emitter) {
    shared::GuideSource source{};
    source.emitter = emitter;
    return source;
}

// An emitter's sources and the boxes that they begin with: one by one, or of one that shines from outside by planes.
std::vector<std::pair<shared::GuideSource, GuideBox>> sourcesOf(const shared::Emitter& emitter, unsigned index,
                                                                const std::vector<UsefulRay>& rays) {
    if (rays.size() < fewestRecords) return {{plainSource(index), {}}};
    std::vector<PlaneCell> cells;
    addCells({}, rays, emitter.type == EMITTER_DIRECTIONAL ? deepestCell : 0, cells);
    std::vector<std::pair<shared::GuideSource, GuideBox>> sources;
    for (const auto& [cell, plane] : cells) {
        GuideBox box;
        std::copy(cell.lower.begin(), cell.lower.end(), box.lower.begin() + 3);
        std::copy(cell.size.begin(), cell.size.end(), box.size.begin() + 3);
        sources.emplace_back(planeSource(index, plane, 1e-5 * emitter.radius), box);
    }
    return sources;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

} // namespace

void GuideLearner::add(const std::vector<shared::EmissionRecord>& records) {
    std::vector<double> weights;
    for (const auto& record : records)
        if (record.emitter != QL_NONE && record.weight > 0) weights.push_back(record.weight);
    auto& round = rounds_.emplace_back();
    if (weights.empty()) return;
    const auto most = static_cast<float>(heaviest * median(weights));
    for (auto record : records) {
        if (record.emitter == QL_NONE || !(record.weight > 0)) continue;
        record.weight = std::min(record.weight, most);
        round.push_back(record);
    }
}

GuideTables GuideLearner::guide() const {
    std::vector<shared::EmissionRecord> records;
    for (const auto& round : rounds_) records.insert(records.end(), round.begin(), round.end());
    std::vector<std::vector<UsefulRay>> rays(emitters_.emitters.size());
    double all = 0;
    for (const auto& record : records) {
        all += record.weight;
        if (isDistant(emitters_.emitters[record.emitter]))
            rays[record.emitter].push_back({unpack(record.position), unpack(record.direction), record.weight});
    }
    if (!(all > 0)) return plainGuide(emitters_);

    std::vector<shared::GuideSource> sources;
    std::vector<SourceBox> roots;
    for (unsigned e = 0; e < emitters_.emitters.size(); ++e) {
        if (!(emitters_.emitters[e].selectionProbability > 0)) continue;
        for (const auto& [source, box] : sourcesOf(emitters_.emitters[e], e, rays[e])) {
            roots.push_back({static_cast<unsigned>(sources.size()), box});
            sources.push_back(source);
        }
    }
    const auto points = invert_(records, makeGuideTables(emitters_, sources, roots));
    std::vector<std::vector<GuideSample>> samples(sources.size());
    std::vector<double> weightOfSource(sources.size());
    for (size_t k = 0; k < points.size(); ++k) {
        if (points[k].source == QL_NONE) continue;
        GuideSample sample;
        std::copy(std::begin(points[k].numbers), std::end(points[k].numbers), sample.u.begin());
        sample.weight = records[k].weight;
        samples[points[k].source].push_back(sample);
        weightOfSource[points[k].source] += sample.weight;
    }
    if (getenv("DEBUG_GUIDE")) for (size_t k = 0; k < std::min<size_t>(points.size(), 12); ++k) fprintf(stderr, "rec e%u w %g pos %.3f %.3f %.3f dir %.3f %.3f %.3f -> s%u %.3f %.3f %.3f %.3f %.3f\n", records[k].emitter, records[k].weight, records[k].position.x, records[k].position.y, records[k].position.z, records[k].direction.x, records[k].direction.y, records[k].direction.z, points[k].source, points[k].numbers[0], points[k].numbers[1], points[k].numbers[2], points[k].numbers[3], points[k].numbers[4]);
    std::vector<SourceBox> boxes;
    for (unsigned s = 0; s < sources.size(); ++s) {
        GuideBox root = roots[s].box;
        root.probability = (1 - plainShare) * weightOfSource[s] / all +
                           plainShare * emitters_.emitters[sources[s].emitter].selectionProbability * root.volume();
        auto leaves = buildGuideTree(samples[s], root);
        if (!(sources[s].scaleU > 0) && guideGain(leaves, root) < leastGain) leaves = {root};
        for (const auto& leaf : leaves) boxes.push_back({s, leaf});
    }
    GuideTables tables = makeGuideTables(emitters_, std::move(sources), boxes);
    tables.isGuided = true;
    return tables;
}

} // namespace quasilux
