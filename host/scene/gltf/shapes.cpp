#include "scene/gltf/shapes.h"

#include "scene/gltf/elements.h"
#include "scene/transform.h"

#include <algorithm>

namespace quasilux {

namespace {

double areaOf(const MeshSource& mesh, const glm::dmat4& toWorld) {
    double area = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const glm::dvec3& first = mesh.positions[a.position];
        const glm::dvec3 u = transformVector(toWorld, mesh.positions[b.position] - first),
                         v = transformVector(toWorld, mesh.positions[c.position] - first);
        area += glm::length(glm::cross(u, v)) / 2;
    }
    return area;
}

/// An attribute that all meshes with colours have.
Element attributeTexture(const char* id, const char* attribute, const SourceLocation& where) {
    Element texture = newObject("texture", "mesh_attribute", id, where);
    addText(texture, "name", attribute);
    return texture;
}

std::vector<double> morphWeights(const tinygltf::Node& node, const tinygltf::Mesh& mesh) {
    return node.weights.empty() ? mesh.weights : node.weights;
}

bool isRegular(const glm::dmat4& toWorld) {
    const glm::dmat3 axes(toWorld);
    const double scale = std::max({glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2])});
    return std::abs(glm::determinant(axes)) > 1e-9 * scale * scale * scale && std::isfinite(scale);
}

} // namespace

int GltfShapes::texCoordOf(const GltfMaterial& material) {
    std::optional<int> first;
    for (const tinygltf::TextureInfo* texture : material.textures()) {
        const int set = GltfTextures::texCoordOf(*texture, material.where);
        if (!first) first = set;
        if (set != *first) context_.withoutEffect.insert("a second set of texture coordinates of a material");
    }
    return first.value_or(0);
}

std::optional<GltfParameter> GltfShapes::emissionOf(const GltfMaterial& material, bool hasUvs) {
    GltfParameter emission{material.emission, {}};
    const glm::dvec3 factor = material.emission;
    if (material.emissiveTexture.index >= 0 && hasUvs && factor != glm::dvec3(0))
        emission = textures_.make(
            material.emissiveTexture, PixelCode::srgb,
            fmt::format("emission {:.6g},{:.6g},{:.6g}", factor.x, factor.y, factor.z),
            [=](const glm::dvec4& pixel) { return glm::dvec3(pixel) * factor; }, material.where);
    if (!emission.isTextured() && emission.value == glm::dvec3(0)) return std::nullopt;
    return emission;
}

GltfShapes::Made GltfShapes::makeMaterial(const GltfMaterial& material, const PrimitiveSurface& primitive,
                                          int texCoord) {
    Made made;
    made.texCoord = texCoord;
    made.colorFactor = material.baseColor;
    const GltfSurface surface = surfaceOf(material, primitive, context_, textures_);
    const auto addOnce = [&](const GltfParameter& parameter, const char* id, const char* attribute) {
        if (parameter.texture == id && context_.ids.insert(id).second)
            scene_.children.push_back(attributeTexture(id, attribute, material.where));
    };
    addOnce(surface.base, vertexColorId, "vertex_color");
    addOnce(surface.transmitted, vertexRootId, "vertex_color_root");
    made.needsRoots = surface.transmitted.texture == vertexRootId;
    addOnce(surface.opacity, vertexAlphaId, "vertex_alpha");
    made.bsdf = context_.newId(material.name, "material");
    scene_.children.push_back(bsdfOf(material, surface, made.bsdf));
    const std::string inside = material.name + " inside";
    if (std::optional<Element> medium = mediumOf(material, "")) {
        made.medium = context_.newId(inside, "");
        medium->attributes.push_back({"id", made.medium});
        scene_.children.push_back(std::move(*medium));
    }
    made.emission = emissionOf(material, primitive.hasUvs);
    if (made.emission && material.doubleSided)
        context_.withoutEffect.insert(
            "the backs of doubleSided materials that emit, which shine from their front alone");
    return made;
}

const GltfShapes::Made& GltfShapes::materialOf(const tinygltf::Primitive& primitive, const SourceLocation& where) {
    const GltfMaterial material = readGltfMaterial(context_, primitive.material, where);
    const int texCoord = texCoordOf(material);
    const PrimitiveSurface surface{primitive.attributes.count(fmt::format("TEXCOORD_{}", texCoord)) > 0,
                                   hasVertexColors(primitive), hasVertexAlpha(context_, primitive)};
    if (!surface.hasUvs && !material.textures().empty())
        context_.withoutEffect.insert("textures of primitives without texture coordinates");
    const auto [entry, isNew] = materials_.try_emplace({primitive.material, surface});
    if (isNew) entry->second = makeMaterial(material, surface, texCoord);
    return entry->second;
}

std::string GltfShapes::meshOf(std::string name, const tinygltf::Primitive& primitive, const Made& material,
                               const std::vector<double>& weights, const SourceLocation& where) {
    if (!primitive.targets.empty() && !weights.empty()) name += fmt::format(" {}", fmt::join(weights, ","));
    const auto [entry, isNew] = context_.parts.meshes.try_emplace(name);
    if (isNew)
        entry->second = readPrimitive(context_, primitive,
                                      {material.texCoord, material.colorFactor, material.needsRoots, weights, where});
    return entry->second ? name : std::string();
}

void GltfShapes::enlargeBox(const MeshSource& mesh, const glm::dmat4& toWorld) {
    for (const glm::dvec3& position : mesh.positions) {
        const glm::dvec3 place = transformPoint(toWorld, position);
        lower_ = glm::min(lower_, place);
        upper_ = glm::max(upper_, place);
    }
}

void GltfShapes::addShape(const std::string& mesh, const tinygltf::Primitive& primitive, const Made& material,
                          const std::string& name, const glm::dmat4& toWorld, const SourceLocation& where) {
    context_.files.guard().addElement(where);
    const MeshSource& source = *context_.parts.meshes.at(mesh);
    Element shape = newObject("shape", "mesh", context_.newId(name, "shape"), where);
    addText(shape, "name", mesh);
    const bool isFlat = !hasNormals(primitive);
    if (isFlat) addFlag(shape, "face_normals", true);
    // The front is where the corners run counter-clockwise before a mirror (section 3.7.4 of the specification).
    // Normals say it themselves.
    if (isFlat && glm::determinant(glm::dmat3(toWorld)) < 0) addFlag(shape, "flip_normals", true);
    if (toWorld != glm::dmat4(1)) addMatrix(shape, "to_world", toWorld);
    addReference(shape, "", material.bsdf);
    if (!material.medium.empty()) addReference(shape, "interior", material.medium);
    if (material.emission && areaOf(source, toWorld) > 0) {
        Element emitter = newObject("emitter", "area", "", where);
        if (material.emission->isTextured())
            addReference(emitter, "radiance", material.emission->texture);
        else
            addColor(emitter, "radiance", material.emission->value);
        addNested(shape, "", std::move(emitter));
        emits_ = true;
    }
    enlargeBox(source, toWorld);
    scene_.children.push_back(std::move(shape));
}

void GltfShapes::add(const PlacedNode& placed) {
    const tinygltf::Node& node = context_.model.nodes[placed.index];
    const SourceLocation where = context_.at("nodes", placed.index);
    if (node.mesh < 0) return;
    const tinygltf::Mesh& mesh = gltfEntry(context_.model.meshes, "meshes", node.mesh, where);
    if (node.skin >= 0) context_.withoutEffect.insert("skins");
    const std::vector<glm::dmat4> places = placesOfMesh(context_, placed);
    for (size_t p = 0; p < mesh.primitives.size(); ++p) {
        const tinygltf::Primitive& primitive = mesh.primitives[p];
        const std::string number = fmt::format("meshes[{}].primitives[{}]", node.mesh, p);
        const SourceLocation place = context_.at(number);
        const Made material = materialOf(primitive, place);
        const std::string name = meshOf(number, primitive, material, morphWeights(node, mesh), place);
        if (name.empty()) continue;
        for (const glm::dmat4& toWorld : places) {
            if (isRegular(toWorld))
                addShape(name, primitive, material, node.name.empty() ? mesh.name : node.name, toWorld, where);
            else
                context_.withoutEffect.insert("nodes with a scale of 0");
        }
    }
}

} // namespace quasilux
