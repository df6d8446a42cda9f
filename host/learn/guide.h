// Guided emission: from useful emission that importance paths found to the tables of kernels/guide.clh
// (docs/method/learning.md).
#pragma once

#include "learn/guide_tree.h"
#include "learn/openings.h"
#include "prepare/device_scene.h"
#include "prepare/guide_tables.h"

#include <functional>
#include <vector>

namespace quasilux {

/// An emitter's light through an opening, as GuideSource.
shared::GuideSource openingSource(unsigned emitter, unsigned first, const Opening& opening);

/// Learns from records; `invert` runs invertEmission of kernels/importance_records.cl.
class GuideLearner {
public:
    using Invert = std::function<std::vector<shared::EmissionPoint>(const std::vector<shared::EmissionRecord>&,
                                                                    const std::vector<shared::GuideSource>& sources)>;
    GuideLearner(const EmitterTables& emitters, Invert invert) : emitters_(emitters), invert_(std::move(invert)) {}

    /// Records whose weights estimate one measure: all those of one round of importance paths.
    void add(const std::vector<shared::EmissionRecord>& records);
    /// The guide learned from all rounds so far.
    GuideTables guide();
    /// Of emitters that shine from outside, as far as known.
    std::vector<Opening> openingsFromOutside() const;

private:
    std::vector<SourceBox> boxesOf(const std::vector<shared::GuideSource>& sources,
                                   const std::vector<std::vector<GuideSample>>& samples,
                                   const std::vector<double>& weights) const;

    void findMoreOpenings(unsigned emitter, const std::vector<UsefulRay>& rays);
    void findSharedOpenings(const std::vector<std::vector<UsefulRay>>& rays);

    std::vector<std::vector<Opening>> openings_; ///< by emitter: those found once stay
    std::vector<Opening> shared_;                ///< of emitters in the scene
    size_t photonsOfRound_ = 0;                  ///< the last one's
    const EmitterTables& emitters_;
    Invert invert_;
    std::vector<std::vector<shared::EmissionRecord>> rounds_;
};

} // namespace quasilux
