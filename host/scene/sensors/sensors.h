// Reading of the sensor and its film. A new plugin is one file here and one line in the table of sensors.cpp
// (docs/reference/scene-language.md).
#pragma once

#include "scene/properties.h"

namespace quasilux {

/// The film of a batch, whose sensors each have an equal part of its width.
struct SharedFilm {
    const Element* film = nullptr; ///< nullptr: the default one
    const Element* batch = nullptr;
    unsigned sensors = 1;
};

/// A sensor that is not read yet.
struct PlacedSensor {
    const Element* element = nullptr;
    std::optional<unsigned> shape; ///< that it lies on
    std::optional<SharedFilm> film;
};

/// What a <sensor> directly in the scene stands for: itself, or the sensors of a batch.
std::vector<PlacedSensor> placeSensors(const Element& element, LoadContext& context);

/// Reads a sensor with its film. Throws InputError for unknown plugins, parameters and films.
Sensor readSensor(const PlacedSensor& placed, LoadContext& context);

/// Throws InputError where the sensor has a spectral response.
void refuseResponse(Properties& properties);

/// Size, filter and format of one sensor's part of the film. Throws InputError where it cannot be divided.
void takeShareOfFilm(const SharedFilm& shared, LoadContext& context, Sensor& sensor);

Names sensorPluginNames();
Names filmPluginNames();
Names filterPluginNames();
Names samplerPluginNames();

/// What each plugin has of its own; size of the film and clipping planes are known already.
void readPerspective(Properties& properties, Sensor& sensor);
void readThinLens(Properties& properties, Sensor& sensor);
void readOrthographic(Properties& properties, Sensor& sensor);
void readFisheye(Properties& properties, Sensor& sensor);
void readRadiancemeter(Properties& properties, Sensor& sensor);
void readIrradiancemeter(Properties& properties, Sensor& sensor);

/// "equidistant", "equisolid" or "orthographic", as quasilux_fisheye and `quasilux dgp` name projections.
std::string fisheyeName(unsigned fisheye);

/// Size, crop window, reconstruction filter, what the image holds.
void readFilm(const Element& element, LoadContext& context, Sensor& sensor);
/// Mitsuba's default where there is no element.
void readFilter(const Element* element, LoadContext& context, Sensor& sensor);

/// Accepts any sampler of Mitsuba: quasilux draws its own numbers.
void readSampler(const Element& element, LoadContext& context);

} // namespace quasilux
