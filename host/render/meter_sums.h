// Sums of photons by pixel in 64-bit fixed point (kernels/splat_sums.clh).
#pragma once

#include "pass_types.h"
#include "render/planned_buffer.h"

namespace quasilux {

/// Units per W sr^-1 m^-2, a power of two, for sums over the `samples` of a pixel, each of the order of `meanRadiance`.
float quantaPerRadiance(double meanRadiance, unsigned samples);

/// 32-bit words of a pixel's sums; `slots` are bits 1 << slot of the map.
size_t splatWords(unsigned slots);

/// Factor on the sum over the paths of a pixel: their mean, of an irradiance meter times pi.
float sampleScale(const shared::Meter& meter);

/// Photons counted where they cross a meter (kernels/meter_photons.clh).
struct MeterSums {
    MeterSums(Device& device, unsigned slots, size_t pixels, double meanRadiance, unsigned samples)
        : sums(planned(slots, pixels).make(device)),
          quantaPerRadiance(quasilux::quantaPerRadiance(meanRadiance, samples)) {
        sums.fill(0);
    }
    static PlannedBuffer<uint32_t> planned(unsigned slots, size_t pixels) {
        return {"meter", splatWords(slots) * pixels};
    }

    Buffer<uint32_t> sums;
    float quantaPerRadiance;
};

} // namespace quasilux
