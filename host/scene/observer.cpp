#include "scene/observer.h"

#include "scene/instruction_values.h"

#include <cmath>
#include <fmt/format.h>

namespace quasilux {

namespace {

const Names observerNames = {"name", "position", "direction", "up", "size"};

glm::dvec3 unitVector(const InstructionValues& values, const char* key, const SourceLocation& where) {
    const glm::dvec3 direction = values.vector(key);
    const double length = glm::length(direction);
    if (!(length > 0)) throw InputError(where, fmt::format("observer: {} is 0,0,0; expected a direction.", key));
    return direction / length;
}

} // namespace

Observer parseObserver(const Instruction& instruction, size_t before) {
    const InstructionValues values(instruction, observerNames, "position and direction (each \"x,y,z\")");
    Observer observer;
    observer.where = instruction.where;
    observer.name = values.has("name") ? values.text("name") : fmt::format("observer {}", before + 1);
    observer.position = values.vector("position");
    observer.direction = unitVector(values, "direction", instruction.where);
    if (values.has("up")) observer.up = unitVector(values, "up", instruction.where);
    if (values.has("size")) observer.size = values.numberAbove("size", 0);
    if (!(glm::length(glm::cross(observer.direction, observer.up)) > 1e-6))
        throw InputError(instruction.where,
                         "observer: direction and up are parallel; give a line of sight that is not, or another up.");
    return observer;
}

IlluminanceGrid eyeGrid(const Observer& observer) {
    const glm::dvec3 right = glm::normalize(glm::cross(observer.direction, observer.up)),
                     above = glm::cross(right, observer.direction);
    IlluminanceGrid grid;
    grid.where = observer.where;
    grid.name = observer.name;
    // right × above looks backwards: -direction.
    grid.edgeU = observer.size * right;
    grid.edgeV = observer.size * above;
    grid.flipNormals = true;
    grid.origin = observer.position - 0.5 * (grid.edgeU + grid.edgeV);
    grid.nx = grid.ny = 1;
    return grid;
}

} // namespace quasilux
