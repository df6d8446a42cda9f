// Runs kernels of tests/kernels/ on the device, with the same .clh files as the renderer.
#pragma once

#include "device/program.h"

#include <string>

namespace quasilux {

/// The first device, shared by all tests of a program: each context of PoCL reads its library of kernels anew, which
/// takes as long as a third of a render's kernels.
Device& testDevice(unsigned workGroupSize = 64);

/// Builds tests/kernels/`file`, which may include anything of kernels/.
Program testProgram(const std::string& file, const std::string& options = "");
/// On another device.
Program testProgram(Device& device, const std::string& file, const std::string& options = "");

} // namespace quasilux
