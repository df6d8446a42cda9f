// `quasilux render` of one scene: its file in, images and statistics out.
#pragma once

#include "cli/options.h"

#include <functional>

namespace quasilux {

/// What is around the render of a scene, where others are rendered too, or this one again.
struct RenderSurroundings {
    std::string label; ///< goes before what the progress line says
    bool drawsProgress = true;
    std::function<bool()> isOutdated; ///< whether the scene has changed, so that the render is given up
};

/// Of a render that was given up, with nothing written, as its scene had changed; no exit code of the program.
constexpr int exitCodeOutdated = -1;

/// `options`: as RenderOptions::forScene makes them. Returns the exit code: 0 done, 130 interrupted before the first
/// pass (nothing is written then). Throws InputError (before anything is rendered), DeviceError, and std::runtime_error
/// where a file cannot be written.
int renderCommand(const RenderOptions& options, const RenderSurroundings& around = {});

/// Throws InputError where a file could not be written.
void checkOutputs(const RenderOptions& options);

} // namespace quasilux
