/* Kernels that are the same for every scene: a program of their own, without options, so they are compiled once. */
#include "record_sort.cl"

#include "importance_cells.cl"
