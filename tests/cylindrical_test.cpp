// Several grids in one render, and cylindrical illuminance: E = 1/pi times the integral of L sin(theta) over all
// directions (EN 12665).
//
// Readings of 8 passes with their standard errors. A test holds chi^2 of its points below mean + 4 standard deviations
// of 8 points with as much freedom (Student's t of 7 has a variance of 1.4; false alarms below 1e-3, and seeds are
// fixed), and each has a wrong rule that it must find.
#include "output/meter_reading.h"
#include "render/renderer.h"
#include "support/meter_scenes.h"
#include "support/shared_features.h"
#include "support/test_kernels.cpp"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <numbers>

namespace quasilux {
namespace {

using glm::dvec3;
using std::numbers::pi;

constexpr unsigned passes = 8;
const std::string lamp = "<emitter type=\"point\"><rgb name=\"intensity\" value=\"10\"/>"
                         "<point name=\"position\" x=\"0.3\" y=\"-0.2\" z=\"2\"/></emitter>";
const dvec3 lampPlace(0.3, -0.2, 2);
constexpr double lampIntensity = 10;

std::string grid(const std::string& name, const std::string& quantity, unsigned nx = 4, unsigned ny = 2) {
    return fmt::format("<?quasilux illuminance-grid name=\"{}\" quantity=\"{}\" origin=\"-1,-1,0\" edge-u=\"2,0,0\" "
                       "edge-v=\"0,2,0\" nx=\"{}\" ny=\"{}\"?>",
                       name, quantity, nx, ny);
}

FilmImage render(const Scene& scene, RenderSettings settings) {
    settings.furtherFeatures = test::surfaceFeatures();
    Renderer renderer(testDevice(), scene, settings);
    for (unsigned pass = 0; pass < passes; ++pass) renderer.renderPass(pass);
    EXPECT_EQ(renderer.counters().nonFinite, 0u);
    return renderer.develop();
}

double cylindricalAt(const dvec3& point) {
    const dvec3 offset = lampPlace - point;
    const double distance = glm::length(offset), sine = std::hypot(offset.x, offset.y) / distance;
    return lampIntensity * sine / (pi * distance * distance);
}

double planarAt(const dvec3& point) {
    const dvec3 offset = lampPlace - point;
    return lampIntensity * offset.z / std::pow(glm::length(offset), 3);
}

/// Mean of `value` over the cell of a point, `height` high.
double meanOverCell(const IlluminanceGrid& grid, unsigned i, unsigned j, double height,
                    const std::function<double(const dvec3&)>& value) {
    constexpr int n = 24;
    double sum = 0;
    for (int a = 0; a < n; ++a)
        for (int b = 0; b < n; ++b)
            for (int c = 0; c < n; ++c)
                sum += value(grid.point(i, j) + ((a + 0.5) / n - 0.5) / grid.nx * grid.edgeU +
                             ((b + 0.5) / n - 0.5) / grid.ny * grid.edgeV +
                             ((c + 0.5) / n - 0.5) * height * grid.normal());
    return sum / (n * n * n);
}

/// Whether the readings of a grid's points are `truth`.
bool agrees(const FilmImage& image, PixelRange range, const std::vector<double>& truth) {
    double chi2 = 0;
    for (size_t k = 0; k < range.count; ++k) {
        const size_t at = 3 * (range.first + k);
        const double error = std::hypot(image.standardError[at], 1e-5 * truth[k]);
        chi2 += std::pow((image.radiance[at] - truth[k]) / error, 2);
    }
    const double count = static_cast<double>(range.count);
    return chi2 < 1.4 * count + 4 * std::sqrt(2.0 * 1.4 * 1.4 * 3 * count);
}

std::vector<double> truths(const IlluminanceGrid& grid, const std::function<double(unsigned, unsigned)>& value) {
    std::vector<double> all;
    for (unsigned j = 0; j < grid.ny; ++j)
        for (unsigned i = 0; i < grid.nx; ++i) all.push_back(value(i, j));
    return all;
}

TEST(SeveralGrids, AreMeasuredTogether) {
    const Scene scene = test::meterScene(lamp + grid("floor", "planar", 3, 2) + grid("faces", "cylindrical") +
                                         grid("again", "planar", 1, 1));
    ASSERT_EQ(scene.grids.size(), 3u);
    EXPECT_EQ(scene.sensor.width, 15u);
    const FilmImage image = render(scene, {});
    const auto ranges = rangesOf(scene.grids);
    for (const size_t k : {size_t{0}, size_t{2}})
        EXPECT_TRUE(agrees(
            image, ranges[k],
            truths(scene.grids[k], [&](unsigned i, unsigned j) { return planarAt(scene.grids[k].point(i, j)); })))
            << scene.grids[k].name;
    const auto right =
        truths(scene.grids[1], [&](unsigned i, unsigned j) { return cylindricalAt(scene.grids[1].point(i, j)); });
    EXPECT_TRUE(agrees(image, ranges[1], right));
    auto wrong = right;
    for (double& value : wrong) value *= 1.02;
    EXPECT_FALSE(agrees(image, ranges[1], wrong)) << "2 % more";
}

TEST(Cylindrical, IsPiInEvenLight) {
    const Scene scene = test::meterScene("<emitter type=\"constant\"><rgb name=\"radiance\" value=\"1\"/></emitter>" +
                                         grid("faces", "cylindrical") + grid("floor", "planar"));
    const FilmImage image = render(scene, {});
    for (const PixelRange& range : rangesOf(scene.grids))
        EXPECT_TRUE(agrees(image, range, std::vector<double>(range.count, pi)));
    EXPECT_EQ(horizontalTwin(scene.grids, 0), std::optional<size_t>(1));
    EXPECT_EQ(horizontalTwin(scene.grids, 1), std::nullopt) << "it is the horizontal one";
    const Modelling found = modelling(image, rangesOf(scene.grids)[0], rangesOf(scene.grids)[1], true);
    EXPECT_NEAR(found.ofMeans, 1, 4 * found.ofMeansStandardError);
    EXPECT_LE(found.least, found.ofMeans);
    EXPECT_GE(found.most, found.ofMeans);
}

// Photons are counted all the way through the cells about the points.
TEST(Cylindrical, IsTheMeanOverCellsByPhotons) {
    RenderSettings settings;
    settings.direct = DirectLight::photons;
    settings.photonsPerPass = 400000;
    const Scene scene = test::meterScene(lamp + grid("faces", "cylindrical"));
    const IlluminanceGrid& cells = scene.grids.front();
    EXPECT_DOUBLE_EQ(cells.height, 0.5) << "as high as the shorter side";
    const FilmImage image = render(scene, settings);
    const auto meanOf = [&](double height, const std::function<double(const dvec3&)>& value) {
        return truths(cells, [&](unsigned i, unsigned j) { return meanOverCell(cells, i, j, height, value); });
    };
    EXPECT_TRUE(agrees(image, {0, 8}, meanOf(cells.height, cylindricalAt)));
    const auto withoutSine = [](const dvec3& point) {
        const dvec3 offset = lampPlace - point;
        return lampIntensity / (pi * glm::dot(offset, offset));
    };
    EXPECT_FALSE(agrees(image, {0, 8}, meanOf(cells.height, withoutSine))) << "mean spherical, not cylindrical";
    EXPECT_FALSE(agrees(image, {0, 8}, meanOf(4 * cells.height, cylindricalAt))) << "cells of another height";
}

// Sunlight along the cells of a grid in absorbing fog, of which red light is weakened e^-2 times in each. Control: what
// is left in the middle of a cell counts for all of it.
TEST(Cylindrical, PhotonsFadeAlongTheCellsInColouredFog) {
    RenderSettings settings;
    settings.direct = DirectLight::photons;
    settings.photonsPerPass = 100000;
    const Scene scene = test::meterScene(
        R"(<emitter type="directional"><vector name="direction" value="1,0,0"/><rgb name="irradiance" value="1"/></emitter>
        <shape type="cube"><transform name="to_world"><scale x="1" y="3" z="3"/></transform><bsdf type="null"/>
        <medium name="interior" type="homogeneous"><rgb name="sigma_t" value="4,1,1"/><float name="albedo" value="0"/>
        </medium></shape>)" +
        grid("faces", "cylindrical"));
    const auto truth = truths(scene.grids.front(), [](unsigned i, unsigned) {
        const double entry = 4 * 0.5 * i, exit = entry + 2;
        return (std::exp(-entry) - std::exp(-exit)) / 2 / pi;
    });
    EXPECT_TRUE(agrees(render(scene, settings), {0, 8}, truth));
    settings.controlOptions = " -DMETER_MIDDLE";
    EXPECT_FALSE(agrees(render(scene, settings), {0, 8}, truth)) << "negative control";
}

TEST(SeveralGrids, HaveNamesOfTheirOwn) {
    const auto refusal = [](const std::string& body) {
        try {
            test::meterScene(lamp + body);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_NE(refusal(grid("a", "planar") + grid("a", "planar")).find("has the name 'a' too"), std::string::npos);
    EXPECT_NE(refusal(grid("a,b", "planar")).find("has a comma"), std::string::npos);
    EXPECT_NE(refusal(grid("a", "spherical")).find("expected planar or cylindrical"), std::string::npos);
}

} // namespace
} // namespace quasilux
