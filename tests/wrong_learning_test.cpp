// Whatever was learned before pass 0 (docs/method/learning.md), means stay and weights are bounded: closed forms with
// learning turned against the scene, a lamp that importance paths never find, the flux of photons.
//
// False alarms: readings are held to 4 standard errors of 10 or 12 batches (Student t: 0.3 % a case), and 0.5 % for
// density radii where these take part; the seeds are fixed.
#include "learn/guide.h"
#include "render/renderer.h"
#include "scene/color.h"
#include "support/meter_scenes.h"
#include "support/render_statistics.h"
#include "support/scene_files.h"
#include "support/stored_photons.h"
#include "support/test_kernels.h"
#include "support/wrong_learning.h"
#include "support/wrong_rules.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <numbers>

namespace quasilux {
namespace {

using test::PhotonRule;

RenderSettings guided(PhotonRule rule, unsigned photons) {
    RenderSettings settings;
    settings.emission = Emission::guided;
    settings.controlOptions += optionOf(rule);
    settings.photonsPerPass = photons;
    return settings;
}

// --- closed forms ---

struct ClosedForm {
    const char* name;
    std::function<Scene()> scene;
    double truth;
    unsigned pixels, photons, passes;
    double wrongWeights = 0.9; ///< the guide's in the negative control, over right ones; 0: left out
};

// Printed where a case fails.
void PrintTo(const ClosedForm& form, std::ostream* stream) { *stream << form.name; }

// CIE 171, 5.4 and 5.8: the surfaces of a closed room of 80 m2 and reflectance 0.5 receive 10,000 lm / (80 m2 (1 -
// 0.5)).
Scene closedRoom() {
    return test::meterScene(
        "<emitter type=\"point\"><point name=\"position\" value=\"1,2.5,2\"/>"
        "<rgb name=\"intensity\" value=\"795.77471546\"/></emitter>"
        "<shape type=\"cube\"><boolean name=\"flip_normals\" value=\"true\"/><transform name=\"to_world\">"
        "<translate value=\"1,1,1\"/><scale value=\"2,2,1.5\"/></transform>" +
        test::diffuse(0.5) + test::irradiancemeter() + "</shape>");
}

class WrongLearning : public testing::TestWithParam<ClosedForm> {};
TEST_P(WrongLearning, LeavesTheMeanAsItIs) {
    const ClosedForm& form = GetParam();
    const Scene scene = form.scene();
    const auto measured = [&](PhotonRule rule, double weights) {
        const auto settings = guided(rule, form.photons);
        auto learned = wronglyLearned(scene, settings);
        for (auto& leaf : learned->tables.guide.leaves) leaf.weight *= static_cast<float>(weights);
        return renderGroups(scene, settings, std::vector<int>(form.pixels, 0), 10, form.passes, learned).front();
    };
    const auto allowed = [&](const MeanAndError& result) { return 4 * result.standardError + 0.005 * form.truth; };
    const auto right = measured(PhotonRule::right, 1);
    const auto wrong = form.wrongWeights > 0 ? measured(PhotonRule::right, form.wrongWeights)
                                             : measured(PhotonRule::missingGuideWeight, 1);
    EXPECT_NEAR(right.mean, form.truth, allowed(right));
    EXPECT_LT(right.standardError, 0.02 * form.truth) << "too noisy to decide anything";
    EXPECT_GT(std::abs(wrong.mean - form.truth), allowed(wrong)) << "negative control";
}
INSTANTIATE_TEST_SUITE_P(
    Guided, WrongLearning,
    testing::Values(ClosedForm{"TurbidPlate", [] { return projectScene("slab.xml"); }, 0.52645242, 256, 4000, 8},
                    ClosedForm{"Caustics",
                               [] {
                                   return projectScene("furnace_glass.xml", {{"resolution", "16"}});
                               },
                               2.5, 256, 16000, 8, 0},
                    ClosedForm{"IlluminanceOfARoom", closedRoom, 250, 1, 16000, 4}),
    [](const auto& form) { return std::string(form.param.name); });

// Away from what importance paths gathered one photon in eight is stored, and stands for all.
TEST(WrongLearning, PhotonsThatAreNotStoredAreMadeUpFor) {
    DeviceScene flat = flattenScene(projectScene("furnace_split.xml"));
    struct Stored {
        double count = 0;
        MeanAndError flux; // direct, of the emitters' flux
    };
    const auto trace = [&](PhotonRule rule, uint32_t seen) {
        LearnedTables learned;
        learned.guide = plainGuide(flat.emitters);
        learned.importance.smallestSize = 0.1f;
        learned.seenCells = {seen};
        setLearned(flat, learned);
        auto settings = guided(rule, 20'000);
        settings.direct = DirectLight::photons;
        PhotonTracing tracing;
        tracing.radius = 0.1f;
        std::vector<double> flux;
        Stored stored;
        for (const auto& pass : tracePhotons(flat, settings, tracing)) {
            flux.push_back(0);
            for (const StoredPhoton& photon : pass[LIGHT_DIRECT]) flux.back() += mean(photon.flux) / flat.emittedFlux;
            stored.count += double(pass[LIGHT_DIRECT].size());
        }
        stored.flux = meanAndError(flux);
        return stored;
    };
    const Stored all = trace(PhotonRule::right, 0xffffffffu), few = trace(PhotonRule::right, 0);
    const Stored wrong = trace(PhotonRule::missingStoreWeight, 0);
    EXPECT_NEAR(few.count / all.count, 0.125, 0.01);
    EXPECT_NEAR(few.flux.mean, 1, 4 * few.flux.standardError);
    EXPECT_GT(std::abs(wrong.flux.mean - 1), 4 * wrong.flux.standardError) << "negative control";
}

// --- bounds ---

// A tenth of the photons begins evenly, so none has more than ten times the flux of a plain one, times the emitter's
// sources.
TEST(GuideBounds, NoLeafOutweighsPlainEmission) {
    const DeviceScene flat = flattenScene(projectScene("furnace_split.xml"));
    const auto heaviest = [&](const GuideTables& guide) {
        double most = 0;
        for (const auto& leaf : guide.leaves) {
            const auto& source = guide.sources[leaf.source];
            const double selection = flat.emitters.emitters[source.emitter].selectionProbability;
            const auto ofEmitter = std::count_if(guide.sources.begin(), guide.sources.end(),
                                                 [&](const auto& other) { return other.emitter == source.emitter; });
            most = std::max(most, leaf.weight * selection / static_cast<double>(ofEmitter));
        }
        return most;
    };
    // All importance paths found the same rays of the first emitter; numbers are what their rays invert to.
    const auto invert = [](const auto& records, const auto& sources) {
        const auto numbers = samplesWithin(0.01, records.size());
        std::vector<shared::EmissionPoint> points(records.size());
        for (size_t k = 0; k < points.size(); ++k) {
            points[k].source = static_cast<unsigned>(sources.size() - 1);
            std::copy(numbers[k].u.begin(), numbers[k].u.end(), std::begin(points[k].numbers));
        }
        return points;
    };
    GuideLearner learner(flat.emitters, invert);
    std::vector<shared::EmissionRecord> records(20'000);
    const auto last = static_cast<unsigned>(flat.emitters.emitters.size() - 1);
    for (auto& record : records) {
        record.emitter = last;
        record.direction = {0, 0, 1};
        record.weight = 1;
    }
    learner.add(records);
    const GuideTables guide = learner.guide();
    EXPECT_GT(guide.leaves.size(), flat.emitters.emitters.size()) << "something was learned";
    EXPECT_LE(heaviest(guide), 10.0001);
    EXPECT_GT(heaviest(cornerGuide(flat.emitters)), 10.0001) << "negative control: a tree without plain photons";
}

// --- a lamp that no importance path finds ---

// A patch at the origin is lit by a point lamp by way of two mirrors alone, as if from 22 above it; a lamp beside it,
// with all that importance paths find, is ten times as strong. Radiance of the patch: reflectance / pi * I / 22^2.
Scene periscope() {
    const auto rectangle = [](const std::string& transform, const std::string& bsdf) {
        return "<shape type=\"rectangle\"><transform name=\"to_world\">" + transform + "</transform>" + bsdf +
               "</shape>";
    };
    const auto mirror = [&](const std::string& place) {
        return rectangle(
            "<scale value=\"2\"/><rotate y=\"1\" angle=\"-45\"/>" + place,
            R"(<bsdf type="twosided"><bsdf type="conductor"><string name="material" value="none"/></bsdf></bsdf>)");
    };
    const std::string black =
        R"(<bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></bsdf>)";
    const std::string white =
        R"(<bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="0.8"/></bsdf></bsdf>)";
    const auto lamp = [](const char* place, const char* intensity) {
        return std::string("<emitter type=\"point\"><point name=\"position\" value=\"") + place +
               "\"/><rgb name=\"intensity\" value=\"" + intensity + "\"/></emitter>";
    };
    test::SceneFiles files;
    return loadScene(files.write(
        "scene.xml",
        R"(<scene version="3.0.0"><integrator type="path"/><sensor type="orthographic"><transform name="to_world">
        <scale x="4" y="4"/><lookat origin="-3,0,4" target="-3,0,0" up="0,1,0"/></transform>
        <film type="hdrfilm"><rfilter type="box"/><integer name="width" value="32"/><integer name="height" value="32"/></film></sensor>)" +
            rectangle("<scale value=\"2\"/>", white) + rectangle("<scale value=\"2\"/><translate x=\"-6\"/>", white) +
            rectangle("<scale value=\"2\"/><rotate y=\"1\" angle=\"90\"/><translate x=\"-8\" z=\"2\"/>", white) +
            rectangle("<scale value=\"3\"/><rotate y=\"1\" angle=\"90\"/><translate x=\"-2.5\" z=\"2\"/>", black) +
            mirror("<translate x=\"0\" z=\"6\"/>") + mirror("<translate x=\"10\" z=\"6\"/>") +
            rectangle("<scale x=\"3\" y=\"6\"/><rotate y=\"1\" angle=\"90\"/><translate x=\"8\" z=\"12\"/>", black) +
            lamp("10,0,12", "100") + lamp("-6,0,3", "1000") + "</scene>"));
}

TEST(UnseenLamp, ByTwoMirrorsIsAsBrightAsItsImage) {
    const Scene scene = periscope();
    // Pixels of a quarter of a unit: those of the patch within half a unit of its centre.
    std::vector<int> group(32 * 32, -1);
    for (int y = 14; y < 18; ++y)
        for (int x = 0; x < 32; ++x) {
            const double place = -3 + (x + 0.5 - 16) * 0.25;
            if (std::abs(place) < 0.5) group[size_t(y * 32 + x)] = 0;
        }
    const double truth = 0.8 / std::numbers::pi * 100 / (22.0 * 22.0);
    const auto measured = [&](PhotonRule rule) {
        return renderGroups(scene, guided(rule, 100'000), group, 10, 20).front();
    };
    const auto right = measured(PhotonRule::right), wrong = measured(PhotonRule::missingGuideWeight);
    const auto allowed = [&](const MeanAndError& result) { return 4 * result.standardError + 0.005 * truth; };
    EXPECT_NEAR(right.mean, truth, allowed(right));
    EXPECT_LT(right.standardError, 0.05 * truth) << "too noisy to decide anything";
    EXPECT_GT(std::abs(wrong.mean - truth), allowed(wrong)) << "negative control";
}

} // namespace
} // namespace quasilux
