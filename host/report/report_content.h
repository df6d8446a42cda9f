// All that a report says, before it is a page.
#pragma once

#include "photometry/grid_values.h"
#include "photometry/luminance_image.h"
#include "render/error_estimate.h"
#include "report/figures.h"

#include <optional>

namespace quasilux {

/// A part of the report that was rendered.
struct RenderedPart {
    unsigned passes = 0;
    double seconds = 0; ///< with preparing and compiling
};

/// All of a scene's grids are measured together.
struct GridPart : RenderedPart {
    std::string name;
    bool isCylindrical = false;
    GridValues values;
    NormFigures figures;
    RenderedPart again; ///< of the points that may be the darkest or brightest
    size_t pointsAgain = 0;
    std::optional<Figure> modelling; ///< cylindrical over horizontal illuminance of the same points, ratio of the means
    PointModelling modellingAtPoints; ///< where there is `modelling`
};

struct ObserverPart : RenderedPart {
    ObserverFigures figures;
};

struct PicturePart : RenderedPart {
    LuminanceImage luminance;
    std::vector<uint8_t> toneMapped; ///< 8-bit sRGB
    ErrorEstimate error;
};

/// Luminaires of one file.
struct LuminaireRow {
    Goniogram goniogram;
    size_t count = 0;
    double lumens = 0; ///< of all of them in the scene, with maintenance factors
    double watts = 0;  ///< of all of them; 0: not said
};
std::vector<LuminaireRow> luminairesOf(const Scene& scene, bool photometric);

struct ReportContent {
    std::string scene; ///< file name without its folder
    std::string device;
    double precision = 0.01; ///< relative half width of the interval of 95 % that figures are to be known to
    double seconds = 0;
    bool hasSky = false;
    std::vector<LuminaireRow> luminaires;
    size_t otherLamps = 0; ///< emitters that are no quasilux_ies
    std::vector<GridPart> grids;
    std::vector<ObserverPart> observers;
    std::optional<PicturePart> picture;
    std::vector<std::pair<std::string, std::string>> settings;
    std::vector<std::string> warnings;

    /// Whether each figure is known to the precision.
    bool isKnown() const;
};

} // namespace quasilux
