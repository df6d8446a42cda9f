// Which instances are no more than a place of a group, and may be kept as that.
#pragma once

#include "scene/xml/element.h"

#include <set>

namespace quasilux {

class PlainInstanceReader {
public:
    /// An element that the scene will have.
    void note(const Element& element);
    /// Keeps `element` in scene.instances, if it is such an instance of a group that was noted. False where it is not,
    /// or has errors.
    bool keep(const Element& element, Element& scene) const;

private:
    std::set<std::string> groups_; ///< ids
};

/// Moves the instances of a scene that is included to the end of another, whose first `children` came before it.
void moveInstances(Element& from, size_t children, Element& to);

} // namespace quasilux
