// A coarse camera: the same view with fewer pixels.
#pragma once

#include "pass_types.h"

namespace quasilux {

/// Pixels of a row and column that are one to a coarse camera: its image is to cost little, whatever the size of the
/// image.
unsigned coarseBlock(const shared::Camera& camera);

/// Whose pixels are blocks of `block` x `block` of those of `camera`.
shared::Camera coarseCamera(shared::Camera camera, unsigned block);

} // namespace quasilux
