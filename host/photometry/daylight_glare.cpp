#include "photometry/daylight_glare.h"

#include "photometry/position_index.h"
#include "util/error.h"
#include "util/nearest.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace quasilux {

namespace {

using std::numbers::pi;

constexpr LineOfSight ahead{{0, 0, 1}, {0, 1, 0}};
constexpr double peakLuminance = 50000; // cd/m², as in evalglare

/// Direction and solid angle of a pixel; none where the image shows nothing there.
struct SeenPixel {
    glm::dvec3 direction{};
    double solidAngle = 0;
};

/// theta and dtheta / dr at the distance r, in half widths.
std::pair<double, double> angleAt(const View& view, double r) {
    const double half = view.width / 2;
    switch (view.projection) {
    case Projection::perspective: {
        const double slope = std::tan(half);
        return {std::atan(r * slope), slope / (1 + r * r * slope * slope)};
    }
    case Projection::equidistant:
        return {r * half, half};
    case Projection::equisolid: {
        const double scale = std::sin(half / 2), s = std::min(r * scale, 1.0);
        return {2 * std::asin(s), 2 * scale / std::sqrt(std::max(1 - s * s, 1e-12))};
    }
    case Projection::orthographic: {
        const double scale = std::sin(half), s = std::min(r * scale, 1.0);
        return {std::asin(s), scale / std::sqrt(std::max(1 - s * s, 1e-12))};
    }
    }
    throw std::logic_error("no such projection");
}

SeenPixel pixelAt(const View& view, double x, double y, double area) {
    const double r = std::hypot(x, y);
    if (view.projection != Projection::perspective && r > 1) return {}; // beyond the circle
    const auto [theta, slope] = angleAt(view, r);
    if (theta >= pi / 2) return {};
    const double sine = std::sin(theta), perRadius = r > 1e-9 ? sine / r : slope;
    return {{r > 1e-9 ? sine * x / r : 0, r > 1e-9 ? sine * y / r : 0, std::cos(theta)}, perRadius * slope * area};
}

class Evaluation {
public:
    Evaluation(const LuminanceImage& image, const View& view) : image_(image) {
        const double half = image.width / 2.0;
        for (unsigned j = 0; j < image.height; ++j)
            for (unsigned i = 0; i < image.width; ++i)
                pixels_.push_back(
                    pixelAt(view, (i + 0.5) / half - 1, (image.height / 2.0 - j - 0.5) / half, 1 / (half * half)));
    }

    double illuminance() const {
        double sum = 0;
        for (size_t k = 0; k < pixels_.size(); ++k) sum += image_.values[k] * cosineWeight(k);
        return sum;
    }
    double covered() const {
        double sum = 0;
        for (size_t k = 0; k < pixels_.size(); ++k) sum += cosineWeight(k);
        return std::min(sum / pi, 1.0);
    }
    /// As if the errors of all pixels were one.
    double illuminanceError() const {
        double sum = 0;
        for (size_t k = 0; k < pixels_.size(); ++k) sum += image_.standardError[k] * cosineWeight(k);
        return sum;
    }

    /// Pixels side by side, also at corners. Peaks are sources of their own: the square of a mean with what is about
    /// them would be far too small.
    std::vector<DaylightGlare::Source> sources(double threshold) {
        std::vector<DaylightGlare::Source> found;
        std::vector<bool> taken(pixels_.size(), false);
        for (const double least : {std::max(threshold, peakLuminance), threshold})
            for (size_t k = 0; k < pixels_.size(); ++k)
                if (isBright(k, least) && !taken[k]) found.push_back(collect(k, least, taken));
        std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return strength(a) > strength(b); });
        return found;
    }

    static double strength(const DaylightGlare::Source& s) {
        return s.luminance * s.luminance * s.solidAngle / (s.positionIndex * s.positionIndex);
    }
    /// Of the sum of strengths, if the luminance of all sources is off by its error.
    double errorOfStrength(double threshold) const {
        double sum = 0;
        for (size_t k = 0; k < pixels_.size(); ++k) {
            if (!isBright(k, threshold)) continue;
            const double p = positionIndexOfDaylight(ahead, pixels_[k].direction);
            sum += 2 * image_.values[k] * image_.standardError[k] * pixels_[k].solidAngle / (p * p);
        }
        return sum;
    }

private:
    double cosineWeight(size_t k) const { return pixels_[k].direction.z * pixels_[k].solidAngle; }
    bool isBright(size_t k, double threshold) const {
        return pixels_[k].solidAngle > 0 && image_.values[k] >= threshold;
    }

    DaylightGlare::Source collect(size_t first, double threshold, std::vector<bool>& taken) const {
        DaylightGlare::Source source;
        glm::dvec3 middle{0};
        double sum = 0;
        std::vector<size_t> open{first};
        taken[first] = true;
        while (!open.empty()) {
            const size_t k = open.back();
            open.pop_back();
            sum += image_.values[k] * pixels_[k].solidAngle;
            source.solidAngle += pixels_[k].solidAngle;
            source.pixels += 1;
            middle += image_.values[k] * pixels_[k].solidAngle * pixels_[k].direction;
            addNeighbours(k, threshold, taken, open);
        }
        source.luminance = sum / source.solidAngle;
        source.positionIndex = positionIndexOfDaylight(ahead, glm::normalize(middle));
        return source;
    }

    void addNeighbours(size_t k, double threshold, std::vector<bool>& taken, std::vector<size_t>& open) const {
        const auto x = static_cast<int>(k % image_.width), y = static_cast<int>(k / image_.width);
        for (int j = std::max(y - 1, 0); j <= std::min(y + 1, static_cast<int>(image_.height) - 1); ++j)
            for (int i = std::max(x - 1, 0); i <= std::min(x + 1, static_cast<int>(image_.width) - 1); ++i) {
                const size_t next = static_cast<size_t>(j) * image_.width + static_cast<size_t>(i);
                if (taken[next] || !isBright(next, threshold)) continue;
                taken[next] = true;
                open.push_back(next);
            }
    }

    const LuminanceImage& image_;
    std::vector<SeenPixel> pixels_;
};

} // namespace

std::vector<std::string> projectionNames() { return {"perspective", "equidistant", "equisolid", "orthographic"}; }

Projection parseProjection(const std::string& name) {
    const auto names = projectionNames();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) throw InputError("projection " + name + " is unknown, " + expectedNames(name, names));
    return static_cast<Projection>(found - names.begin());
}

DaylightGlare daylightGlare(const LuminanceImage& image, const View& view, double threshold,
                            std::optional<double> illuminance) {
    Evaluation evaluation(image, view);
    DaylightGlare found;
    found.covered = evaluation.covered();
    found.illuminance = illuminance.value_or(evaluation.illuminance());
    found.sources = evaluation.sources(threshold);
    double strength = 0;
    for (const auto& source : found.sources) strength += Evaluation::strength(source);
    const double saturation = std::pow(found.illuminance, 1.87);
    const double contrast = strength > 0 ? strength / saturation : 0; // a black image has neither
    found.probability = std::min(1.0, 5.87e-5 * found.illuminance + 9.18e-2 * std::log10(1 + contrast) + 0.16);
    if (image.standardError.empty()) return found;
    const double error = illuminance ? 0 : evaluation.illuminanceError();
    const double ofContrast =
        strength > 0 ? evaluation.errorOfStrength(threshold) / saturation + 1.87 * contrast * error / found.illuminance
                     : 0;
    found.illuminanceError = error;
    found.standardError = 5.87e-5 * error + 9.18e-2 / std::numbers::ln10 * ofContrast / (1 + contrast);
    return found;
}

} // namespace quasilux
