// Which groups of shapes are kept once for all of their instances, as a level of the tree of their own, and which are
// flattened.
#pragma once

#include "scene/load_context.h"

namespace quasilux {

/// Counts in context.groupUse how often the instances in `parent`, and in the merges there, place each group.
void countPlaces(const Element& parent, LoadContext& context);
/// The shapes of an instance that is to be flattened, or none.
std::vector<ShapeDescription> readPlainInstance(const PlainInstances::One& instance, LoadContext& context);
/// The group's shapes, under `place` (in coordinates of the file) after their own transforms.
std::vector<ShapeDescription> readGroupAt(const Element& group, const glm::dmat4& place, LoadContext& context);

/// Decides for all groups that countPlaces() found.
void chooseLevels(LoadContext& context);
/// Adds an instance of the group at `toWorld` (in coordinates of the file) to the scene. False where it is to be
/// flattened.
bool keepAsInstance(const Element& group, const glm::dmat4& toWorld, LoadContext& context);
/// Puts the groups behind all other shapes, when these have been read.
void appendGroups(LoadContext& context);

} // namespace quasilux
