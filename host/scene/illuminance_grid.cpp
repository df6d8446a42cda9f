#include "scene/illuminance_grid.h"

#include "scene/xml/names.h"
#include "scene/xml/numbers.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr std::string_view kind = "illuminance-grid";
const Names gridNames = {"origin", "edge-u", "edge-v", "nx", "ny", "normal", "spacing"};
constexpr uint64_t maximumPoints = 32768; // along one side, as of a film

bool has(const Instruction& instruction, std::string_view key) {
    return std::any_of(instruction.entries.begin(), instruction.entries.end(),
                       [&](const Attribute& entry) { return entry.name == key; });
}

const std::string& valueOf(const Instruction& instruction, std::string_view key) {
    const auto found = std::find_if(instruction.entries.begin(), instruction.entries.end(),
                                    [&](const Attribute& entry) { return entry.name == key; });
    if (found == instruction.entries.end())
        throw InputError(instruction.where,
                         fmt::format("the illuminance-grid lacks {}; expected origin, edge-u, edge-v (each \"x,y,z\"), "
                                     "nx and ny.",
                                     key));
    return found->value;
}

glm::dvec3 vectorOf(const Instruction& instruction, std::string_view key) {
    const auto numbers = parseNumbers(valueOf(instruction, key), instruction.where, key);
    if (numbers.size() != 3)
        throw InputError(
            instruction.where,
            fmt::format("illuminance-grid: {} has {} numbers; expected three, \"x,y,z\".", key, numbers.size()));
    return {numbers[0], numbers[1], numbers[2]};
}

unsigned countOf(const Instruction& instruction, std::string_view key) {
    return static_cast<unsigned>(parseUnsigned(valueOf(instruction, key), 1, maximumPoints, instruction.where, key));
}

/// EN 12464-1:2021, 4.4: at most p = 0.2 * 5^(log10 d) m between points, d being the longer side, or the shorter one where the longer is twice
/// as long or more; p is at most 10 m. Sides are in metres.
void countBySpacing(const Instruction& instruction, IlluminanceGrid& grid) {
    const std::string& rule = valueOf(instruction, "spacing");
    if (rule != "en12464")
        throw InputError(
            instruction.where,
            fmt::format("illuminance-grid: spacing is '{}'; expected en12464, or nx and ny instead.", rule));
    for (const char* key : {"nx", "ny"})
        if (has(instruction, key))
            throw InputError(
                instruction.where,
                fmt::format("illuminance-grid: both spacing and {}; keep the spacing, or nx and ny.", key));
    const double u = glm::length(grid.edgeU), v = glm::length(grid.edgeV);
    const double shorter = std::min(u, v), longer = std::max(u, v), d = longer / shorter < 2 ? longer : shorter;
    const double p = std::min(0.2 * std::pow(5, std::log10(d)), 10.0);
    const auto count = [&](double side) {
        return static_cast<unsigned>(std::clamp(std::round(side / p), 1.0, double(maximumPoints)));
    };
    grid.nx = count(u);
    grid.ny = count(v);
}

/// `normal` only chooses one of the two sides: photons are counted where they cross the grid.
bool isFlipped(const Instruction& instruction, const IlluminanceGrid& grid) {
    if (!has(instruction, "normal")) return false;
    const glm::dvec3 normal = vectorOf(instruction, "normal");
    const double cosine = glm::dot(grid.normal(), normal) / glm::length(normal);
    if (!(std::abs(cosine) > 1 - 1e-4))
        throw InputError(instruction.where,
                         "illuminance-grid: normal is not perpendicular to edge-u and edge-v; choose "
                         "edges across the direction to be measured.");
    return cosine < 0;
}

} // namespace

bool isIlluminanceGrid(const Instruction& instruction) {
    if (instruction.kind.empty()) return false;
    if (instruction.kind != kind)
        throw InputError(instruction.where, fmt::format("unknown <?quasilux {}?>.{}", instruction.kind,
                                                        knownNames(instruction.kind, {kind})));
    return true;
}

IlluminanceGrid parseIlluminanceGrid(const Instruction& instruction) {
    for (const Attribute& entry : instruction.entries)
        if (std::find(gridNames.begin(), gridNames.end(), entry.name) == gridNames.end())
            throw InputError(instruction.where, fmt::format("unknown key '{}' of an illuminance-grid.{}", entry.name,
                                                            knownNames(entry.name, gridNames)));
    IlluminanceGrid grid;
    grid.where = instruction.where;
    grid.origin = vectorOf(instruction, "origin");
    grid.edgeU = vectorOf(instruction, "edge-u");
    grid.edgeV = vectorOf(instruction, "edge-v");
    const double area = glm::length(glm::cross(grid.edgeU, grid.edgeV));
    if (!(area > 1e-6 * glm::length(grid.edgeU) * glm::length(grid.edgeV)))
        throw InputError(instruction.where, "illuminance-grid: edge-u and edge-v span no area.");
    if (has(instruction, "spacing")) {
        countBySpacing(instruction, grid);
    } else {
        grid.nx = countOf(instruction, "nx");
        grid.ny = countOf(instruction, "ny");
    }
    grid.flipNormals = isFlipped(instruction, grid);
    return grid;
}

void measureGrid(Scene& scene) {
    if (!scene.grid)
        throw InputError({scene.path}, "the scene has no illuminance-grid to measure; add <?quasilux illuminance-grid "
                                       "origin=\"x,y,z\" edge-u=\"x,y,z\" edge-v=\"x,y,z\" nx=\"N\" ny=\"N\"?>.");
    Sensor sensor;
    sensor.where = scene.grid->where;
    sensor.plugin = kind;
    sensor.meter = MeterKind::grid;
    sensor.width = scene.grid->nx;
    sensor.height = scene.grid->ny;
    scene.sensor = sensor;
}

} // namespace quasilux
