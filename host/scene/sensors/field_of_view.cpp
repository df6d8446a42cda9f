#include "scene/sensors/field_of_view.h"

#include "scene/xml/numbers.h"

#include <cmath>
#include <fmt/format.h>

namespace quasilux {

namespace {

/// Full diagonal angle of a 36 mm × 24 mm picture behind a lens of `focal_length`, as "50mm".
double diagonalFromFocalLength(Properties& properties) {
    std::string text = properties.string("focal_length", "50mm");
    if (text.size() > 2 && text.compare(text.size() - 2, 2, "mm") == 0) text.resize(text.size() - 2);
    const SourceLocation where = properties.where("focal_length");
    const double length = parseNumber(text, where, "parameter 'focal_length' (in mm, such as \"50mm\")");
    if (length <= 0)
        throw InputError(where, fmt::format("parameter 'focal_length' is {} mm; it must be greater than 0.", length));
    return 2 * std::atan(std::sqrt(36.0 * 36.0 + 24.0 * 24.0) / (2 * length));
}

/// Full horizontal angle from the angle along `axis`; `aspect` is width / height.
double horizontalAngle(double angle, std::string axis, double aspect) {
    if (axis == "smaller") axis = aspect > 1 ? "y" : "x";
    if (axis == "larger") axis = aspect > 1 ? "x" : "y";
    const double extent = std::tan(angle / 2);
    if (axis == "y") return 2 * std::atan(extent * aspect);
    if (axis == "diagonal") return 2 * std::atan(extent / std::sqrt(1 + 1 / (aspect * aspect)));
    return angle;
}

} // namespace

double readFieldOfView(Properties& properties, double aspect) {
    const bool byAngle = properties.has("fov"), byLength = properties.has("focal_length");
    const std::string axis = properties.choiceOfAnyCase("fov_axis", "x", {"x", "y", "diagonal", "smaller", "larger"});
    if (byAngle && byLength)
        throw InputError(properties.where("focal_length"),
                         fmt::format("{} has both fov and focal_length; keep one.", properties.describe()));
    if (!byAngle) return horizontalAngle(diagonalFromFocalLength(properties), "diagonal", aspect);
    const double degrees = properties.number("fov", 0);
    if (degrees <= 0 || degrees >= 180)
        throw InputError(properties.where("fov"),
                         fmt::format("parameter 'fov' is {}; expected degrees between 0 and 180.", degrees));
    return horizontalAngle(glm::radians(degrees), axis, aspect);
}

} // namespace quasilux
