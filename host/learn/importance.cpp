#include "learn/importance.h"

#include <bit>
#include <cmath>
#include <glm/glm.hpp>
#include <map>

namespace quasilux {

namespace {

constexpr double verticesOfCell = 128; // of those that the camera sees, about

double length(const shared::Packed3& v) { return glm::length(glm::dvec3(v.x, v.y, v.z)); }

} // namespace

shared::ImportanceGrid importanceGrid(const DeviceScene& scene, unsigned paths) {
    const auto& camera = scene.camera;
    shared::ImportanceGrid grid{};
    grid.cells = QL_NONE;
    grid.eye = camera.origin;
    const double share = verticesOfCell / paths;
    const double ofScene = std::sqrt(share * scene.surfaceArea);
    const double image = double(camera.width) * camera.height * length(camera.stepX) * length(camera.stepY);
    const bool isCamera = scene.offsets.meter.kind == METER_NONE;
    const bool isPerspective = isCamera && !camera.orthographic;
    // Its image at distance 1, or its image as it is.
    grid.sizePerDistance = isPerspective ? static_cast<float>(std::sqrt(share * image)) : 0;
    grid.smallestSize = static_cast<float>(isPerspective ? 1e-6 * ofScene : isCamera ? std::sqrt(share * image) : ofScene);
    if (!(grid.smallestSize > 0)) grid.smallestSize = 1e-6f;
    return grid;
}

std::vector<uint32_t> importanceCells(const std::vector<shared::PilotPath>& paths,
                                      const std::vector<double>& pathWeights, const std::vector<uint32_t>& keys,
                                      const std::vector<float>& sizes, shared::ImportanceGrid& grid) {
    struct Values {
        double gathered = 0, all = 0;
    };
    std::map<uint32_t, Values> cells; // sorted, so that the table is the same on every machine
    for (size_t k = 0; k < paths.size(); ++k)
        for (size_t v = 0; v < PILOT_VERTICES; ++v) {
            const auto& vertex = paths[k].vertices[v];
            const size_t at = k * PILOT_VERTICES + v;
            if (!(vertex.weight > 0) || !std::isfinite(vertex.weight)) continue;
            const double value = pathWeights[k] * vertex.weight / (double(sizes[at]) * sizes[at]);
            Values& cell = cells[keys[at]];
            if (v == 0) cell.gathered += value;
            cell.all += value;
        }
    const size_t count = std::bit_ceil(2 * cells.size() + 1);
    grid.mask = static_cast<unsigned>(count - 1);
    std::vector<uint32_t> table(IMPORTANCE_WORDS * count);
    for (const auto& [key, values] : cells) {
        size_t at = key & grid.mask;
        while (table[IMPORTANCE_WORDS * at] != 0) at = (at + 1) & grid.mask;
        table[IMPORTANCE_WORDS * at] = key;
        table[IMPORTANCE_WORDS * at + 1] = std::bit_cast<uint32_t>(static_cast<float>(values.gathered));
        table[IMPORTANCE_WORDS * at + 2] = std::bit_cast<uint32_t>(static_cast<float>(values.all));
    }
    return table;
}

} // namespace quasilux
