/* A piece of the film for somebody who looks at it while it renders: each pixel of the cut has the sums of a block of
 * the film's pixels, the mean of some of them. Each pixel that is read costs a cache line, so that large films are
 * looked at in fewer. From: film, of which this is a part. To: the cut, to which every part of the film is added. */
#include "pass_types.h"

/* The film's pixel (x, y) adds `weight` times its floats, if it is in this part. */
inline void addPixel(__global const float* film, __global float* sums, uint2 at, float weight, FilmCut cut) {
    const ulong pixel = (ulong)at.y * cut.filmWidth + at.x;
    if (pixel < cut.firstPixel || pixel >= (ulong)cut.firstPixel + cut.pixels) return;
    weight *= pixel < cut.pixelsAhead ? cut.aheadWeight : 1.f;
    film += (pixel - cut.firstPixel) * cut.filmFloats + cut.firstFloat;
    for (uint k = 0; k < cut.floats; ++k) sums[k] += weight * film[k];
}

__kernel void cutFilm(__global const float* film, __global float* cutSums, FilmCut cut) {
    const uint index = get_global_id(0);
    if (index >= cut.columns * cut.rows) return;
    __global float* sums = cutSums + (size_t)index * cut.floats;
    const uint2 first = (uint2)(cut.x + index % cut.columns * cut.step, cut.y + index / cut.columns * cut.step);
    const uint2 end = min(first + cut.step, (uint2)(cut.filmWidth, cut.filmHeight));
    if (cut.sampling == CUT_MIDDLE) {
        addPixel(film, sums, (first + end) / 2, 1, cut); /* end > first, so it is within */
        return;
    }
    if (cut.sampling == CUT_DIAGONAL) {
        for (uint y = first.y; y < end.y; ++y)
            addPixel(film, sums, (uint2)(first.x + (y - first.y) % (end.x - first.x), y), 1.f / (end.y - first.y), cut);
        return;
    }
    const float weight = 1.f / ((end.x - first.x) * (end.y - first.y));
    for (uint y = first.y; y < end.y; ++y)
        for (uint x = first.x; x < end.x; ++x) addPixel(film, sums, (uint2)(x, y), weight, cut);
}
