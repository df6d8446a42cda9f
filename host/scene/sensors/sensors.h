// Reading of the sensor and its film.
#pragma once

#include "scene/properties.h"

namespace quasilux {

/// Reads <sensor> with its film. Throws InputError for anything but a perspective camera with an hdrfilm.
Sensor readSensor(const Element& element, LoadContext& context);

/// Size and reconstruction filter.
void readFilm(const Element& element, LoadContext& context, Sensor& sensor);

/// Accepts any sampler of Mitsuba: quasilux draws its own numbers.
void readSampler(const Element& element, LoadContext& context);

} // namespace quasilux
