#include "prepare/direct_sharing.h"

#include <algorithm>

namespace quasilux {

namespace {

// In a modified Cornell box sharing begins to pay between shares of 1.3 and 5 per cent.
constexpr double leastShareOfArea = 0.03;

bool mustShare(const shared::Emitter& emitter) {
    const bool fromWithin = emitter.type == EMITTER_SPHERE && emitter.normalSign < 0; // sampled by area
    return fromWithin || emitter.type == EMITTER_TRIANGLES || emitter.type == EMITTER_CONSTANT ||
           emitter.type == EMITTER_ENVMAP;
}

bool hasArea(const shared::Emitter& emitter) {
    return emitter.type == EMITTER_RECTANGLE || emitter.type == EMITTER_SPHERE;
}

} // namespace

unsigned directSharing(const std::vector<shared::Emitter>& all, double scatteringArea, bool meter) {
    if (std::any_of(all.begin(), all.end(), mustShare)) return DIRECT_SHARING_LAMBERT | DIRECT_SHARING_MEDIA;
    if (meter) return 0;
    double area = 0;
    for (const auto& emitter : all) area += hasArea(emitter) ? emitter.area : 0;
    return area > leastShareOfArea * scatteringArea ? DIRECT_SHARING_LAMBERT : 0;
}

} // namespace quasilux
