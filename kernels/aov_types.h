/* Floats of a pixel in the buffer of kernels/aovs.cl (AOV_…_FLOATS of them), shared by host and device like
 * shared_types.h. */
#ifndef QUASILUX_AOV_TYPES_H
#define QUASILUX_AOV_TYPES_H

#define AOV_ALBEDO 0u
#define AOV_POSITION 3u
#define AOV_GEO_NORMAL 6u
#define AOV_SH_NORMAL 9u
#define AOV_DEPTH 12u
#define AOV_PRIM_INDEX 13u
#define AOV_SHAPE_INDEX 14u
#define AOV_COVERAGE 15u /* share of the pixel where a ray meets anything */
#define AOV_ALPHA 16u    /* where it meets anything but null surfaces */
#define AOV_PLAIN_FLOATS 17u
/* And where layers go by texture coordinates (HAS_UV_LAYERS). */
#define AOV_UV 17u
#define AOV_DP_DU 19u
#define AOV_DP_DV 22u
#define AOV_DUV_DX 25u
#define AOV_DUV_DY 27u
#define AOV_ALL_FLOATS 29u

#endif
