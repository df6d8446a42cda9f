/* Parameters of the stages of a pass and the layout of their buffers, shared by host and device like shared_types.h. */
#ifndef QUASILUX_PASS_TYPES_H
#define QUASILUX_PASS_TYPES_H

#include "learned_types.h"
#include "sensor_types.h"

#ifdef __cplusplus
namespace quasilux::shared {
#endif

/* What shares direct light between emitter sampling and its own sampling, beside narrow lobes
 * (host/prepare/direct_sharing.h). */
#define DIRECT_SHARING_LAMBERT 1u
#define DIRECT_SHARING_MEDIA 2u

/* Some emitters' direct light is taken from photons, that of others by sampling them. */
#if defined(HAS_DIRECT_BY_PHOTONS) && defined(DIRECT_BY_EMITTERS)
#define MIXED_DIRECT
#endif

/* All small scene tables lie in one buffer of 32-bit words; these are word offsets into it. */
typedef struct {
    unsigned int primitives, shapes, cornerNormals;
    unsigned int materials, lobes;
    unsigned int textures, texels, uvs, attributes, lobeWeights, reliefs, roughness;
    unsigned int media, mediumPlanes;
    unsigned int emitters, emitterTriangles, emitterCount;
    unsigned int environment; /* two EnvironmentMaps; there are where an emitter is an EMITTER_ENVMAP */
    unsigned int goniograms;  /* words: each GoniogramTable with what it has; one for all luminaires of a type */
    unsigned int lightTree,
        lightTreeCount;           /* LightNode; number of emitters in it, the first of the table; 0: there is none */
    unsigned int variant;         /* of the law: VARIANT_* */
    unsigned int directSharing;   /* DIRECT_SHARING_* */
    unsigned int emittersSampled; /* by genuine diffuse lobes, for direct light: all but those with directByPhotons */
    unsigned int borderLeaves, borderNodes, borderNodeCount;
    /* By patch: the node that holds the segments whose patchA it is; QL_NONE: there are none */
    unsigned int patchNodes;
    unsigned int patchRadius; /* float per patch: largest density radius that its curvature allows */
    unsigned int patchCount;  /* of those; what follows are patches of instances */
    /* Place of the first, steps from one to the next as they are long; child reference of the tree over them, QL_NONE:
     * none */
    unsigned int instances, instanceCount, instanceRoot;
    Meter meter;
    Learned learned;
} SceneTables;

/* Segments of a path are counted up to this many. */
#define PHOTON_DEPTH_MAX 0x1fffffffu

/* Photons on surfaces and in media have maps of their own, by class: slots of one index. */
#define PHOTON_SLOTS 8
#define VOLUME_SLOT(lightClass) (LIGHT_CLASSES + (lightClass))

/* What becomes of the flux of photons (kernels/energy_balance.clh). */
#define ENERGY_EMITTED 0u
#define ENERGY_ABSORBED 1u
#define ENERGY_ESCAPED 2u
#define ENERGY_BEYOND_DEPTH 3u
#define ENERGY_LOST 4u
#define ENERGY_GAINED 5u

/* One work-item traces the paths of one region and stores into blocks of PHOTON_BLOCK photons, which it takes one after
 * the other (kernels/photon_store.clh). */
#define PHOTON_BLOCK 16u
/* Words of a sorted photon, one more where the scene limits the path's depth; of a sorted camera point; and floats of a
 * camera path's sample that waits for its splats (photon_grid.clh, camera_point_paths.cl). */
#define PHOTON_FIELDS_WITHOUT_DEPTH 6
#define POINT_FIELDS 5
#define CAMERA_SAMPLE_FLOATS 6
typedef struct {
    unsigned int stored;                /* photons kept */
    unsigned int wanted;                /* photons that it would have kept with room for all */
    unsigned int firstBlock, lastBlock; /* of its photons, where it has any */
    unsigned int cutPaths;              /* paths ended by PATH_EVENTS_MAX */
    unsigned int nonFinite;
    float fluxCut;               /* W, mean of R, G, B, of those paths */
    float useful, usefulSquares; /* while learning: what the path at hand brings to the image; PhotonRecord::squares */
    unsigned int arrivals,
        seenArrivals;             /* while learning: photons on surfaces, and those where importance paths gathered */
    float density[LIGHT_CLASSES]; /* while learning: photons by area about what the camera sees, times a constant */
    float densityByOctave[DISTANCE_OCTAVES]; /* of them all, by distance from the eye */
    unsigned int overflows;                  /* sums of splats that left the range of their fixed point (camera map) */
    unsigned int clipped;                    /* photons with more flux than packed_flux.clh holds */
    unsigned int meterCaustics;              /* caustic and quasi-caustic photons that were counted at a meter */
    float energy[6], energyRest[6];          /* W, by ENERGY_*: unevaluated sums; 0 without ENERGY_BALANCE */
} RegionCount;

typedef struct {
    unsigned int seedLow, seedHigh;
    unsigned int pass;
    unsigned int paths; /* photons emitted in the pass */
    unsigned int pathsPerRegion;
    unsigned int regions;
    unsigned int photonBlocks, photonStride; /* room for photons; stride as in MapParams */
    float perFluxUnit;                       /* 1 / MapParams::fluxUnit */
    unsigned int maxDepth;                   /* segments of the whole path, QL_NONE = no limit */
    unsigned int learns;                     /* 1: no photon is stored; a PhotonRecord of each path is */
    float usualWorth; /* of a photon to the image, flux * importance: weight windows aim at it; 0: none */
    float keepProbability[LIGHT_CLASSES]; /* of photons in media, by class: they are thinned where there are many */
    SceneTables scene;
} PhotonParams;

/* Compiler option, 1: camera paths estimate the bias of what they take from photons too (docs/method/accuracy.md). */
#ifndef ESTIMATE_BIAS
#define ESTIMATE_BIAS 0
#endif

/* Factor on density radii by distance from the eye (kernels/radius_field.clh): factor[k] at nearest * 2^k, linear
 * between. */
typedef struct {
    unsigned int octaves; /* 0: radii are the same everywhere */
    Packed3 eye;
    float nearest;
    float factor[DISTANCE_OCTAVES + 1];
} RadiusField;

/* One indexed map per photon class, all in one cell table and one sorted set of photons (kernels/photon_grid.clh). */
typedef struct {
    float radius[LIGHT_CLASSES]; /* of density on surfaces, before any factor of the place or the pixel */
    RadiusField field;
    float volumeScale;     /* of this pass's kernels in media to those of pass 0 (Medium) */
    unsigned int media;    /* SceneTables::media */
    unsigned int cellMask; /* cells of one class - 1, a power of two - 1 */
    unsigned int regions;
    unsigned int regionCapacity;  /* of camera points */
    unsigned int photonStride;    /* of the sorted arrays: records from one field to the next */
    float fluxUnit;               /* of photons' flux as stored, W */
    float perKept[LIGHT_CLASSES]; /* of photons in media, by class: 1 / PhotonParams::keepProbability */
    float biasWeight;             /* of this pass in the estimate of bias; 0: it is not estimated in this pass */
} MapParams;

/* A digit of the cells by which records are sorted, lowest first, and the layout of its counts
 * (kernels/cell_sort.clh). */
typedef struct {
    unsigned int shift, mask, bins;  /* the bin of a cell: cell >> shift & mask */
    unsigned int chunks;             /* each counts and places a run of the records, in order */
    unsigned int binSide, chunkSide; /* the count of a bin and a chunk stands at bin * binSide + chunk * chunkSide */
    unsigned int blockCounts;        /* summed by one work-item */
    unsigned int groupBlocks;        /* blocks whose sums are summed by one work-item */
    unsigned int keySide;            /* words from the cell of one record to that of the next */
} SortDigit;

typedef struct {
    unsigned int seedLow, seedHigh;
    unsigned int pass;
    unsigned int bdd;
    unsigned int maxDepth;
    unsigned int pathBlock;       /* pixels of a row and column that have equally many camera paths in a pass */
    unsigned int gathers;         /* 0 where no photons are stored, or light that needs none is all that is asked for */
    unsigned int directSamples;   /* of emitters, where a path takes direct light first */
    unsigned int causticsByPaths; /* paths find caustic light, not photons (takeRadiance) */
    unsigned int radiusBlock;     /* pixels of a row and column that share a density radius */
    /* Pixels of a row and column of the image that one of this camera stands for: 1, but of coarse cameras */
    unsigned int coarseness;
    float spread; /* of places in a pixel about its centre: 1; 1 / coarseness: within a single pixel of the image */
    unsigned int
        countsEvents;  /* 1: what a path brings is not light but how many rays it follows, in the first component */
    float batchWeight; /* 1 / passes of the film's batch that ends with this pass, 0 where it goes on (film.clh) */
    unsigned int filmLayout; /* film_sums.h */
    unsigned int firstPixel,
        pixels; /* of the part of the film, or grid of samples (shared_samples.clh), that the launch traces */
    unsigned int sampleRows; /* of that grid, which are kept at a time */
    unsigned int parts;      /* of a pass, one of which these paths are (host/render/pass_part.h) */
    Camera camera;
    MapParams map;
    SceneTables scene;
} CameraParams;

/* Samples that pixels share (shared_samples.clh): pixels to either side whose samples a filter may reach, and samples
 * that their grid has beyond each edge of the image. */
#define FILTER_TAPS(camera) (((camera)->filterReach + FILTER_CELLS / 2 - 1) / FILTER_CELLS)
#define SAMPLE_BORDER(camera) ((camera)->filterEnds ? 0 : FILTER_TAPS(camera))

/* ---- density radius by pixel (kernels/adaptive_radius.cl) ---- */

/* What coarse passes measure of one class of light in a pixel, relative to the radiance there. */
typedef struct {
    /* Squared: the bias at radius r, in units of MapParams::radius of the first pass, is r^2 times its root */
    float curvature;
    float curvatureNoise; /* of its estimate */
    float variance;       /* of a pass of radius 1, from photons */
    float passes;         /* of the coarse camera with the radius that it has now */
    float squaredRadii;   /* sum over these of the squared radius, in units of MapParams::radius of the first pass */
    float inverseSquares; /* of its inverse */
} RadiusMeasure;

typedef struct {
    unsigned int width, height; /* of the coarse camera */
    unsigned int passes;        /* of it */
    unsigned int newPasses;     /* since radii were last chosen */
    /* Sum over these of the squared radius for scale 1, in units of MapParams::radius of the first pass */
    float squaredShrinks;
    float inverseShrinks;   /* of its inverse */
    float noiseToCurvature; /* variance / (2 curvature) of a pass times this is the best radius to the sixth power */
    float largest;          /* radius, in units of MapParams::radius */
} RadiusParams;

/* ---- camera map: points of camera paths are stored and photons splatted to them (docs/method/architecture.md) ---- */

/* A place where light of one class is taken by density estimation, by all Lambert lobes together, by one other lobe, or
 * by a medium. */
typedef struct {
    unsigned int cell; /* of the index, once it is known; the first, as for photons (SortDigit::keySide) */
    Packed3 position;
    Rgb weight;             /* of (flux * kernel * f) in the pixel; f of Lambert lobes and tints of others included */
    unsigned int place;     /* PHOTON_PATCH_SIDE of the photons that it takes */
    unsigned int slotDepth; /* segments that such a photon may have behind it << 3 | map slot */
    unsigned int pixel;
    unsigned int scatterer; /* surface: POINT_LAMBERT, or lobe index << 1 | 1 where it transmits; medium: SCATTER_* */
    unsigned int wo;        /* towards the camera path, octahedral */
    /* Octahedral: of a surface the shading normal, in a medium where weights of the kernel rise, in kernel space */
    unsigned int normal;
    /* Of a surface the index of its PointBorder, or QL_NONE; in a medium that slope, a float's bits */
    unsigned int border;
} CameraPoint;
#define POINT_LAMBERT QL_NONE

#define BORDER_SECTORS 32
/* What borders leave of the disc about a camera point: sectors as in kernels/density_region.clh. */
typedef struct {
    unsigned int normal;                    /* geometric normal, octahedral: its frame has the sectors */
    float slopeX, slopeY;                   /* weight 1 + slopeX x + slopeY y in that frame */
    unsigned int reach[BORDER_SECTORS / 2]; /* fractions of the radius, 16 bits each */
} PointBorder;

/* One work-item traces the pixels of one region in order and stores into its own parts of both buffers. */
typedef struct {
    unsigned int stored, wanted;               /* camera points, as in RegionCount */
    unsigned int storedBorders, wantedBorders; /* PointBorder records */
    unsigned int cutPaths;
    float cutThroughput; /* of those paths, mean of R, G, B */
} PointRegionCount;

typedef struct {
    MapParams map; /* of camera points: regions and regionCapacity are theirs */
    unsigned int pixelsPerRegion;
    unsigned int borderCapacity; /* of a region */
    float quantaPerRadiance;     /* splats are summed in fixed point: units per W sr^-1 m^-2, a power of two */
} PointParams;

/* Counted over a camera pass. */
typedef struct {
    unsigned int nonFinite;
    unsigned int cutPaths;
    unsigned int cutThroughput; /* of those paths, mean of R, G, B, summed in steps of 1 / CUT_THROUGHPUT_STEPS */
} CameraCounters;
#define CUT_THROUGHPUT_STEPS 1024u

/* Pixels of a block that a piece of the film is made of: the one in its middle, one in each row, all. */
#define CUT_MIDDLE 0u
#define CUT_DIAGONAL 1u
#define CUT_ALL 2u

/* A piece of the film: columns x rows blocks of step x step of its pixels, those at the film's edge maybe smaller. */
typedef struct {
    unsigned int x, y, columns, rows, step;
    unsigned int sampling; /* CUT_*: which of the block's pixels are looked at, to take their mean */
    unsigned int filmWidth, filmHeight;
    unsigned int firstPixel, pixels; /* of the part of the film that is read */
    unsigned int filmFloats;         /* of a pixel */
    unsigned int firstFloat, floats; /* which of them */
    unsigned int pixelsAhead;        /* of the film, from its first on: they have one pass more than the others, */
    float aheadWeight;               /* and this factor makes up for it */
} FilmCut;

#define LOBES_MOST 16u /* lobes on one side of a surface; the host refuses more */
#ifdef HAS_MANY_LOBES
#define LOBES_MAX LOBES_MOST /* on one side of the scene's surfaces */
#else
#define LOBES_MAX 8u
#endif

/* Hard limit on the events of a path; roulette ends practically all of them long before. Paths cut are counted. */
#define PATH_EVENTS_MAX 100000u

#ifdef __cplusplus
} // namespace quasilux::shared
#endif
#endif
