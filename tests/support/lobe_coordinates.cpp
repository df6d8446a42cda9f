#include "support/lobe_coordinates.h"

#include "bsdf/lobe_list.h"

#include <cmath>
#include <numbers>

namespace quasilux {

namespace {

using glm::dvec3;
using std::numbers::pi;

/// Any orthonormal frame with z axis n, by columns.
glm::dmat3 basis(dvec3 n) {
    const dvec3 helper = std::abs(n.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
    const dvec3 s = glm::normalize(glm::cross(helper, n));
    return {s, glm::cross(n, s), n};
}

dvec3 polar(double oneMinusCos, double phi) {
    const double sine = std::sqrt(std::max(oneMinusCos * (2 - oneMinusCos), 0.0));
    return {sine * std::cos(phi), sine * std::sin(phi), 1 - oneMinusCos};
}

double positiveAngle(double y, double x) {
    const double angle = std::atan2(y, x);
    return angle < 0 ? angle + 2 * pi : angle;
}

dvec3 mirror(dvec3 wo) { return {-wo.x, -wo.y, wo.z}; }

LobeDirection microfacetDirection(const shared::Lobe& lobe, dvec3 wo, double s, double phi) {
    const double slope = std::sqrt(s * (2 - s)) / (1 - s);
    const dvec3 h = glm::normalize(dvec3(lobe.alphaU * slope * std::cos(phi), lobe.alphaV * slope * std::sin(phi), 1));
    const double cosH = glm::dot(wo, h);
    // Slope plane to normals: cos^3; normals to reflected directions: 4 wo.h; slope d(slope) = ds / (1 - s)^3.
    const double jacobian = 4 * cosH * lobe.alphaU * lobe.alphaV * std::pow(h.z / (1 - s), 3);
    return {2 * cosH * h - wo, std::max(jacobian, 0.0)};
}

double smithGgx(double scaledTan) { return 2 / (1 + std::sqrt(1 + scaledTan * scaledTan)); }

double smithBeckmann(double scaledTan) {
    const double a = 1 / scaledTan;
    return a >= 1.6 ? 1 : (3.535 * a + 2.181 * a * a) / (1 + 2.276 * a + 2.577 * a * a);
}

// Kept by a coat of this index: the amplitudes of Fresnel's equations.
double transmittedByCoat(double cosine, double eta) {
    const double cosT = std::sqrt(1 - (1 - cosine * cosine) / (eta * eta));
    const double rs = (cosine - eta * cosT) / (cosine + eta * cosT);
    const double rp = (eta * cosine - cosT) / (eta * cosine + cosT);
    return 1 - (rs * rs + rp * rp) / 2;
}

double transmittedByRoughCoat(double cosine, const shared::Lobe& lobe) {
    double x = cosine / (cosine + double(lobe.alphaU));
    if (lobe.alphaV > 0) {
        const double y = 1 - (1 - cosine * cosine) / std::pow(double(lobe.eta.r), 2);
        x = double(lobe.eta.g) * std::pow((y + std::hypot(y, double(lobe.alphaV))) / 2, 0.25) + double(lobe.eta.b);
    }
    double sum = 0;
    for (int k = 0; k < 8; ++k) sum += double(lobe.coat[k]) * std::pow(x, k);
    return sum;
}

bool isGgx(const shared::Lobe& lobe) {
    return lobe.type == LOBE_GGX || lobe.type == LOBE_GGXDIELECTRIC || lobe.type == LOBE_GGXSCHLICK;
}

double schlick(double normal, double grazing, double cosine) {
    return normal + (grazing - normal) * std::pow(1 - cosine, 5);
}

double clearcoatDistribution(double alpha, dvec3 h) {
    const double a2 = alpha * alpha;
    return (a2 - 1) / (pi * std::log(a2) * (h.x * h.x + h.y * h.y + a2 * h.z * h.z));
}

// s is the share of D cos about the normal: GTR1 integrated (Burley 2012, appendix B).
LobeDirection clearcoatDirection(const shared::Lobe& lobe, dvec3 wo, double s, double phi) {
    const double a2 = double(lobe.alphaU) * lobe.alphaU;
    const double sine2 = (std::pow(a2, 1 - s) - a2) / (1 - a2);
    const dvec3 h = {std::sqrt(sine2) * std::cos(phi), std::sqrt(sine2) * std::sin(phi), std::sqrt(1 - sine2)};
    const double cosH = glm::dot(wo, h);
    return {2 * cosH * h - wo, std::max(4 * cosH / (2 * pi * clearcoatDistribution(lobe.alphaU, h) * h.z), 0.0)};
}

LobeCoordinates clearcoatCoordinates(const shared::Lobe& lobe, dvec3 wo, dvec3 wi) {
    const dvec3 h = glm::normalize(wo + wi);
    const double a2 = double(lobe.alphaU) * lobe.alphaU, sine2 = h.x * h.x + h.y * h.y;
    return {1 - std::log((1 - a2) * sine2 + a2) / std::log(a2), positiveAngle(h.y, h.x)};
}

double clearcoatFormula(const shared::Lobe& lobe, dvec3 wo, dvec3 wi) {
    const dvec3 h = glm::normalize(wo + wi);
    const double d = clearcoatDistribution(lobe.alphaU, h);
    const auto shadowing = [](double cosine) { return smithGgx(0.25 * std::sqrt(1 - cosine * cosine) / cosine); };
    return schlick(0.04, 1, glm::dot(wo, h)) * d * shadowing(wo.z) * shadowing(wi.z) / 4;
}

double principledDiffuseFormula(const shared::Lobe& lobe, dvec3 wo, dvec3 wi) {
    const double cosD = glm::dot(wo, glm::normalize(wo + wi)), retro = 2 * double(lobe.alphaU) * cosD * cosD;
    const double fo = std::pow(1 - wo.z, 5), fi = std::pow(1 - wi.z, 5);
    const double rough = (1 - fi / 2) * (1 - fo / 2) + retro * (fo + fi + fo * fi * (retro - 1));
    const double below = schlick(1, retro / 2, wo.z) * schlick(1, retro / 2, wi.z);
    const double flattened = 1.25 * (below * (1 / (wo.z + wi.z) - 0.5) + 0.5);
    return (rough + (flattened - rough) * double(lobe.exponent)) / pi;
}

double microfacetFormula(const shared::Lobe& lobe, dvec3 wo, dvec3 wi) {
    return microfacetDistribution(lobe, glm::normalize(wo + wi)) * microfacetShadowing(lobe, wo) *
           microfacetShadowing(lobe, wi) / (4 * wo.z * wi.z);
}

} // namespace

double microfacetDistribution(const shared::Lobe& lobe, dvec3 h) {
    const double area = pi * lobe.alphaU * lobe.alphaV * std::pow(h.z, 4);
    const double q = (std::pow(h.x / lobe.alphaU, 2) + std::pow(h.y / lobe.alphaV, 2)) / (h.z * h.z);
    return isGgx(lobe) ? 1 / (area * (1 + q) * (1 + q)) : std::exp(-q) / area;
}

double microfacetShadowing(const shared::Lobe& lobe, dvec3 v) {
    const double scaledTan = std::hypot(lobe.alphaU * v.x, lobe.alphaV * v.y) / std::abs(v.z);
    return isGgx(lobe) ? smithGgx(scaledTan) : smithBeckmann(scaledTan);
}

LobeDirection lobeDirection(const shared::Lobe& lobe, dvec3 wo, double s, double phi) {
    if (lobe.type == LOBE_CLEARCOAT) return clearcoatDirection(lobe, wo, s, phi);
    if (LOBE_IS_BROAD(lobe.type)) return {polar(1 - s, phi), 1};
    if (lobe.type == LOBE_PHONG) {
        const double m = 1 / (double(lobe.exponent) + 1);
        const double oneMinusCos = -std::expm1(m * std::log1p(-s));
        return {basis(mirror(wo)) * polar(oneMinusCos, phi), m * std::pow(1 - s, m - 1)};
    }
    return microfacetDirection(lobe, wo, s, phi);
}

LobeCoordinates lobeCoordinates(const shared::Lobe& lobe, dvec3 wo, dvec3 wi) {
    if (lobe.type == LOBE_CLEARCOAT) return clearcoatCoordinates(lobe, wo, wi);
    if (LOBE_IS_BROAD(lobe.type)) return {wi.z, positiveAngle(wi.y, wi.x)};
    if (lobe.type == LOBE_PHONG) {
        const dvec3 offset = wi - mirror(wo);
        const dvec3 v = glm::transpose(basis(mirror(wo))) * wi;
        const double logCos = std::log1p(-0.5 * glm::dot(offset, offset));
        return {-std::expm1((double(lobe.exponent) + 1) * logCos), positiveAngle(v.y, v.x)};
    }
    const dvec3 h = wo + wi;
    const double x = h.x / (lobe.alphaU * h.z), y = h.y / (lobe.alphaV * h.z);
    const double q = x * x + y * y;
    return {1 - 1 / std::sqrt(1 + q), positiveAngle(y, x)};
}

double lobeFormula(const shared::Lobe& lobe, dvec3 wo, dvec3 wi) {
    if (wi.z <= 0) return 0;
    if (lobe.type == LOBE_LAMBERT) return 1 / pi;
    if (lobe.type == LOBE_COATEDLAMBERT)
        return transmittedByCoat(wo.z, lobe.eta.r) * transmittedByCoat(wi.z, lobe.eta.r) / pi;
    if (lobe.type == LOBE_PRINCIPLEDDIFFUSE) return principledDiffuseFormula(lobe, wo, wi);
    if (lobe.type == LOBE_SHEEN) return std::pow(1 - glm::dot(wo, glm::normalize(wo + wi)), 5);
    if (lobe.type == LOBE_CLEARCOAT) return clearcoatFormula(lobe, wo, wi);
    if (lobe.type == LOBE_GGXSCHLICK)
        return schlick(lobe.eta.g, lobe.k.g, glm::dot(wo, glm::normalize(wo + wi))) * microfacetFormula(lobe, wo, wi);
    if (lobe.type == LOBE_ROUGHCOATEDLAMBERT)
        return transmittedByRoughCoat(wo.z, lobe) * transmittedByRoughCoat(wi.z, lobe) / pi;
    if (lobe.type == LOBE_PHONG) {
        const dvec3 offset = wi - mirror(wo);
        const double oneMinusCos = 0.5 * glm::dot(offset, offset);
        if (oneMinusCos >= 1) return 0;
        return (lobe.exponent + 2.0) / (2 * pi) * std::exp(lobe.exponent * std::log1p(-oneMinusCos));
    }
    return microfacetFormula(lobe, wo, wi);
}

} // namespace quasilux
