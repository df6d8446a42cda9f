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

nlohmann::json gridJson(const GridPart& part) {
    return {{"points", part.values.values.size()},
            {"mean", figureJson(part.figures.mean)},
            {"minimum", figureJson(part.figures.minimum)},
            {"maximum", figureJson(part.figures.maximum)},
            {"U0", figureJson(part.figures.overall)},
            {"Ud", figureJson(part.figures.diversity)},
            {"passes", part.passes},
            {"seconds", part.seconds}};
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
    if (content.grid) {
        const NormFigures& figures = content.grid->figures;
        add("mean illuminance", figures.mean, "lx");
        add("minimum", figures.minimum, "lx", true);
        add("maximum", figures.maximum, "lx", true);
        add("uniformity U0 = minimum / mean", figures.overall, "", true);
        add("diversity Ud = minimum / maximum", figures.diversity, "", true);
    }
    for (const ObserverPart& part : content.observers)
        add("UGR, " + part.figures.observer.name, part.figures.rating, "");
    return rows;
}

nlohmann::json reportJson(const ReportContent& content) {
    nlohmann::json observers = nlohmann::json::array();
    for (const ObserverPart& part : content.observers) observers.push_back(observerJson(part));
    nlohmann::json json{{"version", QUASILUX_VERSION},
                        {"scene", content.scene},
                        {"device", content.device},
                        {"seconds", content.seconds},
                        {"precision", content.precision},
                        {"reached", content.isKnown()},
                        {"grid", content.grid ? gridJson(*content.grid) : nlohmann::json()},
                        {"observers", observers},
                        {"warnings", content.warnings}};
    if (content.picture)
        json["picture"] = {{"passes", content.picture->passes},
                           {"seconds", content.picture->seconds},
                           {"relativeError", orNull(content.picture->error.sum())}};
    return json;
}

} // namespace quasilux
