// Scenes that can be put anywhere, turned, and made in any size, for tests that nothing of it changes the image.
#pragma once

#include "scene/scene.h"

#include <string>

namespace quasilux {

struct Placement {
    const char* name = "Ordinary";
    double scale = 1;
    const char* offset = "0,0,0"; ///< scene units
    bool turned = false;          ///< out of the axes
};

/// The scene of this text, whose shapes, points and (orthographic) sensor all have a `to_world`: there the placement is
/// appended. Numbers of the form `1/L:x` are per length and become x / scale.
Scene placedScene(const std::string& text, const Placement& placement);

/// Orthographic sensor that sees [-window, window]^2 at `target` (coordinates as x,y,z) and its square film.
std::string orthographicSensor(const std::string& origin, const std::string& target, double window,
                               unsigned resolution);

/// A closed room with a lamp, a glossy and a glass ball, and a block of turbid glass; radiances of the order of 1.
/// `extra` is added to it.
std::string roomText(const std::string& ballBsdf, const std::string& extra = "");

/// Moves everything in single precision, as a renderer does that takes coordinates as they are.
void moveInSinglePrecision(Scene& scene, const glm::vec3& offset);

} // namespace quasilux
