#include "scene/gltf/meshes.h"

#include "scene/gltf/accessors.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace quasilux {

namespace {

int attributeOf(const std::map<std::string, int>& attributes, const std::string& name) {
    const auto found = attributes.find(name);
    return found == attributes.end() ? -1 : found->second;
}

/// Of one value for each vertex. Throws InputError for another number of them.
GltfNumbers readAttribute(const GltfContext& context, int accessor, std::initializer_list<unsigned> components,
                          size_t vertices, const std::string& name, const SourceLocation& where) {
    GltfNumbers numbers = readAccessor(context, accessor, components, where);
    if (vertices > 0 && numbers.count != vertices)
        throw InputError(where, fmt::format("{} has {} elements, but POSITION has {}.", name, numbers.count, vertices));
    return numbers;
}

/// Adds the morph targets' displacements, by their weights.
void addTargets(const GltfContext& context, const tinygltf::Primitive& primitive, const PrimitiveUse& use,
                const std::string& name, std::vector<glm::dvec3>& vectors) {
    for (size_t t = 0; t < std::min(primitive.targets.size(), use.morphWeights.size()); ++t) {
        const int accessor = attributeOf(primitive.targets[t], name);
        if (use.morphWeights[t] == 0 || accessor < 0) continue;
        const GltfNumbers target = readAttribute(context, accessor, {3}, vectors.size(), name, use.where);
        for (size_t i = 0; i < vectors.size(); ++i) vectors[i] += use.morphWeights[t] * target.vector(i);
    }
}

std::vector<glm::dvec3> vectorsOf(const GltfNumbers& numbers) {
    std::vector<glm::dvec3> vectors;
    vectors.reserve(numbers.count);
    for (size_t i = 0; i < numbers.count; ++i) vectors.push_back(numbers.vector(i));
    return vectors;
}

/// Corners of the triangles by section 3.7.2.1 of the specification.
std::vector<std::array<uint32_t, 3>> trianglesOf(const std::vector<uint32_t>& v, int mode) {
    std::vector<std::array<uint32_t, 3>> triangles;
    if (mode == TINYGLTF_MODE_TRIANGLES)
        for (size_t i = 0; i + 2 < v.size(); i += 3) triangles.push_back({v[i], v[i + 1], v[i + 2]});
    else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP)
        for (size_t i = 0; i + 2 < v.size(); ++i) triangles.push_back({v[i], v[i + 1 + i % 2], v[i + 2 - i % 2]});
    else
        for (size_t i = 1; i + 1 < v.size(); ++i) triangles.push_back({v[i], v[i + 1], v[0]});
    return triangles;
}

MeshAttribute newAttribute(const std::string& name, unsigned channels) {
    MeshAttribute attribute;
    attribute.name = name;
    attribute.channels = channels;
    return attribute;
}

void readColors(const GltfContext& context, const tinygltf::Primitive& primitive, const PrimitiveUse& use,
                MeshSource& mesh) {
    const GltfNumbers colors = readAttribute(context, attributeOf(primitive.attributes, "COLOR_0"), {3, 4},
                                             mesh.positions.size(), "COLOR_0", use.where);
    MeshAttribute color = newAttribute("vertex_color", 3), alpha = newAttribute("vertex_alpha", 1);
    for (size_t i = 0; i < colors.count; ++i) {
        const auto share = [&](unsigned c) {
            return static_cast<float>(std::clamp(colors.at(i, c) * use.colorFactor[static_cast<int>(c)], 0.0, 1.0));
        };
        color.values.push_back({share(0), share(1), share(2)});
        const float opacity = colors.components == 4 ? share(3) : static_cast<float>(use.colorFactor.w);
        alpha.values.push_back({opacity, opacity, opacity});
    }
    if (use.needsRoots) {
        mesh.attributes.push_back(newAttribute("vertex_color_root", 3));
        for (const Rgb& c : color.values)
            mesh.attributes.back().values.push_back({std::sqrt(c.r), std::sqrt(c.g), std::sqrt(c.b)});
    }
    mesh.attributes.push_back(std::move(color));
    mesh.attributes.push_back(std::move(alpha));
}

void readUvs(GltfContext& context, const tinygltf::Primitive& primitive, const PrimitiveUse& use, MeshSource& mesh) {
    const std::string name = fmt::format("TEXCOORD_{}", use.texCoord);
    const int accessor = attributeOf(primitive.attributes, name);
    if (accessor < 0) return;
    const GltfNumbers uvs = readAttribute(context, accessor, {2}, mesh.positions.size(), name, use.where);
    mesh.uvs.reserve(uvs.count);
    for (size_t i = 0; i < uvs.count; ++i) mesh.uvs.emplace_back(uvs.at(i, 0), uvs.at(i, 1));
}

std::vector<uint32_t> cornersOf(const GltfContext& context, const tinygltf::Primitive& primitive, size_t vertices,
                                const SourceLocation& where) {
    if (primitive.indices >= 0) return readIndices(context, primitive.indices, vertices, where);
    std::vector<uint32_t> all(vertices);
    std::iota(all.begin(), all.end(), 0u);
    return all;
}

} // namespace

bool hasVertexColors(const tinygltf::Primitive& primitive) { return primitive.attributes.count("COLOR_0") > 0; }

bool hasVertexAlpha(const GltfContext& context, const tinygltf::Primitive& primitive) {
    const int accessor = attributeOf(primitive.attributes, "COLOR_0");
    return accessor >= 0 && accessor < static_cast<int>(context.model.accessors.size()) &&
           context.model.accessors[static_cast<size_t>(accessor)].type == TINYGLTF_TYPE_VEC4;
}

bool hasNormals(const tinygltf::Primitive& primitive) { return primitive.attributes.count("NORMAL") > 0; }

std::shared_ptr<const MeshSource> readPrimitive(GltfContext& context, const tinygltf::Primitive& primitive,
                                                const PrimitiveUse& use) {
    const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    if (mode > TINYGLTF_MODE_TRIANGLE_FAN)
        throw InputError(use.where, fmt::format("unknown mode {}; expected 0 to 6.", mode));
    if (mode < TINYGLTF_MODE_TRIANGLES) {
        context.withoutEffect.insert("points and lines");
        return nullptr;
    }
    const int positions = attributeOf(primitive.attributes, "POSITION");
    if (positions < 0) {
        context.withoutEffect.insert("primitives without POSITION");
        return nullptr;
    }
    // Where --lenient forgives that an extension is required: what it compresses has no buffer.
    const tinygltf::Accessor& stored = gltfEntry(context.model.accessors, "accessors", positions, use.where);
    if (stored.bufferView < 0 && !stored.sparse.isSparse) {
        context.withoutEffect.insert("primitives whose POSITION has no buffer");
        return nullptr;
    }
    MeshSource mesh;
    mesh.positions = vectorsOf(readAttribute(context, positions, {3}, 0, "POSITION", use.where));
    const size_t vertices = mesh.positions.size();
    addTargets(context, primitive, use, "POSITION", mesh.positions);
    if (hasNormals(primitive)) {
        mesh.normals = vectorsOf(
            readAttribute(context, attributeOf(primitive.attributes, "NORMAL"), {3}, vertices, "NORMAL", use.where));
        addTargets(context, primitive, use, "NORMAL", mesh.normals);
    }
    readUvs(context, primitive, use, mesh);
    if (hasVertexColors(primitive)) readColors(context, primitive, use, mesh);
    const auto corner = [&](uint32_t index) {
        MeshSource::Corner made;
        made.position = index;
        made.vertex = index;
        if (!mesh.normals.empty()) made.normal = index;
        if (!mesh.uvs.empty()) made.uv = index;
        return made;
    };
    for (const auto& [a, b, c] : trianglesOf(cornersOf(context, primitive, vertices, use.where), mode))
        mesh.triangles.push_back({corner(a), corner(b), corner(c)});
    if (mesh.triangles.empty()) return nullptr;
    return std::make_shared<const MeshSource>(std::move(mesh));
}

} // namespace quasilux
