#include "scene/shapes/curve_file.h"

#include "scene/transform.h"
#include "scene/xml/numbers.h"
#include "scene/xml/xml_document.h"

#include <fmt/format.h>
#include <sstream>

namespace quasilux {

namespace {

CurvePoint parsePoint(const std::string& line, const SourceLocation& where) {
    const std::vector<double> numbers = parseNumbers(line, where, "control point");
    if (numbers.size() != 4)
        throw InputError(
            where, fmt::format("a control point of {} numbers; expected four, x y z radius, or a blank line between "
                               "two curves.",
                               numbers.size()));
    if (!(numbers[3] >= 0))
        throw InputError(where, fmt::format("a radius of {}; it must not be negative.", numbers[3]));
    return {{numbers[0], numbers[1], numbers[2]}, numbers[3]};
}

void checkLength(const Curve& curve, size_t fewest, const SourceLocation& where) {
    if (curve.size() < fewest)
        throw InputError(
            where, fmt::format("a curve of {} control points ends here; expected at least {}.", curve.size(), fewest));
}

} // namespace

std::vector<Curve> readCurves(Properties& properties, size_t fewest) {
    const std::string name = properties.string("filename", "");
    const SourceLocation whereName = properties.where("filename");
    if (name.empty())
        throw InputError(whereName,
                         fmt::format("{} needs <string name=\"filename\" value=\"…\"/>.", properties.describe()));
    const std::string path = properties.context().files.resolve(name, whereName);
    const glm::dmat4 own = properties.ownTransform("to_world");
    std::istringstream lines(readTextFile(path, whereName, "curve"));
    std::vector<Curve> curves(1);
    SourceLocation where{path, 0, 0};
    for (std::string line; std::getline(lines, line);) {
        ++where.line;
        if (line.find_first_not_of(" \t\r") != std::string::npos) {
            CurvePoint point = parsePoint(line, where);
            point.position = transformPoint(own, point.position);
            curves.back().push_back(point);
        } else if (!curves.back().empty()) {
            checkLength(curves.back(), fewest, where);
            curves.emplace_back();
        }
    }
    if (curves.back().empty()) curves.pop_back();
    if (curves.empty())
        throw InputError(SourceLocation{path, 0, 0}, "the file has no control points; expected lines x y z radius.");
    checkLength(curves.back(), fewest, where);
    return curves;
}

} // namespace quasilux
