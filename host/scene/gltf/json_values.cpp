#include "scene/gltf/json_values.h"

#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace quasilux {

namespace {

const tinygltf::Value* extensionOf(const tinygltf::ExtensionMap& extensions, const std::string& name) {
    const auto found = extensions.find(name);
    return found == extensions.end() ? nullptr : &found->second;
}

} // namespace

GltfValues::GltfValues(const tinygltf::ExtensionMap& extensions, const std::string& name, SourceLocation where)
    : GltfValues(extensionOf(extensions, name), std::move(where)) {}

GltfValues::GltfValues(const tinygltf::Value* object, SourceLocation where)
    : object_(object), where_(std::move(where)) {
    if (object_ && !object_->IsObject()) throw InputError(where_, "expected a JSON object.");
}

const tinygltf::Value* GltfValues::find(const std::string& name) const {
    return object_ && object_->Has(name) ? &object_->Get(name) : nullptr;
}

double GltfValues::number(const std::string& name, double missing) const {
    const tinygltf::Value* value = find(name);
    if (!value) return missing;
    const double number = value->IsNumber() ? value->GetNumberAsDouble() : NAN;
    if (!std::isfinite(number)) throw InputError(where_, fmt::format("'{}' is no finite number.", name));
    return number;
}

double GltfValues::numberWithin(const std::string& name, double missing, double least, double most) const {
    const double value = number(name, missing);
    if (value < least || value > most)
        throw InputError(where_, fmt::format("'{}' is {}; expected {} to {}.", name, value, least, most));
    return value;
}

int GltfValues::index(const std::string& name) const {
    const tinygltf::Value* value = find(name);
    if (!value) return -1;
    if (!value->IsInt() || value->GetNumberAsInt() < 0)
        throw InputError(where_, fmt::format("'{}' is no index.", name));
    return value->GetNumberAsInt();
}

std::string GltfValues::text(const std::string& name) const {
    const tinygltf::Value* value = find(name);
    if (!value) return {};
    if (!value->IsString()) throw InputError(where_, fmt::format("'{}' is no text.", name));
    return value->Get<std::string>();
}

std::vector<double> GltfValues::numbers(const std::string& name, size_t count) const {
    const tinygltf::Value* value = find(name);
    if (!value) return {};
    std::vector<double> numbers;
    for (size_t k = 0; k < value->ArrayLen(); ++k) {
        const tinygltf::Value& entry = value->Get(static_cast<int>(k));
        if (entry.IsNumber() && std::isfinite(entry.GetNumberAsDouble())) numbers.push_back(entry.GetNumberAsDouble());
    }
    if (numbers.size() != count || value->ArrayLen() != count)
        throw InputError(where_, fmt::format("'{}' is not an array of {} finite numbers.", name, count));
    return numbers;
}

glm::dvec2 GltfValues::pair(const std::string& name, const glm::dvec2& missing) const {
    const std::vector<double> two = numbers(name, 2);
    return two.empty() ? missing : glm::dvec2(two[0], two[1]);
}

glm::dvec3 GltfValues::triple(const std::string& name, const glm::dvec3& missing) const {
    const std::vector<double> three = numbers(name, 3);
    return three.empty() ? missing : glm::dvec3(three[0], three[1], three[2]);
}

GltfValues GltfValues::member(const std::string& name) const {
    return {find(name), {fmt::format("{}.{}", where_.file, name)}};
}

tinygltf::TextureInfo GltfValues::texture(const std::string& name) const {
    tinygltf::TextureInfo texture;
    const GltfValues members = member(name);
    if (!members.isGiven()) return texture;
    texture.index = members.index("index");
    if (texture.index < 0) throw InputError(where_, fmt::format("'{}' has no index of a texture.", name));
    texture.texCoord = std::max(members.index("texCoord"), 0);
    if (const tinygltf::Value* extensions = members.find("extensions"))
        for (const std::string& key : extensions->Keys()) texture.extensions[key] = extensions->Get(key);
    return texture;
}

} // namespace quasilux
