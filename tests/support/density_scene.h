// Hand-made surfaces, prepared by the host as for a render, and density estimates on them by the kernels.
#pragma once

#include "bench/micro/traced_photons.h"
#include "device/buffer.h"
#include "prepare/device_scene.h"

#include <functional>
#include <glm/glm.hpp>
#include <random>

namespace quasilux {

/// As tests/kernels/density.cl reads them.
struct RegionQuery {
    shared::Packed3 position, normal;
    unsigned primitive; ///< which the point lies on
    float radius;
    unsigned firstPatch = 0; ///< of the primitive's instance
};

inline constexpr unsigned densitySectors = 32;
struct RegionAnswer {
    float kernelIntegral, radiusSquared;
    unsigned bordered;
    shared::Packed3 axisS, axisT;
    float correctionA, correctionB, correctionC;
    float reachSquared[densitySectors];
};

struct Estimate {
    float byRegion;
    float sloped; ///< by region, where irradiance is 5 + x
    float byDisc; ///< as if there were no borders
};

/// Photons on what is not hidden: red flux 1 per unit of area, green 5 + x.
struct UniformPhotons {
    std::vector<TracedPhoton> photons;
    float fluxUnit = 1; ///< of theirs
    double density = 0; ///< photons per unit of area
};

class DensityScene {
public:
    /// Every shape becomes Lambert; `radius` is the largest of any query.
    DensityScene(Scene scene, float radius);

    std::vector<RegionAnswer> regions(const std::vector<RegionQuery>& queries);
    std::vector<Estimate> estimates(const std::vector<RegionQuery>& queries, const UniformPhotons& photons,
                                    const std::string& options = "");

    /// `count` points over the area of all shapes, on the front, those where `hidden` (point, primitive) left out.
    using Hidden = std::function<bool(glm::dvec3, unsigned)>;
    UniformPhotons lightUp(unsigned count, const Hidden& hidden, std::mt19937& random) const;

    unsigned patchOf(unsigned primitive) const;

private:
    Scene scene_;
    float radius_;
    DeviceScene device_;
    Buffer<shared::BvhNode> nodes_;
    Buffer<shared::PrimitiveBlock> blocks_;
    Buffer<uint32_t> tables_;
};

} // namespace quasilux
