// Keys of the report.
#include "compare/comparison_json.h"

namespace quasilux {

using nlohmann::json;

namespace {

// nlohmann writes what is not finite as null.
json orNull(const std::optional<double>& value) { return value ? json(*value) : json(nullptr); }

json regionJson(const RegionMeasures& region) {
    return {{"region", region.name},
            {"pixels", region.pixels},
            {"nonFinite", region.nonFinite},
            {"relMSE", region.relMse},
            {"referenceNoise", orNull(region.referenceNoise)},
            {"imageNoise", orNull(region.imageNoise)},
            {"netRelMSE", region.netRelMse},
            {"denominatorNoise", orNull(region.denominatorNoise)},
            {"RMSE", region.rmse},
            {"meanImage", region.meanImage},
            {"meanReference", region.meanReference},
            {"bias", region.bias},
            {"relativeBias", region.relativeBias()},
            {"standardError", orNull(region.standardError())},
            {"standardErrorByPixels", orNull(region.standardErrorByPixels)},
            {"standardErrorByTiles", orNull(region.standardErrorByTiles)}};
}

json worstJson(const WorstPixel& pixel) {
    return {{"x", pixel.x},
            {"y", pixel.y},
            {"image", pixel.image},
            {"reference", pixel.reference},
            {"relativeSquare", pixel.relativeSquare},
            {"standardErrors", orNull(pixel.standardErrors)}};
}

} // namespace

json comparisonJson(const Comparison& comparison) {
    json regions = json::array(), worst = json::array();
    for (const auto& region : comparison.regions) regions.push_back(regionJson(region));
    for (const auto& pixel : comparison.worst) worst.push_back(worstJson(pixel));
    return {{"regions", regions},
            {"worst", worst},
            {"nonFinite",
             {{"image", comparison.nonFiniteImage},
              {"reference", comparison.nonFiniteReference},
              {"pixels", comparison.nonFinitePixels.size()},
              {"leftOut", comparison.nonFiniteLeftOut}}},
            {"beyondThreeStandardErrors", orNull(comparison.beyondThreeStandardErrors)}};
}

} // namespace quasilux
