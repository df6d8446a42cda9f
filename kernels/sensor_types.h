/* The sensor: structs and constants that host and device share, as shared_types.h. */
#ifndef QUASILUX_SENSOR_TYPES_H
#define QUASILUX_SENSOR_TYPES_H

#include "shared_types.h"

#ifdef __cplusplus
namespace quasilux::shared {
#endif

/* ---- camera ---------------------------------------------------------------------------------------------------- */

#define FILTER_BOX 0u
#define FILTER_TABLE 1u /* any other: FilterStep records */
#define FILTER_CELLS 64 /* of the table, in a pixel */

/* Sums of a filter f along one axis up to the lower end of a cell, in units of the integral of |f|
 * (kernels/filter_table.clh). */
typedef struct {
    float magnitude; /* of |f| */
    float value;     /* of f */
} FilterStep;

/* How far from the middle of the image, in half widths r, a fisheye shows the angle theta; h is its `halfAngle`. */
#define FISHEYE_NONE 0u
#define FISHEYE_EQUIDISTANT 1u  /* r = theta / h */
#define FISHEYE_EQUISOLID 2u    /* r = sin(theta / 2) / sin(h / 2): each pixel has the same solid angle */
#define FISHEYE_ORTHOGRAPHIC 3u /* r = sin(theta) / sin(h): each pixel has the same share of the illuminance */

typedef struct {
    Packed3 origin; /* orthographic: centre of the near plane */
    /* Direction to the upper left corner of the image, at depth 1; orthographic: offset to it; fisheye: place of it
     * about the middle, in half widths, on the axes to the right and up. */
    Packed3 corner;
    Packed3 stepX, stepY;    /* direction per pixel, to the right and down; orthographic, fisheye: offset */
    Packed3 forward;         /* unit */
    float nearClip, farClip; /* depths along `forward`; fisheye: distances */
    unsigned int orthographic;
    unsigned int fisheye; /* FISHEYE_* */
    float halfAngle;      /* that a fisheye shows at the half width of its film */
    Packed3 lensX, lensY; /* from the centre of a thin lens to its rim; 0: a pinhole */
    float focusDistance;  /* of a thin lens: depth of the plane that is sharp */
    unsigned int width, height;
    unsigned int filter;      /* FILTER_* */
    float filterRadius;       /* pixels, box only */
    unsigned int filterSteps; /* FILTER_TABLE: word offset of its FilterStep records into the scene tables */
    unsigned int filterReach; /* and cells on either side of the pixel's centre */
    unsigned int filterEnds;  /* and 1: it ends at the edge of the image */
    unsigned int medium;      /* in which it stands: index, MEDIUM_NONE or MEDIUM_BY_PLACE */
} Camera;

/* ---- irradiance meters (kernels/meter.clh) ----------------------------------------------------------------------- */

#define METER_PARALLELOGRAM 0u
#define METER_TRIANGLE 1u
#define METER_SPHERE 2u

/* A piece of what a meter measures on. Its front is the side of sign * cross(e1, e2), of a sphere the outside if sign >
 * 0. */
typedef struct {
    unsigned int type;  /* METER_* */
    Packed3 p0;         /* corner; sphere: centre */
    Packed3 e1, e2, e3; /* sides; sphere: its own axes x, y, z in the world, unit */
    float radius;       /* sphere */
    float sign;
    float areaCdf; /* share of the meter's area up to and including this piece; last = 1 */
} MeterPrimitive;

#define GRID_PLANAR 0u      /* irradiance of the grid's plane */
#define GRID_CYLINDRICAL 1u /* mean of that of planes that hold the grid's normal */

/* Points of a grid: the centres of equal cells of a parallelogram. Its pixels lie one after the other, row by row. */
typedef struct {
    MeterPrimitive plane;
    unsigned int firstPixel, columns, rows;
    unsigned int quantity; /* GRID_* */
    unsigned int medium;   /* in which it lies: index, MEDIUM_NONE or MEDIUM_BY_PLACE */
    /* GRID_CYLINDRICAL: of the cells in which photons are counted, half of it on each side of the plane */
    float height;
    float inverseExtent; /* 1 / area of a cell; GRID_CYLINDRICAL: 1 / its volume */
} MeterGrid;

#define METER_NONE 0u /* the sensor is a camera */
#define METER_RAY 1u  /* radiance along the camera's one ray */
#define METER_AREA 2u /* irradiance: a pixel is a part of the surface */
#define METER_GRID 3u /* irradiance: a pixel is a point of a grid */

typedef struct {
    unsigned int kind; /* METER_NONE ... METER_GRID */
    /* MeterPrimitive records, of METER_GRID MeterGrid records: word offset into the scene tables, number */
    unsigned int primitives, primitiveCount;
    unsigned int width, height; /* pixels */
    unsigned int samples;       /* paths of a pixel in each pass, a power of two */
    unsigned int lobe;          /* a white Lambert lobe */
    unsigned int medium; /* METER_RAY, METER_AREA: in which the meter lies: index, MEDIUM_NONE or MEDIUM_BY_PLACE */
    float inverseArea;   /* METER_AREA: 1 / area of a pixel */
} Meter;

#ifdef __cplusplus
} // namespace quasilux::shared
#endif
#endif
