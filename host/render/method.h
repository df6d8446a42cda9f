// From the scene's features and the settings to what the kernels are compiled for: classes of photons and options.
#pragma once

#include "device/device.h"
#include "prepare/device_scene.h"
#include "render/settings.h"

#include <string>

namespace quasilux {

/// Bits 1 << LIGHT_* of the photons that some camera path can use; the others are not stored (kernels/law.clh).
unsigned photonClasses(const Features& features, const RenderSettings& settings);

/// The same and those of other splits and variants that share these kernels, RenderSettings::furtherClasses. Where none
/// are in use themselves, the kernels find an empty map.
unsigned compiledClasses(const Features& features, const RenderSettings& settings);

/// Why camera paths cannot find the caustic light themselves, with CausticLight::paths; empty where they can. They take
/// it by meeting emitters after specular events alone since the hit that takes it, so nothing but specular events may
/// be left to photons.
std::string whyNotCausticsByPaths(const Scene& scene, const Features& features, const RenderSettings& settings);

/// Do the kernels estimate the bias that the density radius leaves? Neither in the camera map nor of a meter's
/// readings.
bool estimatesBias(const Features& features, const RenderSettings& settings);
/// Of the image's film: what the settings ask it to keep, as far as there is such a thing.
FilmLayout filmLayout(const Features& features, const RenderSettings& settings);
/// Bytes that one of its buffers may have. Only camera paths of the photon map add to a part of the film at a time.
uint64_t largestFilmBuffer(const Features& features, const RenderSettings& settings, const DeviceInfo& device);
/// Is the density radius chosen by pixel?
bool adaptsRadius(const Features& features, const RenderSettings& settings);
/// Do pixels share samples, as their filter is wider than one (kernels/shared_samples.clh)?
bool sharesSamples(const Features& features, const RenderSettings& settings);

/// Is it learned before pass 0 where photons serve the image? Only where kernels know photons.
bool learns(const Features& features, const RenderSettings& settings);
/// Whether direct light of some emitters may be taken from photons, that of others by sampling them.
bool mayTakeDirectFromPhotons(const Features& features, const RenderSettings& settings);

/// An irradiance meter scatters by its variant: genuine diffuse in the main one, else quasi-specular (meterScattering,
/// kernels/law.clh).
bool meterIsGenuineDiffuse(const Features& features, const RenderSettings& settings);

/// Whether photons that cross an irradiance meter are counted there (kernels/meter_photons.clh).
bool meterCountsPhotons(const Features& features, const RenderSettings& settings);
/// Whether caustics or quasi-caustics are among them.
bool meterCountsCaustics(const Features& features, const RenderSettings& settings);

/// What the kernels are compiled for: what the scene needs, or everything.
Features compiledFeatures(const DeviceScene& scene, const RenderSettings& settings);

/// Do photons say how many events they have had?
bool storesDepth(const DeviceScene& scene, const RenderSettings& settings);

/// Compiler options shared by all stages.
std::string kernelOptions(const DeviceScene& scene, const RenderSettings& settings);

/// A few for every camera path, but `fewest` at least.
unsigned photonsForPixels(const shared::Camera& camera, unsigned fewest);

/// Photons emitted per pass: what the user said, else by pixels, but enough to keep a device busy.
unsigned photonsPerPass(const RenderSettings& settings, const shared::Camera& camera);
/// Paths of a meter's pixel in each pass, a power of two; 1 of a camera.
unsigned meterSamples(const DeviceScene& scene, const RenderSettings& settings);

} // namespace quasilux
