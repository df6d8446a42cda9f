/* Chooses the density radius of each block of pixels and class of light from the film of a coarse camera.
 * From: that film. To: radii of the passes to come.
 *
 * The bias of a pixel at radius r is c r^2, its variance v / r^2 a pass. Both are known from the estimate of bias
 * (docs/method/accuracy.md): its mean is c r^2, and its variance BIAS_VARIANCE times that of the density estimate. The
 * mean square error of many passes is least where r^6 = v / (2 c^2) * noiseToCurvature (docs/method/radius.md). */
#include "adaptive_radius.clh"
#include "film.clh"

/* Variance of the estimated bias, in units of that of the estimate itself (docs/method/accuracy.md). */
#define BIAS_VARIANCE 1.6f
/* Blocks on all sides that are averaged with one: a single one knows little but noise. */
#define RADIUS_WINDOW 2
/* A squared curvature below this share of its noise is taken to be as large. */
#define CURVATURE_FLOOR 0.1f
/* Squared bias counts this many times while the coarse camera's disc is the largest: of features narrower than it c r^2
 * says too little. */
#define BIAS_CARE 3.0f
#define RADIUS_SCALE_MIN 0.1f
/* The coarse camera's disc is made as small as its measures certainly ask for, but not for less than a quarter of
 * it. */
#define NARROWING_HYSTERESIS 0.75f

/* Of the coarse film, which has everything. */
#define COARSE_LAYOUT (FILM_HAS_BIAS | FILM_HAS_COMPONENTS)

/* `coarseScales`: radii of the coarse camera, in units of MapParams::radius. */
__kernel void measureRadii(__global const float* film, __global const float* coarseScales,
                           __global RadiusMeasure* measures, const RadiusParams params) {
    const uint pixel = get_global_id(0);
    if (pixel >= params.width * params.height) return;
    __global const float* sums = film + (size_t)pixel * FILM_PIXEL_FLOATS(COARSE_LAYOUT);
    for (uint c = 0; c < LIGHT_CLASSES; ++c) {
        if (!(PHOTON_CLASSES >> c & 1)) continue;
        const size_t i = radiusIndex(pixel, c);
        __global RadiusMeasure* measure = measures + i;
        measure->passes += params.newPasses;
        measure->squaredRadii += params.squaredShrinks * coarseScales[i] * coarseScales[i];
        measure->inverseSquares += params.inverseShrinks / (coarseScales[i] * coarseScales[i]);
        const float n = measure->passes;
        __global const float* bias = sums + FILM_CLASS_BIAS(COARSE_LAYOUT) + c * FILM_BIAS_FLOATS;
        float square = 0, noise = 0;
        for (uint channel = 0; channel < 3; ++channel) {
            const float radiance = sums[FILM_TOTAL_SUM + channel] / params.passes;
            if (!(radiance > 0)) continue;
            const float sum = bias[FILM_BIAS_SUM + channel], mean = sum / n;
            square += mean * mean / (radiance * radiance);
            noise += max(bias[FILM_BIAS_SQUARES + channel] - sum * mean, 0.f) / (n * (n - 1)) / (radiance * radiance);
        }
        if (!isfinite(square + noise)) square = noise = 0;
        const float perRadius = n / measure->squaredRadii;
        measure->curvature = (square - noise) * perRadius * perRadius;
        measure->curvatureNoise = noise * perRadius * perRadius;
        measure->variance = noise * n * n / (BIAS_VARIANCE * measure->inverseSquares);
    }
}

/* 0 where nothing is known, or `curvature` is not positive. */
inline float bestRadius(float curvature, float variance, const RadiusParams* params) {
    const float sixth = params->noiseToCurvature * variance / (2 * curvature);
    return sixth > 0 && isfinite(sixth) ? exp2(log2(sixth) / 6) : 0;
}

/* Of a squared mean over the square of its standard error, less 1: what one in fifty exceeds by chance (Student's t,
 * its one-sided 99 %), with the noise from so many passes in some four parts of the window whose discs do not
 * overlap. */
inline float excessByChance(float passes) { return 5 + 8 / ((passes - 1) * (passes - 1)); }

/* The coarse camera goes on with radius `scale`, and forgets the bias that it has measured. */
inline void narrowDisc(float scale, uint lightClass, __global float* sums, __global float* coarseScale,
                       __global RadiusMeasure* measure) {
    *coarseScale = scale;
    measure->passes = measure->squaredRadii = measure->inverseSquares = 0;
    __global float* bias = sums + FILM_CLASS_BIAS(COARSE_LAYOUT) + lightClass * FILM_BIAS_FLOATS;
    for (uint k = 0; k < FILM_BIAS_FLOATS; ++k) bias[k] = 0;
}

/* `before`: the radii chosen before, which stay where there is no such light. */
__kernel void chooseRadii(__global float* film, __global RadiusMeasure* measures, __global float* coarseScales,
                          __global const float* before, __global float* scales, const RadiusParams params) {
    const uint pixel = get_global_id(0);
    if (pixel >= params.width * params.height) return;
    const int x = pixel % params.width, y = pixel / params.width;
    const int left = max(x - RADIUS_WINDOW, 0), right = min(x + RADIUS_WINDOW, (int)params.width - 1);
    const int top = max(y - RADIUS_WINDOW, 0), bottom = min(y + RADIUS_WINDOW, (int)params.height - 1);
    for (uint c = 0; c < LIGHT_CLASSES; ++c) {
        if (!(PHOTON_CLASSES >> c & 1)) continue;
        float curvature = 0, noise = 0, variance = 0;
        for (int v = top; v <= bottom; ++v)
            for (int u = left; u <= right; ++u) {
                __global const RadiusMeasure* measure = measures + radiusIndex(v * params.width + u, c);
                curvature += measure->curvature;
                noise += measure->curvatureNoise;
                variance += measure->variance;
            }
        const size_t i = radiusIndex(pixel, c);
        const float care = coarseScales[i] < params.largest ? 1 : BIAS_CARE;
        const float best = bestRadius(care * max(curvature, CURVATURE_FLOOR * noise), variance, &params);
        scales[i] = best > 0 ? clamp(best, RADIUS_SCALE_MIN, params.largest) : before[i];
        const float certain = curvature - excessByChance(measures[i].passes) * noise;
        const float wanted = bestRadius(care * certain, variance, &params), narrow = max(wanted, RADIUS_SCALE_MIN);
        if (wanted > 0 && narrow < NARROWING_HYSTERESIS * coarseScales[i])
            narrowDisc(narrow, c, film + (size_t)pixel * FILM_PIXEL_FLOATS(COARSE_LAYOUT), coarseScales + i,
                       measures + i);
    }
}
