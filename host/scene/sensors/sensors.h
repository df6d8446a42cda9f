// Reading of the sensor and its film. A new plugin is one file here and one line in the table of sensors.cpp (docs/reference/scene-language.md).
#pragma once

#include "scene/properties.h"

namespace quasilux {

/// Reads <sensor> with its film; `shape` is the index of the shape that it stands in. Throws InputError for unknown
/// plugins, parameters and films.
Sensor readSensor(const Element& element, LoadContext& context, std::optional<unsigned> shape);

/// What each plugin has of its own; size of the film and clipping planes are known already.
void readPerspective(Properties& properties, Sensor& sensor);
void readThinLens(Properties& properties, Sensor& sensor);
void readOrthographic(Properties& properties, Sensor& sensor);
void readRadiancemeter(Properties& properties, Sensor& sensor);
void readIrradiancemeter(Properties& properties, Sensor& sensor);

/// Size, crop window, reconstruction filter, what the image holds.
void readFilm(const Element& element, LoadContext& context, Sensor& sensor);
/// Mitsuba's default where there is no element.
void readFilter(const Element* element, LoadContext& context, Sensor& sensor);

/// Accepts any sampler of Mitsuba: quasilux draws its own numbers.
void readSampler(const Element& element, LoadContext& context);

} // namespace quasilux
