// Cameras, meters, grids and observers as a scene file says them: a part of the scene (scene.h).
#pragma once

#include "sensor_types.h"
#include "util/error.h"

#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>

namespace quasilux {

/// What a sensor measures that is no camera.
enum class MeterKind { none, ray, area, grid };
/// Or else it measures radiance.
inline bool isIrradiance(MeterKind meter) { return meter == MeterKind::area || meter == MeterKind::grid; }

/// What is measured at the points of a grid: illuminance of its plane, or the mean of that of all planes that hold its
/// normal.
enum class IlluminanceKind { planar, cylindrical };

/// <?quasilux illuminance-grid …?>: points at the centres of nx × ny equal cells of a parallelogram, all of one normal.
struct IlluminanceGrid {
    SourceLocation where;
    std::string name; ///< in tables and reports; of one scene each another
    IlluminanceKind kind = IlluminanceKind::planar;
    glm::dvec3 origin{}, edgeU{},
        edgeV{}; ///< corner and sides, world space; column i lies along edgeU, row j along edgeV
    unsigned nx = 0, ny = 0;
    bool flipNormals = false; ///< the normal is edgeU × edgeV, or its opposite
    double height = 0;        ///< cylindrical: of the cells in which photons are counted, half of it on each side

    size_t points() const { return size_t{nx} * ny; }
    glm::dvec3 point(unsigned i, unsigned j) const { return origin + (i + 0.5) / nx * edgeU + (j + 0.5) / ny * edgeV; }
    glm::dvec3 normal() const {
        const glm::dvec3 n = glm::normalize(glm::cross(edgeU, edgeV));
        return flipNormals ? -n : n;
    }
};

/// <?quasilux observer …?>: an eye that glare is rated for.
struct Observer {
    SourceLocation where;
    std::string name;
    glm::dvec3 position{}, direction{0, 1, 0}, up{0, 0, 1}; ///< world space; the last two are unit
    double size = 0.1;                                      ///< side of the square that light is measured on at the eye
};

/// What the image holds beside R, G, B.
struct PixelFormat {
    bool luminance = false, xyz = false, alpha = false;
};

struct Sensor {
    SourceLocation where;
    std::string plugin = "perspective";
    MeterKind meter = MeterKind::none;
    unsigned meterShape = 0;   ///< MeterKind::area: which lies on it
    glm::dmat4 toWorld{1.0};   ///< looks along its local +z, +y up, +x to the LEFT of the image (Mitsuba)
    bool orthographic = false; ///< parallel rays from local x in [-1, 1]; else perspective, or a fisheye
    unsigned fisheye = FISHEYE_NONE;
    double fovX = 0;              ///< perspective, fisheye: full horizontal angle, radians (fov_axis already resolved)
    glm::dvec2 principalPoint{0}; ///< perspective: of the film's size, by how much the view lies to the right and down
    double apertureRadius = 0;    ///< of a thin lens, scene units; 0: a pinhole
    double focusDistance = 0;     ///< and depth of the plane that is sharp
    double nearClip = 1e-2, farClip = 1e4;
    unsigned width = 768, height = 576;         ///< pixels of the image: the film's, or those of its crop window
    unsigned filmWidth = 768, filmHeight = 576; ///< of the whole film, which the view is laid over
    unsigned cropX = 0, cropY = 0;              ///< of the film's pixels, where the image begins
    unsigned filter = FILTER_BOX;
    double filterRadius = 0.5;                 ///< pixels
    std::function<double(double)> filterShape; ///< along one axis, not normalised; FILTER_TABLE needs it
    bool filterEnds = false;                   ///< at the edge of the image: sample_border is false
    PixelFormat pixelFormat;
    std::optional<unsigned> medium; ///< as stated, index into Scene::media
};

} // namespace quasilux
