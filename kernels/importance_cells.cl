/* Learning, step 3: the cells of the importance grid where importance paths (importance_paths.cl) were. */
#include "importance.clh"

/* The keys of the importance grid's cells that each vertex lies in, fine and coarse, and the fine one's size; and of
 * the cell where each path gathers. */
__kernel void findImportanceCells(__global const ImportancePath* paths, __global uint* keys, __global float* sizes,
                                  __global uint* seenKeys, const ImportanceGrid grid, const uint count) {
    const uint index = get_global_id(0);
    if (index >= count) return;
    for (uint k = 0; k < IMPORTANCE_VERTICES; ++k) {
        const ImportanceVertex vertex = paths[index].vertices[k];
        const float3 position = load3(vertex.position);
        const uint place = index * IMPORTANCE_VERTICES + k;
        keys[2 * place] = vertex.weight > 0 ? importanceKey(&grid, position, vertex.face, 1) : 0;
        keys[2 * place + 1] = vertex.weight > 0 ? importanceKey(&grid, position, vertex.face, IMPORTANCE_COARSE) : 0;
        sizes[place] = vertex.weight > 0 ? importanceCellSize(&grid, position) : 1;
    }
    const ImportanceVertex gathers = paths[index].vertices[0];
    seenKeys[index] = gathers.weight > 0 ? importanceKey(&grid, load3(gathers.position), gathers.face, SEEN_COARSE) : 0;
}
