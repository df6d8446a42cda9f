#include "render/film_image.h"

#include <stdexcept>

namespace quasilux {

std::string componentName(unsigned component) {
    switch (component) {
    case LIGHT_DIRECT:
        return "direct";
    case LIGHT_CAUSTIC:
        return "caustic";
    case LIGHT_QUASI_CAUSTIC:
        return "quasi_caustic";
    case LIGHT_DIFFUSE:
        return "diffuse";
    case FILM_EMISSION:
        return "emission";
    default:
        throw std::out_of_range("film component " + std::to_string(component) + " does not exist");
    }
}

} // namespace quasilux
