// Parallel light: irradiance by the cosine law, through clear panes with all their internal reflections, and focused by
// a ball of glass. What comes through glass is a caustic, so meters count photons here, whatever samples direct light.
//
// A reading passes within 3 of its standard errors (two-sided, Student's t: 2 % of right readings would fail after 8
// passes, 0.9 % after 16; the seed is fixed, so what passes goes on passing); it must be known to 0.35 %, and light 2 % stronger must be found wrong.
#include "support/meter_readings.h"

#include <numbers>

namespace quasilux {
namespace {

/// Parallel light that comes down at `angle` degrees to the vertical.
std::string beamAt(double angle) {
    const double t = angle * std::numbers::pi / 180;
    return test::beam(fmt::format("{:.9f},0,{:.9f}", std::sin(t), -std::cos(t)));
}

const Method methods[] = {{"emitters"},
                          {"photons", 0, "auto", DirectLight::photons},
                          {"camera map, BDD 1", 1, "auto", DirectLight::emitters, Variant::main, MapOrder::camera}};

TEST(Beam, FollowsTheCosineLaw) {
    for (const double tilt : {0.0, 40.0, 85.0}) {
        const auto scene = test::meterScene(test::beam("0,0,-1") + test::meterAt(tilt, "y", 0.5));
        const double truth = std::cos(tilt * std::numbers::pi / 180);
        for (const Method& method : methods) {
            SCOPED_TRACE(fmt::format("{} {}", tilt, method.name));
            expectReading(scene, method, truth, false, 8, 50000);
        }
    }
}

/// T = (1 - R) / (1 + R), R the mean of both polarisations at one hit (Stokes 1862, pile of plates).
double transmittance(double angle, double index) {
    const double t = angle * std::numbers::pi / 180, c = std::cos(t),
                 ct = std::sqrt(1 - std::sin(t) * std::sin(t) / (index * index));
    const double s = (c - index * ct) / (c + index * ct), p = (index * c - ct) / (index * c + ct);
    const double r = (s * s + p * p) / 2;
    return (1 - r) / (1 + r);
}

TEST(Beam, PassesAClearPaneWithAllItsReflections) {
    EXPECT_NEAR(transmittance(60, 1.5), 0.8362324627101683, 1e-12);
    // Thin and close, so that no reflection of weight comes from beside it.
    const std::string pane = "<shape type=\"cube\"><transform name=\"to_world\"><scale value=\"2,2,0.05\"/>"
                             "<translate z=\"0.1\"/></transform>" +
                             test::glass(1.5) + "</shape>";
    for (const double angle : {0.0, 45.0, 75.0}) {
        const auto scene = test::meterScene(beamAt(angle) + pane + test::meterAt(0, "y", 1));
        const double truth = std::cos(angle * std::numbers::pi / 180) * transmittance(angle, 1.5);
        const unsigned passes = angle > 70 ? 16 : 8, photons = angle > 70 ? 200000 : 50000; // few enter it there
        for (const Method& method : methods) {
            SCOPED_TRACE(fmt::format("{} {}", angle, method.name));
            expectReading(scene, method, truth, false, passes, photons);
        }
        // Control: without what is reflected within the pane, (1 - R)^2.
        const double r = (1 - transmittance(angle, 1.5)) / (1 + transmittance(angle, 1.5));
        if (angle > 70) {
            EXPECT_FALSE(agrees(measure(scene, methods[0], passes, photons), truth * (1 - r) * (1 + r), false));
        }
    }
}

/// A ball of radius 1 and index 1.5, 1.2 above the floor, all orders of internal reflection: by quadrature over the
/// impact parameter (scripts/oracles.py, `ball_lens`), mean over a square of side 1 under it.
TEST(Beam, IsFocusedByABallOfGlass) {
    const auto scene = test::meterScene(test::beam("0,0,-1") +
                                        "<shape type=\"sphere\"><point name=\"center\" x=\"0\" "
                                        "y=\"0\" z=\"1.2\"/>" +
                                        test::glass(1.5) + "</shape>" + test::meterAt(0, "y", 0.5));
    for (const Method& method : methods) {
        SCOPED_TRACE(method.name);
        expectReading(scene, method, 2.569710934867342, false, 8, 100000);
    }
}

} // namespace
} // namespace quasilux
