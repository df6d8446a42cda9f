// Closed shapes that state media, and which of them holds a point.
#pragma once

#include "scene/box.h"
#include "scene/scene.h"

#include <vector>

namespace quasilux {

/// The inside of one shape.
class MediumBody {
public:
    /// `shape` must outlive it.
    explicit MediumBody(const ShapeDescription& shape);

    /// Whether the shape goes round `point`: for a mesh by its winding number, which is 1 inside and 0 outside of a
    /// closed mesh wherever the point lies, without rays that could meet edges; an open mesh holds what it surrounds
    /// more than halfway.
    bool holds(const glm::dvec3& point) const;
    /// Whether its surface may pass through the box: surely not, if not.
    bool mayCross(const Box& box) const;
    /// Scene units cubed. Of two bodies, one within the other, the inner one has less.
    double volume() const { return volume_; }
    /// The medium inside as stated: behind the surface, or, where the normals point inwards, on their side.
    unsigned medium() const { return medium_; }

private:
    double windingNumber(const glm::dvec3& point) const;

    const ShapeDescription* shape_;
    Box box_;
    double volume_ = 0;
    unsigned medium_ = MEDIUM_NONE;
};

class MediumBodies {
public:
    /// Of the shapes that state a medium. `scene` must outlive it.
    explicit MediumBodies(const Scene& scene);

    /// Medium inside of the innermost body that holds `point`; outside of all, what the sensor says that it stands in
    /// there, or MEDIUM_NONE.
    unsigned mediumAt(const glm::dvec3& point) const;
    /// What all of the box lies in; MEDIUM_BY_PLACE where a surface that states media may pass through it, unless the box
    /// is a point.
    unsigned mediumOf(const Box& box) const;
    /// What most of the points lie in.
    unsigned mediumAtMost(const std::vector<glm::dvec3>& points) const;

private:
    std::vector<MediumBody> bodies_; ///< by volume
    unsigned outside_ = MEDIUM_NONE;
};

} // namespace quasilux
