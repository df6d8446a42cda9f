// Files of volumes, spectra, luminaires, weather and grids.
#include "fuzz/input_files.h"
#include "fuzz/targets.h"

#include "photometry/grid_values.h"
#include "scene/goniograms/goniogram.h"
#include "scene/skies/weather_file.h"
#include "scene/spectrum/spectrum.h"
#include "scene/volumes/vol_file.h"

namespace quasilux::fuzz {

namespace {

const SourceLocation mention{"scene.xml", 1, 1};

} // namespace

void readVol(std::string_view input) {
    expectInputErrors([&] { readVolFile(write("a.vol", input), mention); });
}

void readSpectrum(std::string_view input) {
    expectInputErrors([&] { readSpectrumFile(write("a.spd", input), mention); });
    expectInputErrors([&] { parseSpectrum(std::string(input), mention, "spectrum"); });
}

void readIesFile(std::string_view input) {
    expectInputErrors([&] {
        const Goniogram goniogram = readGoniogram(write("a.ies", input), mention);
        goniogram.intensity({0.6, 0, 0.8});
    });
}

void readEulumdatFile(std::string_view input) {
    expectInputErrors([&] {
        const Goniogram goniogram = readGoniogram(write("a.ldt", input), mention);
        goniogram.intensity({0.6, 0, 0.8});
    });
}

void readWeather(std::string_view input) {
    expectInputErrors([&] { readWeatherHour("a.epw", std::string(input), 6, 21, 12, mention); });
}

void readGrid(std::string_view input) {
    const std::string path = write("a.csv", input);
    expectInputErrors([&] { readGridTable(path, GridQuantity::illuminance); });
    expectInputErrors([&] { readGridTable(path, GridQuantity::daylightFactor); });
}

} // namespace quasilux::fuzz
