/* A pass of --map photons as one program: the compiler reads what the stages share only once. photon_map.cl comes first,
 * since a file is included where it is first named, and the others name some of its files under conditions. */
#include "photon_map.cl"
#include "camera_paths.cl"
#include "photon_trace.cl"
