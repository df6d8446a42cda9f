// Openings that light comes through from outside (windows, skylights), found from rays that serve the image
// (docs/method/learning.md).
#pragma once

#include <glm/glm.hpp>
#include <limits>
#include <vector>

namespace quasilux {

/// A ray that serves the image.
struct UsefulRay {
    glm::dvec3 position{}, direction{}; ///< direction is of unit length
    double weight = 0;
    /// Begins at `position`, where its light is scattered into all directions; or else comes from outside and ends there
    bool isScattered = false;
    double length = std::numeric_limits<double>::infinity(); ///< from `position` to where it arrives
};

/// Of a place from the line that the ray lies on.
double distance(const UsefulRay& ray, const glm::dvec3& place);

/// Which of the rays systematic resampling draws, in their order, each as often as it weighs (no more than `mostCopies`
/// times or so): `count` of them, fewer where some weigh more than that.
std::vector<size_t> drawnByWeight(const std::vector<UsefulRay>& rays, size_t count,
                                  double mostCopies = std::numeric_limits<double>::infinity());

/// A rectangle, or a square that faces every place where rays begin.
struct Opening {
    glm::dvec3 centre{}, axisU{1, 0, 0}, axisV{0, 1, 0}; ///< axes orthonormal
    double halfU = 0, halfV = 0;
    bool faces = false; ///< axes are left out then

    /// Does the ray come through the rectangle, and not end at it? Does it pass the square on its way?
    bool holds(const UsefulRay& ray) const;
};

/// For scattered rays; those from outside come through rectangles.
enum class OpeningShape {
    rectangle,
    square, ///< that faces every place
    either, ///< whichever is likelier
};

/// At most `most`, the one first by which the rays' log likelihood grows most, were every second one aimed at it:
/// before, rays from outside are spread evenly over a sphere of this `radius`, scattered ones over all directions. The
/// same for the same rays. What comes through `known` ones is left out, and openings that bring less than `leastGain`
/// of the likelihood.
std::vector<Opening> findOpenings(std::vector<UsefulRay> rays, double radius, const std::vector<Opening>& known,
                                  size_t most, OpeningShape shape = OpeningShape::either, double leastGain = 0.05);

} // namespace quasilux
