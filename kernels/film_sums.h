/* Where the sums of a pixel lie in the film, in floats; shared by host and device. Those of the whole image come first:
 * the sum over passes, the sum of the batches' squares, both compensated, and the sum of the batch that is open. By
 * `layout`, the same of the bias of the whole image, plain; of components; and of the bias of each class of light,
 * plain. */
#ifndef QUASILUX_FILM_SUMS_H
#define QUASILUX_FILM_SUMS_H

#include "shared_types.h"

/* Bits of a layout. */
#define FILM_HAS_BIAS 1u
#define FILM_HAS_COMPONENTS 2u
/* Said of a pass, no part of where sums lie: its samples come in several parts, so a batch of one pass has a sum. */
#define FILM_IN_PARTS 4u

/* A compensated sum: high, low for each of R, G, B. */
#define FILM_SUM_FLOATS 6

#define FILM_TOTAL_SUM 0
#define FILM_TOTAL_SQUARES FILM_SUM_FLOATS
#define FILM_TOTAL_BATCH (FILM_TOTAL_SQUARES + FILM_SUM_FLOATS)
#define FILM_TOTAL_FLOATS (FILM_TOTAL_BATCH + 3)

/* Of the total's bias, and of that of a class. An estimate of an error is not needed to more than three digits. */
#define FILM_BIAS_SUM 0
#define FILM_BIAS_SQUARES 3
#define FILM_BIAS_BATCH 6
#define FILM_BIAS_FLOATS 9
#define FILM_TOTAL_BIAS FILM_TOTAL_FLOATS

/* Sums of the components, squares of the classes of light, open batches of these. */
#define FILM_COMPONENT_SUMS(layout) (FILM_TOTAL_FLOATS + ((layout)&FILM_HAS_BIAS ? FILM_BIAS_FLOATS : 0))
#define FILM_CLASS_SQUARES(layout) (FILM_COMPONENT_SUMS(layout) + FILM_COMPONENTS * FILM_SUM_FLOATS)
#define FILM_CLASS_BATCH(layout) (FILM_CLASS_SQUARES(layout) + LIGHT_CLASSES * FILM_SUM_FLOATS)
#define FILM_CLASS_BIAS(layout) (FILM_CLASS_BATCH(layout) + LIGHT_CLASSES * 3)
#define FILM_PIXEL_FLOATS(layout)                                                                                      \
    (!((layout)&FILM_HAS_COMPONENTS) ? FILM_COMPONENT_SUMS(layout)                                                     \
     : (layout)&FILM_HAS_BIAS        ? FILM_CLASS_BIAS(layout) + LIGHT_CLASSES * FILM_BIAS_FLOATS                      \
                                     : FILM_CLASS_BIAS(layout))

#endif
