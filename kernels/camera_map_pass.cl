/* A pass of --map camera as one program, as photon_map_pass.cl. */
#define MAP_CAMERA
#define ONE_CELL_SIZE /* of points: discs are as large at all distances */
#include "camera_point_map.cl"

#include "camera_point_paths.cl"

#include "photon_splat.cl"

#ifdef LEARNS
#include "importance_paths.cl"

#include "importance_records.cl"
#endif
