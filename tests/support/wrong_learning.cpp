#include "support/wrong_learning.h"
#include "support/shared_features.h"

#include "render/renderer.h"
#include "support/test_kernels.h"

#include <gtest/gtest.h>
#include <random>

namespace quasilux {

std::vector<GuideSample> samplesWithin(double side, size_t count) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> number;
    std::vector<GuideSample> samples(count);
    for (auto& sample : samples) {
        for (float& u : sample.u) u = number(random);
        for (size_t d = 1; d < 3; ++d) sample.u[d] = 0.3f + static_cast<float>(side) * sample.u[d];
        sample.weight = 1;
    }
    return samples;
}

GuideTables cornerGuide(const EmitterTables& emitters) {
    std::vector<shared::GuideSource> sources;
    std::vector<SourceBox> boxes;
    for (unsigned e = 0; e < emitters.emitters.size(); ++e) {
        for (const auto& leaf : buildGuideTree(samplesWithin(0.1, 3000), {})) boxes.push_back({e, leaf.box});
        sources.push_back(plainSource(e, e));
    }
    GuideTables guide = makeGuideTables(emitters, std::move(sources), boxes);
    guide.isGuided = true;
    return guide;
}

std::shared_ptr<LearnedScene> learnedOf(const Scene& scene, const RenderSettings& settings) {
    return std::make_shared<LearnedScene>(*Renderer(testDevice(), scene, settings).learned());
}

std::shared_ptr<LearnedScene> wronglyLearned(const Scene& scene, const RenderSettings& settings) {
    auto learned = learnedOf(scene, settings);
    learned->tables.guide = cornerGuide(flattenScene(scene).emitters);
    learned->tables.aims.clear();
    learned->tables.seenCells = {0};
    learned->usualWorth = 0;
    return learned;
}

MeanAndError meanOfImage(const Scene& scene, DirectLight direct, bool wrongly, unsigned passesPerBatch) {
    RenderSettings settings;
    settings.direct = direct;
    settings.furtherFeatures = test::sharedFeatures(scene);
    settings.photonsPerPass = 16000;
    const std::vector<int> one(size_t{scene.sensor.width} * scene.sensor.height, 0);
    return renderGroups(scene, settings, one, 10, passesPerBatch, wrongly ? wronglyLearned(scene, settings) : nullptr)
        .front();
}

void expectMeanOfImage(const Scene& scene, double truth) {
    for (const DirectLight direct : {DirectLight::emitters, DirectLight::photons})
        for (const bool wrongly : {false, true}) {
            const auto result = meanOfImage(scene, direct, wrongly);
            const double allowed = 4 * result.standardError + 0.005 * truth;
            EXPECT_NEAR(result.mean, truth, allowed) << "photons " << (direct == DirectLight::photons) << wrongly;
            EXPECT_GT(std::abs(result.mean - 1.05 * truth), allowed) << "negative control";
        }
}

} // namespace quasilux
