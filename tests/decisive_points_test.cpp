// Points that may be the darkest or brightest of a grid: which they are, that they are measured at their places, and
// what norms ask for from readings of all points and other ones of those.
//
// False alarms: seeds are fixed; of 300 trials the variance of errors in units of stated ones is known to 8 %, and may
// be a quarter off, 3 of these.
#include "report/decisive_points.h"

#include "support/eye_readings.h"
#include "support/meter_scenes.h"

#include <cmath>
#include <gmock/gmock.h>
#include <random>

namespace quasilux {
namespace {

using testing::Contains;
using testing::ElementsAre;

/// Readings of points with these values, whose passes have normal noise of this standard deviation, relative to them.
BatchedReadings readingsOf(const std::vector<double>& values, double noise, unsigned passes, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    BatchedReadings readings(true);
    std::vector<double> sums(values.size());
    FilmImage image;
    image.width = unsigned(values.size());
    image.height = 1;
    for (image.passes = 1; image.passes <= passes; ++image.passes) {
        image.radiance.clear();
        for (size_t k = 0; k < values.size(); ++k) {
            sums[k] += values[k] * (1 + noise * normal(random));
            image.radiance.insert(image.radiance.end(), 3, float(sums[k] / image.passes));
        }
        readings.add(image);
    }
    return readings;
}

/// Two grids of 40 and 20 points; the least are 3 and 12, the largest 39 and 0 of theirs.
const std::vector<PixelRange> ranges{{0, 40}, {40, 20}};
std::vector<double> illuminances() {
    std::vector<double> values;
    for (int k = 0; k < 40; ++k) values.push_back(200 + 10 * std::abs(k - 3));
    for (int k = 0; k < 20; ++k) values.push_back(k == 0 ? 900 : 300 + 20 * std::abs(k - 12));
    return values;
}

TEST(DecisivePoints, AreThoseThatMayBeExtreme) {
    const auto readings = readingsOf(illuminances(), 0.2, 512, 1); // points are known to 0.9 %
    const auto decisive = decisivePoints(readings, ranges, 0.01);
    ASSERT_TRUE(decisive);
    ASSERT_EQ(decisive->size(), 2u);
    EXPECT_THAT(decisive->at(0).least, Contains(3));
    EXPECT_LT(decisive->at(0).least.size(), 10u);
    EXPECT_THAT(decisive->at(0).largest, Contains(39));
    EXPECT_THAT(decisive->at(1).least, Contains(12));
    EXPECT_THAT(decisive->at(1).largest, ElementsAre(0));
    const auto places = extremeRanges(*decisive);
    EXPECT_EQ(places[0].least.first, 0u);
    EXPECT_EQ(places[0].largest.first, decisive->at(0).least.size());
    EXPECT_EQ(places[1].least.first, decisive->at(0).count());
    EXPECT_EQ(places[1].largest.first + 1, decisive->at(0).count() + decisive->at(1).count());
}

TEST(DecisivePoints, AreNotMeasuredApartWhereThatIsMoreWork) {
    EXPECT_FALSE(decisivePoints(readingsOf(illuminances(), 0.2, 16, 1), ranges, 0.01)) << "too many may be extreme yet";
    EXPECT_FALSE(decisivePoints(readingsOf(illuminances(), 0.2, 1600, 1), ranges, 0.1)) << "all is known";
    EXPECT_FALSE(decisivePoints(readingsOf(std::vector(60, 100.0), 0.2, 64, 1), ranges, 0.01)) << "any may be extreme";
}

TEST(DecisivePoints, HaveTheirPlacesInTheGrid) {
    IlluminanceGrid grid;
    grid.kind = IlluminanceKind::cylindrical;
    grid.origin = {1, 2, 3};
    grid.edgeU = {4, 0, 1};
    grid.edgeV = {0, 3, 0};
    grid.nx = 4;
    grid.ny = 3;
    grid.flipNormals = true;
    grid.height = 0.5;
    const auto points = gridsOf({grid, grid}, {{{0, 7}, {11}}, {{}, {5}}});
    ASSERT_EQ(points.size(), 4u);
    const size_t numbers[] = {0, 7, 11, 5};
    for (size_t k = 0; k < points.size(); ++k) {
        const auto expected = grid.point(unsigned(numbers[k] % 4), unsigned(numbers[k] / 4));
        EXPECT_LT(glm::length(points[k].point(0, 0) - expected), 1e-12);
        EXPECT_LT(glm::length(points[k].normal() - grid.normal()), 1e-12);
        EXPECT_EQ(points[k].kind, grid.kind);
        EXPECT_EQ(points[k].height, grid.height);
        EXPECT_EQ(points[k].points(), 1u);
        EXPECT_NEAR(glm::length(glm::cross(points[k].edgeU, points[k].edgeV)) * 12,
                    glm::length(glm::cross(grid.edgeU, grid.edgeV)), 1e-12);
    }
}

/// Errors of figures over many trials, in units of those stated: means of their squares.
struct Trial {
    double mean = 0, minimum = 0, overall = 0, diversity = 0;
};
Trial squaresOfErrors(const ExtremeRanges& places) {
    const auto values = illuminances();
    const std::vector<double> again{values[3], values[2], values[4], values[39], values[38]};
    const double mean = 200 + (10.0 / 40) * (6 + 36 * 37 / 2.0); // of the first grid
    Trial sums;
    constexpr unsigned trials = 300;
    const auto squared = [](const Figure& figure, double truth) {
        return std::pow((figure.value - truth) / figure.standardError, 2) / trials;
    };
    for (unsigned seed = 1; seed <= trials; ++seed) {
        const auto all = readingsOf(values, 0.2, 64, 2 * seed), other = readingsOf(again, 0.02, 64, 2 * seed + 1);
        const NormFigures figures = normFigures(all, ranges[0], other, places);
        sums.mean += squared(figures.mean, mean);
        sums.minimum += squared(figures.minimum, 200);
        sums.overall += squared(figures.overall, 200 / mean);
        sums.diversity += squared(figures.diversity, 200 / 560.0);
    }
    return sums;
}

TEST(DecisivePoints, GiveFiguresWithTheirErrors) {
    const Trial right = squaresOfErrors({{0, 3}, {3, 2}});
    for (const double square : {right.mean, right.minimum, right.overall, right.diversity})
        EXPECT_NEAR(square, 1, 0.25);
    const Trial wrong = squaresOfErrors({{1, 2}, {3, 2}});
    EXPECT_GT(wrong.minimum, 2) << "negative control: without the darkest point";
    EXPECT_GT(squaresOfErrors({{3, 2}, {0, 3}}).diversity, 100) << "negative control: least and largest exchanged";
}

// By a device: points of a grid, one by one, have what the grid has there.
TEST(DecisivePoints, AreReadAsInTheGrid) {
    Scene scene = test::meterScene(
        test::squareLight(1, "z=\"1\"") + test::rectangle("3,3,1", "", "0,0,-0.5", test::diffuse(0.7)) +
        "<?quasilux illuminance-grid origin=\"-1,-1,0\" edge-u=\"2,0,0\" edge-v=\"0,2,0\" nx=\"5\" ny=\"4\" "
        "normal=\"0,0,-1\"?>");
    const std::vector<DecisivePoints> decisive{{{0, 7}, {13}}};
    Scene points = scene;
    points.grids = gridsOf(scene.grids, decisive);
    useGridsAsSensor(points);
    const auto read = [](const Scene& measured, uint64_t seed) {
        RenderSettings settings;
        settings.seed = seed;
        Renderer renderer(testDevice(), measured, settings);
        BatchedReadings readings(false);
        for (unsigned pass = 0; pass < 32; ++pass) {
            renderer.renderPass(pass);
            readings.add(renderer.develop());
        }
        return std::pair{readings.means(), readings.standardErrors()};
    };
    const auto [all, errors] = read(scene, 1);
    const auto [some, errorsOfSome] = read(points, 2);
    ASSERT_EQ(some.size(), 3u);
    const size_t numbers[] = {0, 7, 13};
    for (size_t k = 0; k < 3; ++k) {
        const double error = std::hypot(errors[numbers[k]], errorsOfSome[k]);
        EXPECT_NEAR(some[k], all[numbers[k]], 4 * error + 1e-5 * some[k]);
        EXPECT_LT(error, 0.01 * some[k]) << "too noisy to decide anything";
        EXPECT_GT(std::abs(some[k] - all[numbers[(k + 1) % 3]]), 4 * error) << "control: another point";
    }
}

} // namespace
} // namespace quasilux
