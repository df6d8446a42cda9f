#include "scene/gltf/nodes.h"

#include "scene/gltf/accessors.h"
#include "scene/gltf/json_values.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace quasilux {

namespace {

glm::dmat4 translation(const glm::dvec3& by) {
    glm::dmat4 matrix(1);
    matrix[3] = glm::dvec4(by, 1);
    return matrix;
}

glm::dmat4 scaling(const glm::dvec3& by) {
    glm::dmat4 matrix(1);
    for (int c = 0; c < 3; ++c) matrix[c][c] = by[c];
    return matrix;
}

/// By a quaternion x, y, z, w of any length.
glm::dmat4 rotation(const glm::dvec4& quaternion, const SourceLocation& where) {
    const double length = glm::length(quaternion);
    if (!(length > 0) || !std::isfinite(length))
        throw InputError(where, "the rotation is no quaternion: its length is 0 or not finite.");
    const glm::dvec3 v = glm::dvec3(quaternion) / length;
    const double w = quaternion.w / length;
    glm::dmat4 matrix(1);
    for (int c = 0; c < 3; ++c) {
        glm::dvec3 axis(0);
        axis[c] = 1;
        matrix[c] = glm::dvec4(axis + 2.0 * glm::cross(v, glm::cross(v, axis) + w * axis), 0);
    }
    return matrix;
}

/// The numbers that a property of a node has, which may be missing.
bool isGiven(const std::vector<double>& numbers, size_t count, const char* name, const SourceLocation& where) {
    if (numbers.empty()) return false;
    const bool finite = std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
    if (numbers.size() != count || !finite)
        throw InputError(where,
                         fmt::format("'{}' has {} numbers; expected {} finite ones.", name, numbers.size(), count));
    return true;
}

glm::dmat4 matrixOf(const tinygltf::Node& node, const SourceLocation& where) {
    if (isGiven(node.matrix, 16, "matrix", where)) {
        glm::dmat4 matrix;
        for (int k = 0; k < 16; ++k) matrix[k / 4][k % 4] = node.matrix[static_cast<size_t>(k)];
        const glm::dvec4 lastRow(matrix[0][3], matrix[1][3], matrix[2][3], matrix[3][3]);
        if (lastRow != glm::dvec4(0, 0, 0, 1))
            throw InputError(where, "the matrix is not affine: its last row is not 0, 0, 0, 1.");
        return matrix;
    }
    const auto triple = [&](const std::vector<double>& v) { return glm::dvec3(v[0], v[1], v[2]); };
    glm::dmat4 matrix(1);
    if (isGiven(node.translation, 3, "translation", where)) matrix = translation(triple(node.translation));
    if (isGiven(node.rotation, 4, "rotation", where))
        matrix *= rotation({triple(node.rotation), node.rotation[3]}, where);
    if (isGiven(node.scale, 3, "scale", where)) matrix *= scaling(triple(node.scale));
    return matrix;
}

/// Nodes that are nobody's children.
std::vector<int> rootsOf(const tinygltf::Model& model) {
    std::vector<bool> isChild(model.nodes.size());
    for (const tinygltf::Node& node : model.nodes)
        for (const int child : node.children)
            if (child >= 0 && static_cast<size_t>(child) < isChild.size()) isChild[static_cast<size_t>(child)] = true;
    std::vector<int> roots;
    for (size_t k = 0; k < isChild.size(); ++k)
        if (!isChild[k]) roots.push_back(static_cast<int>(k));
    if (roots.empty() && !isChild.empty()) roots.push_back(0); // a cycle, which is found then
    return roots;
}

} // namespace

const tinygltf::Scene* shownScene(const GltfContext& context) {
    const tinygltf::Model& model = context.model;
    if (model.defaultScene >= 0) return &gltfEntry(model.scenes, "scenes", model.defaultScene, context.at("scene"));
    return model.scenes.empty() ? nullptr : &model.scenes.front();
}

std::vector<PlacedNode> placeNodes(const GltfContext& context) {
    const tinygltf::Model& model = context.model;
    const tinygltf::Scene* scene = shownScene(context);
    struct Open {
        int index;
        glm::dmat4 parent;
        SourceLocation mention;
    };
    std::vector<Open> open;
    const auto add = [&](const std::vector<int>& children, const glm::dmat4& parent, const SourceLocation& mention) {
        for (size_t k = children.size(); k-- > 0;) open.push_back({children[k], parent, mention});
    };
    add(scene ? scene->nodes : rootsOf(model), glm::dmat4(1), context.at(scene ? "scenes" : "nodes"));
    std::vector<bool> isPlaced(model.nodes.size());
    std::vector<PlacedNode> placed;
    while (!open.empty()) {
        const Open next = open.back();
        open.pop_back();
        const tinygltf::Node& node = gltfEntry(model.nodes, "nodes", next.index, next.mention);
        const auto index = static_cast<size_t>(next.index);
        const SourceLocation where = context.at("nodes", index);
        if (isPlaced[index]) throw InputError(where, "the node has two parents, or is its own child; expected a tree.");
        isPlaced[index] = true;
        context.files.guard().addElement(where);
        placed.push_back({index, next.parent * matrixOf(node, where)});
        add(node.children, placed.back().toWorld, where);
    }
    return placed;
}

std::vector<glm::dmat4> placesOfMesh(const GltfContext& context, const PlacedNode& node) {
    const SourceLocation where = context.at("nodes", node.index);
    const GltfValues instancing(context.model.nodes[node.index].extensions, "EXT_mesh_gpu_instancing", where);
    if (!instancing.isGiven()) return {node.toWorld};
    const GltfValues attributes = instancing.member("attributes");
    size_t count = 0;
    const auto read = [&](const char* name, unsigned components) -> std::optional<GltfNumbers> {
        const int accessor = attributes.index(name);
        if (accessor < 0) return std::nullopt;
        GltfNumbers numbers = readAccessor(context, accessor, {components}, where);
        if (count > 0 && numbers.count != count)
            throw InputError(where, fmt::format("EXT_mesh_gpu_instancing: {} has {} elements, another attribute {}.",
                                                name, numbers.count, count));
        count = numbers.count;
        return numbers;
    };
    const auto moved = read("TRANSLATION", 3), turned = read("ROTATION", 4), scaled = read("SCALE", 3);
    std::vector<glm::dmat4> places;
    for (size_t i = 0; i < count; ++i) {
        glm::dmat4 place = node.toWorld;
        if (moved) place *= translation(moved->vector(i));
        if (turned) place *= rotation({turned->vector(i), turned->at(i, 3)}, where);
        if (scaled) place *= scaling(scaled->vector(i));
        places.push_back(place);
    }
    return places;
}

glm::dmat4 rigid(const glm::dmat4& toWorld, const SourceLocation& where) {
    const glm::dmat3 axes(toWorld);
    const glm::dvec3 z = glm::normalize(axes[2]), x = glm::normalize(axes[0] - glm::dot(axes[0], z) * z);
    const glm::dvec3 y = glm::cross(z, x);
    if (!std::isfinite(glm::dot(x, y) + glm::dot(y, z)))
        throw InputError(where, "a camera or light with a scale of 0; its axes have no direction.");
    glm::dmat4 matrix(1);
    matrix[0] = glm::dvec4(x, 0);
    matrix[1] = glm::dvec4(y, 0);
    matrix[2] = glm::dvec4(z, 0);
    matrix[3] = toWorld[3];
    return matrix;
}

} // namespace quasilux
