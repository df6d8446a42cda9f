// <emitter type="envmap">: radiance from outside of the scene by an image of latitude and longitude.
#include "scene/emitters/emitters.h"
#include "scene/textures/texture_plugin.h"
#include "scene/transform.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

// Sums of probabilities are multiples of 2^-24, and each pixel of a row or column is to have some
// (host/prepare/environment.cpp).
constexpr unsigned longestSide = 32768;
// Of a matrix from a turn or a mirroring: digits that a file leaves out.
constexpr double looseness = 1e-3;

} // namespace

glm::dmat3 axesOfSurroundings(Properties& properties) {
    glm::dmat3 given(properties.transform("to_world"));
    const double scale = glm::length(given[0]); // of what is infinitely far away it changes nothing
    if (scale > 0) given /= scale;
    if (!keepsAngles(given, 1, looseness))
        throw InputError(properties.where("to_world"),
                         fmt::format("the to_world of an emitter '{}' may turn, mirror and scale it alike in all "
                                     "directions, not shear it: the surroundings are infinitely far away.",
                                     properties.plugin()));
    const glm::dvec3 x = glm::normalize(given[0]), y = glm::normalize(given[1] - glm::dot(given[1], x) * x);
    const glm::dvec3 z = glm::cross(x, y);
    return {x, y, glm::dot(z, given[2]) < 0 ? -z : z};
}

SceneEmitter readEnvmap(Properties& properties) {
    Surroundings surroundings = newSurroundings(properties);
    const std::string name = properties.string("filename", "");
    const SourceLocation where = properties.where("filename");
    if (name.empty())
        throw InputError(where,
                         fmt::format("{} needs <string name=\"filename\" value=\"…\"/>.", properties.describe()));
    const auto scale = static_cast<float>(properties.numberAbove("scale", 1, 0, false));
    properties.accept({"mis_compensation"});
    EnvironmentImage image;
    image.axes = axesOfSurroundings(properties);

    const std::string path = properties.context().files.resolve(name, where);
    const Image read = readImage(path, false, TextureUse::emission, where, properties.context().files.guard());
    if (read.height < 2 || std::max(read.width, read.height) > longestSide)
        throw InputError(where,
                         fmt::format("the image '{}' has {} x {} pixels; an environment map has at least two rows, "
                                     "and at most {} pixels on a side.",
                                     path, read.width, read.height, longestSide));
    if (read.clamped > 0)
        properties.context().warn(where, fmt::format("{} of the {} pixels of '{}' are negative and are taken as 0.",
                                                     read.clamped, read.pixels.size(), name));
    image.pixels = read.pixels;
    bool isBlack = true;
    for (Rgb& pixel : image.pixels) {
        pixel = pixel * scale;
        isBlack = isBlack && quasilux::isBlack(pixel);
    }
    if (isBlack) return surroundings; // off, as surroundings without an image and radiance
    image.width = read.width;
    image.height = read.height;
    surroundings.image = std::move(image);
    return surroundings;
}

} // namespace quasilux
