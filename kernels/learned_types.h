/* What is learned about a scene before pass 0 (docs/method/learning.md), shared by host and device like shared_types.h.
 * All tables lie behind the scene's own in one buffer; offsets are in words. */
#ifndef QUASILUX_LEARNED_TYPES_H
#define QUASILUX_LEARNED_TYPES_H

#include "shared_types.h"

#ifdef __cplusplus
namespace quasilux::shared {
#endif

/* ---- guided emission (kernels/guide.clh) ---- */

/* Numbers that make a photon: which part of the emitter, two for the place, two for the direction. */
#define EMISSION_DIMENSIONS 5

/* Coordinates of an emitter's rays. Those which come through an opening (a rectangle) may have coordinates of their
 * own: place = centre + a axisU + b axisV, |a| < halfU, |b| < halfV, instead of the place on an emitter that shines
 * from outside, or instead of the direction of one in the scene. halfU = 0: the emitter's own coordinates. A ray
 * belongs to the first of its emitter's sources that holds it. */
typedef struct {
    unsigned int emitter;
    unsigned int first;           /* source of the emitter */
    Packed3 centre, axisU, axisV; /* axes orthonormal */
    float halfU, halfV;
    unsigned int faces; /* 1: a square that faces each place its rays begin at; axes are left out */
} GuideSource;

/* Openings at which scattered photons are aimed together, all of them or those of one set (kernels/aim.clh). Those of a
 * set follow each other. */
typedef struct {
    GuideSource opening;
    float share;        /* of the set's photons; those of a set sum to 1 */
    unsigned int count; /* of the set, where it is its first */
} AimSource;

/* A box of emission numbers in which photons are uniform. The leaves of all sources together hold each ray exactly
 * once. */
typedef struct {
    float cdf; /* probability of the leaves up to and including this one; last = 1 */
    unsigned int source;
    float weight; /* factor on the emitter's flux: share of the cube / probability of the leaf */
    float lower[5], size[5];
} GuideLeaf;

/* Emission that would serve the camera, as an importance path found it. */
typedef struct {
    unsigned int emitter;        /* QL_NONE: nothing found */
    unsigned int element;        /* triangle of a mesh */
    Packed3 position, direction; /* of the ray, away from the emitter */
    float weight;                /* estimate of what it brings to the image, over all photons */
    float inverseDensity;        /* photon: 1 / density of its numbers; direct light: 1 / probability of the emitter */
    unsigned int pixel;
} EmissionRecord;

/* A photon of a round while learning. */
typedef struct {
    EmissionRecord emission;
    float flux; /* that it began with, W, mean of R, G, B, times the photons of the round */
    /* Of what it brings to the image wherever it is stored, summed: in proportion to its part of the noise */
    float squares;
    float events; /* of its path: in proportion to the time that it takes */
} PhotonRecord;

/* The numbers of such a ray. */
typedef struct {
    unsigned int source; /* QL_NONE: none has it */
    float numbers[5];
} EmissionPoint;

/* ---- where photons matter (kernels/importance.clh) ---- */

/* Of a cell: its key (0: empty); what a unit of flux that arrives there brings to the image by being gathered there,
 * and what it brings in all; and where light that is scattered there matters, as (1 + number of a set's first opening)
 * << 16 | probability * 65535 of aiming at it. */
#define IMPORTANCE_WORDS 4
/* Instead of an aim: too few importance paths came to know where scattered light matters; the coarse cell does. */
#define IMPORTANCE_UNKNOWN 0xffffffffu
#define IMPORTANCE_COARSE 8.0f /* size of a coarse cell to that of a fine one */
/* The same of the cells that hold where importance paths gathered at all: wide enough for discs that reach in from
 * beside. */
#define SEEN_COARSE 4.0f

/* Distances from the eye, by powers of two: nearer ones belong to the first, farther ones to the last. */
#define DISTANCE_OCTAVES 16

/* Hashed cells whose size is a power of two in proportion to the distance from the camera. */
typedef struct {
    unsigned int cells; /* offset of IMPORTANCE_WORDS for each; QL_NONE: nothing is known */
    unsigned int mask;  /* cells - 1, a power of two - 1; at least half of them are empty */
    Packed3 eye;
    float sizePerDistance, smallestSize;
    float nearest;         /* distance from the eye where the first of DISTANCE_OCTAVES begins */
    unsigned int seen;     /* offset of the bits of cells where importance paths gathered; QL_NONE: nothing is known */
    unsigned int seenMask; /* bits - 1, a power of two - 1; a cell may share its bit */
} ImportanceGrid;

/* Vertex of an importance path. */
#define IMPORTANCE_VERTICES 4
typedef struct {
    Packed3 position;
    unsigned int face; /* importanceFace() */
    float weight;      /* throughput, mean of R, G, B; 0: none */
    float found; /* radiance that the path found by this vertex: by samples of emitters and by what it then ran into */
} ImportanceVertex;

typedef struct {
    EmissionRecord indirect,
        direct; /* one of all that the path found, in proportion to their weights, with their sum */
    ImportanceVertex vertices[IMPORTANCE_VERTICES]; /* the first one is where photons are gathered */
    float radiance;                                 /* of the whole path, mean of R, G, B */
    float gatheredShare; /* of the direct light, what photons might bring instead of samples */
    unsigned int pixel;
    float laterProbability; /* with which the emitter of `indirect` was, or would be, chosen */
} ImportancePath;

/* ---- which emitters direct light is sampled from (kernels/light_choice.clh) ---- */

/* Of a block of pixels, LIGHT_CHOICES of them. The first one stands for all emitters, as if nothing were learned; its
 * `first` is the number of those that follow. No emitter is in two of these. */
#define LIGHT_CHOICES 64
typedef struct {
    unsigned int first, count; /* emitters */
    unsigned int node;         /* of the light tree, where there are several */
    float probability;
} LightChoice;

/* ---- all of it ---- */

typedef struct {
    unsigned int leaves, leafCount, sources;
    unsigned int lights;                            /* QL_NONE: by power alone */
    unsigned int lightBlockSize, lightBlockColumns; /* pixels of a row and column, blocks of a row */
    unsigned int aims, aimCount, aimSets;           /* AimSource records, and of how many sets */
    unsigned int directEnvironment; /* of the EnvironmentMaps, the one by which direct light is sampled: 0 or 1 */
    unsigned int laterLights;       /* blocks from one that is of first events to that of later ones (lightBlock) */
    ImportanceGrid importance;
} Learned;

#ifdef __cplusplus
} // namespace quasilux::shared
#endif
#endif
