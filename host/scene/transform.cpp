// <transform> and its operations, in double precision.
#include "scene/transform.h"

#include "scene/xml/numbers.h"

#include <cmath>
#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

namespace quasilux {

namespace {

std::string describe(const Element& element) {
    const std::string& name = element.get("name");
    return name.empty() ? fmt::format("<{}>", element.tag) : fmt::format("parameter '{}'", name);
}

glm::dvec3 parseTriple(const Element& element, const std::string& attribute) {
    const std::string what = fmt::format("<{}> {}", element.tag, attribute);
    const std::vector<double> values = parseNumbers(element.get(attribute), element.where, what);
    if (values.size() != 3)
        throw InputError(element.where, fmt::format("{}: {} numbers; expected three.", what, values.size()));
    return {values[0], values[1], values[2]};
}

glm::dmat4 parseRotation(const Element& element) {
    const glm::dvec3 axis = parseVector(element, 0);
    const double length = glm::length(axis);
    if (!(length > 0)) throw InputError(element.where, "<rotate>: the axis is zero; give x, y or z.");
    const double degrees = parseNumber(element.get("angle"), element.where, "<rotate> angle");
    return glm::rotate(glm::dmat4(1.0), glm::radians(degrees), axis / length);
}

/// Mitsuba's look_at: local +z towards the target, +x = up × z (to the left of the image).
glm::dmat4 parseLookAt(const Element& element) {
    const glm::dvec3 origin = parseTriple(element, "origin"), target = parseTriple(element, "target");
    glm::dvec3 up = element.find("up") ? parseTriple(element, "up") : glm::dvec3(0);
    const glm::dvec3 toTarget = target - origin;
    if (!(glm::length(toTarget) > 0))
        throw InputError(element.where, "<lookat>: origin and target are the same point; the view has no direction.");
    const glm::dvec3 forward = glm::normalize(toTarget);
    if (up == glm::dvec3(0)) up = axesAcross(forward).first; // as Mitsuba
    const glm::dvec3 left = glm::cross(glm::normalize(up), forward);
    if (glm::length(left) < 1e-9)
        throw InputError(element.where, "<lookat>: up is parallel to the view direction; choose another up.");
    const glm::dvec3 side = glm::normalize(left);
    return {glm::dvec4(side, 0), glm::dvec4(glm::cross(forward, side), 0), glm::dvec4(forward, 0),
            glm::dvec4(origin, 1)};
}

/// Rows of 4 × 4 or 3 × 3 numbers, as they are written on paper.
glm::dmat4 parseMatrix(const Element& element) {
    const std::vector<double> values = parseNumbers(element.get("value"), element.where, "<matrix>");
    if (values.size() != 16 && values.size() != 9)
        throw InputError(element.where, fmt::format("<matrix>: {} numbers; expected 16 or 9.", values.size()));
    const size_t size = values.size() == 16 ? 4 : 3;
    glm::dmat4 matrix(1.0);
    for (size_t row = 0; row < size; ++row)
        for (size_t column = 0; column < size; ++column)
            matrix[static_cast<int>(column)][static_cast<int>(row)] = values[row * size + column];
    if (matrix[0][3] != 0 || matrix[1][3] != 0 || matrix[2][3] != 0 || matrix[3][3] != 1)
        throw InputError(element.where, "<matrix>: the last row is not 0 0 0 1; only affine transforms are supported.");
    return matrix;
}

glm::dmat4 parseOperation(const Element& element) {
    if (element.tag == "translate") return glm::translate(glm::dmat4(1.0), parseVector(element, 0));
    if (element.tag == "scale") return glm::scale(glm::dmat4(1.0), parseVector(element, 1));
    if (element.tag == "rotate") return parseRotation(element);
    if (element.tag == "lookat") return parseLookAt(element);
    return parseMatrix(element);
}

void checkRegular(const glm::dmat4& matrix, const Element& element) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(matrix[column][row]))
                throw InputError(element.where, "transform: the product of its operations is not finite.");
    const double x = glm::length(glm::dvec3(matrix[0])), y = glm::length(glm::dvec3(matrix[1])),
                 z = glm::length(glm::dvec3(matrix[2]));
    // Each direction is measured by its own scale, so that a thin plate (scale 1, 1, 1e-8) is regular.
    const bool zero = !(x > 0 && y > 0 && z > 0);
    const glm::dmat3 directions{glm::dvec3(matrix[0]) / x, glm::dvec3(matrix[1]) / y, glm::dvec3(matrix[2]) / z};
    if (zero || std::abs(glm::determinant(directions)) < 1e-10)
        throw InputError(element.where, "transform is singular (it flattens space); every scale must differ from 0.");
}

} // namespace

std::pair<glm::dvec3, glm::dvec3> axesAcross(const glm::dvec3& n) {
    const double sign = std::copysign(1.0, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
    return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}};
}

glm::dvec3 parseVector(const Element& element, double missing) {
    const std::string what = describe(element);
    const bool components = element.find("x") || element.find("y") || element.find("z");
    if (const std::string* value = element.find("value")) {
        if (components) throw InputError(element.where, what + " has both value and x, y, z; keep one form.");
        const std::vector<double> numbers = parseNumbers(*value, element.where, what);
        if (numbers.size() == 1) return glm::dvec3(numbers[0]);
        if (numbers.size() != 3)
            throw InputError(element.where,
                             fmt::format("{}: {} numbers; expected three, or one for all.", what, numbers.size()));
        return {numbers[0], numbers[1], numbers[2]};
    }
    if (!components) throw InputError(element.where, what + " has no numbers; give x, y, z or value=\"a,b,c\".");
    const auto component = [&](const char* name) {
        const std::string* text = element.find(name);
        return text ? parseNumber(*text, element.where, fmt::format("{} {}", what, name)) : missing;
    };
    return {component("x"), component("y"), component("z")};
}

glm::dmat4 parseTransform(const Element& element) {
    glm::dmat4 product(1.0);
    for (const Element& operation : element.children) product = parseOperation(operation) * product;
    checkRegular(product, element);
    return product;
}

glm::vec3 toSingle(const glm::dvec3& point, const SourceLocation& where) {
    const glm::vec3 single(point);
    if (!std::isfinite(single.x) || !std::isfinite(single.y) || !std::isfinite(single.z))
        throw InputError(where, fmt::format("the point ({}, {}, {}) is out of the range of single precision.", point.x,
                                            point.y, point.z));
    return single;
}

} // namespace quasilux
