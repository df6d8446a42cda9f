#include "scene/illuminance_grid.h"

#include "scene/instruction_values.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace quasilux {

namespace {

const Names gridNames = {"name", "quantity", "origin", "edge-u", "edge-v", "nx", "ny", "normal", "spacing"};
constexpr unsigned maximumPoints = 32768; // along one side, as of a film

std::string nameOf(const InstructionValues& values, const Instruction& instruction,
                   const std::vector<IlluminanceGrid>& others) {
    std::string name = values.has("name") ? values.text("name") : fmt::format("grid {}", others.size() + 1);
    if (name.empty() || name.find_first_of(",\"\n\r") != std::string::npos)
        throw InputError(
            instruction.where,
            "illuminance-grid: name is empty or has a comma, a quote or a line break; choose one without.");
    for (const IlluminanceGrid& other : others)
        if (other.name == name)
            throw InputError(instruction.where, fmt::format("illuminance-grid: the one at {} has the name '{}' too; "
                                                            "choose another.",
                                                            other.where.text(), name));
    return name;
}

IlluminanceKind kindOf(const InstructionValues& values, const SourceLocation& where) {
    if (!values.has("quantity") || values.text("quantity") == "planar") return IlluminanceKind::planar;
    if (values.text("quantity") == "cylindrical") return IlluminanceKind::cylindrical;
    throw InputError(where, fmt::format("illuminance-grid: quantity is '{}'; expected planar or cylindrical.",
                                        values.text("quantity")));
}

/// EN 12464-1:2021, 4.4: at most p = 0.2 * 5^(log10 d) m between points, d being the longer side, or the shorter one
/// where the longer is twice as long or more; p is at most 10 m. Along d there are d / p points, to the nearest whole
/// number, and the other side is divided by the spacing that they then have, so that cells are nearly square. Sides are
/// in metres.
void countBySpacing(const InstructionValues& values, IlluminanceGrid& grid) {
    const std::string& rule = values.text("spacing");
    if (rule != "en12464")
        throw InputError(
            grid.where,
            fmt::format("illuminance-grid: spacing is '{}'; expected en12464, or nx and ny instead.", rule));
    for (const char* key : {"nx", "ny"})
        if (values.has(key))
            throw InputError(
                grid.where, fmt::format("illuminance-grid: both spacing and {}; keep the spacing, or nx and ny.", key));
    const double u = glm::length(grid.edgeU), v = glm::length(grid.edgeV);
    const double shorter = std::min(u, v), longer = std::max(u, v), d = longer / shorter < 2 ? longer : shorter;
    const double p = std::min(0.2 * std::pow(5, std::log10(d)), 10.0);
    const auto count = [](double side, double spacing) {
        return static_cast<unsigned>(std::clamp(std::round(side / spacing), 1.0, double(maximumPoints)));
    };
    const double spacing = d / count(d, p);
    grid.nx = count(u, spacing);
    grid.ny = count(v, spacing);
}

/// `normal` only chooses one of the two sides: photons are counted where they cross the grid.
bool isFlipped(const InstructionValues& values, const IlluminanceGrid& grid) {
    if (!values.has("normal")) return false;
    const glm::dvec3 normal = values.vector("normal");
    const double cosine = glm::dot(grid.normal(), normal) / glm::length(normal);
    if (!(std::abs(cosine) > 1 - 1e-4))
        throw InputError(grid.where, "illuminance-grid: normal is not perpendicular to edge-u and edge-v; choose "
                                     "edges across the direction to be measured.");
    return cosine < 0;
}

} // namespace

IlluminanceGrid parseIlluminanceGrid(const Instruction& instruction, const std::vector<IlluminanceGrid>& others) {
    const InstructionValues values(instruction, gridNames, "origin, edge-u, edge-v (each \"x,y,z\"), nx and ny");
    IlluminanceGrid grid;
    grid.where = instruction.where;
    grid.name = nameOf(values, instruction, others);
    grid.kind = kindOf(values, instruction.where);
    grid.origin = values.vector("origin");
    grid.edgeU = values.vector("edge-u");
    grid.edgeV = values.vector("edge-v");
    const double area = glm::length(glm::cross(grid.edgeU, grid.edgeV));
    if (!(area > 1e-6 * glm::length(grid.edgeU) * glm::length(grid.edgeV)))
        throw InputError(instruction.where, "illuminance-grid: edge-u and edge-v span no area.");
    if (values.has("spacing")) {
        countBySpacing(values, grid);
    } else {
        grid.nx = values.count("nx", maximumPoints);
        grid.ny = values.count("ny", maximumPoints);
    }
    grid.flipNormals = isFlipped(values, grid);
    // Photons are counted in cells about the points, no higher than they are wide.
    grid.height = std::min(glm::length(grid.edgeU) / grid.nx, glm::length(grid.edgeV) / grid.ny);
    return grid;
}

void useGridsAsSensor(Scene& scene) {
    if (scene.grids.empty())
        throw InputError({scene.path}, "the scene has no illuminance-grid to measure; add <?quasilux illuminance-grid "
                                       "origin=\"x,y,z\" edge-u=\"x,y,z\" edge-v=\"x,y,z\" nx=\"N\" ny=\"N\"?>.");
    Sensor sensor;
    sensor.where = scene.grids.front().where;
    sensor.plugin = illuminanceGridKind;
    sensor.meter = MeterKind::grid;
    sensor.width = scene.grids.front().nx;
    sensor.height = scene.grids.front().ny;
    if (scene.grids.size() > 1) {
        uint64_t points = 0;
        for (const IlluminanceGrid& grid : scene.grids) points += grid.points();
        if (points > uint64_t{maximumPoints} * maximumPoints)
            throw InputError(sensor.where, fmt::format("the scene's grids have {} points, {} at most can be measured; "
                                                       "give fewer.",
                                                       points, uint64_t{maximumPoints} * maximumPoints));
        sensor.width = static_cast<unsigned>(points);
        sensor.height = 1;
    }
    scene.sensor = sensor;
}

} // namespace quasilux
