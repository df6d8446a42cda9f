// <sensor type="irradiancemeter">: the irradiance on the shape that it stands in.
#include "scene/sensors/sensors.h"

namespace quasilux {

void readIrradiancemeter(Properties& properties, Sensor& sensor) {
    properties.refuse("to_world", "the meter lies on its shape; move the shape instead");
    sensor.meter = MeterKind::area;
}

} // namespace quasilux
