// Tabulated phase functions and blends on the device, as the loader and host/prepare make them, against their formulas
// in double: values, sampling against the density, eight at once, and the share that a level leaves genuine diffuse.
// 3 chi-squared tests; false-alarm rate of the program 1e-4 (support/chi_squared.h).
#include "prepare/device_scene.h"
#include "prepare/scene_tables.h"
#include "support/chi_squared.h"
#include "support/scene_files.h"
#include "support/test_kernels.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace quasilux {
namespace {

using std::numbers::pi;

constexpr size_t sampleCount = 200000;
constexpr int statisticalTests = 3;
constexpr int cells = 60;

double henyeyGreenstein(double g, double c) { return (1 - g * g) / (4 * pi) * std::pow(1 + g * g - 2 * g * c, -1.5); }

double table(const std::vector<double>& values, double c) {
    double integral = 0;
    const auto last = double(values.size() - 1);
    for (size_t i = 0; i + 1 < values.size(); ++i) integral += (values[i] + values[i + 1]) / last;
    const double place = (c + 1) / 2 * last;
    const size_t i = std::min(size_t(place), values.size() - 2);
    return (values[i] + (place - double(i)) * (values[i + 1] - values[i])) / (2 * pi * integral);
}

struct Mixture {
    const char* name;
    std::string xml;
    double (*value)(double cosine);
};

const Mixture mixtures[] = {
    {"Table", R"(<phase type="tabphase"><string name="values" value="0.5, 0.1, 0, 0, 0.4, 2.5"/></phase>)",
     [](double c) {
         return table({0.5, 0.1, 0, 0, 0.4, 2.5}, c);
     }},
    {"Blend",
     R"(<phase type="blendphase"><float name="weight" value="0.3"/><phase type="hg"><float name="g" value="0.85"/></phase>
        <phase type="blendphase"><float name="weight" value="0.5"/><phase type="rayleigh"/><phase type="hg"><float name="g" value="-0.6"/></phase></phase></phase>)",
     [](double c) {
         return 0.7 * henyeyGreenstein(0.85, c) + 0.15 * 3 / (16 * pi) * (1 + c * c) + 0.15 * henyeyGreenstein(-0.6, c);
     }},
    {"BlendWithATable", R"(<phase type="blendphase"><float name="weight" value="0.6"/><phase type="isotropic"/>
        <phase type="tabphase"><string name="values" value="1,0,2"/></phase></phase>)",
     [](double c) {
         return 0.4 / (4 * pi) + 0.6 * table({1, 0, 2}, c);
     }},
};

struct Prepared {
    std::vector<uint32_t> words;
    MediumDecision decision;
};

Prepared prepare(const Mixture& mixture) {
    const Scene scene = test::loadBody("<shape type=\"cube\"><medium type=\"homogeneous\" name=\"interior\">" +
                                       mixture.xml + "</medium></shape>");
    const auto split = decideMediumSplit(scene, "level:0.1", true);
    SceneTableWriter writer;
    appendMedia(flattenMedia(scene, split, 1000), writer);
    return {writer.words(), split.at(0)};
}

Program& program(bool alone) {
    static Program all = testProgram("phase.cl", "-DHAS_PHASE_ISOTROPIC -DHAS_PHASE_HG -DHAS_PHASE_RAYLEIGH "
                                                 "-DHAS_PHASE_MIXED"),
                   only = testProgram("phase.cl", "-DHAS_PHASE_MIXED");
    return alone ? only : all;
}

std::vector<float> run(const Mixture& mixture, const char* kernel, const std::vector<float>& numbers, size_t perItem,
                       bool alone = false) {
    Buffer<uint32_t> m(testDevice(), prepare(mixture).words, "medium");
    Buffer<float> in(testDevice(), numbers, "numbers"), out(testDevice(), numbers.size(), "result");
    const size_t count = numbers.size() / perItem;
    program(alone).kernel(kernel).launch(count, m, in, out, cl_uint(count));
    return out.read();
}

/// Integrals of 2 pi f over equal steps of the cosine.
template <typename Function>
std::vector<double> integrals(Function f) {
    constexpr int steps = 2000;
    std::vector<double> result(cells);
    for (int cell = 0; cell < cells; ++cell)
        for (int i = 0; i < steps; ++i) {
            const double c = -1 + 2.0 / cells * (cell + (i + 0.5) / steps);
            result[size_t(cell)] += 2 * pi * f(c) * 2 / cells / steps;
        }
    return result;
}

double samplingFit(const Mixture& mixture, const Mixture& assumed) {
    std::vector<uint64_t> counts(cells);
    for (const float oneMinusCos : run(mixture, "sampleAngles", uniformNumbers(sampleCount, 3), 1)) {
        const double c = 1 - double(oneMinusCos);
        ++counts[size_t(std::clamp(int((c + 1) / 2 * cells), 0, cells - 1))];
    }
    return chiSquaredPValue(counts, integrals(assumed.value));
}

std::vector<float> cosines() {
    std::vector<float> all;
    for (int i = 0; i < 256; ++i) all.push_back(static_cast<float>(i) / 127.5f - 1);
    return all;
}

TEST(MixedPhase, ValuesAreThoseOfTheFormulas) {
    const auto c = cosines();
    for (const Mixture& mixture : mixtures)
        for (const bool alone : {false, true}) {
            const auto single = run(mixture, "phaseValues", c, 1, alone);
            const auto eight = run(mixture, "phaseValuesByEight", c, 8, alone);
            for (size_t i = 0; i < c.size(); ++i) {
                const double exact = mixture.value(double(c[i]));
                ASSERT_NEAR(single[i], exact, 3e-6 * exact + 1e-7) << mixture.name << " at " << c[i];
                ASSERT_NEAR(eight[i], single[i], 1e-6 * single[i] + 1e-7) << mixture.name << " at " << c[i];
            }
        }
}

TEST(MixedPhase, SamplesFollowTheDensity) {
    for (const Mixture& mixture : mixtures)
        EXPECT_GT(samplingFit(mixture, mixture), significanceLevel(statisticalTests)) << mixture.name;
}

TEST(MixedPhase, NegativeControlAnotherMixtureFails) {
    Mixture wrong = mixtures[1];
    wrong.value = [](double c) {
        return 0.67 * henyeyGreenstein(0.85, c) + 0.18 * 3 / (16 * pi) * (1 + c * c) + 0.15 * henyeyGreenstein(-0.6, c);
    };
    EXPECT_LT(samplingFit(mixtures[1], wrong), significanceLevel(statisticalTests));
    wrong.value = [](double c) { return table({0.5, 0.1, 0, 0, 0.4, 2.35}, c); };
    EXPECT_LT(samplingFit(mixtures[0], wrong), significanceLevel(statisticalTests));
}

TEST(MixedPhase, EightSamplesAreTheScalarOnes) {
    auto u = uniformNumbers(1024, 4);
    u[0] = 0;
    u[1] = 1 - 0x1p-24f;
    for (const Mixture& mixture : mixtures) {
        const auto single = run(mixture, "sampleAngles", u, 1), eight = run(mixture, "sampleAnglesByEight", u, 8);
        for (size_t i = 0; i < u.size(); ++i) {
            ASSERT_TRUE(single[i] >= 0 && single[i] <= 2) << mixture.name << " at " << u[i];
            ASSERT_EQ(eight[i], single[i]) << mixture.name;
        }
    }
}

TEST(MixedPhase, TheShareBelowALevelIsItsIntegral) {
    for (const Mixture& mixture : mixtures) {
        double exact = 0;
        for (const double part : integrals([&](double c) { return std::min(mixture.value(c), 0.1); })) exact += part;
        const MediumDecision decision = prepare(mixture).decision;
        EXPECT_NEAR(decision.genuineDiffuseShare, exact, 1e-4) << mixture.name;
        EXPECT_EQ(decision.level, 0.1f) << mixture.name;
    }
}

} // namespace
} // namespace quasilux
