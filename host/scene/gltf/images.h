// Images of glTF files, PNG or JPEG, as the scene language takes them: one for each meaning of their channels.
#pragma once

#include "scene/gltf/gltf_context.h"

#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <memory>

namespace quasilux {

/// How a pixel is read: colours are sRGB encoded, everything else is linear (section 3.8.3 of the specification). Alpha
/// is linear.
enum class PixelCode { srgb, linear };

/// What becomes of a pixel, red, green, blue, alpha.
using PixelChange = std::function<glm::dvec3(const glm::dvec4&)>;

/// What an image became: the name of one in EmbeddedParts, or a value where it is the same everywhere.
struct MadeImage {
    std::string name; ///< empty: `value` everywhere
    glm::dvec3 value{};
    bool isConstant() const { return name.empty(); }
};

class GltfImages {
public:
    explicit GltfImages(GltfContext& context) : context_(context) {}

    /// The image with all pixels changed. `meaning` tells changes apart, so that each is made once. Throws InputError.
    MadeImage make(int image, PixelCode code, const std::string& meaning, const PixelChange& change);

private:
    struct Pixels {
        unsigned width = 0, height = 0;
        std::vector<glm::vec4> values; ///< as they are stored, from 0 to 1
    };
    const Pixels& pixelsOf(int image);

    GltfContext& context_;
    int lastIndex_ = -1; ///< of `last_`, as the meanings of an image are mostly asked for one after the other
    Pixels last_;
    std::map<std::string, MadeImage> made_;
};

} // namespace quasilux
