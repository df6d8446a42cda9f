// Density radii of a render: those of pass 0 by how photons lie about what the camera sees, or by the scene's area; of
// later passes by their number alone. Radii by pixel are multiples of them (adaptive_radius.h).
#pragma once

#include "learn/learning.h"
#include "render/settings.h"

namespace quasilux {

class RadiusSchedule {
public:
    RadiusSchedule(const DeviceScene& flat, const RenderSettings& settings, const LearnedScene& learned);

    /// Of pass 0, scene units.
    double first(unsigned lightClass) const { return first_[lightClass]; }
    /// Of pass 0, where photons were spread evenly over all surfaces.
    double firstByArea() const { return firstByArea_; }

    std::array<float, LIGHT_CLASSES> radii(unsigned pass) const;
    /// Of kernels in media to their first size.
    float volumeScale(unsigned pass) const;

private:
    double scale_; ///< RenderSettings::radiusScale
    double firstByArea_;
    std::array<double, LIGHT_CLASSES> first_{};
};

} // namespace quasilux
