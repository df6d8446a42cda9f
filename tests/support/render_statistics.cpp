#include "support/render_statistics.h"

#include "support/test_kernels.h"

#include <algorithm>
#include <cmath>

namespace quasilux {

namespace {

constexpr double luminanceWeights[3] = {0.2126, 0.7152, 0.0722};

// Sum over passes, so that batches come out as differences.
std::vector<double> groupSums(const FilmImage& image, const std::vector<int>& group, size_t groups) {
    std::vector<double> sums(groups), pixels(groups);
    for (size_t k = 0; k < group.size(); ++k) {
        if (group[k] < 0) continue;
        const auto g = static_cast<size_t>(group[k]);
        for (size_t c = 0; c < 3; ++c) sums[g] += luminanceWeights[c] * image.radiance[3 * k + c];
        pixels[g] += 1;
    }
    for (size_t g = 0; g < groups; ++g) sums[g] *= image.passes / pixels[g];
    return sums;
}

} // namespace

MeanAndError meanAndError(const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    MeanAndError result;
    double squares = 0;
    for (const double value : values) {
        result.mean += value / n;
        squares += value * value / n;
    }
    result.standardError = std::sqrt(std::max(0.0, squares - result.mean * result.mean) / (n - 1));
    return result;
}

Scene projectScene(const std::string& name, const std::vector<std::pair<std::string, std::string>>& parameters) {
    return loadScene(std::string(QUASILUX_SOURCE_DIR) + "/scenes/" + name, parameters);
}

std::vector<MeanAndError> renderGroups(const Scene& scene, const RenderSettings& settings,
                                       const std::vector<int>& group, unsigned batches, unsigned passesPerBatch,
                                       std::shared_ptr<const LearnedScene> learned) {
    const auto groups = static_cast<size_t>(*std::max_element(group.begin(), group.end()) + 1);
    Renderer renderer(testDevice(), scene, settings, std::move(learned));
    std::vector<std::vector<double>> means(groups);
    std::vector<double> before(groups);
    for (unsigned batch = 0; batch < batches; ++batch) {
        for (unsigned k = 0; k < passesPerBatch; ++k) renderer.renderPass(batch * passesPerBatch + k);
        const auto sums = groupSums(renderer.develop(), group, groups);
        for (size_t g = 0; g < groups; ++g) means[g].push_back((sums[g] - before[g]) / passesPerBatch);
        before = sums;
    }
    std::vector<MeanAndError> out;
    for (const auto& ofGroup : means) out.push_back(meanAndError(ofGroup));
    return out;
}

} // namespace quasilux
