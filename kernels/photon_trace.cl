/* Stage 1 of a pass: trace photons from the emitters and store them by class.
 * From: emitters. To: photons in blocks, chained in an order that is the region's own (so the result does not depend on
 * scheduling). */
#include "photon_trace.clh"

__kernel void tracePhotons(__global const BvhNode* nodes, __global const PrimitiveBlock* blocks,
                           __global const uint* tables, __global uint* photons, __global uint* photonBlocks,
                           __global RegionCount* counts, const PhotonParams params
#ifdef HAS_METER_PHOTONS
                           ,
                           __global uint* meterSums, const float quantaPerRadiance
#endif
) {
    const uint region = get_global_id(0);
    if (region >= params.regions) return;
    PhotonSink sink;
    const PhotonStore store = {photons, photonBlocks, params.photonBlocks, params.photonStride, params.perFluxUnit};
    sink.store = store;
#ifdef HAS_METER_PHOTONS
    sink.meter.sums = meterSums;
    sink.meter.quantaPerIrradiance = quantaPerRadiance * params.scene.meter.samples * M_1_PI_F;
#endif
    const PhotonWorld world = {nodes, blocks, tables, &params};
    traceRegion(region, &world, &sink, counts);
}
