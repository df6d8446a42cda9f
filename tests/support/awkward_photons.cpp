#include "support/awkward_photons.h"

#include "bench/micro/native_flux.h"

#include <cmath>
#include <random>

namespace quasilux {

PhotonIndexSettings settingsOfFlux() {
    PhotonIndexSettings settings;
    settings.fluxUnit = testFluxUnit;
    return settings;
}

uint32_t packedFlux(float r, float g, float b) {
    return nativePackFlux({r / testFluxUnit, g / testFluxUnit, b / testFluxUnit}, nearestCode);
}

TracedPhoton photonAt(float x, float y, float z, unsigned lightClass, unsigned id) {
    TracedPhoton photon{};
    photon.position = {x, y, z};
    photon.direction = id * 2654435761u;
    photon.flux = packedFlux(float(id), float(id % 1000) + 0.5f, 1);
    photon.patchSide = id % 5;
    photon.depth = 1 + id % 200;
    photon.slot = lightClass;
    return photon;
}

std::vector<TracedPhoton> awkwardPhotons(unsigned count, float center, float cell,
                                         const std::vector<unsigned>& classes) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> wide(-40, 40);
    std::normal_distribution<float> narrow(0, 0.3f);
    std::vector<TracedPhoton> photons;
    for (unsigned id = 0; id < count; ++id) {
        float p[3];
        for (float& x : p) {
            x = id % 4 == 0 ? wide(random) : narrow(random);
            if (id % 4 == 1) x = std::round(x * 10) - (id % 8 == 1 ? 0.f : 1e-7f);
            if (id % 4 == 2 && id % 12 == 2) x = 0.25f;
            x = center + x * cell;
        }
        photons.push_back(photonAt(p[0], p[1], p[2], classes[id % classes.size()], id));
    }
    return photons;
}

} // namespace quasilux
