// A pass of a render: one independent estimate of the image, added to the film. There are three kinds, by a photon map
// for camera paths or for meters and by a map of camera points; only makePass() tells them apart.
#pragma once

#include "device/program.h"
#include "render/film.h"
#include "render/gathered_photons.h"
#include "render/geometry_buffers.h"
#include "render/memory_plan.h"
#include "render/radius_schedule.h"
#include "render/render_counters.h"
#include "render/sampling_gain.h"
#include "util/state_archive.h"

#include <memory>

namespace quasilux {

/// What passes of all kinds work with. It outlives them.
struct PassContext {
    Device& device;
    const Program& program;
    const GeometryBuffers& geometry;
    const DeviceScene& flat;
    const RenderSettings& settings;
    const RadiusSchedule& radii;
    const shared::RadiusField& field;
    Film& film;
    const BufferSizes& buffers; ///< of the render so far
    unsigned classes;           ///< bits 1 << slot of the photons that kernels know
    shared::CameraParams camera;
    shared::PhotonParams photons;
};

class Pass {
public:
    virtual ~Pass() = default;

    /// Adds the estimate of this number to the film, and to the counters what it counted; passes and seconds are the
    /// caller's.
    virtual void run(unsigned pass, RenderCounters& counters) = 0;
    /// That each pass has traced, of all pixels.
    virtual uint64_t cameraPaths() const = 0;
    /// PassPart::count of each.
    virtual unsigned photonParts() const { return 1; }
    /// Memory that all passes will take, known once the pass is made.
    const MemoryForecast& forecast() const { return forecast_; }

    /// Seconds that a camera path of each pixel takes without gathering photons; 0 where it gathers none anyway, or
    /// passes have no more than one. It leaves what is no part of the image in the film.
    virtual double secondsWithoutGathering() { return 0; }
    /// What camera paths by pixel would gain, with so many of the mean pixel; nothing where passes have no more than
    /// one. No pass may follow.
    virtual SamplingGain samplingGain(unsigned /*paths*/) { return {}; }
    /// Which photons of this pass its camera paths gather; none where nothing is gathered.
    virtual std::optional<GatheredCount> countGathered(unsigned /*pass*/) { return std::nullopt; }
    /// Radii by pixel are what passes leave besides the film. Are they those of all passes to come?
    virtual bool radiiAreChosen() const { return true; }
    virtual void saveRadii(StateSink& /*sink*/) const {}
    virtual void restoreRadii(const StateSource& /*source*/) {}

protected:
    MemoryForecast forecast_;
};

/// The kind that sensor and settings ask for, with its kernels compiled. Throws InputError where a pass does not fit
/// into the device's memory.
std::unique_ptr<Pass> makePass(const PassContext& context);

/// All buffers, of which `untouched` bytes are still to become resident: those of a CPU device are memory of this
/// process.
MemoryForecast forecastOf(const PassContext& context, const BufferSizes& sizes, uint64_t untouched);

} // namespace quasilux
