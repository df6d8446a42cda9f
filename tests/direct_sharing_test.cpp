// Which scattering shares direct light with emitter sampling. Nothing is estimated.
#include "prepare/direct_sharing.h"

#include <gtest/gtest.h>

namespace quasilux {
namespace {

std::vector<shared::Emitter> emitterOf(unsigned type, float area) {
    shared::Emitter emitter{};
    emitter.type = type;
    emitter.area = area;
    emitter.normalSign = 1;
    return {emitter};
}

TEST(DirectSharing, LambertLobesShareUnderLargeEmitters) {
    for (const unsigned type : {EMITTER_RECTANGLE, EMITTER_SPHERE}) {
        EXPECT_EQ(directSharing(emitterOf(type, 1), 100, false), 0u);
        EXPECT_EQ(directSharing(emitterOf(type, 10), 100, false), DIRECT_SHARING_LAMBERT);
        EXPECT_EQ(directSharing(emitterOf(type, 10), 100, true), 0u) << "a meter";
    }
}

TEST(DirectSharing, SeveralEmittersCountTogether) {
    auto emitters = emitterOf(EMITTER_RECTANGLE, 2);
    emitters.push_back(emitters[0]);
    EXPECT_EQ(directSharing(emitters, 100, false), DIRECT_SHARING_LAMBERT);
}

// Directions cannot meet them; and `area` of parallel light is that of its beam.
TEST(DirectSharing, PointsAndBeamsAreNothingToShareWith) {
    for (const unsigned type : {EMITTER_POINT, EMITTER_DIRECTIONAL})
        EXPECT_EQ(directSharing(emitterOf(type, 1000), 100, false), 0u);
}

TEST(DirectSharing, UnboundedEstimatesAlwaysShare) {
    for (const unsigned type : {EMITTER_TRIANGLES, EMITTER_CONSTANT})
        for (const bool meter : {false, true})
            EXPECT_EQ(directSharing(emitterOf(type, 1e-3f), 100, meter), DIRECT_SHARING_LAMBERT | DIRECT_SHARING_MEDIA);
}

TEST(DirectSharing, SpheresThatShineInwardsToo) {
    auto emitters = emitterOf(EMITTER_SPHERE, 1);
    EXPECT_EQ(directSharing(emitters, 100, true), 0u);
    emitters[0].normalSign = -1;
    EXPECT_EQ(directSharing(emitters, 100, true), DIRECT_SHARING_LAMBERT | DIRECT_SHARING_MEDIA);
}

TEST(DirectSharing, NothingThatScattersNothingThatShares) { EXPECT_EQ(directSharing({}, 0, false), 0u); }

} // namespace
} // namespace quasilux
