// The meshes of nodes as <shape type="mesh">, with their materials.
#pragma once

#include "scene/gltf/bsdf_elements.h"
#include "scene/gltf/meshes.h"
#include "scene/gltf/nodes.h"

#include <map>
#include <utility>

namespace quasilux {

class GltfShapes {
public:
    GltfShapes(GltfContext& context, Element& scene) : context_(context), scene_(scene), textures_(context, scene) {}

    /// The mesh of the node, if it has one. Throws InputError.
    void add(const PlacedNode& node);

    bool emits() const { return emits_; }
    bool isEmpty() const { return lower_.x > upper_.x; }
    /// Corners of the box about all of them.
    glm::dvec3 lower() const { return lower_; }
    glm::dvec3 upper() const { return upper_; }

private:
    /// What a material became at such primitives.
    struct Made {
        std::string bsdf, medium; ///< ids; no medium: empty
        std::optional<GltfParameter> emission;
        int texCoord = 0;
        glm::dvec4 colorFactor{1};
        bool needsRoots = false; ///< of vertex colours
    };
    const Made& materialOf(const tinygltf::Primitive& primitive, const SourceLocation& where);
    Made makeMaterial(const GltfMaterial& material, const PrimitiveSurface& primitive, int texCoord);
    std::optional<GltfParameter> emissionOf(const GltfMaterial& material, bool hasUvs);
    int texCoordOf(const GltfMaterial& material);
    std::string meshOf(std::string name, const tinygltf::Primitive& primitive, const Made& material,
                       const std::vector<double>& weights, const SourceLocation& where);
    void addShape(const std::string& mesh, const tinygltf::Primitive& primitive, const Made& material,
                  const std::string& name, const glm::dmat4& toWorld, const SourceLocation& where);
    void enlargeBox(const MeshSource& mesh, const glm::dmat4& toWorld);

    GltfContext& context_;
    Element& scene_;
    GltfTextures textures_;
    std::map<std::pair<int, PrimitiveSurface>, Made> materials_;
    bool emits_ = false;
    glm::dvec3 lower_{std::numeric_limits<double>::max()}, upper_{-std::numeric_limits<double>::max()};
};

} // namespace quasilux
