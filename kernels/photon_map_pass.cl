/* The kernels of a pass of --map photons that depend on the scene as one program: the compiler reads what the stages
 * share only once. The others are programs of their own (host/render/pass_program.cpp). The order matters, since a file
 * is included where it is first named, and later ones name some under conditions that do not hold. */
#include "photon_map.cl"

#include "camera_paths.cl"

#include "photon_trace.cl"

#ifdef LEARNS
#include "importance_paths.cl"

#include "importance_records.cl"
#endif
