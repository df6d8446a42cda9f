// Many emitters (docs/method/learning.md, "Direct light"): the tree holds them, its choices have the probabilities that
// it says, and images keep their means.
//
// False alarms: 1e-4 for the chi-squared tests together; the furnace is held to 4 standard errors of 10 batches
// (Student t: 0.3 %).
#include "learn/direct_choice.h"
#include "learn/learning.h"
#include "prepare/light_tree.h"
#include "prepare/pack.h"
#include "support/chi_squared.h"
#include "support/emitter_cases.h"
#include "support/render_statistics.h"
#include "support/scene_files.h"
#include "support/test_kernels.h"
#include "support/wrong_rules.h"

#include <gtest/gtest.h>
#include <numeric>
#include <random>

namespace quasilux {
namespace {

using test::optionOf, test::SamplingRule;

using glm::dvec3;

// --- the tree ---

/// Rectangles that shine down from a ceiling of 20 x 20, some spheres, points and meshes between them; powers differ by
/// up to 100.
EmitterTables manyEmitters() {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> number;
    EmitterTables tables;
    for (int k = 0; k < 301; ++k) {
        const dvec3 place(20 * number(random), 20 * number(random), 3 + 0.2 * number(random));
        shared::Emitter emitter = makeRectangle(place, {0, 0.2, 0}, {0.3, 0, 0});
        if (k % 7 == 1) emitter = makeSphere(place, 0.1, 1);
        if (k % 7 == 2) emitter = makePoint(place);
        if (k % 7 == 3) {
            auto [mesh, triangles] =
                makeTriangles({{place, {0, 0.2, 0.1}, {0.3, 0, 0}}, {place, {0.1, 0.1, 0}, {0, 0.2, 0}}});
            mesh.firstTriangle = static_cast<unsigned>(tables.triangles.size());
            tables.triangles.insert(tables.triangles.end(), triangles.begin(), triangles.end());
            emitter = mesh;
        }
        tables.emitters.push_back(emitter);
        tables.power.push_back(std::pow(100, number(random)));
    }
    return tables;
}

const std::vector<dvec3> places = {{10, 10, 0}, {0.5, 19, 2.9}, {10, 10, 3.1}, {-30, 40, 1}, {10, 10, 500}};

/// Does this node hold the emitters of `order` from `first` on, and so on below it?
void expectHolds(const EmitterTables& tables, const LightTree& tree, size_t node, size_t first, size_t count) {
    const shared::LightNode& n = tree.nodes.at(node);
    double power = 0;
    for (size_t k = first; k < first + count; ++k) {
        const auto& emitter = tables.emitters[tree.order[k]];
        power += tables.power[tree.order[k]];
        if (emitter.type != EMITTER_RECTANGLE) continue;
        for (const double u : {0.0, 1.0})
            for (const double v : {0.0, 1.0}) {
                const dvec3 corner = unpack(emitter.origin) + u * unpack(emitter.edgeU) + v * unpack(emitter.edgeV);
                EXPECT_TRUE(glm::all(glm::lessThan(unpack(n.lower) - 1e-5, corner)));
                EXPECT_TRUE(glm::all(glm::lessThan(corner, unpack(n.upper) + 1e-5)));
            }
        EXPECT_GT(glm::dot(unpack(emitter.normal), unpack(n.axis)), n.cosSpread - 1e-6);
    }
    EXPECT_NEAR(n.power, power, 1e-5 * power);
    if (count == 1) return;
    const size_t half = count / 2;
    expectHolds(tables, tree, node + 1, first, half);
    expectHolds(tables, tree, node + 2 * half, first + half, count - half);
}

TEST(LightTree, EachNodeHoldsItsEmitters) {
    const EmitterTables tables = manyEmitters();
    const LightTree tree = buildLightTree(tables);
    EXPECT_EQ(tree.nodes.size(), 2 * tables.emitters.size() - 1);
    auto sorted = tree.order;
    std::sort(sorted.begin(), sorted.end());
    for (unsigned k = 0; k < sorted.size(); ++k) EXPECT_EQ(sorted[k], k);
    expectHolds(tables, tree, 0, 0, tables.emitters.size());
}

TEST(LightTree, OneEmitterIsATree) {
    EmitterTables tables;
    tables.emitters = {makePoint({1, 2, 3})};
    tables.power = {5};
    EXPECT_EQ(buildLightTree(tables).nodes.size(), 1u);
}

// --- choices ---

Program& program() {
    static Program built = testProgram("lights.cl", "-DHAS_LIGHT_TREE -DHAS_EMITTER_RECTANGLE -DBVH_STACK_SIZE=8");
    return built;
}

std::vector<double> probabilitiesAt(const LightTree& tree, dvec3 place) {
    const auto count = static_cast<unsigned>(tree.order.size());
    const Buffer<shared::LightNode> nodes(testDevice(), tree.nodes, "nodes");
    const Buffer<float> probabilities(testDevice(), count, "probabilities");
    program()
        .kernel("lightProbabilities")
        .launch(count, nodes, count, float(place.x), float(place.y), float(place.z), probabilities);
    const auto read = probabilities.read();
    return {read.begin(), read.end()};
}

/// How often each emitter was chosen; each time with the probability that it has.
std::vector<uint64_t> choicesAt(const LightTree& tree, dvec3 place, const std::vector<double>& expected) {
    const auto numbers = uniformNumbers(200'000, 5);
    const auto count = static_cast<unsigned>(numbers.size());
    const Buffer<shared::LightNode> nodes(testDevice(), tree.nodes, "nodes");
    const Buffer<float> from(testDevice(), numbers, "numbers"), probabilities(testDevice(), count, "probabilities");
    const Buffer<uint32_t> chosen(testDevice(), count, "chosen");
    program()
        .kernel("chooseLights")
        .launch(count, nodes, static_cast<unsigned>(tree.order.size()), float(place.x), float(place.y), float(place.z),
                from, chosen, probabilities, count);
    std::vector<uint64_t> counts(expected.size());
    const auto lights = chosen.read();
    const auto said = probabilities.read();
    for (size_t k = 0; k < lights.size(); ++k) {
        ++counts.at(lights[k]);
        EXPECT_NEAR(said[k], expected[lights[k]], 1e-5 * expected[lights[k]]);
    }
    return counts;
}

TEST(LightTree, EmittersAreChosenAsOftenAsItSays) {
    const LightTree tree = buildLightTree(manyEmitters());
    for (const dvec3& place : places) {
        const auto probabilities = probabilitiesAt(tree, place);
        EXPECT_NEAR(std::accumulate(probabilities.begin(), probabilities.end(), 0.0), 1, 1e-5);
        const double level = significanceLevel(static_cast<int>(places.size()));
        EXPECT_GT(chiSquaredPValue(choicesAt(tree, place, probabilities), probabilities), level);
        const auto elsewhere = probabilitiesAt(tree, place + dvec3(1, 0.5, 0));
        if (glm::distance(place, dvec3(10, 10, 3)) > 20) continue; // far from all of them places are alike
        EXPECT_LT(chiSquaredPValue(choicesAt(tree, place, probabilities), elsewhere), level) << "negative control";
    }
}

TEST(LightTree, LeavesLessVarianceThanPower) {
    EmitterTables tables;
    for (int k = 0; k < 2500; ++k) {
        tables.emitters.push_back(makeRectangle({k % 50, k / 50, 3}, {0, 0.2, 0}, {0.2, 0, 0}));
        tables.power.push_back(1);
    }
    const LightTree tree = buildLightTree(tables);
    const dvec3 place(20.3, 30.4, 0);
    const auto probabilities = probabilitiesAt(tree, place);
    double mean = 0, byTree = 0, byPower = 0;
    for (size_t k = 0; k < probabilities.size(); ++k) {
        const dvec3 offset = unpack(tables.emitters[tree.order[k]].origin) + dvec3(0.1, 0.1, 0) - place;
        const double squared = glm::dot(offset, offset), value = offset.z * offset.z / (squared * squared);
        mean += value;
        byTree += value * value / probabilities[k];
        byPower += value * value * 2500;
    }
    EXPECT_LT(byTree - mean * mean, 0.1 * (byPower - mean * mean));
}

// --- images ---

/// A cube of side 4 whose walls are 6 x 16 squares that emit 0.1 and reflect 0.9: radiance is 1 everywhere.
Scene furnaceOfSquares() {
    const char* const walls[] = {"<rotate x=\"1\" angle=\"0\"/>",  "<rotate x=\"1\" angle=\"180\"/>",
                                 "<rotate x=\"1\" angle=\"90\"/>", "<rotate x=\"1\" angle=\"-90\"/>",
                                 "<rotate y=\"1\" angle=\"90\"/>", "<rotate y=\"1\" angle=\"-90\"/>"};
    std::string shapes;
    for (const char* wall : walls)
        for (int x = 0; x < 4; ++x)
            for (int y = 0; y < 4; ++y)
                shapes +=
                    "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"0.5\"/><translate x=\"" +
                    std::to_string(x - 1.5) + "\" y=\"" + std::to_string(y - 1.5) + "\" z=\"-2\"/>" + wall +
                    "</transform><bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"0.9\"/></bsdf><emitter "
                    "type=\"area\"><rgb name=\"radiance\" value=\"0.1\"/></emitter></shape>";
    test::SceneFiles files;
    return loadScene(files.write(
        "scene.xml",
        R"(<scene version="3.0.0"><integrator type="path"/><sensor type="perspective"><float name="fov" value="80"/>
        <transform name="to_world"><lookat origin="-1.2,-1,-0.7" target="1,1,0.5" up="0,0,1"/></transform>
        <film type="hdrfilm"><rfilter type="box"/><integer name="width" value="16"/><integer name="height" value="16"/></film></sensor>)" +
            shapes + "</scene>"));
}

RenderSettings furnaceSettings() {
    RenderSettings settings;
    settings.emission = Emission::guided;
    settings.photonsPerPass = 8000;
    return settings;
}

/// Follows everything, with what others have learned.
RenderSettings pathTracing(SamplingRule rule = SamplingRule::right) {
    RenderSettings settings = furnaceSettings();
    settings.quasiSpecular = "all";
    settings.quasiSpecularOverridesScene = true;
    settings.cameraPaths = 4;
    settings.variant = Variant::alternative;
    settings.controlOptions = optionOf(rule);
    return settings;
}

constexpr unsigned furnaceBatches = 10;

/// What batches of the furnace learn, each by a seed of its own.
const std::vector<std::shared_ptr<const LearnedScene>>& learnedOfBatches() {
    static const auto all = [] {
        const Scene scene = furnaceOfSquares();
        std::vector<std::shared_ptr<const LearnedScene>> learned;
        for (unsigned batch = 0; batch < furnaceBatches; ++batch) {
            RenderSettings settings = furnaceSettings();
            settings.seed = batch + 1;
            learned.push_back(Renderer(testDevice(), scene, settings).learned());
        }
        return learned;
    }();
    return all;
}

/// Mean over the image, of the batches with the choices of emitters that `change` makes of those learned.
template <typename Change>
MeanAndError furnaceMean(const Change& change, RenderSettings settings = furnaceSettings()) {
    const Scene scene = furnaceOfSquares();
    std::vector<double> means;
    for (unsigned batch = 0; batch < furnaceBatches; ++batch) {
        LearnedScene learned = *learnedOfBatches()[batch];
        EXPECT_FALSE(learned.tables.lights.empty());
        EXPECT_EQ(learned.tables.lights.size(), learned.tables.laterLights.size());
        change(learned.tables);
        settings.seed = batch + 1;
        Renderer renderer(testDevice(), scene, settings, std::make_shared<const LearnedScene>(learned));
        for (unsigned pass = 0; pass < 4; ++pass) renderer.renderPass(pass);
        const auto image = renderer.develop();
        const double sum = std::accumulate(image.radiance.begin(), image.radiance.end(), 0.0);
        means.push_back(sum / static_cast<double>(image.radiance.size()));
    }
    return meanAndError(means);
}

void halveTheUnlearned(std::vector<shared::LightChoice>& choices) {
    for (size_t k = 0; k < choices.size(); k += LIGHT_CHOICES) choices[k].probability = 0.5f;
}

TEST(ManyEmitters, FurnaceIsAsBrightAsItsWalls) {
    const MeanAndError right = furnaceMean([](const auto&) {});
    EXPECT_NEAR(right.mean, 1, 4 * right.standardError + 0.003);
    EXPECT_LT(right.standardError, 0.004) << "too noisy to decide anything";
    const MeanAndError wrong = furnaceMean([](LearnedTables& learned) { halveTheUnlearned(learned.lights); });
    EXPECT_GT(std::abs(wrong.mean - 1), 4 * wrong.standardError + 0.003)
        << "negative control: probabilities that are no choice's";
}

// Paths that are followed from wall to wall choose by another list after their first scattering, here as if nothing
// were known; emission that they meet is weighed by the choice where they came from.
TEST(ManyEmitters, LaterChoicesAreWeighedByTheirOwnList) {
    const auto forget = [](LearnedTables& learned) {
        for (size_t k = 0; k < learned.laterLights.size(); k += LIGHT_CHOICES) learned.laterLights[k] = {0, 0, 0, 1};
    };
    const MeanAndError learned = furnaceMean([](const auto&) {}, pathTracing()),
                       unlearned = furnaceMean(forget, pathTracing());
    for (const MeanAndError& right : {learned, unlearned}) {
        EXPECT_NEAR(right.mean, 1, 4 * right.standardError + 0.003);
        EXPECT_LT(right.standardError, 0.004) << "too noisy to decide anything";
    }
    const MeanAndError next = furnaceMean(forget, pathTracing(SamplingRule::nextChoice));
    EXPECT_GT(std::abs(next.mean - 1), 4 * next.standardError + 0.003) << "negative control: by the next choice";
    const MeanAndError wrong =
        furnaceMean([](LearnedTables& tables) { halveTheUnlearned(tables.laterLights); }, pathTracing());
    EXPECT_GT(std::abs(wrong.mean - 1), 4 * wrong.standardError + 0.003)
        << "negative control: probabilities that are no choice's";
}

// 100 parallel lights, which are in no tree: as many as fit are listed, and the others keep their share.
TEST(ManyEmitters, ListsOfDistantEmittersEnd) {
    EmitterTables tables;
    std::vector<DirectFind> finds;
    shared::Camera camera{};
    camera.width = camera.height = 8;
    for (unsigned k = 0; k < 100; ++k) {
        tables.emitters.push_back(makeDirectional({0, 0, -1}, {0, 0, 0}, 1));
        finds.push_back({k, k % 64, 1.0 + k, 0.01});
    }
    const auto choice = chooseDirect(finds, finds, tables, camera, false);
    ASSERT_EQ(choice.lights.size(), size_t(LIGHT_CHOICES));
    EXPECT_EQ(choice.lights[0].first, LIGHT_CHOICES - 1u);
    double sum = 0;
    for (const auto& light : choice.lights) sum += light.probability;
    EXPECT_NEAR(sum, 1, 1e-5);
    EXPECT_GT(choice.lights[0].probability, 0.1) << "of the 37 that are not listed";
    EXPECT_EQ(choice.lights[1].first, 99u) << "the strongest first";
}

// A spot in front of a sky whose power is that of the whole, wide floor: where it shines, importance paths must have
// met it, with genuine diffuse lobes and with others. By power alone it would be chosen 300 times less often than the
// sky.
TEST(ManyEmitters, AWeakSpotIsLearnedWhereItShines) {
    for (const char* bsdf : {"diffuse", "roughconductor"}) {
        test::SceneFiles files;
        const Scene scene = loadScene(files.write(
            "scene.xml",
            R"(<scene version="3.0.0"><integrator type="path"/><sensor type="perspective"><float name="fov" value="10"/>
            <transform name="to_world"><lookat origin="0,-3,3" target="0,0,0" up="0,0,1"/></transform><film type="hdrfilm">
            <integer name="width" value="16"/><integer name="height" value="16"/></film></sensor>
            <emitter type="constant"><rgb name="radiance" value="1"/></emitter><emitter type="spot"><transform name="to_world">
            <lookat origin="0,3,3" target="0,0,0" up="0,0,1"/></transform><rgb name="intensity" value="20"/></emitter>
            <shape type="rectangle"><transform name="to_world"><scale value="20"/></transform><bsdf type=")" +
                std::string(bsdf) + R"("/></shape></scene>)"));
        RenderSettings settings;
        settings.emission = Emission::guided;
        const auto learned = Renderer(testDevice(), scene, settings).learned();
        const auto& lights = learned->tables.lights;
        ASSERT_FALSE(lights.empty());
        for (size_t block = 0; block < lights.size(); block += LIGHT_CHOICES) {
            double ofSpot = 0; // emitter 0; the sky is last
            for (size_t k = 1; k <= lights[block].first; ++k)
                if (lights[block + k].first == 0) ofSpot += lights[block + k].probability;
            EXPECT_GT(ofSpot, 0.05) << bsdf << ", block " << block / LIGHT_CHOICES;
        }
    }
}

TEST(ManyEmitters, GroupsOfEmittersAreLearnedByBlock) {
    const auto learned = Renderer(testDevice(), furnaceOfSquares(), furnaceSettings()).learned();
    const auto& choices = learned->tables.lights;
    double sum = 0;
    for (unsigned k = 0; k <= choices[0].first; ++k) sum += choices[k].probability;
    EXPECT_NEAR(sum, 1, 1e-5);
    std::vector<unsigned> listed(96);
    for (unsigned k = 1; k <= choices[0].first; ++k)
        for (unsigned e = choices[k].first; e < choices[k].first + choices[k].count; ++e) ++listed.at(e);
    for (const unsigned times : listed) EXPECT_LE(times, 1u);
}

} // namespace
} // namespace quasilux
