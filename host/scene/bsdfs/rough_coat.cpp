// Transmission and reflection of a border of microfacets by quadrature, and a fit of the former.
#include "scene/bsdfs/rough_coat.h"

#include "scene/bsdfs/bsdf_plugin.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace quasilux {

namespace {

constexpr double grazing = 1e-6; ///< the smallest cosine

/// Smith's G1, as kernels/bsdf/*_normals.clh have it; 0 from below.
double shadowing(const RoughCoat& coat, double cosine) {
    if (cosine <= 0) return 0;
    const double scaledTan = coat.alpha * std::sqrt(std::max(1 - cosine * cosine, 0.0)) / cosine;
    if (coat.ggx) return 2 / (1 + std::sqrt(1 + scaledTan * scaledTan));
    const double a = 1 / std::max(scaledTan, 1e-12);
    return a >= 1.6 ? 1 : (3.535 * a + 2.181 * a * a) / (1 + 2.276 * a + 2.577 * a * a);
}

/// One facet as the light meets it.
struct Facet {
    double cosH;  ///< of the light to its normal
    double cosN;  ///< of its normal to the surface's
    double share; ///< of the light from this cosine that meets it, G1(light) included
};

/// Sums what `value` says of the facets that light from this cosine meets. Facets are drawn by D cos at the middles of
/// strata; u = 1 - (1 - x)² puts more of them into the tail of GGX.
template <typename Value>
double overFacets(const RoughCoat& coat, double cosine, Value value) {
    constexpr int radii = 160, angles = 64;
    const double mu = std::max(cosine, grazing), sine = std::sqrt(1 - std::min(mu * mu, 1.0));
    const double shadow = shadowing(coat, mu);
    double sum = 0;
    for (int i = 0; i < radii; ++i) {
        const double rest = 1 - (i + 0.5) / radii, u = 1 - rest * rest;
        const double tan2 = coat.alpha * coat.alpha * (coat.ggx ? u / (1 - u) : -std::log1p(-u));
        const double cosN = 1 / std::sqrt(1 + tan2), sinN = std::sqrt(tan2) * cosN;
        for (int k = 0; k < angles; ++k) {
            const double cosH = sine * sinN * std::cos((k + 0.5) / angles * std::numbers::pi) + mu * cosN;
            if (cosH > 0) sum += value(Facet{cosH, cosN, 2 * rest * shadow * cosH / (mu * cosN)});
        }
    }
    return sum / (radii * angles);
}

double reflected(const RoughCoat& coat, double cosine, double eta) {
    return overFacets(coat, cosine, [&](const Facet& facet) {
        const double cosOut = 2 * facet.cosH * facet.cosN - std::max(cosine, grazing);
        return facet.share * dielectricReflectance(facet.cosH, eta) * shadowing(coat, cosOut);
    });
}

double powerSum(const std::array<double, 8>& factors, double x) {
    double value = 0;
    for (size_t k = factors.size(); k-- > 0;) value = value * x + factors[k];
    return value;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

/// The factors of `columns` whose sum is nearest to `values` (modified Gram-Schmidt; Björck 1967).
std::array<double, 8> leastSquares(std::array<std::vector<double>, 8> columns, std::vector<double> values) {
    double triangle[8][8] = {};
    std::array<double, 8> factors{};
    for (size_t k = 0; k < 8; ++k) {
        triangle[k][k] = std::sqrt(dot(columns[k], columns[k]));
        for (double& x : columns[k]) x /= triangle[k][k];
        for (size_t j = k + 1; j < 8; ++j) {
            triangle[k][j] = dot(columns[k], columns[j]);
            for (size_t i = 0; i < values.size(); ++i) columns[j][i] -= triangle[k][j] * columns[k][i];
        }
        factors[k] = dot(columns[k], values);
        for (size_t i = 0; i < values.size(); ++i) values[i] -= factors[k] * columns[k][i];
    }
    for (size_t k = 8; k-- > 0;) {
        for (size_t j = k + 1; j < 8; ++j) factors[k] -= triangle[k][j] * factors[j];
        factors[k] /= triangle[k][k];
    }
    return factors;
}

} // namespace

double RoughCoat::transmitted(double cosine) const {
    return overFacets(*this, cosine, [&](const Facet& facet) {
        const double squared = 1 - (1 - facet.cosH * facet.cosH) / (eta * eta);
        if (squared <= 0) return 0.0;
        const double cosOut = (facet.cosH / eta - std::sqrt(squared)) * facet.cosN - std::max(cosine, grazing) / eta;
        return facet.share * (1 - dielectricReflectance(facet.cosH, eta)) * shadowing(*this, -cosOut);
    });
}

double RoughCoat::internalReflectance() const {
    constexpr int count = 64;
    double sum = 0;
    for (int k = 0; k < count; ++k) {
        const double cosine = k / (count - 1.0);
        sum += 2 * cosine * reflected(*this, cosine, 1 / eta);
    }
    return sum / count;
}

double CoatFit::variable(double cosine) const {
    if (edge <= 0) return cosine / (cosine + knee);
    const double y = 1 - (1 - cosine * cosine) / (eta * eta), sum = std::sqrt(y * y + edge * edge) + std::abs(y);
    return scale * std::sqrt(std::sqrt((y > 0 ? sum : edge * edge / sum) / 2)) + offset;
}

double CoatFit::operator()(double cosine) const {
    const double value = powerSum(factors, variable(cosine));
    return edge == 0 ? value : std::max(value, 0.0);
}

double CoatFit::ofDiffuseLight() const {
    constexpr int steps = 1000;
    double sum = 0;
    for (int k = 0; k < steps; ++k) {
        const double cosine = (k + 0.5) / steps;
        sum += 2 * cosine * (*this)(cosine);
    }
    return sum / steps;
}

namespace {

/// Fits `values` at these cosines, whose errors count 1 / `scales` of themselves.
void fitTo(const std::vector<double>& cosines, std::vector<double> values, const std::vector<double>& scales,
           CoatFit& fit) {
    std::array<std::vector<double>, 8> columns;
    for (size_t i = 0; i < cosines.size(); ++i) {
        const double x = fit.variable(cosines[i]);
        double power = 1 / scales[i];
        for (auto& column : columns) {
            column.push_back(power);
            power *= x;
        }
        values[i] /= scales[i];
    }
    fit.factors = leastSquares(std::move(columns), std::move(values));
}

std::vector<double> evenCosines(size_t count) {
    std::vector<double> cosines;
    for (size_t i = 0; i < count; ++i) cosines.push_back(static_cast<double>(i) / static_cast<double>(count - 1));
    return cosines;
}

std::vector<double> transmittedAt(const RoughCoat& coat, const std::vector<double>& cosines) {
    std::vector<double> values;
    values.reserve(cosines.size());
    for (const double cosine : cosines) values.push_back(coat.transmitted(cosine));
    return values;
}

/// Makes the variable run from -1 to 1: powers of numbers near 1 have factors that cancel, too large for floats.
void spreadVariable(CoatFit& fit) {
    const double least = fit.variable(0), most = fit.variable(1);
    fit.scale = 2 / (most - least);
    fit.offset = -(most + least) / (most - least);
}

/// The variable that serves best: of widths of the edge about the critical angle, and of knees without an edge, which
/// serve where roughness has blurred it away.
CoatFit fitBelowOne(const RoughCoat& coat) {
    constexpr size_t count = 96, nearEdge = 48;
    const double critical = std::sqrt(1 - coat.eta * coat.eta);
    std::vector<double> cosines = evenCosines(count);
    for (const double at : evenCosines(nearEdge)) cosines.push_back(std::clamp(critical + 0.2 * (at - 0.5), 0.0, 1.0));
    const std::vector<double> values = transmittedAt(coat, cosines);
    std::vector<CoatFit> candidates;
    for (const double widths : {0.5, 0.75, 1., 1.5, 2., 3., 4., 6., 8., 12.})
        candidates.push_back({0.1, widths * std::max(0.7 * coat.alpha * critical / coat.eta, 1e-4), coat.eta});
    for (CoatFit& fit : candidates) spreadVariable(fit);
    for (const double knee : {0.02, 0.05, 0.1, 0.3, 1.}) candidates.push_back({knee, -1, coat.eta});
    const auto worstOf = [&](const CoatFit& fit) {
        double worst = 0;
        for (size_t i = 0; i < cosines.size(); ++i) worst = std::max(worst, std::abs(fit(cosines[i]) - values[i]));
        return worst;
    };
    CoatFit best;
    double least = INFINITY;
    for (CoatFit& fit : candidates) {
        fitTo(cosines, values, std::vector<double>(values.size(), 1), fit);
        const double worst = worstOf(fit);
        if (worst >= least) continue;
        least = worst;
        best = fit;
    }
    return best;
}

} // namespace

CoatFit fitTransmission(const RoughCoat& coat) {
    if (coat.eta < 1) return fitBelowOne(coat);
    CoatFit fit;
    fit.knee = std::max(coat.alpha, 0.1);
    const std::vector<double> cosines = evenCosines(64), values = transmittedAt(coat, cosines);
    fitTo(cosines, values, values, fit); // the relative error counts
    return fit;
}

} // namespace quasilux
