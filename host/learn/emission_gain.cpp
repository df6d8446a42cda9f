#include "learn/emission_gain.h"

#include "prepare/device_scene.h"

#include <algorithm>

namespace quasilux {

namespace {

// A photon's squares count at most this many times the median: a few that are brought by chance would decide alone.
constexpr float heaviestSquares = 1000;

float mostSquares(const std::vector<shared::PhotonRecord>& photons) {
    std::vector<float> squares;
    for (const auto& photon : photons)
        if (photon.squares > 0) squares.push_back(photon.squares);
    if (squares.empty()) return 0;
    const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
    std::nth_element(squares.begin(), middle, squares.end());
    return heaviestSquares * *middle;
}

} // namespace

// E_plain[f] = E_guided[f r] with r = density by plain emission / density by the guide = flux / plain flux. By plain
// emission the square of what a photon brings is 1 / r^2 as large.
void EmissionGain::add(const std::vector<shared::PhotonRecord>& photons, const EmitterTables& emitters) {
    const float most = mostSquares(photons);
    for (const auto& photon : photons) {
        const unsigned e = photon.emission.emitter;
        if (e == QL_NONE || !(photon.flux > 0)) continue;
        const double plainFlux = emitters.power[e] / emitters.emitters[e].selectionProbability;
        const double r = photon.flux / plainFlux, squares = std::min(photon.squares, most);
        noise_ += squares;
        plainNoise_ += squares / r;
        events_ += photon.events;
        plainEvents_ += photon.events * r;
    }
}

double EmissionGain::ratio() const {
    return noise_ * events_ > 0 ? plainNoise_ * plainEvents_ / (noise_ * events_) : 1;
}

} // namespace quasilux
