#include "prepare/scene_tree.h"

#include "prepare/bvh_append.h"
#include "prepare/device_scene.h"
#include "scene/transform.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <numbers>

namespace quasilux {

namespace {

constexpr size_t wordsOfBlock = sizeof(shared::PrimitiveBlock) / sizeof(uint32_t);
constexpr size_t stepsOfBlock = wordsOfBlock / INSTANCE_STEP;
constexpr size_t stepsOfInstance = sizeof(shared::Instance) / sizeof(uint32_t) / INSTANCE_STEP;
static_assert(wordsOfBlock % INSTANCE_STEP == 0 && stepsOfInstance * INSTANCE_STEP * 4 == sizeof(shared::Instance) &&
              sizeof(shared::ShapeGroup) <= INSTANCE_STEP * 4);

/// What a unit of the coordinates that a box is computed from may be off by.
constexpr double boxRounding = 1e-6;

std::vector<PrimitiveBounds> slotsOf(const shared::BvhNode& node) {
    std::vector<PrimitiveBounds> boxes;
    for (unsigned k = 0; k < BVH_WIDTH; ++k)
        if (node.lowerX[k] <= node.upperX[k])
            boxes.push_back(
                {{node.lowerX[k], node.lowerY[k], node.lowerZ[k]}, {node.upperX[k], node.upperY[k], node.upperZ[k]}});
    return boxes;
}

/// Boxes about what lies below a node, up to 64: turned, together they are less loose than one.
std::vector<PrimitiveBounds> boxesBelow(const Bvh& bvh, unsigned root) {
    std::vector<PrimitiveBounds> boxes;
    const std::vector<PrimitiveBounds> slots = slotsOf(bvh.nodes[root]); // the filled ones come first
    for (unsigned k = 0; k < slots.size(); ++k) {
        const unsigned child = bvh.nodes[root].child[k];
        if (child & BVH_LEAF_BIT)
            boxes.push_back(slots[k]);
        else
            for (const PrimitiveBounds& box : slotsOf(bvh.nodes[child])) boxes.push_back(box);
    }
    return boxes;
}

/// About the boxes where the instance puts them.
PrimitiveBounds boundsInWorld(const Instance& instance, const std::vector<PrimitiveBounds>& boxes) {
    const glm::dmat4x3 m(instance.toWorld);
    Box all;
    for (const PrimitiveBounds& box : boxes) {
        const glm::dvec3 center = 0.5 * (glm::dvec3(box.lower) + glm::dvec3(box.upper));
        const glm::dvec3 half = 0.5 * (glm::dvec3(box.upper) - glm::dvec3(box.lower)) + boxRounding * glm::abs(center);
        const glm::dvec3 middle = m * glm::dvec4(center, 1);
        const glm::dvec3 extent = glm::abs(m[0]) * half.x + glm::abs(m[1]) * half.y + glm::abs(m[2]) * half.z +
                                  boxRounding * (glm::abs(middle) + glm::abs(m[3]));
        all.add({middle - extent, middle + extent});
    }
    return {glm::vec3(all.lower), glm::vec3(all.upper)};
}

/// Squares of what a matrix scales vectors by, in its three principal directions, falling: eigenvalues of a symmetric
/// matrix (Smith 1961).
std::array<double, 3> principalSquares(const glm::dmat3& m) {
    const glm::dmat3 a = glm::transpose(m) * m;
    const double mean = (a[0][0] + a[1][1] + a[2][2]) / 3;
    const glm::dmat3 rest = a - mean * glm::dmat3(1);
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += glm::dot(rest[k], rest[k]);
    const double spread = std::sqrt(sum / 6);
    if (spread <= 1e-7 * mean) return {mean, mean, mean};
    const double cosine = std::clamp(glm::determinant(rest / spread) / 2, -1.0, 1.0);
    const double angle = std::acos(cosine) / 3;
    const double largest = mean + 2 * spread * std::cos(angle),
                 least = mean + 2 * spread * std::cos(angle + 2 * std::numbers::pi / 3);
    return {largest, 3 * mean - largest - least, least};
}

/// Of a surface that a matrix carries, a radius of curvature shrinks at most by this: the square of the least scale
/// over the largest.
double radiusScale(const glm::dmat3& toWorld) {
    const auto squares = principalSquares(toWorld);
    return std::max(squares[2], 1e-30 * squares[0]) / std::sqrt(squares[0]);
}

shared::Instance recordOf(const Instance& instance, unsigned groupPlace, unsigned firstPatch) {
    shared::Instance record{};
    const glm::dmat3 axes(glm::mat3(instance.toWorld[0], instance.toWorld[1], instance.toWorld[2]));
    const glm::dmat3 inverse = glm::inverse(axes);
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column) {
            record.toWorld[4 * row + column] = instance.toWorld[column][row];
            if (column < 3) record.toGroup[3 * row + column] = float(inverse[column][row]);
        }
    record.group = groupPlace;
    record.firstPatch = firstPatch;
    record.radiusScale = float(radiusScale(axes));
    return record;
}

void appendInstanceTree(const Scene& scene, SceneTree& tree) {
    tree.firstGroup = unsigned(stepsOfBlock * tree.bvh.blocks.size());
    tree.firstInstance = unsigned(tree.firstGroup + scene.groups.size());
    const size_t end =
        stepsOfBlock * tree.bvh.blocks.size() + scene.groups.size() + stepsOfInstance * scene.instances.size();
    if (end > BVH_INSTANCE_BIT)
        throw InputError({scene.path},
                         fmt::format("{} instances and the meshes of the scene are more than the tree can "
                                     "address; place fewer.",
                                     scene.instances.size()));
    std::vector<std::vector<PrimitiveBounds>> boxes;
    for (const unsigned root : tree.groupRoots) boxes.push_back(boxesBelow(tree.bvh, root));
    tree.instanceRoot = appendTree(
        scene.instances.size(),
        [&](size_t i) { return boundsInWorld(scene.instances[i], boxes[scene.instances[i].group]); }, 1,
        [&](const unsigned* index, unsigned) {
            return BVH_LEAF_BIT | BVH_INSTANCE_BIT | unsigned(tree.firstInstance + stepsOfInstance * *index);
        },
        tree.bvh);
}

} // namespace

SceneTree buildSceneTree(const Scene& scene) {
    SceneTree tree;
    const std::vector<BvhPrimitive> world = flattenPrimitives(scene, scene.worldShapes());
    if (scene.instances.empty()) {
        tree.bvh = buildBvh(world);
        return tree;
    }
    tree.bvh.nodes.emplace_back(); // the root
    std::vector<unsigned> roots = {appendTree(world, 0, tree.bvh)};
    if (world.empty()) roots.clear();
    unsigned primitive = unsigned(world.size());
    for (const ShapeGroup& group : scene.groups) {
        const std::vector<BvhPrimitive> own = flattenPrimitives(scene, scene.shapesOf(group));
        tree.groupRoots.push_back(appendTree(own, primitive, tree.bvh));
        primitive += unsigned(own.size());
    }
    appendInstanceTree(scene, tree);
    roots.push_back(tree.instanceRoot);
    joinTrees(roots, tree.bvh);
    ++tree.bvh.depth;
    return tree;
}

void appendInstances(const Scene& scene, const SurfaceBorders& borders, std::vector<shared::ShapeGroup> groups,
                     SceneTree& tree) {
    if (scene.instances.empty()) return;
    auto& blocks = tree.bvh.blocks;
    const size_t steps = scene.groups.size() + stepsOfInstance * scene.instances.size();
    blocks.resize(blocks.size() + (steps + stepsOfBlock - 1) / stepsOfBlock);
    auto* words = reinterpret_cast<uint32_t*>(blocks.data());
    for (size_t k = 0; k < groups.size(); ++k) {
        groups[k].root = tree.groupRoots[k];
        std::memcpy(words + INSTANCE_STEP * (tree.firstGroup + k), &groups[k], sizeof groups[k]);
    }
    const std::vector<unsigned> first = firstPatches(scene, borders);
    for (size_t k = 0; k < scene.instances.size(); ++k) {
        const Instance& instance = scene.instances[k];
        const shared::Instance record = recordOf(instance, tree.firstGroup + instance.group, first[k]);
        std::memcpy(words + INSTANCE_STEP * (tree.firstInstance + stepsOfInstance * k), &record, sizeof record);
    }
}

} // namespace quasilux
