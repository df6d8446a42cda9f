#include "prepare/guide_tables.h"

#include "prepare/device_scene.h"
#include "prepare/pack.h"
#include "scene/color.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace quasilux {

namespace {

// The flux of stored photons has a range (kernels/packed_flux.clh). Photons that carry too much for it would be cut,
// and their light be missing, so most of them must not be so light that heavy ones are out of it: of light ones too
// little for it one in a few carries what the others lack.
constexpr double heaviestToTypical = 0x1p18;

// Of a photon by even numbers, times the number of photons.
double fluxOf(const EmitterTables& emitters, const shared::GuideSource& source) {
    const double power = emitters.power[source.emitter];
    if (!(source.halfU > 0)) return power;
    const auto& emitter = emitters.emitters[source.emitter];
    const double area = 4 * source.halfU * source.halfV;
    if (!isDistant(emitter)) { // about: as if it lay in one point and faced the opening
        const glm::dvec3 offset = unpack(source.centre) - unpack(emitter.origin);
        return power * area / (area + std::numbers::pi * glm::dot(offset, offset));
    }
    const double solidAngle = emitter.type == EMITTER_DIRECTIONAL ? 1 : 4 * std::numbers::pi;
    return mean(emitter.radiance) * solidAngle * area;
}

// Random numbers are multiples of 2^-24, so boxes have so many of them each: single precision and sums of small numbers
// after large ones would leave some boxes none, or not what their weight says.
constexpr double numbers = 0x1p24, fewestNumbers = 16;

/// How many numbers fall to each box, in proportion to its probability: in all as many as there are.
std::vector<double> numbersOf(const std::vector<SourceBox>& boxes) {
    const double fewest = std::clamp(std::floor(numbers / (2.0 * double(boxes.size()))), 1.0, fewestNumbers);
    double all = 0, taken = 0;
    for (const auto& [source, box] : boxes) all += box.probability;
    std::vector<double> counts;
    for (const auto& [source, box] : boxes) {
        counts.push_back(std::max(std::round(box.probability / all * numbers), fewest));
        taken += counts.back();
    }
    for (double over = taken - numbers; over != 0;) { // from those that have most
        double& most = *std::max_element(counts.begin(), counts.end());
        const double change = std::min(over, std::floor(most / 2));
        most -= change;
        over -= change;
    }
    return counts;
}

} // namespace

bool isSurroundings(const shared::Emitter& emitter) {
    return emitter.type == EMITTER_CONSTANT || emitter.type == EMITTER_ENVMAP;
}

bool isDistant(const shared::Emitter& emitter) {
    return isSurroundings(emitter) || emitter.type == EMITTER_DIRECTIONAL;
}

double GuideBox::volume() const {
    return std::accumulate(size.begin(), size.end(), 1.0, [](double product, double s) { return product * s; });
}

GuideTables makeGuideTables(const EmitterTables& emitters, std::vector<shared::GuideSource> sources,
                            const std::vector<SourceBox>& boxes) {
    GuideTables tables;
    double cdf = 0, logFlux = 0, heaviest = 0;
    const std::vector<double> counts = numbersOf(boxes);
    for (size_t k = 0; k < boxes.size(); ++k) {
        const auto& [source, box] = boxes[k];
        const double probability = counts[k] / numbers, weight = box.volume() / probability;
        cdf += probability;
        shared::GuideLeaf leaf{};
        leaf.cdf = static_cast<float>(cdf); // without rounding
        leaf.source = source;
        leaf.weight = static_cast<float>(weight);
        for (size_t d = 0; d < emissionDimensions; ++d) {
            leaf.lower[d] = static_cast<float>(box.lower[d]);
            leaf.size[d] = static_cast<float>(box.size[d]);
        }
        tables.leaves.push_back(leaf);
        const double flux = weight * fluxOf(emitters, sources[source]);
        logFlux += probability * std::log(flux);
        heaviest = std::max(heaviest, flux);
    }
    tables.typicalFlux = std::max(std::exp(logFlux), heaviest / heaviestToTypical);
    tables.sources = std::move(sources);
    return tables;
}

shared::GuideSource plainSource(unsigned emitter, unsigned first) {
    shared::GuideSource source{};
    source.emitter = emitter;
    source.first = first;
    return source;
}

GuideTables plainGuide(const EmitterTables& emitters) {
    std::vector<shared::GuideSource> sources;
    std::vector<SourceBox> boxes;
    for (unsigned k = 0; k < emitters.emitters.size(); ++k) {
        SourceBox whole{static_cast<unsigned>(sources.size()), {}};
        whole.box.probability = emitters.emitters[k].selectionProbability;
        if (!(whole.box.probability > 0)) continue;
        boxes.push_back(whole);
        sources.push_back(plainSource(k, static_cast<unsigned>(sources.size())));
    }
    return makeGuideTables(emitters, std::move(sources), boxes);
}

} // namespace quasilux
