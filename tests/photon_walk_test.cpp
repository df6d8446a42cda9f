// Photons that walk through a medium by eight (kernels/photon_walk.clh) do what they do on their own: the same numbers
// are drawn, so paths differ by rounding only, which grows from collision to collision. And thinning keeps the mean.
//
// Walks are compiled on every device here (-DWALK_ANYWHERE); photons on their own by the option that the kernels have
// for devices without AVX.
//
// Deterministic: photons of the first collisions, of which 99 % must agree to 0.002 mm; with another seed (the negative
// control) next to none does. Statistical: flux by class, the mean of 12 passes of the ratio of two runs that share
// their paths, within 4 standard errors of 1 (Student t with 11 degrees of freedom: 0.2 % a case); seeds are fixed.
#include "support/render_statistics.h"
#include "support/stored_photons.h"
#include "support/traversal_device.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace quasilux {
namespace {

StoredPasses trace(const PhotonTracing& tracing) {
    RenderSettings settings;
    settings.quasiSpecular = "level:0.1";
    settings.quasiSpecularOverridesScene = true;
    settings.bdd = 0;
    FlattenSettings flattening;
    flattening.quasiSpecular = settings.quasiSpecular;
    flattening.overridesScene = true;
    return tracePhotons(flattenScene(projectScene("plate_checker.xml"), flattening), settings, tracing);
}

double flux(const std::vector<StoredPhoton>& photons) {
    double sum = 0;
    for (const auto& photon : photons) sum += photon.flux.r;
    return sum;
}

/// Share of the photons of `a` that have a partner in `b`.
double sharePaired(std::vector<StoredPhoton> a, std::vector<StoredPhoton> b) {
    constexpr float tolerance = 0.002f;
    const auto byX = [](const StoredPhoton& one, const StoredPhoton& other) { return one.x < other.x; };
    std::sort(b.begin(), b.end(), byX);
    size_t paired = 0;
    for (const auto& p : a) {
        auto other = std::lower_bound(b.begin(), b.end(), StoredPhoton{p.x - tolerance, 0, 0, {}}, byX);
        for (; other != b.end() && other->x <= p.x + tolerance; ++other)
            if (std::abs(other->y - p.y) <= tolerance && std::abs(other->z - p.z) <= tolerance) {
                ++paired;
                break;
            }
    }
    return double(paired) / double(a.size());
}

/// Flux in a slot, `a` to `b`.
MeanAndError fluxRatio(const StoredPasses& a, const StoredPasses& b, unsigned slot) {
    std::vector<double> ratios;
    for (unsigned pass = 0; pass < a.size(); ++pass) ratios.push_back(flux(a[pass][slot]) / flux(b[pass][slot]));
    return meanAndError(ratios);
}

const std::string walking = " -DWALK_ANYWHERE", onTheirOwn = " -DPORTABLE_MASK";

const StoredPasses& abreast() {
    static const StoredPasses stored = trace({walking});
    return stored;
}

TEST(PhotonWalk, AbreastPhotonsDoWhatTheyDoOnTheirOwn) {
    const StoredPasses alone = trace({onTheirOwn}), otherSeed = trace({onTheirOwn, {1, 1, 1, 1}, 8});
    for (const unsigned lightClass : {LIGHT_CAUSTIC, LIGHT_QUASI_CAUSTIC, LIGHT_DIFFUSE}) {
        const unsigned slot = VOLUME_SLOT(lightClass);
        ASSERT_GT(abreast()[0][slot].size(), 300u) << "too few photons of class " << lightClass;
        const MeanAndError ratio = fluxRatio(abreast(), alone, slot);
        EXPECT_NEAR(ratio.mean, 1, 4 * ratio.standardError + 1e-6) << "class " << lightClass;
        EXPECT_LT(ratio.standardError, 0.02) << "too noisy to decide anything about class " << lightClass;
    }
    const unsigned first = VOLUME_SLOT(LIGHT_CAUSTIC); // first collisions: nothing has scattered before
    EXPECT_GT(sharePaired(abreast()[0][first], alone[0][first]), 0.99);
    EXPECT_LT(sharePaired(abreast()[0][first], otherSeed[0][first]), 0.01) << "any photon would have a partner";
}

// Negative controls: flights that end beyond the border taken for collisions; the phase function's value the wrong way
// round.
TEST(PhotonWalk, WrongWalksAreFound) {
    const StoredPasses alone = trace({onTheirOwn});
    const unsigned slot = VOLUME_SLOT(LIGHT_DIFFUSE);
    for (const auto& [right, wrong] :
         {std::pair("return clearance > 2 *", "return clearance + 0.03f > 2 *"),
          std::pair("phaseValue8(in->medium, 1.0f - oneMinusCos)", "phaseValue8(in->medium, oneMinusCos - 1.0f)")}) {
        const StoredPasses walked = trace({walking, {1, 1, 1, 1}, 7, mutant("photon_walk.clh", right, wrong)});
        const MeanAndError ratio = fluxRatio(walked, alone, slot);
        EXPECT_GT(std::abs(ratio.mean - 1), 4 * ratio.standardError + 1e-6) << wrong;
    }
}

TEST(PhotonWalk, ThinningKeepsTheMean) {
    const std::array<float, LIGHT_CLASSES> keep = {1, 0.5f, 0.3f, 0.11f};
    for (const std::string& options : {walking, onTheirOwn, onTheirOwn + walking}) {
        const StoredPasses thinned = trace({options, keep});
        for (const unsigned lightClass : {LIGHT_CAUSTIC, LIGHT_QUASI_CAUSTIC, LIGHT_DIFFUSE}) {
            const unsigned slot = VOLUME_SLOT(lightClass);
            const MeanAndError ratio = fluxRatio(thinned, abreast(), slot);
            EXPECT_NEAR(ratio.mean, 1, 4 * ratio.standardError) << "class " << lightClass << options;
            EXPECT_LT(ratio.standardError, 0.012) << "too noisy to decide anything about class " << lightClass;
            // Negative control: flux divided by a share 5 % off would be seen.
            EXPECT_GT(std::abs(1.05 * ratio.mean - 1), 4 * ratio.standardError) << "class " << lightClass << options;
            const double share = double(thinned[0][slot].size()) / double(abreast()[0][slot].size());
            EXPECT_NEAR(share, keep[lightClass], 0.1 * keep[lightClass]);
        }
    }
}

} // namespace
} // namespace quasilux
