// `quasilux devices`: the OpenCL devices and their numbers.
#pragma once

namespace quasilux {

/// Prints a table, or a JSON array, on stdout.
void listDevicesCommand(bool json);

} // namespace quasilux
