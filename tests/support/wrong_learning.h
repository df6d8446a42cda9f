// What is learned about a scene, turned against it: means must not depend on it.
#pragma once

#include "learn/guide_tree.h"
#include "learn/learning.h"
#include "render/settings.h"
#include "support/render_statistics.h"

#include <memory>
#include <vector>

namespace quasilux {

/// Emission numbers, even but for two of them, which lie within an interval of this length.
std::vector<GuideSample> samplesWithin(double side, size_t count);

/// Photons begin nearly all in a hundredth of each emitter's numbers, which serves nothing.
GuideTables cornerGuide(const EmitterTables& emitters);

/// What a renderer of these settings learns, to be changed.
std::shared_ptr<LearnedScene> learnedOf(const Scene& scene, const RenderSettings& settings);

/// That guide; and no place is said to be gathered from, so that most photons are not stored.
std::shared_ptr<LearnedScene> wronglyLearned(const Scene& scene, const RenderSettings& settings);

/// Mean luminance of the image, over ten batches of passes; `wrongly`: by wronglyLearned().
MeanAndError meanOfImage(const Scene& scene, DirectLight direct, bool wrongly, unsigned passesPerBatch = 8);

/// It is `truth` by emitters and by photons, whatever was learned; and not 5 % more.
void expectMeanOfImage(const Scene& scene, double truth);

} // namespace quasilux
