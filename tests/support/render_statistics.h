// Renders a scene in independent batches of passes and gives means over groups of pixels with their standard errors.
#pragma once

#include "render/renderer.h"

#include <memory>
#include <string>
#include <vector>

namespace quasilux {

struct MeanAndError {
    double mean = 0;
    double standardError = 0; ///< of the mean, from the spread of the batches (photon noise is shared between pixels)
};

/// Of independent values, at least two.
MeanAndError meanAndError(const std::vector<double>& values);

/// Scene of scenes/, with `parameters` replacing its defaults.
Scene projectScene(const std::string& name, const std::vector<std::pair<std::string, std::string>>& parameters = {});

/// Luminance averaged over each group of pixels. `group[pixel]` is the group, or a negative number for none. `learned`:
/// as Renderer has it.
std::vector<MeanAndError> renderGroups(const Scene& scene, const RenderSettings& settings,
                                       const std::vector<int>& group, unsigned batches, unsigned passesPerBatch,
                                       std::shared_ptr<const LearnedScene> learned = nullptr);

} // namespace quasilux
