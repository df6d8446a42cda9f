#include "report/report_content.h"

#include "scene/photometric_units.h"

#include <algorithm>

namespace quasilux {

std::vector<LuminaireRow> luminairesOf(const Scene& scene, bool photometric) {
    std::vector<LuminaireRow> rows;
    for (const LuminaireType& type : scene.luminaireTypes) rows.push_back({type.goniogram, 0, 0, 0});
    for (const PointEmitter& emitter : scene.pointEmitters) {
        if (!emitter.luminaire) continue;
        LuminaireRow& row = rows[emitter.luminaire->type];
        const double metres = scene.luminaireTypes[emitter.luminaire->type].metresPerUnit;
        const Rgb& factor = emitter.intensity; // on the file's candela, by the square of a scene unit
        row.count += 1;
        row.lumens += (photometric ? 1 : luminousEfficacy) * luminanceOf(factor.r, factor.g, factor.b) * metres *
                      metres * row.goniogram.lumens();
        row.watts += row.goniogram.lampSets.at(row.goniogram.lampSet).watts;
    }
    return rows;
}

bool ReportContent::isKnown() const {
    return std::all_of(grids.begin(), grids.end(),
                       [&](const GridPart& part) { return areKnown(part.figures, precision); }) &&
           std::all_of(observers.begin(), observers.end(),
                       [&](const ObserverPart& part) { return quasilux::isKnown(part.figures, precision); });
}

} // namespace quasilux
