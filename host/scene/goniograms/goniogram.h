// Goniograms: what a luminaire's file says of it, whatever the format (docs/reference/photometry.md).
#pragma once

#include "util/error.h"

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace quasilux {

/// What light leaves the luminaire through, about its centre; metres, none negative.
struct LuminousShape {
    enum class Kind {
        point,
        box,        ///< flat, a rectangle, where height is 0
        uprightRod, ///< a cylinder along the axis; flat, an ellipse or a disc, where height is 0
        /// a cylinder that lies along C0, with a cross-section sizeC90 × height; a disc that faces C0 where sizeC0 is 0
        rodAlongC0,
        rodAlongC90, ///< likewise, with a cross-section sizeC0 × height
        ellipsoid
    };
    Kind kind = Kind::point;
    double sizeC0 = 0, sizeC90 = 0, height = 0; ///< along C0–C180, along C90–C270, along the axis

    /// Square metres that it covers seen along the unit vector `direction`; 0 where it is flat and seen edge-on, to a
    /// millionth of its sides.
    double projectedArea(const glm::dvec3& direction) const;
    /// Or else it is a point or a line, whose luminance has no bounds.
    bool hasArea() const;
    /// "rectangle 1.2 m × 0.6 m".
    std::string text() const;
};

/// One of the ways in which the luminaire is equipped.
struct LampSet {
    double lamps = 0;  ///< their number
    double lumens = 0; ///< of all of them
    double watts = 0;  ///< with their gear; 0: not said
    std::string name;
};

/// Factors on the intensities by the luminaire's tilt; empty: none.
struct TiltTable {
    std::vector<double> degrees, factors;
};

/// Candela over a sphere of directions about the luminaire. In its own frame the photometric axis (gamma = 0) is +z, C0
/// is +x and C90 is
/// -y: C runs counter-clockwise for who looks along the light, as LM-63 and CIE 121 have it of a luminaire seen from
///   above.
struct Goniogram {
    std::string path, format, luminaire;
    std::vector<std::string> warnings; ///< "file:line: …"

    /// Degrees from the grid's pole, from 0 to 180, and about it, from 0 to 360; none less than the one before. Two
    /// that are equal are the two sides of a jump.
    std::vector<double> polar, azimuth;
    std::vector<double> candela; ///< polar angles of an azimuth side by side
    glm::dmat3 axes{1.0}; ///< the grid's azimuth 0, its azimuth 90 and its pole in the luminaire's frame, orthonormal
    bool isOfAxis = true; ///< the pole is the photometric axis (type C)

    bool absolute = false;                 ///< intensities were measured, not scaled to the flux of the lamps
    std::vector<LampSet> lampSets;         ///< at least one
    size_t lampSet = 0;                    ///< that the intensities are of
    std::array<double, 10> directRatios{}; ///< of EULUMDAT, for room indices 0.6 to 5; 0 elsewhere
    double statedRatio = 0;                ///< of EULUMDAT: light output ratio in percent; 0: not said
    TiltTable tilt;
    LuminousShape shape;

    double at(size_t azimuthIndex, size_t polarIndex) const {
        return candela[azimuthIndex * polar.size() + polarIndex];
    }
    /// Linear in both angles between the values of the table. `direction` is a unit vector of the luminaire's frame.
    double intensity(const glm::dvec3& direction) const;
    /// The integral over all directions of what `intensity` returns.
    double lumens() const { return lumensBeyond(0); }
    /// Those of directions at least so many degrees from the grid's pole.
    double lumensBeyond(double angle) const;
    /// Candela at most.
    double largest() const;
    /// Factor on the intensities; 1 without a table. Throws InputError beyond its ends.
    double tiltFactor(double degrees, const SourceLocation& where) const;
};

/// Of photometry of type C: azimuth is C, the pole is gamma = 0.
inline glm::dmat3 axesOfTypeC() { return {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}}; }

/// Unit vector in the luminaire's frame.
glm::dvec3 directionAt(double c, double gamma);

/// The set of lamps to take where a file has several, from 1 on.
inline constexpr size_t firstLampSet = 1;

/// Throws InputError at `where` if this file may not be read.
using FileCheck = std::function<void(const std::string& path, const SourceLocation& where)>;

/// By its ending, .ies or .ldt. Throws InputError at file:line; `where`: of the mention, for files that cannot be read.
/// `mayRead` is asked about files that this one names.
Goniogram readGoniogram(const std::string& path, const SourceLocation& where, size_t lampSet = firstLampSet,
                        const FileCheck& mayRead = {});

/// Of the content of an IES file that a scene holds under `name`, and that names no other file.
Goniogram readHeldGoniogram(const std::string& name, const std::string& content);

} // namespace quasilux
