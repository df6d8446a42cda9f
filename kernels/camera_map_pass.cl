/* A pass of --map camera as one program, as photon_map_pass.cl. */
#define MAP_CAMERA
#include "camera_point_map.cl"

#include "camera_paths.cl"

#include "photon_trace.cl"

#ifdef LEARNS
#include "importance_paths.cl"

#include "importance_records.cl"
#endif
