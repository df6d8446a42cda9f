// Values of extensions and extras, which tinygltf leaves as JSON.
#pragma once

#include "util/error.h"

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <tiny_gltf.h>

namespace quasilux {

/// The members of an object of an extension, or of extras. All functions throw InputError at `where` for a value of
/// another kind.
class GltfValues {
public:
    /// The extension of that name, or nothing: everything is missing then.
    GltfValues(const tinygltf::ExtensionMap& extensions, const std::string& name, SourceLocation where);
    GltfValues(const tinygltf::Value* object, SourceLocation where);

    bool isGiven() const { return object_ != nullptr; }
    const tinygltf::Value* find(const std::string& name) const;
    double number(const std::string& name, double missing) const;
    double numberWithin(const std::string& name, double missing, double least, double most) const;
    int index(const std::string& name) const; ///< -1 where it is missing
    std::string text(const std::string& name) const;
    glm::dvec2 pair(const std::string& name, const glm::dvec2& missing) const;
    glm::dvec3 triple(const std::string& name, const glm::dvec3& missing) const;
    GltfValues member(const std::string& name) const;
    /// A texture: its index -1 where it is missing.
    tinygltf::TextureInfo texture(const std::string& name) const;

private:
    std::vector<double> numbers(const std::string& name, size_t count) const;

    const tinygltf::Value* object_;
    SourceLocation where_;
};

} // namespace quasilux
