// Tabulates kernels/law.clh: classes taken by each kind of lobe after d = 0..3, q = 0..1, for BDD 0..3.
#include "law.clh"

__kernel void tabulateLaw(__global uint* taken, __global uint* mayScatter, uint variant) {
    const uint i = get_global_id(0);
    if (i >= 2 * 4 * 2 * 4) return;
    const uint scattering = i & 1 ? SCATTER_QUASI_SPECULAR : SCATTER_GENUINE_DIFFUSE;
    const uint d = i >> 1 & 3, q = i >> 3 & 1, bdd = i >> 4;
    taken[i] = lawLightTaken(scattering, d, q, bdd, variant);
    mayScatter[i] = lawMayScatter(scattering, d, bdd);
}

__kernel void tabulateClasses(__global uint* classes) {
    const uint events = get_global_id(0);
    if (events < 8) classes[events] = lawPhotonClass(events);
}

__kernel void tabulateSpecular(__global uint* taken, __global uint* mayScatter, uint variant) {
    if (get_global_id(0) > 0) return;
    taken[0] = lawLightTaken(SCATTER_SPECULAR, 0, 0, 0, variant);
    mayScatter[0] = lawMayScatter(SCATTER_SPECULAR, 5, 0);
}
