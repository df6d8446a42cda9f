// Searches of the photon index find what a search of all photons finds, each photon once, also where rows of cells
// share the table or wrap around its end.
//
// No test here is statistical: photons are random but seeded, and what they are compared with is exact or in double.
#include "bench/micro/native_flux.h"
#include "device/kernel_sources.h"
#include "support/awkward_photons.h"
#include "support/test_kernels.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/glm.hpp>
#include <gtest/gtest.h>
#include <random>
#include <sstream>

namespace quasilux {
namespace {

using Photon = TracedPhoton;

shared::Rgb fluxOf(const Photon& photon) {
    const shared::Rgb flux = nativeUnpackFlux(photon.flux);
    return {flux.r * testFluxUnit, flux.g * testFluxUnit, flux.b * testFluxUnit};
}

struct Query {
    float x, y, z, radius;
};
struct Sum {
    float r, g, b, unused;
};

std::string testKernel(const std::string& file) {
    std::ifstream stream(std::string(QUASILUX_SOURCE_DIR) + "/tests/kernels/" + file);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

struct GatherSettings {
    unsigned lightClass = LIGHT_DIFFUSE, patchSide = 0, depthMax = QL_NONE;
    bool joinsRuns = true;   ///< false: the negative control, where photons in cells that rows share are met twice
    bool bothOctaves = true; ///< false: that where cells of the second octave are left out
};

void replaceAll(std::string& text, const std::string& from, const std::string& to) {
    EXPECT_NE(text.find(from), std::string::npos) << "the negative control must follow density.clh";
    for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
}

std::vector<Sum> gather(const PhotonIndex& index, const std::vector<Query>& queries,
                        const PhotonIndexSettings& settings, const GatherSettings& what = {}) {
    std::map<std::string, std::string> files{{"photon_gather.cl", testKernel("photon_gather.cl")}};
    std::string text = kernelSources().at("density.clh");
    if (!what.joinsRuns) replaceAll(text, "    joinRuns(runs);", "");
    if (!what.bothOctaves) replaceAll(text, "octave <= octaves.y", "octave == octaves.x");
    if (!what.joinsRuns || !what.bothOctaves) files["density.clh"] = text;
    Program program(testDevice(), "photon_gather.cl", photonIndexOptions(settings), files);
    Buffer<Query> queryBuffer(testDevice(), queries, "queries");
    Buffer<Sum> sums(testDevice(), queries.size(), "sums");
    program.kernel("gather").launch(queries.size(), index.cellStart, index.sorted, queryBuffer, sums, index.map,
                                    unsigned(queries.size()), what.lightClass, what.patchSide, what.depthMax);
    return sums.read();
}

/// Sums over all photons in double precision, and how many of them are in reach and have flux.
struct ExactSum {
    double r = 0, g = 0, b = 0;
    unsigned lit = 0;
};

ExactSum searchAll(const std::vector<Photon>& photons, const Query& query, const GatherSettings& what) {
    ExactSum sum;
    for (const Photon& p : photons) {
        if (p.slot != what.lightClass || p.patchSide != what.patchSide || p.depth > what.depthMax) continue;
        const double x = double(p.position.x) - query.x, y = double(p.position.y) - query.y,
                     z = double(p.position.z) - query.z;
        const double q = (x * x + y * y + z * z) / (double(query.radius) * query.radius);
        if (q >= 1) continue;
        const shared::Rgb flux = fluxOf(p);
        sum.r += (1 - q) * flux.r;
        sum.g += (1 - q) * flux.g;
        sum.b += (1 - q) * flux.b;
        sum.lit += flux.b > 0;
    }
    return sum;
}

std::vector<Query> queriesAbout(const std::vector<Photon>& photons, unsigned count, float radius) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> offset(-1.2f, 1.2f);
    std::vector<Query> queries;
    for (unsigned k = 0; k < count; ++k) {
        const auto& p = photons[random() % photons.size()].position;
        const auto move = [&](float x) { return k % 5 == 0 ? x : x + offset(random) * radius; };
        queries.push_back({move(p.x), move(p.y), move(p.z), radius});
    }
    return queries;
}

/// Relative to the sum, where sums of n terms in floats may be off; `each` bounds the error of one kernel weight.
constexpr double each = 4e-7, relative = 3e-6;

TEST(PhotonSearch, SumsAreThoseOfAllPhotons) {
    for (const unsigned cells : {4u, 16u, 1024u})
        for (const float center : {0.f, -40.f, 3000.f})
            for (const float share : {1.f, 0.37f}) { // a region may be smaller than the cells
                PhotonIndexSettings settings = settingsOfFlux();
                settings.classes = 1u << LIGHT_CAUSTIC | 1u << LIGHT_DIFFUSE;
                settings.radius = {9, 0.3f, 9, 0.25f};
                settings.cells = cells;
                const auto photons = awkwardPhotons(6007, center, 0.25f, {LIGHT_DIFFUSE, LIGHT_CAUSTIC});
                const PhotonIndex index = indexPhotons(photons, settings);
                for (const unsigned lightClass : {LIGHT_CAUSTIC, LIGHT_DIFFUSE}) {
                    const GatherSettings what{lightClass, 2};
                    const auto queries = queriesAbout(photons, 200, settings.radius[lightClass] * share);
                    const auto sums = gather(index, queries, settings, what);
                    unsigned crowded = 0;
                    for (size_t k = 0; k < queries.size(); ++k) {
                        const ExactSum exact = searchAll(photons, queries[k], what);
                        crowded += exact.lit > 20;
                        EXPECT_NEAR(sums[k].r, exact.r, relative * exact.r + each * 6007);
                        EXPECT_NEAR(sums[k].g, exact.g, relative * exact.g + each * 1000);
                        EXPECT_NEAR(sums[k].b, exact.b, relative * exact.b + each);
                    }
                    EXPECT_GT(crowded, 40u);
                }
            }
}

/// Lights a few photons at a time, so that most discs hold one of them or none: a photon missed, or met twice, cannot
/// hide in the rounding of a sum. Returns the number of wrong answers.
unsigned faultsOfSingles(const PhotonIndexSettings& settings, unsigned& singles, bool joinsRuns) {
    auto photons = awkwardPhotons(4001, 0, 0.25f, {LIGHT_DIFFUSE});
    for (Photon& photon : photons) photon.patchSide = 0;
    const auto queries = queriesAbout(photons, 400, settings.radius[LIGHT_DIFFUSE]);
    const GatherSettings what{LIGHT_DIFFUSE, 0, QL_NONE, joinsRuns, true};
    unsigned faults = 0;
    for (unsigned lit = 0; lit < 12; ++lit) {
        for (size_t k = 0; k < photons.size(); ++k) {
            const float flux = k * 7919 % 397 == lit * 33 ? 1.f : 0.f;
            photons[k].flux = packedFlux(flux, flux, flux);
        }
        const auto sums = gather(indexPhotons(photons, settings), queries, settings, what);
        for (size_t k = 0; k < queries.size(); ++k) {
            const ExactSum exact = searchAll(photons, queries[k], what);
            singles += exact.lit == 1;
            if (exact.lit == 0 ? sums[k].b != 0 : std::abs(sums[k].b - exact.b) > each * exact.lit) ++faults;
        }
    }
    return faults;
}

TEST(PhotonSearch, EachPhotonIsMetOnce) {
    unsigned singles = 0;
    for (const unsigned cells : {4u, 8u, 64u, 4096u}) {
        PhotonIndexSettings settings = settingsOfFlux();
        settings.radius[LIGHT_DIFFUSE] = 0.25f;
        settings.cells = cells;
        EXPECT_EQ(faultsOfSingles(settings, singles, true), 0u) << cells << " cells";
    }
    EXPECT_GT(singles, 1000u);
}

TEST(PhotonSearch, RowsThatShareCellsFailWithoutTheCheck) {
    unsigned singles = 0;
    PhotonIndexSettings settings = settingsOfFlux();
    settings.radius[LIGHT_DIFFUSE] = 0.25f;
    settings.cells = 8;
    EXPECT_GT(faultsOfSingles(settings, singles, false), 100u);
}

// ---- cells by distance (kernels/radius_field.clh) ----

constexpr unsigned octaves = 6;

shared::RadiusField fieldAboutEye() {
    const float factors[octaves + 1] = {0.1f, 0.15f, 0.3f, 0.6f, 0.7f, 0.5f, 1};
    shared::RadiusField field{octaves, {0.5f, -1, 2}, 1, {}};
    std::copy(std::begin(factors), std::end(factors), field.factor);
    return field;
}

// Of the cells that a distance lies in.
float cellFactor(const shared::RadiusField& field, double distance) {
    const double octave =
        std::clamp(std::floor(std::log2(std::max(distance, 1e-9) / field.nearest)), 0.0, octaves - 1.0);
    return std::max(field.factor[size_t(octave)], field.factor[size_t(octave) + 1]);
}

/// As many at every distance from a tenth of the nearest to twice the farthest octave, a dozen in each place.
std::vector<Photon> photonsAboutEye(const shared::RadiusField& field, float radius) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(-1, 1);
    std::vector<Photon> photons;
    for (unsigned id = 0; id < 12000; ++id) {
        static glm::vec3 place;
        static float distance;
        if (id % 12 == 0) {
            distance = 0.1f * std::exp2(5.2f * (1 + uniform(random)));
            place = distance * glm::normalize(glm::vec3(uniform(random), uniform(random), uniform(random)));
        }
        const float r = radius * cellFactor(field, distance);
        const auto at = [&](float middle, float eye) { return middle + eye + r * uniform(random); };
        photons.push_back(
            photonAt(at(place.x, field.eye.x), at(place.y, field.eye.y), at(place.z, field.eye.z), LIGHT_DIFFUSE, id));
        photons.back().patchSide = 0;
    }
    return photons;
}

/// Searches with the largest radii that are allowed; returns how many answers are wrong, `lit` how many photons were
/// met.
unsigned faultsAboutEye(bool bothOctaves, size_t& lit) {
    PhotonIndexSettings settings = settingsOfFlux();
    settings.field = fieldAboutEye();
    settings.radius[LIGHT_DIFFUSE] = 2;
    const auto photons = photonsAboutEye(settings.field, settings.radius[LIGHT_DIFFUSE]);
    auto queries = queriesAbout(photons, 2000, 0.1f);
    for (Query& query : queries) {
        const auto& eye = settings.field.eye;
        const float away = std::hypot(query.x - eye.x, query.y - eye.y, query.z - eye.z);
        query.radius = std::min(0.33f * std::max(away, 1.5f), 2 * cellFactor(settings.field, away));
        for (const float sign : {-1.f, 1.f})
            query.radius = std::min(query.radius, 2 * cellFactor(settings.field, away + sign * 1.01f * query.radius));
    }
    const GatherSettings what{LIGHT_DIFFUSE, 0, QL_NONE, true, bothOctaves};
    const auto sums = gather(indexPhotons(photons, settings), queries, settings, what);
    unsigned faults = 0;
    for (size_t k = 0; k < queries.size(); ++k) {
        const ExactSum exact = searchAll(photons, queries[k], what);
        lit += exact.lit;
        faults += std::abs(sums[k].b - exact.b) > relative * exact.b + each * exact.lit;
    }
    return faults;
}

TEST(PhotonSearch, FindsPhotonsInCellsOfTwoOctaves) {
    size_t lit = 0;
    EXPECT_EQ(faultsAboutEye(true, lit), 0u);
    EXPECT_GT(lit, 10'000u);
    EXPECT_GT(faultsAboutEye(false, lit), 50u) << "negative control";
}

TEST(PhotonSearch, EndsExactlyAtTheRadius) {
    // Radius 1/4 and offsets of whole multiples of 2^-9: squares are exact, so the answer is too. A photon on
    // the sphere is outside, one 128th of the radius further in is inside.
    const int onSphere[][3] = {{128, 0, 0}, {0, -128, 0}, {0, 0, 128}};
    std::vector<Photon> photons;
    std::vector<Query> queries;
    std::vector<double> expected;
    unsigned place = 0;
    for (const auto& direction : onSphere)
        for (int phase = 0; phase < 128; phase += 5) // where in its cell the query lies
            for (const int steps : {127, 128}) {
                const float x = 8 * float(place % 7) + float(phase) / 512,
                            y = 8 * float(place / 7) - float(phase) / 512, z = -float(phase) / 512;
                ++place;
                queries.push_back({x, y, z, 0.25f});
                const float s = float(steps) / 128 / 512;
                photons.push_back(photonAt(x + float(direction[0]) * s, y + float(direction[1]) * s,
                                           z + float(direction[2]) * s, LIGHT_DIFFUSE, 0));
                expected.push_back(steps == 128 ? 0 : 1 - (127.0 / 128) * (127.0 / 128));
            }
    PhotonIndexSettings settings = settingsOfFlux();
    settings.radius[LIGHT_DIFFUSE] = 0.25f;
    settings.cells = 64;
    const auto sums = gather(indexPhotons(photons, settings), queries, settings);
    for (size_t k = 0; k < queries.size(); ++k) EXPECT_EQ(double(sums[k].b), expected[k]) << k;
}

TEST(PhotonSearch, PatchSideAndDepthAreAskedFor) {
    PhotonIndexSettings settings = settingsOfFlux();
    settings.radius[LIGHT_DIFFUSE] = 0.25f;
    settings.storesDepth = true;
    const auto photons = awkwardPhotons(4001, 0, 0.25f, {LIGHT_DIFFUSE});
    const PhotonIndex index = indexPhotons(photons, settings);
    const auto queries = queriesAbout(photons, 100, 0.25f);
    std::vector<double> found;
    for (const unsigned depthMax : {0u, 1u, 60u, 200u, QL_NONE}) {
        const GatherSettings what{LIGHT_DIFFUSE, 3, depthMax, true};
        const auto sums = gather(index, queries, settings, what);
        found.push_back(0);
        for (size_t k = 0; k < queries.size(); ++k) {
            const ExactSum exact = searchAll(photons, queries[k], what);
            EXPECT_NEAR(sums[k].b, exact.b, relative * exact.b + each);
            found.back() += sums[k].b;
        }
    }
    EXPECT_EQ(found[0], 0);
    EXPECT_LT(found[1], found[2]);
    EXPECT_LT(found[2], found[3]);
    EXPECT_EQ(found[3], found[4]);
}

} // namespace
} // namespace quasilux
