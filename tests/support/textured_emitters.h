// The kernels of tests/kernels/textured_emitters.cl as functions, and a picture for them.
#pragma once

#include "scene/scene.h"

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace quasilux {

/// The last emitter of a scene as the kernels have it, with its texture.
struct TexturedEmitter {
    shared::Emitter record{};
    shared::Texture texture{};
    std::vector<Rgb> texels;
    double power = 0; ///< W, mean of R, G, B, as it is chosen by
};
TexturedEmitter lastEmitter(const Scene& scene);

/// A unit vector of the frame <lookat origin="1,-2,3" target="2,0,4" up="0,0,1"/>, in the world.
glm::dvec3 askew(const glm::dvec3& local);

/// Along unit directions away from a point emitter.
std::vector<glm::dvec3> intensities(const TexturedEmitter& emitter, const std::vector<glm::dvec3>& directions);

struct DirectedPhoton {
    glm::dvec3 direction, flux;
    glm::dvec2 found; ///< numbers that make it, by emitterInvertEmission
};
/// Two numbers a photon.
std::vector<DirectedPhoton> directedPhotons(const TexturedEmitter& emitter, const std::vector<float>& numbers);

/// A file of floats, three a pixel.
void writeFloats(const std::string& path, int width, int height, const std::vector<float>& rgb);
/// Writes three by two pixels of floats, pixel k of the colour (0.1 k, 0.5 k, 2 - 0.3 k): values below and above 1.
void writeSixPixels(const std::string& path);

} // namespace quasilux
