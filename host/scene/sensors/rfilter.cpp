// <rfilter>: the reconstruction filters of Mitsuba. Each is a product of the same function along both axes.
#include "scene/plugin_lookup.h"
#include "scene/sensors/sensors.h"

#include <cmath>
#include <numbers>

namespace quasilux {

namespace {

void readBox(Properties&, Sensor& sensor) {
    sensor.filter = FILTER_BOX;
    sensor.filterRadius = 0.5;
    sensor.filterShape = [](double) { return 1.0; };
}

void readTent(Properties& properties, Sensor& sensor) {
    sensor.filter = FILTER_TABLE;
    const double radius = sensor.filterRadius = properties.numberAbove("radius", 1, 0, true);
    sensor.filterShape = [radius](double x) { return 1 - x / radius; };
}

void useGaussian(Sensor& sensor, double stddev) {
    sensor.filter = FILTER_TABLE;
    sensor.filterRadius = 4 * stddev;
    sensor.filterShape = [stddev](double x) { return std::exp(-x * x / (2 * stddev * stddev)); };
}

void readGaussian(Properties& properties, Sensor& sensor) {
    useGaussian(sensor, properties.numberAbove("stddev", 0.5, 0, true));
}

/// Mitchell and Netravali 1988, "Reconstruction Filters in Computer Graphics", equation 8, times 6.
double mitchell(double x, double b, double c) {
    const double square = x * x, cube = square * x;
    if (x < 1) return (12 - 9 * b - 6 * c) * cube + (-18 + 12 * b + 6 * c) * square + (6 - 2 * b);
    return (-b - 6 * c) * cube + (6 * b + 30 * c) * square + (-12 * b - 48 * c) * x + (8 * b + 24 * c);
}

void useMitchell(Sensor& sensor, double b, double c) {
    sensor.filter = FILTER_TABLE;
    sensor.filterRadius = 2;
    sensor.filterShape = [b, c](double x) { return mitchell(x, b, c); };
}

/// The integral of equation 8 is 1 whatever b and c; but where its lobes are large, samples cancel each other.
double readMitchellParameter(Properties& properties, const std::string& name) {
    const double value = properties.number(name, 1.0 / 3);
    if (value < 0 || value > 1)
        throw InputError(properties.where(name), fmt::format("parameter '{}' of {} is {}; expected 0 to 1.", name,
                                                             properties.describe(), value));
    return value;
}

void readMitchell(Properties& properties, Sensor& sensor) {
    const double b = readMitchellParameter(properties, "B"), c = readMitchellParameter(properties, "C");
    useMitchell(sensor, b, c);
}

void readCatmullRom(Properties&, Sensor& sensor) { useMitchell(sensor, 0, 0.5); }

/// sinc(x) sinc(x / lobes).
void readLanczos(Properties& properties, Sensor& sensor) {
    sensor.filter = FILTER_TABLE;
    const double lobes = sensor.filterRadius = properties.numberAbove("lobes", 3, 1, false);
    sensor.filterShape = [lobes](double x) {
        const double angle = std::numbers::pi * x;
        return x > 0 ? std::sin(angle) * std::sin(angle / lobes) * lobes / (angle * angle) : 1.0;
    };
}

struct FilterPlugin {
    std::string_view name;
    void (*read)(Properties&, Sensor&);
};
constexpr FilterPlugin filterPlugins[] = {
    {"box", readBox},
    {"tent", readTent},
    {"gaussian", readGaussian},
    {"mitchell", readMitchell},
    {"catmullrom", readCatmullRom},
    {"lanczos", readLanczos},
};

} // namespace

Names filterPluginNames() { return namesOf(filterPlugins); }

void readFilter(const Element* element, LoadContext& context, Sensor& sensor) {
    if (!element) return useGaussian(sensor, 0.5);
    const FilterPlugin& plugin = findPlugin(filterPlugins, *element);
    Properties properties(*element, context);
    plugin.read(properties, sensor);
    constexpr double maximumRadius = 16;
    if (sensor.filterRadius > maximumRadius)
        throw InputError(element->where, fmt::format("the filter reaches {} pixels; at most {} are supported.",
                                                     sensor.filterRadius, maximumRadius));
    properties.finish();
}

} // namespace quasilux
