// Reconstruction filters as tables: places follow the filter's magnitude, weighted means are those of the filter
// itself, also where it ends at the edge of the image; an image seen through each is what the filter makes of it,
// whether pixels share samples or not.
//
// False alarms: all chi-squared and z tests together raise one with probability 1e-4 (support/chi_squared.h).
#include "prepare/device_scene.h"
#include "prepare/filter_table.h"
#include "prepare/scene_tables.h"
#include "render/renderer.h"
#include "support/chi_squared.h"
#include "support/scene_files.h"
#include "support/test_kernels.h"

#include <cmath>

namespace quasilux {
namespace {

constexpr int tests = 64; // upper bound of their number in this program

constexpr unsigned width = 16, height = 8;

Scene sceneSeenBy(const std::string& filter, const std::string& film = "") {
    test::SceneFiles files;
    // A bright rectangle over x in [-0.25, 0.75] and y in [-0.125, 0.25], of pixels 1/8 wide.
    return loadScene(files.write(
        "scene.xml",
        R"(<scene version="3.0.0"><sensor type="orthographic"><transform name="to_world"><lookat origin="0,0,5"
           target="0,0,0" up="0,1,0"/></transform><film type="hdrfilm"><integer name="width" value="16"/><integer
           name="height" value="8"/>)" +
            film + filter +
            R"(</film></sensor><shape type="rectangle"><transform name="to_world"><scale x="0.5" y="0.1875"/>
           <translate x="0.25" y="0.0625"/></transform><emitter type="area"><rgb name="radiance" value="3,2,1"/>
           </emitter></shape></scene>)"));
}

const std::string lanczos = R"(<rfilter type="lanczos"/>)", catmullRom = R"(<rfilter type="catmullrom"/>)",
                  mitchell = R"(<rfilter type="mitchell"/>)", gaussian = R"(<rfilter type="gaussian"/>)",
                  ends = R"(<boolean name="sample_border" value="false"/>)";

struct Case {
    std::string filter, film;
    unsigned pixel;
};
const std::vector<Case> cases{{lanczos, "", 60},
                              {R"(<rfilter type="lanczos"><integer name="lobes" value="2"/></rfilter>)", "", 0},
                              {catmullRom, "", 60},
                              {mitchell, "", 60},
                              {R"(<rfilter type="mitchell"><float name="B" value="0.2"/></rfilter>)", "", 60},
                              {gaussian, ends, 0},     // upper left corner
                              {lanczos, ends, 127},    // lower right corner
                              {lanczos, ends, 1 + 16}, // beside the corner
                              {R"(<rfilter type="tent"><float name="radius" value="1.5"/></rfilter>)", ends, 15}};

struct Place {
    float x, y, weight, unused;
};

std::vector<Place> placesOf(const Sensor& sensor, unsigned pixel, const std::vector<float>& numbers) {
    struct Float2 {
        float x, y;
    };
    std::vector<Float2> pairs;
    for (size_t k = 0; k + 1 < numbers.size(); k += 2) pairs.push_back({numbers[k], numbers[k + 1]});
    SceneTableWriter tables;
    shared::Camera camera = flattenCamera(sensor);
    camera.filterSteps = tables.append(std::vector<unsigned>{7, 7, 7}) + 3;
    tables.append(filterTable(sensor));
    Program program = testProgram("film.cl", "-DBVH_STACK_SIZE=32 -DPHOTON_CLASSES=8u -DHAS_FILTER_TABLE");
    Buffer<Float2> input(testDevice(), pairs, "numbers");
    Buffer<uint32_t> words(testDevice(), tables.words(), "tables");
    Buffer<Place> places(testDevice(), pairs.size(), "places");
    program.kernel("filterPlaces").launch(pairs.size(), input, places, words, camera, pixel, unsigned(pairs.size()));
    return places.read();
}

/// Along one axis the part of the filter that lies on the film, by its distance from pixel `at` of `size`.
double filterAt(const Sensor& sensor, double x, unsigned at, unsigned size) {
    if (std::abs(x) >= sensor.filterRadius) return 0;
    const double onFilm = at + 0.5 + x;
    return sensor.filterEnds && (onFilm < 0 || onFilm > size) ? 0 : sensor.filterShape(std::abs(x));
}
double filterAt(const Sensor& sensor, unsigned pixel, double x, double y) {
    return filterAt(sensor, x, pixel % width, width) * filterAt(sensor, y, pixel / width, height);
}

double magnitudePValue(const Sensor& sampled, const Sensor& expected, unsigned pixel) {
    const double r = sampled.filterRadius;
    const SampleGrid grid{-r, r, -r, r, 24, 24};
    std::vector<double> probabilities(size_t(grid.cells()), 0);
    double total = 0;
    for (const QuadraturePoint& q : gridQuadrature(grid, 64)) {
        const double value = std::abs(filterAt(expected, pixel, q.u, q.v)) * q.weight;
        probabilities[size_t(q.cell)] += value;
        total += value;
    }
    for (double& p : probabilities) p /= total;
    std::vector<uint64_t> counts(size_t(grid.cells()) + 1, 0);
    for (const Place& p : placesOf(sampled, pixel, uniformNumbers(400'000, 5))) ++counts[size_t(grid.cell(p.x, p.y))];
    return chiSquaredPValue(counts, probabilities);
}

TEST(FilterTable, PlacesFollowTheMagnitudeOfTheFilter) {
    for (const Case& c : cases) {
        const Sensor sensor = sceneSeenBy(c.filter, c.film).sensor;
        ASSERT_TRUE(needsFilterTable(sensor));
        EXPECT_GT(magnitudePValue(sensor, sensor, c.pixel), significanceLevel(tests)) << c.filter << c.film;
    }
    // Control: Mitchell's filter with B = 0.2 taken for that of 1/3.
    EXPECT_LT(magnitudePValue(sceneSeenBy(cases[4].filter).sensor, sceneSeenBy(mitchell).sensor, 60),
              significanceLevel(tests));
}

/// z of the weighted mean of cos(a x + b y) against the filter's own; `wrong`: magnitudes of the weights are taken.
double meanDeviate(const Case& c, double a, double b, bool wrong) {
    const Sensor sensor = sceneSeenBy(c.filter, c.film).sensor;
    const double r = sensor.filterRadius;
    double integral = 0, total = 0;
    for (const QuadraturePoint& q : gridQuadrature({-r, r, -r, r, 24, 24}, 64)) {
        const double value = filterAt(sensor, c.pixel, q.u, q.v) * q.weight;
        integral += value * std::cos(a * q.u + b * q.v);
        total += value;
    }
    double sum = 0, squares = 0;
    const auto places = placesOf(sensor, c.pixel, uniformNumbers(400'000, 6));
    for (const Place& p : places) {
        const double weight = wrong ? std::abs(p.weight) : p.weight;
        const double value = weight * std::cos(a * p.x + b * p.y);
        sum += value;
        squares += value * value;
    }
    const double n = double(places.size()), mean = sum / n;
    return (mean - integral / total) / std::sqrt(std::max(1e-12, squares / n - mean * mean) / n);
}

TEST(FilterTable, WeightedMeansAreThoseOfTheFilter) {
    for (const Case& c : cases)
        for (const double a : {0.0, 2.3})
            EXPECT_GT(normalPValue(meanDeviate(c, a, 1.1, false)), significanceLevel(tests)) << c.filter << c.film;
    EXPECT_LT(normalPValue(meanDeviate(cases[0], 2.3, 1.1, true)), significanceLevel(tests)) << "control: no sign";
}

TEST(FilterTable, EndsOfTheUnitInterval) {
    for (const Case& c : cases) {
        const Sensor sensor = sceneSeenBy(c.filter, c.film).sensor;
        for (const Place& p : placesOf(sensor, c.pixel, extremeNumbers(2))) {
            EXPECT_LE(std::max(std::abs(p.x), std::abs(p.y)), sensor.filterRadius + 1.0 / FILTER_CELLS);
            EXPECT_TRUE(std::isfinite(p.weight));
        }
    }
}

/// Share of the filter of pixel `at` that lies over [from, to), in pixels.
double shareOver(const Sensor& sensor, unsigned at, unsigned size, double from, double to) {
    constexpr int points = 20000;
    double inside = 0, all = 0;
    for (int k = 0; k < points; ++k) {
        const double x = sensor.filterRadius * (2 * (k + 0.5) / points - 1), place = at + 0.5 + x;
        const double value = filterAt(sensor, x, at, size);
        all += value;
        if (place >= from && place < to) inside += value;
    }
    return inside / all;
}

double worstPValue(const Sensor& expected, const FilmImage& image) {
    double worst = 1;
    for (unsigned row = 0; row < height; ++row)
        for (unsigned column = 0; column < width; ++column) {
            const double truth = 3 * shareOver(expected, column, width, 6, 14) * shareOver(expected, row, height, 2, 5);
            const size_t at = size_t(3) * (row * width + column);
            const double error = image.standardError[at];
            if (error > 0) worst = std::min(worst, normalPValue((image.radiance[at] - truth) / error));
        }
    return worst;
}

FilmImage imageOf(const Scene& scene, MapOrder map) {
    RenderSettings settings;
    settings.photonsPerPass = 256;
    settings.map = map;
    Renderer renderer(testDevice(), scene, settings);
    for (unsigned pass = 0; pass < 600; ++pass) renderer.renderPass(pass);
    return renderer.develop();
}

// Of 128 pixels: the level of the worst one. Batches make the error of a pixel's mean less sure than that of a normal
// deviate; a wrong filter is off by hundreds of standard errors.
TEST(FilterTable, AnImageIsWhatTheFilterMakesOfIt) {
    const double level = significanceLevel(tests * 128 * 6);
    for (const MapOrder map : {MapOrder::photons, MapOrder::camera})
        for (const Case& c : {Case{lanczos, "", 0}, Case{mitchell, ends, 0}, Case{gaussian, "", 0}}) {
            const Scene scene = sceneSeenBy(c.filter, c.film);
            EXPECT_GT(worstPValue(scene.sensor, imageOf(scene, map)), level) << c.filter << c.film;
        }
    const std::string broad = R"(<rfilter type="tent"><float name="radius" value="2"/></rfilter>)";
    EXPECT_LT(worstPValue(sceneSeenBy(broad).sensor, imageOf(sceneSeenBy(catmullRom), MapOrder::photons)), level)
        << "control: another filter";
}

std::string tent(double radius) {
    return R"(<rfilter type="tent"><float name="radius" value=")" + std::to_string(radius) + R"("/></rfilter>)";
}

// A filter narrower than a cell of the table counts as one of a cell's width.
TEST(FilterTable, NarrowFiltersHaveSamplesInEveryPass) {
    for (const double radius : {2.0, 1.0, 0.7}) EXPECT_TRUE(gainsBySharing(sceneSeenBy(tent(radius)).sensor)) << radius;
    EXPECT_TRUE(gainsBySharing(sceneSeenBy(lanczos).sensor));
    for (const double radius : {0.6, 0.5, 0.01, 0.0004}) {
        const Scene scene = sceneSeenBy(tent(radius));
        EXPECT_FALSE(gainsBySharing(scene.sensor)) << radius;
        RenderSettings settings;
        settings.photonsPerPass = 256;
        Renderer renderer(testDevice(), scene, settings);
        renderer.renderPass(0);
        const FilmImage image = renderer.develop();
        const size_t inside = size_t(3) * (3 * width + 8); // 1.5 pixels and more from the rectangle's edges
        EXPECT_NEAR(image.radiance[inside], 3, 1e-5) << radius;
        EXPECT_NEAR(image.radiance[0], 0, 1e-5) << radius;
    }
}

} // namespace
} // namespace quasilux
