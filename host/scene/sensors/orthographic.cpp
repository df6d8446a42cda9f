// <sensor type="orthographic">: parallel rays; to_world scales the [-1, 1] that the film is wide.
#include "scene/sensors/sensors.h"

namespace quasilux {

void readOrthographic(Properties& properties, Sensor& sensor) {
    sensor.orthographic = true;
    sensor.toWorld = properties.transform("to_world");
}

} // namespace quasilux
