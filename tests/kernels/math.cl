/* Elementary functions of kernels/elementary.clh; frames, ray origins and packed vectors of kernels/math.clh; over
 * arrays. */
#include "math.clh"

#define FUNCTION_LOG2 0
#define FUNCTION_EXP2 1
#define FUNCTION_LOG1P 2
#define FUNCTION_EXPM1NEG 3
#define FUNCTION_SIN_TWO_PI 4
#define FUNCTION_COS_TWO_PI 5
#define FUNCTION_ATAN2_UPPER 6
#define FUNCTION_POW 7

static float evaluate(uint function, float x, float y) {
    switch (function) {
    case FUNCTION_LOG2:
        return fastLog2(x);
    case FUNCTION_EXP2:
        return fastExp2(x);
    case FUNCTION_LOG1P:
        return fastLog1p(x);
    case FUNCTION_EXPM1NEG:
        return fastExpm1Neg(x);
    case FUNCTION_SIN_TWO_PI:
        return sinCosTwoPi(x).x;
    case FUNCTION_COS_TWO_PI:
        return sinCosTwoPi(x).y;
    case FUNCTION_ATAN2_UPPER:
        return fastAtan2Upper(y, x);
    default:
        return fastPow(x, y);
    }
}

__kernel void evaluateFunction(uint function, __global const float* x, __global const float* y, __global float* result,
                               uint count) {
    const uint i = get_global_id(0);
    if (i < count) result[i] = evaluate(function, x[i], y[i]);
}

static float8 evaluate8(uint function, float8 x, float8 y) {
    float8 sine, cosine;
    switch (function) {
    case FUNCTION_LOG2:
        return fastLog28(x);
    case FUNCTION_EXP2:
        return fastExp28(x);
    case FUNCTION_LOG1P:
        return fastLog1p8(x);
    case FUNCTION_SIN_TWO_PI:
        sinCosTurn8(x, &sine, &cosine);
        return sine;
    case FUNCTION_COS_TWO_PI:
        sinCosTurn8(x, &sine, &cosine);
        return cosine;
    default:
        return fastPow8(x, y);
    }
}

/* Eight numbers a work-item. */
__kernel void evaluateFunction8(uint function, __global const float* x, __global const float* y, __global float* result,
                                uint count) {
    const uint i = get_global_id(0);
    if (i < count) vstore8(evaluate8(function, vload8(i, x), vload8(i, y)), i, result);
}

static Packed3 pack3(float3 v) {
    Packed3 p;
    p.x = v.x;
    p.y = v.y;
    p.z = v.z;
    return p;
}

/* Three vectors per normal: s, t, n; then local and back for (1, 2, 3). */
__kernel void makeFrames(__global const Packed3* normals, __global Packed3* result, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const Frame frame = frameFromNormal(load3(normals[i]));
    result[4 * i] = pack3(frame.s);
    result[4 * i + 1] = pack3(frame.t);
    result[4 * i + 2] = pack3(frame.n);
    result[4 * i + 3] = pack3(toWorld(&frame, toLocal(&frame, (float3)(1.0f, 2.0f, 3.0f))));
}

__kernel void offsetOrigins(__global const Packed3* points, __global const Packed3* normals, __global Packed3* result,
                            uint count) {
    const uint i = get_global_id(0);
    if (i < count)
        result[i] =
            pack3(offsetRayOrigin(load3(points[i]), load3(normals[i]), POSITION_ERROR * length(load3(points[i]))));
}

__kernel void octahedralRoundTrip(__global const Packed3* vectors, __global Packed3* result, uint count) {
    const uint i = get_global_id(0);
    if (i < count) result[i] = pack3(decodeOctahedral(encodeOctahedral(load3(vectors[i]))));
}

__kernel void colours(__global const Rgb* rgb, __global float* result, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    result[2 * i] = luminance(loadRgb(rgb[i]));
    result[2 * i + 1] = maxComponent(loadRgb(rgb[i]));
}
