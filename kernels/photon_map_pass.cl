/* A pass of --map photons as one program: the compiler reads what the stages share only once. The order matters, since
 * a file is included where it is first named, and later ones name some under conditions that do not hold. */
#include "photon_map.cl"

#include "camera_paths.cl"

#include "photon_trace.cl"

#ifdef LEARNS
#include "importance_paths.cl"

#include "importance_records.cl"
#endif

#ifdef ADAPTIVE_RADIUS
#include "adaptive_radius.cl"
#endif
