#include "render/radius_field.h"

#include "prepare/pack.h"

#include <algorithm>
#include <cmath>

namespace quasilux {

namespace {

constexpr double steepest = 2; // of the factors at the two ends of an octave
constexpr double even = 1.25;  // factors that differ less than this are all 1
// Discs whose radius is no more than this share of their distance lie in two octaves.
constexpr double shareOfDistance = 0.25;

using Octave = LearnedScene::Octave;

double densityOf(const Octave& octave) {
    return octave.gathered > 0 && octave.arrived > 0 ? octave.arrived / octave.gathered : 0;
}

Octave sum(const Octave* begin, const Octave* end) {
    Octave all;
    for (const Octave* o = begin; o < end; ++o) {
        all.arrived += o->arrived;
        all.gathered += o->gathered;
    }
    return all;
}

// Radii by octave, from a first one on that holds all nearer ones.
struct OctaveRadii {
    unsigned first = 0;
    std::vector<double> factors;
};

OctaveRadii octaveRadii(const LearnedScene& learned, double radius, double largest) {
    const Octave* begin = learned.octaves.data();
    const double all = densityOf(sum(begin, begin + DISTANCE_OCTAVES));
    unsigned last = DISTANCE_OCTAVES;
    while (last > 0 && !(densityOf(begin[last - 1]) > 0)) --last;
    const auto factorOf = [&](const Octave& octave) {
        const double density = densityOf(octave);
        return density > 0 ? std::min(std::sqrt(all / density), largest) : 0;
    };
    // Of octave k, which begins there; of all before it, which reach half as far into it.
    const auto fits = [&](unsigned k) {
        const double distance = learned.tables.importance.nearest * std::exp2(k);
        const double before = k > 0 ? factorOf(sum(begin, begin + k)) : 0;
        return std::max(factorOf(begin[k]), before) * radius <= shareOfDistance * distance;
    };
    unsigned first = 0;
    while (first < last && !fits(first)) ++first;
    OctaveRadii radii{first, {}};
    if (first >= last) return radii;
    if (first > 0) radii.factors.push_back(factorOf(sum(begin, begin + first)));
    for (unsigned k = first; k < last; ++k) radii.factors.push_back(factorOf(begin[k]));
    if (first > 0) --radii.first; // its end is where the octave before begins
    double before = 0;            // where nothing is known of an octave, that of the one before
    for (double& factor : radii.factors) before = factor = factor > 0 ? factor : before;
    for (size_t k = radii.factors.size(); k-- > 1;)
        if (!(radii.factors[k - 1] > 0)) radii.factors[k - 1] = radii.factors[k];
    return radii;
}

} // namespace

shared::RadiusField radiusField(const LearnedScene& learned, double radius, double largest) {
    shared::RadiusField field{};
    const auto& grid = learned.tables.importance;
    if (!(grid.sizePerDistance > 0)) return field;
    const OctaveRadii radii = octaveRadii(learned, radius, largest);
    const auto [least, most] = std::minmax_element(radii.factors.begin(), radii.factors.end());
    if (radii.factors.size() < 2 || *most < even * *least) return field;
    field.octaves = static_cast<unsigned>(radii.factors.size());
    field.eye = grid.eye;
    field.nearest = static_cast<float>(grid.nearest * std::exp2(radii.first));
    const auto at = [&](size_t k) { return radii.factors[std::min(k, radii.factors.size() - 1)]; };
    double before = at(0);
    for (size_t k = 0; k <= radii.factors.size(); ++k) {
        const double wanted = std::sqrt(at(k > 0 ? k - 1 : 0) * at(k));
        before = std::clamp(wanted, before / steepest, before * steepest);
        field.factor[k] = static_cast<float>(before);
    }
    return field;
}

} // namespace quasilux
