// Two levels cost rays a little and save memory: they are taken where flattened copies would be most of the scene.
#include "scene/shapes/instance_levels.h"

#include "scene/origin.h"
#include "scene/transform.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

namespace quasilux {

namespace {

/// Primitives of flattened instances, together: some 500 MB on the host with their tree and borders.
constexpr size_t mostFlattened = 1'000'000;
/// Kernels take directions of rays whose lengths lie within 1e-6 and 1e6.
constexpr double leastScale = 1e-5, largestScale = 1e5;

size_t primitivesOf(const std::vector<ShapeDescription>& shapes) {
    size_t count = 0;
    for (const ShapeDescription& shape : shapes) count += shape.sphere ? 1 : shape.mesh.triangles.size();
    return count;
}

bool hasSphere(const GroupUse& use) {
    return std::any_of(use.shapes.begin(), use.shapes.end(),
                       [](const auto& shape) { return shape.sphere.has_value(); });
}

/// Media lie where their shapes are in the world.
bool mustBeFlattened(const GroupUse& use) {
    return std::any_of(use.shapes.begin(), use.shapes.end(),
                       [](const auto& shape) { return shape.interior || shape.exterior; });
}

/// In a space in which single precision does them justice.
void readOwnSpace(const Element& group, GroupUse& use, LoadContext& context) {
    const auto at = [&](const glm::dvec3& center) {
        return readGroupAt(group, glm::translate(glm::dmat4(1.0), context.scene.origin - center), context);
    };
    use.shapes = at(glm::dvec3(0));
    use.center = farCenter(boxOf(use.shapes));
    if (use.center != glm::dvec3(0)) use.shapes = at(use.center);
}

/// Whether kernels can carry rays there.
bool suits(const GroupUse& use, const glm::dmat4& toWorld) {
    const glm::dmat3 axes(toWorld), inverse = glm::inverse(axes);
    double largest = 0, largestOfInverse = 0; // above the lengths of what unit vectors become
    for (int k = 0; k < 3; ++k) {
        largest += glm::dot(axes[k], axes[k]);
        largestOfInverse += glm::dot(inverse[k], inverse[k]);
    }
    if (!(std::sqrt(largest) < largestScale && std::sqrt(largestOfInverse) < 1 / leastScale)) return false;
    const double scale = std::cbrt(std::abs(glm::determinant(axes)));
    return !hasSphere(use) || keepsAngles(axes / scale, 1, 1e-4); // or else reading it says what is wrong
}

} // namespace

void chooseLevels(LoadContext& context) {
    const auto& wanted = context.scene.settings.instances;
    if (context.groupUse.empty() || wanted == InstanceLevels::one) return;
    size_t flattened = 0;
    for (const Element* group : context.placedGroups) {
        GroupUse& use = context.groupUse[group];
        if (!wanted && use.places < 2) continue;
        readOwnSpace(*group, use, context);
        const size_t primitives = primitivesOf(use.shapes);
        use.isKept = primitives > 0 && !mustBeFlattened(use);
        if (use.isKept) flattened += use.places * primitives;
    }
    if (wanted || flattened > mostFlattened) return;
    for (auto& [group, use] : context.groupUse) {
        use.isKept = false;
        use.shapes = {}; // read again where instances place them
    }
}

bool keepAsInstance(const Element& group, const glm::dmat4& toWorld, LoadContext& context) {
    const auto found = context.groupUse.find(&group);
    if (found == context.groupUse.end() || !found->second.isKept || !suits(found->second, toWorld)) return false;
    GroupUse& use = found->second;
    if (!use.index) {
        use.index = static_cast<unsigned>(context.keptGroups.size());
        context.keptGroups.push_back(&use);
    }
    glm::dmat4 own = glm::translate(toWorld, use.center);
    own[3] -= glm::dvec4(context.scene.origin, 0);
    context.scene.instances.push_back({*use.index, glm::mat4x3(own)});
    return true;
}

void appendGroups(LoadContext& context) {
    Scene& scene = context.scene;
    for (GroupUse* use : context.keptGroups) {
        scene.groups.push_back({static_cast<unsigned>(scene.shapes.size()), static_cast<unsigned>(use->shapes.size()),
                                boxOf(use->shapes)});
        std::move(use->shapes.begin(), use->shapes.end(), std::back_inserter(scene.shapes));
    }
}

} // namespace quasilux
