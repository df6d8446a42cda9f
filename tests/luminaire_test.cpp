// <emitter type="quasilux_ies">: intensities and photons of the kernels against the goniogram, and places on the
// luminous shape. Reading: luminaire_loader_test.
// False-alarm rate of the tests of samplers 1e-4 together. Seeds are fixed.
#include "prepare/device_scene.h"
#include "support/chi_squared.h"
#include "support/luminaire_files.h"
#include "support/scene_files.h"
#include "support/test_kernels.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace quasilux {
namespace {

using glm::dvec3;
using std::numbers::pi;
using test::askewPlace;
using test::IesText;
using test::luminaireXml;

constexpr int statisticalTests = 60;
constexpr size_t sampleCount = 100000;
constexpr double degree = pi / 180;
const std::vector<std::string> fileNames{"isotropic100", "lambert1000", "spot_cos40", "asym_cosphi", "quadrant"};

struct Luminaire {
    shared::Emitter record;
    std::vector<uint32_t> words;
    Goniogram goniogram;
    glm::dmat3 axes; ///< of the luminaire in the world
    double power;

    dvec3 toWorld(const dvec3& local) const { return axes * local; }
};

/// The last emitter of `body`.
Luminaire flattened(const Scene& scene) {
    const DeviceScene flat = flattenScene(scene, {"auto", 1000, false});
    const PointEmitter& point = scene.pointEmitters.back();
    return {flat.emitters.emitters.back(), flat.emitters.goniograms,
            scene.luminaireTypes.at(point.luminaire->type).goniogram, point.luminaire->axes,
            flat.emitters.power.back()};
}

/// Of W, that is in photometric units, where intensities are candela.
Scene photometricScene(const std::string& body) {
    return test::loadBody("<?quasilux units=\"photometric\"?><shape type=\"rectangle\"/>" + body);
}
Luminaire luminaire(const std::string& name, const std::string& more = askewPlace) {
    return flattened(photometricScene(luminaireXml(test::luminaireFolder + name + ".ies", more)));
}
Luminaire luminaire(const IesText& ies) {
    test::SceneFiles folder;
    return flattened(photometricScene(luminaireXml(folder.write("lamp.ies", ies.text()), askewPlace)));
}

Program& program() {
    static Program built = testProgram("luminaires.cl", "-DHAS_EMITTER_GONIOGRAM");
    return built;
}

std::vector<float> launch(const char* kernel, const Luminaire& lamp, const std::vector<float>& in, size_t count,
                          size_t words) {
    Device& device = testDevice();
    Buffer<shared::Emitter> record(device, {lamp.record}, "emitter");
    Buffer<cl_uint> tables(device, lamp.words, "goniograms");
    Buffer<float> given(device, in, "given"), out(device, words * count, "result");
    program().kernel(kernel).launch(count, record, tables, given, out, cl_uint(count));
    return out.read();
}

dvec3 tripleAt(const std::vector<float>& values, size_t first) {
    return {values[first], values[first + 1], values[first + 2]};
}

struct Sent {
    dvec3 position, direction, flux;
    std::vector<float> found; ///< numbers
};
std::vector<Sent> photons(const Luminaire& lamp, const std::vector<float>& numbers) {
    const size_t count = numbers.size() / 5;
    const auto values = launch("photons", lamp, numbers, count, 14);
    std::vector<Sent> result;
    for (size_t i = 0; i < count; ++i)
        result.push_back({tripleAt(values, 14 * i),
                          tripleAt(values, 14 * i + 3),
                          tripleAt(values, 14 * i + 6),
                          {values.begin() + ptrdiff_t(14 * i + 9), values.begin() + ptrdiff_t(14 * i + 14)}});
    return result;
}

/// Files of types A and B, a jump, a dark sector, coarse and fine angles beside each other.
IesText unevenLamp(int type) {
    IesText ies;
    ies.type = type;
    if (type == 1) {
        ies.vertical = {0, 1, 2, 30, 90, 180};
        ies.horizontal = {0, 10, 180, 350, 360};
        ies.candela = [](double v, double h) {
            return h == 180 ? 0.0 : v == 1 ? 5000 : 100 + 10 * std::abs(std::sin(v)) + std::fmod(h, 360);
        };
    } else {
        ies.vertical = {-90, -20, 0, 15, 90};
        ies.horizontal = {-90, 0, 5, 60, 90};
        ies.candela = [](double v, double h) { return 50 + (v < 0 ? 0 : v) + 2 * std::abs(h); };
    }
    return ies;
}

std::vector<std::pair<std::string, Luminaire>> manyLuminaires() {
    std::vector<std::pair<std::string, Luminaire>> all;
    for (const auto& name : fileNames) all.emplace_back(name, luminaire(name));
    for (const int type : {1, 2, 3}) all.emplace_back("uneven " + std::to_string(type), luminaire(unevenLamp(type)));
    return all;
}

TEST(Luminaire, IntensityIsThatOfTheGoniogram) {
    for (const auto& [name, lamp] : manyLuminaires()) {
        const auto numbers = uniformNumbers(2 * 3000, 41);
        std::vector<float> in;
        std::vector<dvec3> local;
        for (size_t i = 0; i < numbers.size(); i += 2) {
            local.push_back(directionAt(360.0 * numbers[i], std::acos(1 - 2.0 * numbers[i + 1]) / degree));
            const dvec3 from = dvec3(1, -2, 3) + 2.0 * lamp.toWorld(local.back());
            in.insert(in.end(), {float(from.x), float(from.y), float(from.z), 0.5f, 0.3f, 0.6f});
        }
        const auto found = launch("irradiances", lamp, in, local.size(), 6);
        for (size_t i = 0; i < local.size(); ++i) {
            // Rounding of the place moves the direction, beside a jump to its other side.
            double least = 1e30, most = 0;
            for (const double turn : {-2e-5, 0.0, 2e-5})
                for (const double tip : {-2e-5, 0.0, 2e-5}) {
                    const dvec3 side = glm::normalize(glm::cross(local[i], dvec3(0.3, 0.5, 0.8)));
                    const double value = lamp.goniogram.intensity(
                        glm::normalize(local[i] + turn * side + tip * glm::cross(side, local[i])));
                    least = std::min(least, value);
                    most = std::max(most, value);
                }
            const double intensity = 4 * found[6 * i];
            ASSERT_GE(intensity, least * (1 - 1e-5) - 1e-6 * lamp.goniogram.largest()) << name;
            ASSERT_LE(intensity, most * (1 + 1e-5) + 1e-6 * lamp.goniogram.largest()) << name;
        }
    }
}

/// Of a cell of gamma's cosine and C, by the midpoint rule.
std::vector<double> sharesOfCells(const Goniogram& goniogram, const SampleGrid& grid) {
    std::vector<double> shares(size_t(grid.cells()), 0.0);
    double all = 0;
    for (const QuadraturePoint& q : gridQuadrature(grid, 24)) {
        const double share = q.weight * goniogram.intensity(directionAt(q.v, std::acos(q.u) / degree));
        shares[size_t(q.cell)] += share;
        all += share;
    }
    for (double& share : shares) share /= all;
    return shares;
}

std::vector<uint64_t> countsOfCells(const Luminaire& lamp, const std::vector<Sent>& sent, const SampleGrid& grid) {
    std::vector<uint64_t> counts(size_t(grid.cells()) + 1);
    for (const Sent& photon : sent) {
        const dvec3 d = glm::transpose(lamp.axes) * photon.direction;
        const double c = std::atan2(-d.y, d.x) / degree;
        ++counts[size_t(grid.cell(std::clamp(d.z, -1.0, 1.0), c < 0 ? c + 360 : c))];
    }
    return counts;
}

TEST(Luminaire, PhotonsFollowTheGoniogram) {
    const SampleGrid grid{-1, 1, 0, 360, 40, 12};
    for (const auto& [name, lamp] : manyLuminaires()) {
        const auto numbers = uniformNumbers(5 * sampleCount, 42);
        const auto sent = photons(lamp, numbers);
        const auto counts = countsOfCells(lamp, sent, grid);
        EXPECT_GT(chiSquaredPValue(counts, sharesOfCells(lamp.goniogram, grid)), significanceLevel(statisticalTests))
            << name;
        // A luminaire of which one in five photons of C up to 180 degrees is missing.
        Goniogram wrong = lamp.goniogram;
        for (size_t k = 0; k < wrong.candela.size(); ++k)
            if (wrong.azimuth[k / wrong.polar.size()] < 180) wrong.candela[k] *= 0.8;
        EXPECT_LT(chiSquaredPValue(counts, sharesOfCells(wrong, grid)), significanceLevel(statisticalTests))
            << name << ", negative control";

        double sum = 0, squares = 0;
        size_t uneven = 0;
        for (const Sent& photon : sent) {
            // Within 5 degrees the sine is nearly a line. The probability of a cell is a whole number of 2^-24: of rare
            // cells coarse.
            ASSERT_LT(photon.flux.x / lamp.power, 2.5) << name;
            uneven += std::abs(photon.flux.x / lamp.power - 1) > 2e-3 ? 1 : 0;
            ASSERT_NEAR(glm::length(photon.direction), 1, 1e-5);
            sum += photon.flux.x;
            squares += photon.flux.x * photon.flux.x;
        }
        EXPECT_LT(uneven, sampleCount / 200) << name;
        const double mean = sum / sampleCount;
        const double error = std::sqrt(std::max(squares / sampleCount - mean * mean, 0.0) / sampleCount) + 3e-6 * mean;
        EXPECT_GT(normalPValue((mean - lamp.power) / error), significanceLevel(statisticalTests)) << name;
        EXPECT_LT(normalPValue((mean - 1.001 * lamp.power) / error), significanceLevel(statisticalTests))
            << name << ", negative control";
        EXPECT_NEAR(lamp.power / lamp.goniogram.lumens(), 1, 1e-6);
    }
}

TEST(Luminaire, InversionGivesTheNumbersOfAPhoton) {
    for (const auto& [name, lamp] : manyLuminaires()) {
        const auto numbers = uniformNumbers(5 * 3000, 43);
        const auto sent = photons(lamp, numbers);
        size_t far = 0;
        for (size_t i = 0; i < sent.size(); ++i)
            for (size_t k = 3; k < 5; ++k) {
                const double off = std::abs(sent[i].found[k] - numbers[5 * i + k]);
                if (std::min(off, 1 - off) > 1e-3) ++far;
            }
        // Beside a pole, and in cells that hold a few photons of a million, directions have too few digits.
        EXPECT_LT(far, sent.size() / 100) << name;
    }
}

TEST(Luminaire, ExtremeNumbersGiveFinitePhotons) {
    for (const auto& [name, lamp] : manyLuminaires())
        for (const Sent& photon : photons(lamp, extremeNumbers(5))) {
            ASSERT_GE(photon.flux.x, 0) << name;
            ASSERT_LT(photon.flux.x / lamp.power, 2.5) << name;
            ASSERT_NEAR(glm::length(photon.direction), 1, 1e-5) << name;
        }
}

// --- the luminous shape ---

struct ShapeCase {
    std::string size; ///< width, length, height
    std::function<glm::dvec2(const dvec3&)> even;
};
/// Twice the share of a disc within a point, less 1, and its turn.
glm::dvec2 onDisc(double x, double y) { return {2 * (x * x + y * y) - 1, std::atan2(y, x) / pi}; }
/// Coordinates of a place of the luminaire that are even in [-1, 1]^2.
const std::vector<ShapeCase> shapeCases{
    {"0.6 1.2 0", [](const dvec3& p) { return glm::dvec2(p.x / 0.6, p.y / 0.3); }},
    {"0.6 1.2 0.4", [](const dvec3& p) { return glm::dvec2(p.x / 0.6, p.z / 0.2); }},
    {"-0.5 -0.5 0", [](const dvec3& p) { return onDisc(p.x / 0.25, p.y / 0.25); }},
    {"-0.5 -1 0.3", [](const dvec3& p) { return onDisc(p.x / 0.5, p.y / 0.25); }},
    {"-0.5 2 -0.4", [](const dvec3& p) { return onDisc(p.y / 0.25, p.z / 0.2); }},
    {"2 -0.5 -0.4",
     [](const dvec3& p) { return glm::dvec2(p.y, 2 * (std::pow(p.x / 0.25, 2) + std::pow(p.z / 0.2, 2)) - 1); }},
    {"-0.5 0 -0.4", [](const dvec3& p) { return onDisc(p.y / 0.25, p.z / 0.2); }},
    {"-0.5 -0.6 -0.4", [](const dvec3& p) { return glm::dvec2(p.z / 0.2, std::atan2(p.y / 0.25, p.x / 0.3) / pi); }}};

Luminaire lampOfSize(const std::string& size, int type) {
    IesText ies = unevenLamp(type);
    ies.size = size;
    return luminaire(ies);
}

TEST(LuminaireShape, PlacesAreEvenOnItWhateverTheTypeOfTheFile) {
    const SampleGrid grid{-1, 1, -1, 1, 10, 10};
    for (const ShapeCase& shape : shapeCases)
        for (const int type : {1, 2, 3}) {
            const Luminaire lamp = lampOfSize(shape.size, type);
            const auto numbers = uniformNumbers(5 * 20000, 44);
            std::vector<uint64_t> counts(size_t(grid.cells()) + 1);
            double off = 0;
            for (size_t i = 0; const Sent& photon : photons(lamp, numbers)) {
                const dvec3 local = glm::transpose(lamp.axes) * (photon.position - dvec3(1, -2, 3));
                ASSERT_LT(glm::length(local), lamp.record.radius * (1 + 1e-5) + 1e-6);
                const glm::dvec2 even = shape.even(local);
                ++counts[size_t(grid.cell(std::clamp(even.x, -1.0, 1.0), even.y))];
                for (const size_t k : {0u, 1u, 2u}) {
                    // A number that decides no place comes back as it was given, which is a half.
                    const double apart = std::abs(photon.found[k] - numbers[5 * i + k]);
                    if (photon.found[k] != 0.5f) off += std::min(apart, 1 - apart) > 2e-3 ? 1 : 0;
                }
                ++i;
            }
            EXPECT_LT(off, 100) << shape.size << ", type " << type;
            EXPECT_GT(chiSquaredPValue(counts, std::vector<double>(grid.cells(), 1.0 / grid.cells())),
                      significanceLevel(statisticalTests))
                << shape.size << ", type " << type;
        }
}

/// Irradiance of a surface at `from`, which faces the luminaire along `normal`; the mean over many samples.
double irradianceAt(const Luminaire& lamp, const dvec3& from, const dvec3& normal) {
    const auto numbers = uniformNumbers(3 * sampleCount, 45);
    std::vector<float> in;
    for (size_t i = 0; i < numbers.size(); i += 3)
        in.insert(in.end(), {float(from.x), float(from.y), float(from.z), numbers[i], numbers[i + 1], numbers[i + 2]});
    const auto found = launch("irradiances", lamp, in, sampleCount, 6);
    double sum = 0;
    for (size_t i = 0; i < sampleCount; ++i)
        sum += found[6 * i] * std::max(glm::dot(glm::normalize(tripleAt(found, 6 * i + 3) - from), normal), 0.0);
    return sum / sampleCount;
}

TEST(LuminaireShape, ALambertianSquareShinesAsAnAreaLight) {
    IesText ies;
    ies.size = "1 1 0";
    ies.vertical.clear();
    for (int k = 0; k <= 90; ++k) ies.vertical.push_back(k);
    ies.candela = [](double v, double) { return std::cos(v * degree); };
    const Luminaire lamp = luminaire(ies);
    const dvec3 axis = lamp.toWorld({0, 0, 1});
    // A square of side 1 and radiance 1 at distance 1: 4 (x / sqrt(1 + x^2)) atan(x / sqrt(1 + x^2)), x = 1/2.
    const double x = 0.5 / std::sqrt(1.25), square = 4 * x * std::atan(x);
    const double near = irradianceAt(lamp, dvec3(1, -2, 3) + axis, -axis);
    EXPECT_NEAR(near / square, 1, 2e-3);
    EXPECT_GT(std::abs(near - 1), 0.2) << "negative control: of a point it is 1";
    // At five times its size it is as a point to 2 %, and at fifty to 0.02 %.
    EXPECT_NEAR(irradianceAt(lamp, dvec3(1, -2, 3) + 5.0 * axis, -axis) * 25, 1, 0.02);
    EXPECT_NEAR(irradianceAt(lamp, dvec3(1, -2, 3) + 50.0 * axis, -axis) * 2500, 1, 5e-4);
}

TEST(LuminaireShape, FarFieldOfEveryShapeIsThatOfTheFile) {
    for (const ShapeCase& shape : shapeCases) {
        const Luminaire lamp = lampOfSize(shape.size, 1);
        for (const dvec3& local : {directionAt(300, 20), directionAt(70, 75), directionAt(20, 130)}) {
            const dvec3 direction = lamp.toWorld(local);
            const double distance = 300 * lamp.record.radius;
            EXPECT_NEAR(irradianceAt(lamp, dvec3(1, -2, 3) + distance * direction, -direction) * distance * distance /
                            lamp.goniogram.intensity(local),
                        1, 2e-3)
                << shape.size;
        }
    }
}

} // namespace
} // namespace quasilux
