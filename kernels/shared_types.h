/* Structs and constants that host (C++20) and device (OpenCL C 1.2) share, written once.
 *
 * Plain C: scalar fields only (a float3 takes 16 bytes on the device), no padding, 4-byte alignment throughout.
 * tests/layout_test.cpp compares size and offset of every field on both sides, so add a new struct there too.
 * Lengths are in scene units, flux in W, radiance in W sr^-1 m^-2 (taking one scene unit as one metre).
 */
#ifndef QUASILUX_SHARED_TYPES_H
#define QUASILUX_SHARED_TYPES_H

#ifdef __cplusplus
namespace quasilux::shared {
#endif

#define QL_NONE 0xffffffffu

typedef struct {
    float x, y, z;
} Packed3; /* point, vector or normal */

typedef struct {
    float r, g, b;
} Rgb; /* linear sRGB primaries */

/* ---- geometry: 8-wide bounding volume hierarchy ------------------------------------------------------------- */

#define BVH_WIDTH 8
#define BVH_LEAF_BIT 0x80000000u /* child reference: leaf bit | (blocks - 1) << 27 | first block */
#define BVH_LEAF_COUNT_SHIFT 27  /* 4 bits: up to 16 blocks in one leaf, 8 where there are instances */
#define BVH_LEAF_FIRST_MASK 0x07ffffffu
#define BVH_INSTANCE_BIT 0x40000000u     /* of a leaf: the rest is the place of an Instance */
#define PRIMITIVE_NULL_BIT 0x80000000u   /* primitive whose bsdf is `null`: shadow and photon rays pass through it */
#define PRIMITIVE_SPHERE_BIT 0x40000000u /* lane holds a sphere: v0 = centre, v1x = radius, v2 is no number */
#define PRIMITIVE_INDEX_MASK 0x3fffffffu

/* Inner node, 224 bytes. An empty slot has lower = +inf, upper = -inf, so no ray enters it. */
typedef struct {
    float lowerX[8], lowerY[8], lowerZ[8];
    float upperX[8], upperY[8], upperZ[8];
    unsigned int child[8];
} BvhNode;

/* Leaf block, 320 bytes: the corners of eight triangles. Those of an unused lane (primitive QL_NONE) or a degenerate
 * triangle are no numbers, so that no ray meets it. */
typedef struct {
    float v0x[8], v0y[8], v0z[8];
    float v1x[8], v1y[8], v1z[8];
    float v2x[8], v2y[8], v2z[8];
    unsigned int primitive[8]; /* index | PRIMITIVE_*_BIT */
} PrimitiveBlock;

/* Shapes that lie in the scene many times, and one of those times. Both follow the blocks; their places count in words
 * from the first block on, in steps of INSTANCE_STEP. */
#define INSTANCE_STEP 8
typedef struct {
    unsigned int root;                                       /* node of the group's own tree, in its own space */
    unsigned int borderNodes, borderLeaves, borderNodeCount; /* of its own border tree: as in SceneTables */
    unsigned int patchNodes, patchRadius;                    /* likewise, by patch of the group */
} ShapeGroup;

typedef struct {
    float toWorld[12];       /* rows: from the group's space, the last of four numbers is added */
    float toGroup[9];        /* rows: its inverse, of what is left after that sum */
    unsigned int group;      /* place of the ShapeGroup */
    unsigned int firstPatch; /* what is added to patches of the group */
    float radiusScale;       /* how much smaller the group's radii of curvature may be */
} Instance;

/* What a primitive belongs to; indexed by primitive index. */
typedef struct {
    unsigned int shape; /* index into Shape records */
    /* Smooth surface component: primitives joined across edges flatter than the crease angle; of a ShapeGroup counted
     * in it */
    unsigned int patch;
} PrimitiveInfo;

typedef struct {
    unsigned int material;
    unsigned int emitter;        /* index, or QL_NONE */
    unsigned int firstPrimitive; /* primitives of a shape are consecutive */
    unsigned int firstNormal;    /* index of its first corner normal (3 per triangle), or QL_NONE: flat */
    float normalSign;            /* -1 where `flip_normals` is set */
    unsigned int firstUv; /* word in the uv table, or QL_NONE: no textures. Mesh: u, v by corner, 6 words a triangle;
                             sphere: the rows of the rotation from the world to its own axes, 9 words */
    unsigned int interior, exterior; /* medium behind the surface and on the side of its normal: index, MEDIUM_NONE or,
                                        both, MEDIUM_UNCHANGED */
} Shape;

/* Segments that kernels take together. */
#define BORDER_LANES 8

/* Border segments (host/prepare/borders.h) of a leaf of the tree over them: ends, and patches that they bound. Places
 * that are left over have no length. */
typedef struct {
    float ax[BORDER_LANES], ay[BORDER_LANES], az[BORDER_LANES];
    float bx[BORDER_LANES], by[BORDER_LANES], bz[BORDER_LANES];
    unsigned int patchA[BORDER_LANES], patchB[BORDER_LANES];
} BorderLeaf;

/* Node of the tree (border_tree.clh), in depth-first order. */
typedef struct {
    Packed3 center, halfExtent;         /* of its box */
    float radius;                       /* of the ball about it */
    unsigned int patchFirst, patchLast; /* all patches of its segments lie between */
    unsigned int next;                  /* the first node that is not below it */
    unsigned int leaf;                  /* index; QL_NONE: an inner node */
} BorderNode;

/* ---- scattering ---------------------------------------------------------------------------------------------- */

/* Variants of the law (kernels/law.clh), and how a lobe scatters by it. */
#define VARIANT_MAIN 0u
#define VARIANT_ALTERNATIVE 1u
#define SCATTER_GENUINE_DIFFUSE 1u
#define SCATTER_QUASI_SPECULAR 2u
#define SCATTER_SPECULAR 4u /* delta */

/* One lobe of a BSDF. Which fields mean what is said in kernels/bsdf/lobes/<lobe>.clh; `type` is LOBE_* of
 * kernels/bsdf/lobe_list.h. */
typedef struct {
    unsigned int type;
    unsigned int scattering; /* SCATTER_* */
    Rgb reflectance;         /* scale of the lobe, blend weight included */
    Rgb transmittance;       /* scale of a transmitted part */
    Rgb eta;                 /* real index of refraction relative to the outside, per channel; dielectric: .r only */
    Rgb k;                   /* imaginary part */
    float alphaU, alphaV;    /* microfacet roughness */
    float exponent;          /* Phong */
    float coat[8];           /* rough coats: polynomial in the cosine */
    unsigned int reflectanceTexture, transmittanceTexture; /* 1 + index of the Texture that multiplies it; 0: none */
    unsigned int firstWeight, weightCount;                 /* LobeWeight records, which multiply all of it */
    unsigned int etaTexture, kTexture; /* facets: 1 + index of the Texture that eta or k is instead; 0: none */
} Lobe;

/* A factor on a lobe by texture, such as its share in a blend or under a mask: a function of x = offset + factor times
 * the texture. */
#define WEIGHT_VALUE 0u             /* x */
#define WEIGHT_RECIPROCAL 1u        /* 1 / x */
#define WEIGHT_ROOT 2u              /* its root */
#define WEIGHT_TINT 3u              /* x over its luminance; white where x is black */
#define WEIGHT_NORMALREFLECTANCE 4u /* ((x - 1) / (x + 1))^2: of an index x what is reflected at normal incidence */
#define WEIGHS_REFLECTED 1u         /* parts of the lobe */
#define WEIGHS_TRANSMITTED 2u
typedef struct {
    unsigned int texture;  /* index of a Texture */
    unsigned int function; /* WEIGHT_* */
    unsigned int parts;    /* WEIGHS_*, one or both */
    float offset, factor;
} LobeWeight;

#define MATERIAL_NULL 1u
#define MATERIAL_ANISOTROPIC 2u /* its lobes lie along the derivative of the position by u */
/* Lobes seen from the side of the normal and from behind; a count of 0 is black. */
typedef struct {
    unsigned int frontFirst, frontCount;
    unsigned int backFirst, backCount;
    unsigned int flags;
    unsigned int frontRelief, backRelief;       /* 1 + index of the Relief that bends the side's normals; 0: none */
    unsigned int frontRoughness, backRoughness; /* 1 + index of the RoughnessLevels of the side's lobes; 0: none */
} Material;

/* Microfacet roughness, and other numbers that lobes are not linear in, by up to three textures. The lobes of the side
 * are there once for each combination of levels (those of the last texture follow each other); of levels that lie
 * evenly in the fourth root of x = offset + factor times the texture, the nearest one is taken. */
#define ROUGHNESS_TEXTURES 3
typedef struct {
    unsigned int texture[3]; /* 1 + index of a Texture whose channels are equal; 0: none, one level */
    unsigned int levels[3];
    float offset[3], factor[3];
    float least[3]; /* fourth root of x at the first level */
    float levelsPerUnit[3];
} RoughnessLevels;

#define RELIEF_NORMALS 0u  /* the texture holds normals: 2 rgb - 1, in the frame of dp/du */
#define RELIEF_HEIGHTS 1u  /* it holds heights, times `scale`, along the shading normal */
#define RELIEF_FLIPS 1u    /* flag: bent normals on the wrong side of the surface are turned over */
#define RELIEF_SHADOWS 2u  /* flag: bent normals take light that the surface itself would shadow, by a factor */
#define RELIEF_MIRRORED 4u /* flag: of the back, mirrored in the surface; else turned over */
/* Bends shading normals by a texture: normal and bump maps. */
typedef struct {
    unsigned int type;    /* RELIEF_* */
    unsigned int texture; /* index */
    float scale;
    unsigned int flags;
} Relief;

/* ---- participating media -------------------------------------------------------------------------------------- */

#define PHASE_ISOTROPIC 0u
#define PHASE_HG 1u
#define PHASE_RAYLEIGH 2u
#define PHASE_MIXED 3u     /* of a medium: its PhasePart records */
#define PHASE_TABULATED 4u /* of a part only */

#define MEDIUM_NONE QL_NONE              /* vacuum */
#define MEDIUM_BY_PLACE MEDIUM_UNCHANGED /* of an emitter, a grid, a camera: not the same everywhere on it */
#define MEDIUM_UNCHANGED 0xfffffffeu /* of a surface that bounds no medium: a path that passes it stays where it is */

/* A medium, homogeneous unless it has a grid of extinction. The phase function p is split by a level (sr^-1): genuine
 * diffuse = min(p, level), quasi-specular = the peak above it. Level 0: all of it is quasi-specular; infinity: all of
 * it genuine diffuse (standard method). */
typedef struct {
    unsigned int phase;                /* PHASE_* */
    float g;                           /* mean cosine of the scattering angle; > 0 forwards */
    unsigned int firstPart, partCount; /* PHASE_MIXED: PhasePart records, words from this record on */
    Rgb sigmaT;                        /* extinction coefficient, 1/scene unit; with a grid: its mean */
    Rgb albedo;                        /* scattering / extinction */
    /* VolumeGrid records that say them instead: words from this record on; 0: none. */
    unsigned int extinctionGrid, albedoGrid;
    float extinctionScale; /* on the former */
    float level;
    float genuineDiffuseShare; /* integral of min(p, level) over the sphere */
    Packed3 kernelAxis;        /* unit; flat density kernels are cylinders about it (kernels/volume_region.clh) */
    /* Of the density kernel in pass 0, by light class, scene units: radius across the axis and half height along it;
     * half height 0: a ball. */
    float kernelRadius[4], kernelHalfHeight[4];
    unsigned int firstPlane, planeCount; /* MediumPlane records that bound it with nothing inside; 0: not known */
    /* Of a medium without a border: ball about all that is in the scene, and a mean free path more. 1/scene unit; 0: it
     * has a border. */
    Packed3 sceneCenter;
    float inverseReach;
} Medium;

/* One of the phase functions that a medium's is the weighted sum of. */
typedef struct {
    unsigned int phase; /* PHASE_*, of one function */
    float g;
    float weight, weightCdf; /* share of this one; of all up to and including this one, last = 1 */
    /* PHASE_TABULATED: words from this record on. Densities, sr^-1, at equal steps of the cosine from -1 to 1, linear
     * between; then as many shares of the scattering below each. */
    unsigned int firstValue, valueCount;
} PhasePart;

/* A face of a medium that is a convex polyhedron: the inside has dot(normal, x) < offset. */
typedef struct {
    Packed3 normal; /* unit, outwards */
    float offset;
} MediumPlane;

/* Values at the centres of voxels (kernels/volume_grid.clh). As an extinction it fills its box, nothing beyond. */
#define VOLUME_NEAREST 0u /* filter */
#define VOLUME_TRILINEAR 1u
typedef struct {
    float toVoxels[12];      /* rows: from the world to places where voxel (i, j, k) covers i to i + 1 and so on */
    Packed3 lower, upper;    /* box in the world */
    unsigned int size[3];    /* voxels along x, y, z */
    unsigned int channels;   /* 1 or 3, side by side */
    unsigned int filter;     /* VOLUME_* */
    unsigned int wrap;       /* WRAP_*: beyond the voxels */
    unsigned int firstValue; /* words from this record on; x fastest */
} VolumeGrid;

/* Known mistakes, switched on by tests as negative controls: 1 flux at collisions is not divided by the extinction, 2
 * refracted radiance is not scaled by 1/eta^2, 3 the phase function has the wrong sign of g where photons are taken, 4
 * flux in a heterogeneous medium is divided by the mean of its extinction, 5 (medium_place.clh), 6 (camera.clh), 7
 * those that survive roulette far outside do not carry the flux of those that it ended, 8 density kernels end at null
 * surfaces that have the same medium on both sides. */
#ifndef MEDIUM_RULE
#define MEDIUM_RULE 0
#endif

/* ---- textures: factors of reflectance that vary over a surface --------------------------------------------------- */

#define TEXTURE_CHECKERBOARD 0u
#define TEXTURE_BITMAP 1u
#define TEXTURE_VERTEX_ATTRIBUTE 2u /* of meshes: by vertex, linear between; and by face */
#define TEXTURE_FACE_ATTRIBUTE 3u
#define TEXTURE_VOLUME 4u  /* of places in the world, not of texture coordinates */
#define TEXTURE_NEAREST 0u /* filter */
#define TEXTURE_BILINEAR 1u
#define WRAP_REPEAT 0u
#define WRAP_MIRROR 1u
#define WRAP_CLAMP 2u

typedef struct {
    unsigned int type;    /* TEXTURE_* */
    float toU[3], toV[3]; /* looked up at (toU . (u, v, 1), toV . (u, v, 1)) */
    Rgb color0, color1;   /* checkerboard: of the square at the origin, of its neighbours */
    /* And 1 + index of a Texture that is there instead; 0: none. */
    unsigned int texture0, texture1;
    unsigned int filter, wrap;  /* bitmap */
    unsigned int width, height; /* bitmap, pixels */
    /* Bitmap: rows from v = 0 on, each from u = 0 on. Attribute: word in the table of attributes, where by shape it is
     * said in which word of that table its colours begin, one a face or one a corner. Volume: word of its VolumeGrid
     * there. */
    unsigned int firstTexel;
} Texture;

/* ---- emitters ------------------------------------------------------------------------------------------------- */

#define EMITTER_RECTANGLE 0u   /* emits on the side of `normal`; sampled by solid angle */
#define EMITTER_TRIANGLES 1u   /* any other mesh; sampled by area */
#define EMITTER_SPHERE 2u      /* origin, radius; emits outwards (inwards if normalSign < 0); sampled by solid angle */
#define EMITTER_POINT 3u       /* origin; radiance field holds the intensity in W sr^-1 */
#define EMITTER_DIRECTIONAL 4u /* parallel light; radiance field holds its irradiance; the rest as EMITTER_CONSTANT */
/* The same radiance from everywhere outside; origin, radius: sphere about the scene; area: of its great disc. At most
 * one, the last of the table. */
#define EMITTER_CONSTANT 5u
/* As EMITTER_CONSTANT, but for the radiance, which is that of an EnvironmentMap; radiance: its mean over the sphere;
 * edgeU, edgeV, normal: the map's own x, y, z in the world, unit. At most one of both. */
#define EMITTER_ENVMAP 6u
/* As EMITTER_POINT, but for the intensity, which falls off with the angle to `normal`. Its texture is looked up at 1/2
 * + (d . edgeU, d . edgeV) / (d . normal) in the direction d. */
#define EMITTER_SPOT 7u
/* As EMITTER_POINT, but for the intensity: radiance over cos^3 of the angle to `normal`, times the texture, which is
 * looked up as that of EMITTER_SPOT; none outside of its unit square. `area`: of the square, at depth 1; cutoffAngle: of
 * its corners from `normal`. */
#define EMITTER_PROJECTOR 8u
/* As EMITTER_TRIANGLES, but along the normals of the triangles only; radiance field holds the irradiance across the
 * beam; normal: that of all triangles, unit, or 0 where they differ. */
#define EMITTER_DIRECTIONALAREA 9u
/* Intensity of a GoniogramTable times radiance, from its luminous shape about origin; edgeU, edgeV, normal: x, y, z of
 * the table in the world, unit; radius: of a sphere about the shape. At an angle a from `normal` its intensity is at
 * most that of a surface which looks cutoffAngle nearer to it: cos(a - cutoffAngle) of the largest one. */
#define EMITTER_GONIOGRAM 10u
/* Instead of an index, of shapes that the camera looks through as it does through those that emit (hide_emitters). */
#define EMITTER_OFF 0xfffffffeu

typedef struct {
    unsigned int type;
    unsigned int shape;   /* QL_NONE for a point, parallel light and the surroundings */
    Rgb radiance;         /* point: radiant intensity; parallel light: irradiance */
    Packed3 origin;       /* rectangle: corner; sphere, point: centre */
    Packed3 edgeU, edgeV; /* rectangle: sides, orthogonal */
    Packed3 normal;       /* rectangle: unit normal of the emitting side; parallel light: where it travels */
    float area;
    float radius;
    float normalSign;
    float selectionProbability;                /* in proportion to power; beams: host/prepare/flatten_emitters.cpp */
    float selectionCdf;                        /* sum of the probabilities up to and including this emitter; last = 1 */
    unsigned int firstTriangle, triangleCount; /* into EmitterTriangle */
    unsigned int medium;                       /* into which it emits: index, MEDIUM_NONE or MEDIUM_BY_PLACE */
    float beamAngle, cutoffAngle; /* spot: full intensity up to beamAngle, none beyond cutoffAngle, which is larger */
    unsigned int directByPhotons; /* 1: genuine diffuse lobes take its direct light from photons, not by sampling it */
    unsigned int texture;         /* 1 + index of the Texture that multiplies `radiance`; 0: none */
    unsigned int goniogram;       /* word at which its GoniogramTable begins */
} Emitter;

typedef struct {
    Packed3 p0, e1, e2; /* the emitting side is the one of cross(e1, e2) */
    float areaCdf;      /* share of the emitter's area up to and including this triangle; last = 1 */
} EmitterTriangle;

/* Radiance from outside, by direction (kernels/emitters/envmap.clh). The words of its tables are counted from here on.
 * There are two, which share the texels: by the first one directions are sampled in proportion to the radiance, by the
 * second to what exceeds its mean, for direct light that directions of the lobes find too (Karlik et al. 2019, "MIS
 * Compensation"). */
#define ENVMAP_BLOCK 64
typedef struct {
    unsigned int width, height; /* pixels, at least 1 x 2 */
    unsigned int texels;        /* Rgb, row by row from its own +y on */
    /* Cells by which directions are sampled: those between its pixels, width by height - 1, or fewer. Of fewer there are
     * weights at their corners, floats, row by row; 0: the pixels' own. */
    unsigned int cellsAcross, cellsDown, weights;
    /* Floats, sums of probabilities: of the rows of cells; in each of them of its cells; of those every ENVMAP_BLOCK-th
     * and the last one. */
    unsigned int rows, columns, blocks;
    float base; /* subtracted from the weights: 0, or their mean over the sphere */
} EnvironmentMap;

/* What the light of a GoniogramTable is sent from, about its own axes. */
#define LUMINOUS_POINT 0u
#define LUMINOUS_BOX 1u   /* or a rectangle, flat */
#define LUMINOUS_ROD_X 2u /* a cylinder along x, elliptic; or, flat, an ellipse */
#define LUMINOUS_ROD_Y 3u
#define LUMINOUS_ROD_Z 4u
#define LUMINOUS_ELLIPSOID 5u /* its surface */

/* Intensities by direction (kernels/emitters/goniogram.clh). The words of its tables follow, and are counted from here
 * on. */
typedef struct {
    unsigned int rows, columns;    /* angles from the pole and about it, at least 2 each */
    unsigned int polars, azimuths; /* floats: these angles, radians, from 0 to pi and to 2 pi; equal ones are a jump */
    unsigned int sines;            /* floats: of the former */
    unsigned int intensities;      /* floats: by azimuth, rows of each side by side */
    unsigned int rowSums,
        columnSums;     /* floats, sums of probabilities: of rows - 1 rows of cells; of columns - 1 in each of them */
    unsigned int shape; /* LUMINOUS_* */
    Packed3 halfSize;   /* of the shape, scene units */
} GoniogramTable;

/* Of a tree over emitters (kernels/light_tree.clh), which lie in its order: of a node of n of them the first child has
 * the first n / 2 and follows it, the second one comes 2 (n / 2) nodes after it. */
typedef struct {
    Packed3 lower, upper;       /* box about the emitters */
    Packed3 axis;               /* of a cone that holds the normals of their emitting sides */
    float cosSpread, sinSpread; /* of its half angle */
    float power;
} LightNode;

/* ---- light classes (kernels/law.clh) ----------------------------------------------------------------------------- */

#define LIGHT_DIRECT 0u
#define LIGHT_CAUSTIC 1u
#define LIGHT_QUASI_CAUSTIC 2u
#define LIGHT_DIFFUSE 3u
#define LIGHT_CLASSES 4
#define FILM_EMISSION 4u /* emitters seen straight or through specular events; a film component, not a photon class */
#define FILM_COMPONENTS 5

#ifdef __cplusplus
} // namespace quasilux::shared
#endif
#endif
