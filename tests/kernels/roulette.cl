/* How many events each of `paths` survives by kernels/roulette.clh. Option KEEPS_SURVIVAL: a wrong rule, by which a
 * number drawn anew is held against the probability of having survived from the start. */
#include "roulette.clh"

inline int survives(Roulette* roulette, float probability, Rng* rng) {
#ifdef KEEPS_SURVIVAL
    const float before = roulette->survival;
    const int goesOn = survivesRoulette(roulette, probability, rng);
    if (goesOn && roulette->survival == 1) roulette->survival = before * probability;
    return goesOn;
#else
    return survivesRoulette(roulette, probability, rng);
#endif
}

__kernel void survivedEvents(__global const float* probability, uint events, __global uint* survived, uint paths) {
    const uint i = get_global_id(0);
    if (i >= paths) return;
    Rng rng = rngMake(5, 0, 0, i);
    Roulette roulette = {(i + rngNext(&rng)) / paths, 1};
    uint k = 0;
    while (k < events && survives(&roulette, probability[k], &rng)) ++k;
    survived[i] = k;
}
