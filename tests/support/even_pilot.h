// What a pilot measures that has the same noise and bias everywhere.
#pragma once

#include "auto/prediction.h"

namespace quasilux {

inline PilotMeasure evenPilot(unsigned passes, double noisePerPass, double bias, double secondsPerPass) {
    constexpr size_t tiles = 64;
    PilotMeasure pilot;
    pilot.passes = passes;
    pilot.secondsPerPass = secondsPerPass;
    pilot.noise.assign(tiles, noisePerPass / passes / tiles);
    pilot.bias.assign(tiles, bias / tiles);
    return pilot;
}

} // namespace quasilux
