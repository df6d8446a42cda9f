/* Learning, step 2: the numbers by which sources emit the rays that importance paths (importance_paths.cl) and the
 * photons of learning found. */
#include "guide.clh"

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
