// Renders some passes of a scene by the installed libraries and prints the image's mean.
#include "device/device.h"
#include "render/renderer.h"
#include "scene/scene.h"

#include <cstdio>
#include <numeric>

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    const quasilux::Scene scene = quasilux::loadScene(argv[1], {{"resolution", "16"}});
    quasilux::Device device;
    quasilux::Renderer renderer(device, scene, quasilux::settingsFromScene(scene));
    for (unsigned pass = 0; pass < 4; ++pass) renderer.renderPass(pass);
    const quasilux::FilmImage image = renderer.develop();
    const double sum = std::accumulate(image.radiance.begin(), image.radiance.end(), 0.0);
    std::printf("%.6g\n", sum / static_cast<double>(image.radiance.size()));
}
