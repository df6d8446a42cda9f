// A volume as kernels read it.
#pragma once

#include "prepare/device_scene.h"

namespace quasilux {

/// Appends the volume's record, its values, and the maxima over blocks of cells by which empty space is skipped
/// (kernels/volume_grid.clh).
void appendVolume(const VolumeDescription& volume, MediumTables& tables);

} // namespace quasilux
