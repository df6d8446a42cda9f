#include "scene/gltf/accessors.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

namespace quasilux {

namespace {

// Elements that no buffer holds: they are zero, or given by a sparse part.
constexpr size_t mostWithoutBuffer = 1 << 24;

size_t bytesOf(int componentType, const SourceLocation& where) {
    switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return 4;
    default:
        throw InputError(where,
                         fmt::format("unknown componentType {}; expected 5120 to 5123, 5125 or 5126.", componentType));
    }
}

template <typename Number>
Number load(const unsigned char* bytes) {
    Number number;
    std::memcpy(&number, bytes, sizeof(number));
    return number;
}

/// Of integers that are shares the value by section 3.6.2.2 of the specification.
template <typename Integer>
double share(Integer number, bool normalized) {
    if (!normalized) return number;
    return std::max(double(number) / std::numeric_limits<Integer>::max(), -1.0);
}

double numberAt(const unsigned char* bytes, int componentType, bool normalized) {
    switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return share(load<int8_t>(bytes), normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return share(load<uint8_t>(bytes), normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return share(load<int16_t>(bytes), normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return share(load<uint16_t>(bytes), normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return share(load<uint32_t>(bytes), normalized);
    default:
        return double(load<float>(bytes));
    }
}

unsigned componentsOf(int type) {
    switch (type) {
    case TINYGLTF_TYPE_SCALAR:
        return 1;
    case TINYGLTF_TYPE_VEC2:
        return 2;
    case TINYGLTF_TYPE_VEC3:
        return 3;
    case TINYGLTF_TYPE_VEC4:
        return 4;
    default:
        return 0;
    }
}

/// `count` elements of `size` bytes that begin `offset` bytes after the start of the view.
GltfBytes elementsOf(const GltfContext& context, int view, size_t offset, size_t count, size_t size,
                     const SourceLocation& where) {
    GltfBytes bytes = bytesOfView(context, view, where);
    const size_t stride = bytes.stride == 0 ? size : bytes.stride;
    const bool fits = offset <= bytes.size && size <= bytes.size - offset &&
                      (count - 1) <= (bytes.size - offset - size) / stride && stride >= size;
    if (!fits)
        throw InputError(where,
                         fmt::format("{} elements of {} bytes, {} from each to the next, from byte {} on, reach beyond "
                                     "bufferViews[{}] of {} bytes.",
                                     count, size, stride, offset, view, bytes.size));
    return {bytes.data + offset, bytes.size - offset, stride};
}

/// Those of its buffer.
void readDense(const GltfBytes& bytes, const tinygltf::Accessor& accessor, GltfNumbers& numbers,
               const SourceLocation& where) {
    const size_t each = bytesOf(accessor.componentType, where);
    for (size_t i = 0; i < numbers.count; ++i)
        for (unsigned c = 0; c < numbers.components; ++c)
            numbers.values[i * numbers.components + c] =
                numberAt(bytes.data + i * bytes.stride + c * each, accessor.componentType, accessor.normalized);
}

/// Elements that stand in for others.
void applySparse(const GltfContext& context, const tinygltf::Accessor& accessor, GltfNumbers& numbers,
                 const SourceLocation& where) {
    const auto& sparse = accessor.sparse;
    if (sparse.count < 1 || static_cast<size_t>(sparse.count) > numbers.count)
        throw InputError(where, fmt::format("sparse.count is {}; expected 1 to {}.", sparse.count, numbers.count));
    if (sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
        throw InputError(where, "sparse: a byteOffset below 0.");
    const auto count = static_cast<size_t>(sparse.count);
    const size_t each = bytesOf(accessor.componentType, where),
                 indexSize = bytesOf(sparse.indices.componentType, where);
    const GltfBytes indices = elementsOf(context, sparse.indices.bufferView,
                                         static_cast<size_t>(sparse.indices.byteOffset), count, indexSize, where);
    const GltfBytes values =
        elementsOf(context, sparse.values.bufferView, static_cast<size_t>(sparse.values.byteOffset), count,
                   each * numbers.components, where);
    for (size_t k = 0; k < count; ++k) {
        const double index = numberAt(indices.data + k * indices.stride, sparse.indices.componentType, false);
        if (!(index >= 0 && index < double(numbers.count) && index == std::floor(index)))
            throw InputError(where, fmt::format("sparse: index {} does not exist; the accessor has {} elements.", index,
                                                numbers.count));
        for (unsigned c = 0; c < numbers.components; ++c)
            numbers.values[static_cast<size_t>(index) * numbers.components + c] =
                numberAt(values.data + k * values.stride + c * each, accessor.componentType, accessor.normalized);
    }
}

} // namespace

GltfBytes bytesOfView(const GltfContext& context, int view, const SourceLocation& where) {
    const tinygltf::BufferView& description = gltfEntry(context.model.bufferViews, "bufferViews", view, where);
    const SourceLocation place = context.at("bufferViews", static_cast<size_t>(view));
    const tinygltf::Buffer& buffer = gltfEntry(context.model.buffers, "buffers", description.buffer, place);
    const size_t size = buffer.data.size();
    if (description.byteOffset > size || description.byteLength > size - description.byteOffset)
        throw InputError(place, fmt::format("{} bytes from byte {} on reach beyond buffers[{}], which has {}.",
                                            description.byteLength, description.byteOffset, description.buffer, size));
    return {buffer.data.data() + description.byteOffset, description.byteLength, description.byteStride};
}

GltfNumbers readAccessor(const GltfContext& context, int index, std::initializer_list<unsigned> components,
                         const SourceLocation& where) {
    const tinygltf::Accessor& accessor = gltfEntry(context.model.accessors, "accessors", index, where);
    const SourceLocation place = context.at("accessors", static_cast<size_t>(index));
    context.files.guard().note(place);
    GltfNumbers numbers;
    numbers.count = accessor.count;
    numbers.components = componentsOf(accessor.type);
    if (std::find(components.begin(), components.end(), numbers.components) == components.end())
        throw InputError(place, fmt::format("elements of {} numbers, but {} asks for {}.", numbers.components,
                                            where.text(), fmt::join(components.begin(), components.end(), " or ")));
    if (numbers.count < 1) throw InputError(place, "count is 0; expected at least one element.");
    if (accessor.bufferView < 0 && numbers.count > mostWithoutBuffer)
        throw InputError(place, fmt::format("{} elements without a bufferView; expected at most {}.", numbers.count,
                                            mostWithoutBuffer));
    std::optional<GltfBytes> dense; // known to be there before memory is taken for them
    if (accessor.bufferView >= 0)
        dense = elementsOf(context, accessor.bufferView, accessor.byteOffset, numbers.count,
                           bytesOf(accessor.componentType, place) * numbers.components, place);
    numbers.values.resize(numbers.count * numbers.components);
    if (dense) readDense(*dense, accessor, numbers, place);
    if (accessor.sparse.isSparse) applySparse(context, accessor, numbers, place);
    for (size_t k = 0; k < numbers.values.size(); ++k)
        if (!std::isfinite(numbers.values[k]))
            throw InputError(place, fmt::format("element {} is not made of finite numbers.", k / numbers.components));
    return numbers;
}

std::vector<uint32_t> readIndices(const GltfContext& context, int index, size_t end, const SourceLocation& where) {
    const GltfNumbers numbers = readAccessor(context, index, {1}, where);
    std::vector<uint32_t> indices;
    indices.reserve(numbers.count);
    for (size_t k = 0; k < numbers.count; ++k) {
        const double value = numbers.values[k];
        if (!(value >= 0 && value < double(end)) || value != std::floor(value))
            throw InputError(context.at("accessors", static_cast<size_t>(index)),
                             fmt::format("index {} at place {} does not exist; there are {} vertices.", value, k, end));
        indices.push_back(static_cast<uint32_t>(value));
    }
    return indices;
}

} // namespace quasilux
