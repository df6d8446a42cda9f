#include "learn/guide.h"

#include "learn/openings.h"
#include "prepare/pack.h"

#include <algorithm>
#include <cmath>

namespace quasilux {

namespace {

// Share of all photons that emitters get by their power, whatever was learned.
constexpr double plainShare = 0.1;
// An emitter is guided where photons by plain emission would have this many times the second moment at least: below,
// evenly spread numbers (kernels/lattice.clh) do as much.
constexpr double leastGain = 1.5;
constexpr size_t fewestRecords = 64;
constexpr size_t mostOpenings = 16; // of an emitter
// Of emitters in the scene: openings are theirs together, and each has those that so many of its records come through.
constexpr size_t mostSharedOpenings = 4, fewestThroughOpening = 8;
constexpr double leastSharedGain = 0.3;
// A record counts at most this many times the median: a single rare one opens a box, but does not take all photons.
constexpr double heaviest = 200;

// An emitter's openings, and it itself for all other rays.
void addSources(unsigned index, const std::vector<Opening>& openings, std::vector<shared::GuideSource>& sources) {
    const auto first = static_cast<unsigned>(sources.size());
    for (const Opening& opening : openings) sources.push_back(openingSource(index, first, opening));
    sources.push_back(plainSource(index, first));
}

// Emitters in the scene, but for those that choose no direction.
bool sharesOpenings(const shared::Emitter& emitter) {
    return !isDistant(emitter) && emitter.type != EMITTER_DIRECTIONALAREA;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

} // namespace

shared::GuideSource openingSource(unsigned emitter, unsigned first, const Opening& opening) {
    shared::GuideSource source = plainSource(emitter, first);
    source.centre = pack(opening.centre);
    source.axisU = pack(opening.axisU);
    source.axisV = pack(opening.axisV);
    source.halfU = static_cast<float>(opening.halfU);
    source.halfV = static_cast<float>(opening.halfV);
    source.faces = opening.faces;
    return source;
}

void GuideLearner::add(const std::vector<shared::EmissionRecord>& records) {
    photonsOfRound_ = records.size();
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

void GuideLearner::findMoreOpenings(unsigned emitter, const std::vector<UsefulRay>& rays) {
    auto& known = openings_[emitter];
    if (rays.size() < fewestRecords || known.size() >= mostOpenings) return;
    for (const Opening& opening :
         findOpenings(rays, emitters_.emitters[emitter].radius, known, mostOpenings - known.size()))
        known.push_back(opening);
}

void GuideLearner::findSharedOpenings(const std::vector<std::vector<UsefulRay>>& rays) {
    std::vector<UsefulRay> all;
    for (size_t e = 0; e < rays.size(); ++e)
        if (sharesOpenings(emitters_.emitters[e])) all.insert(all.end(), rays[e].begin(), rays[e].end());
    if (all.size() < fewestRecords) return;
    double radius = 0; // of the order of the scene
    for (const auto& ray : all) radius = std::max(radius, glm::distance(ray.position, all.front().position));
    for (const Opening& opening :
         findOpenings(all, radius, shared_, mostSharedOpenings - shared_.size(), OpeningShape::either, leastSharedGain))
        shared_.push_back(opening);
    for (size_t e = 0; e < rays.size(); ++e) {
        if (!sharesOpenings(emitters_.emitters[e])) continue;
        openings_[e].clear();
        for (const Opening& opening : shared_) {
            const auto through =
                std::count_if(rays[e].begin(), rays[e].end(), [&](const auto& ray) { return opening.holds(ray); });
            if (static_cast<size_t>(through) >= fewestThroughOpening) openings_[e].push_back(opening);
        }
    }
}

std::vector<Opening> GuideLearner::openingsFromOutside() const {
    std::vector<Opening> all;
    for (size_t e = 0; e < openings_.size(); ++e)
        if (isDistant(emitters_.emitters[e])) all.insert(all.end(), openings_[e].begin(), openings_[e].end());
    return all;
}

GuideTables GuideLearner::guide() {
    openings_.resize(emitters_.emitters.size());
    std::vector<shared::EmissionRecord> records;
    for (const auto& round : rounds_) records.insert(records.end(), round.begin(), round.end());
    std::vector<std::vector<UsefulRay>> rays(emitters_.emitters.size());
    double all = 0;
    for (const auto& record : records) {
        all += record.weight;
        rays[record.emitter].push_back({unpack(record.position), unpack(record.direction), record.weight,
                                        !isDistant(emitters_.emitters[record.emitter])});
    }
    if (!(all > 0)) return plainGuide(emitters_);

    findSharedOpenings(rays);
    std::vector<shared::GuideSource> sources;
    for (unsigned e = 0; e < emitters_.emitters.size(); ++e)
        if (emitters_.emitters[e].selectionProbability > 0) {
            if (isDistant(emitters_.emitters[e])) findMoreOpenings(e, rays[e]);
            addSources(e, openings_[e], sources);
        }
    const auto points = invert_(records, sources);
    const auto rounds = static_cast<double>(rounds_.size()), photonRounds = std::max(1.0, rounds - 1);
    std::vector<std::vector<GuideSample>> samples(sources.size());
    std::vector<double> weightOfSource(sources.size());
    for (size_t k = 0; k < points.size(); ++k) {
        if (points[k].source == QL_NONE) continue;
        GuideSample sample;
        std::copy(std::begin(points[k].numbers), std::end(points[k].numbers), sample.u.begin());
        sample.weight = records[k].weight / rounds;
        if (records[k].inverseDensity > 0)
            sample.square = double(records[k].weight) * records[k].weight / records[k].inverseDensity *
                            static_cast<double>(photonsOfRound_) / photonRounds;
        samples[points[k].source].push_back(sample);
        weightOfSource[points[k].source] += sample.weight;
    }
    GuideTables tables = makeGuideTables(emitters_, sources, boxesOf(sources, samples, weightOfSource));
    tables.isGuided = true;
    return tables;
}

std::vector<SourceBox> GuideLearner::boxesOf(const std::vector<shared::GuideSource>& sources,
                                             const std::vector<std::vector<GuideSample>>& samples,
                                             const std::vector<double>& weights) const {
    std::vector<SourceBox> boxes;
    std::vector<double> wanted; // photons, by what boxes bring to the image
    double all = 0;
    for (unsigned s = 0; s < sources.size(); ++s) {
        auto leaves = buildGuideTree(samples[s], {});
        const bool isWhole = !(sources[s].halfU > 0) && s == sources[s].first;
        if (isWhole && guideGain(leaves, {}) < leastGain) leaves = {{{}, 0}};
        for (const auto& [box, squares] : leaves) {
            boxes.push_back({s, box});
            wanted.push_back(std::max(weights[s] * box.probability, std::sqrt(squares * box.volume())));
            all += wanted.back();
        }
    }
    std::vector<double> sourcesOfEmitter(emitters_.emitters.size());
    for (const auto& source : sources) sourcesOfEmitter[source.emitter] += 1;
    for (size_t k = 0; k < boxes.size(); ++k) {
        const unsigned emitter = sources[boxes[k].source].emitter;
        const double plain =
            emitters_.emitters[emitter].selectionProbability / sourcesOfEmitter[emitter] * boxes[k].box.volume();
        boxes[k].box.probability = (1 - plainShare) * (all > 0 ? wanted[k] / all : 0) + plainShare * plain;
    }
    return boxes;
}

} // namespace quasilux
