#include "report/figure_text.h"

#include <cmath>
#include <fmt/format.h>

namespace quasilux {

namespace {

/// Digits behind the point, so that an error has two in all.
int digitsOf(double error) {
    if (!(error > 0) || !std::isfinite(error)) return 3;
    return std::clamp(1 - static_cast<int>(std::floor(std::log10(error))), 0, 9);
}

TableRow rowOf(const std::string& name, const Figure& figure, const char* unit, double precision, bool ofMinimum) {
    if (!std::isfinite(figure.value)) return {name, "none", "", "", "", ""};
    const double relative = figure.relativeHalfWidth();
    const bool isExact = figure.isKnown() && figure.standardError == 0;
    return {name,
            fmt::format("{} {}", valueText(figure), unit),
            intervalText(figure),
            std::isfinite(relative)
                ? fmt::format("{:.2g} %{}", 100 * relative, relative > precision ? " (not reached)" : "")
                : "not known",
            isExact            ? "0"
            : figure.isKnown() ? fmt::format("{:.2g}", figure.standardError)
                               : "not known",
            !ofMinimum || !figure.isKnown() ? "–"
            : figure.bias == 0              ? "0"
                                            : fmt::format("{:+.2g}", figure.bias)};
}

nlohmann::json orNull(double value) { return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(); }

nlohmann::json figureJson(const Figure& figure) {
    return {{"value", orNull(figure.value)},
            {"standardError", orNull(figure.standardError)},
            {"halfWidth95", orNull(figure.halfWidth())},
            {"relativeHalfWidth95", orNull(figure.relativeHalfWidth())},
            {"atMostToAdd", orNull(figure.bias)}};
}

nlohmann::json pointsJson(const PointModelling& points) {
    return {{"least", points.least}, {"largest", points.largest}, {"within", points.within}, {"points", points.points}};
}

nlohmann::json gridJson(const GridPart& part) {
    return {{"name", part.name},
            {"kind", part.isCylindrical ? "cylindrical" : "planar"},
            {"points", part.values.values.size()},
            {"modelling", part.modelling ? figureJson(*part.modelling) : nlohmann::json()},
            {"modellingAtPoints", part.modelling ? pointsJson(part.modellingAtPoints) : nlohmann::json()},
            {"mean", figureJson(part.figures.mean)},
            {"minimum", figureJson(part.figures.minimum)},
            {"maximum", figureJson(part.figures.maximum)},
            {"U0", figureJson(part.figures.overall)},
            {"Ud", figureJson(part.figures.diversity)},
            {"passes", part.passes},
            {"seconds", part.seconds},
            {"pointsAgain", part.pointsAgain},
            {"passesAgain", part.again.passes},
            {"secondsAgain", part.again.seconds}};
}

nlohmann::json observerJson(const ObserverPart& part) {
    nlohmann::json sources = nlohmann::json::array();
    for (const GlareSource& source : part.figures.sources.seen)
        sources.push_back({{"name", source.name},
                           {"luminance", source.luminance},
                           {"solidAngle", source.solidAngle},
                           {"positionIndex", source.positionIndex},
                           {"visible", source.visible}});
    return {{"name", part.figures.observer.name},
            {"UGR", figureJson(part.figures.rating)},
            {"indirectIlluminance", figureJson(part.figures.indirect)},
            {"directIlluminance", figureJson(part.figures.direct)},
            {"sources", sources},
            {"leftOut", part.figures.sources.leftOut},
            {"passes", part.passes},
            {"seconds", part.seconds}};
}

} // namespace

std::string valueText(const Figure& figure) {
    return figure.isKnown() ? fmt::format("{:.{}f}", figure.value, digitsOf(figure.standardError))
                            : fmt::format("{:.3g}", figure.value);
}

std::string intervalText(const Figure& figure) {
    return figure.isKnown() ? fmt::format("± {:.{}f}", figure.halfWidth(), digitsOf(figure.standardError))
                            : "not known";
}

std::vector<TableRow> figureRows(const ReportContent& content) {
    std::vector<TableRow> rows{{"figure", "value", "95 %", "relative", "standard error", "to add at most"}};
    const auto add = [&](const std::string& name, const Figure& figure, const char* unit, bool ofMinimum = false) {
        rows.push_back(rowOf(name, figure, unit, content.precision, ofMinimum));
    };
    for (const GridPart& part : content.grids) {
        const NormFigures& figures = part.figures;
        const std::string begin = content.grids.size() > 1 ? part.name + ": " : "";
        add(begin + (part.isCylindrical ? "mean cylindrical illuminance" : "mean illuminance"), figures.mean, "lx");
        add(begin + "minimum", figures.minimum, "lx", true);
        add(begin + "maximum", figures.maximum, "lx", true);
        add(begin + "uniformity U0 = minimum / mean", figures.overall, "", true);
        add(begin + "diversity Ud = minimum / maximum", figures.diversity, "", true);
        if (part.modelling) add(begin + "modelling = mean cylindrical / horizontal", *part.modelling, "");
    }
    for (const ObserverPart& part : content.observers)
        add("UGR, " + part.figures.observer.name, part.figures.rating, "");
    return rows;
}

std::vector<std::string> glareRemarks(const ObserverFigures& figures) {
    std::vector<std::string> remarks;
    const std::vector<GlareSource>& seen = figures.sources.seen;
    const auto isBeyond = [](const GlareSource& s) {
        return s.solidAngle < smallestSource || s.solidAngle > largestSource;
    };
    if (!seen.empty() && std::isnan(figures.rating.value))
        remarks.push_back("No indirect light was found at the eye, so that there is no background to rate against.");
    if (std::any_of(seen.begin(), seen.end(), isBeyond))
        remarks.push_back("Some are smaller than 0.0003 sr or larger than 0.1 sr, for which UGR was not made.");
    for (const std::string& why : figures.sources.leftOut)
        remarks.push_back("Not rated: " + why + " The rating is too low by it.");
    return remarks;
}

nlohmann::json reportJson(const ReportContent& content) {
    std::vector<std::string> warnings = content.warnings;
    for (const ObserverPart& part : content.observers)
        for (const std::string& remark : glareRemarks(part.figures))
            warnings.push_back(fmt::format("UGR, {}: {}", part.figures.observer.name, remark));
    nlohmann::json observers = nlohmann::json::array(), grids = nlohmann::json::array();
    for (const ObserverPart& part : content.observers) observers.push_back(observerJson(part));
    for (const GridPart& part : content.grids) grids.push_back(gridJson(part));
    nlohmann::json json{{"version", QUASILUX_VERSION},
                        {"scene", content.scene},
                        {"device", content.device},
                        {"seconds", content.seconds},
                        {"precision", content.precision},
                        {"reached", content.isKnown()},
                        {"grids", grids},
                        {"observers", observers},
                        {"warnings", warnings}};
    if (content.picture)
        json["picture"] = {{"passes", content.picture->passes},
                           {"seconds", content.picture->seconds},
                           {"relativeError", orNull(content.picture->error.sum())}};
    return json;
}

} // namespace quasilux
