// Numbers out of the buffers of a glTF file, every one within bounds.
#pragma once

#include "scene/gltf/gltf_context.h"

#include <array>
#include <glm/glm.hpp>
#include <optional>

namespace quasilux {

/// Of `count` elements, each of so many components, one after the other.
struct GltfNumbers {
    size_t count = 0;
    unsigned components = 0;
    std::vector<double> values; ///< finite

    double at(size_t element, unsigned component) const { return values[element * components + component]; }
    glm::dvec3 vector(size_t element) const { return {at(element, 0), at(element, 1), at(element, 2)}; }
};

/// An accessor of one of these numbers of components; integers that are `normalized` become shares. `where` mentions
/// it. Throws InputError.
GltfNumbers readAccessor(const GltfContext& context, int accessor, std::initializer_list<unsigned> components,
                         const SourceLocation& where);

/// An accessor of whole numbers below `end`. Throws InputError.
std::vector<uint32_t> readIndices(const GltfContext& context, int accessor, size_t end, const SourceLocation& where);

/// The bytes that a buffer view stands for. Throws InputError.
struct GltfBytes {
    const unsigned char* data = nullptr;
    size_t size = 0, stride = 0; ///< stride 0: elements follow each other
};
GltfBytes bytesOfView(const GltfContext& context, int view, const SourceLocation& where);

} // namespace quasilux
