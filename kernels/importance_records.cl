/* Learning, steps 2 and 3: what becomes of what importance paths found.
 * From: importance paths (importance_paths.cl) and the photons of learning. To: the numbers by which sources emit such
 * rays, and the cells of the importance grid where paths were. */
#include "guide.clh"
#include "importance.clh"

/* The first source of an emitter; sources are in the order of their emitters. */
inline uint firstSource(__global const GuideSource* sources, uint count, uint emitter) {
    uint first = 0, last = count;
    while (first < last) {
        const uint middle = first + (last - first) / 2;
        if (sources[middle].emitter < emitter)
            first = middle + 1;
        else
            last = middle;
    }
    return first;
}

/* The numbers of the rays that importance paths found, in the coordinates of the source that is to emit them. */
__kernel void invertEmission(__global const uint* tables, __global const EmissionRecord* records,
                             __global const GuideSource* sources, const uint sourceCount,
                             __global EmissionPoint* points, const SceneTables scene, const uint count) {
    const uint index = get_global_id(0);
    if (index >= count) return;
    const EmissionRecord record = records[index];
    EmissionPoint point;
    point.source = QL_NONE;
    Rng rng = rngMake(0, 0, STREAM_SPARE, index);
    const float2 spare = rngNext2(&rng);
    __global const Emitter* emitters = SCENE_TABLE(tables, &scene, Emitter, emitters);
    const EmitterData data = emitterData(tables, &scene);
    for (uint k = firstSource(sources, sourceCount, record.emitter);
         k < sourceCount && sources[k].emitter == record.emitter && point.source == QL_NONE; ++k) {
        const float3 position = load3(record.position), direction = load3(record.direction);
        if (!holdsRay(sources + k, emitters + record.emitter, position, direction)) continue;
        const EmissionNumbers u = invertSource(emitters + record.emitter, &data, sources + k, record.element, position,
                                               direction, (float3)(rngNext(&rng), spare));
        point.source = k;
        point.numbers[0] = u.part;
        point.numbers[1] = u.position.x;
        point.numbers[2] = u.position.y;
        point.numbers[3] = u.direction.x;
        point.numbers[4] = u.direction.y;
    }
    points[index] = point;
}

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
