/* Queries and results of the micro-benchmark of gathering; shared by host and device like shared_types.h. */
#ifndef QUASILUX_GATHER_TYPES_H
#define QUASILUX_GATHER_TYPES_H

#include "shared_types.h"

#ifdef __cplusplus
namespace quasilux::shared {
#endif

typedef struct {
    Packed3 position;
    unsigned int patchSide;
} GatherQuery;

typedef struct {
    Rgb irradiance, bias; /* sums of flux times weight */
} GatherSum;

#ifdef __cplusplus
} // namespace quasilux::shared
#endif
#endif
