#include "support/rough_interface.h"

#include "bsdf/lobe_list.h"
#include "support/lobe_coordinates.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <fmt/format.h>

namespace quasilux {

namespace {

using glm::dvec3;

constexpr int cosineSteps = 48;
constexpr int fineness = 16;

double reflectance(double cosI, double eta) {
    const std::complex<double> g = std::sqrt(std::complex<double>(eta * eta - (1 - cosI) * (1 + cosI)));
    const auto rs = (cosI - g) / (cosI + g), rp = (eta * eta * cosI - g) / (eta * eta * cosI + g);
    return 0.5 * (std::norm(rs) + std::norm(rp));
}

dvec3 facetNormal(const shared::Lobe& lobe, double s, double phi) {
    const double slope = std::sqrt(s * (2 - s)) / (1 - s);
    return glm::normalize(dvec3(lobe.alphaU * slope * std::cos(phi), lobe.alphaV * slope * std::sin(phi), 1));
}

/// Where a facet sends wo to; the zero vector where it does not see it, does not send it, or sends it to the wrong
/// side.
dvec3 sendByFacet(const shared::Lobe& lobe, dvec3 wo, dvec3 h, bool transmits) {
    const double cosH = glm::dot(wo, h), eta = lobe.eta.r;
    if (cosH <= 0) return dvec3(0);
    if (!transmits) {
        const dvec3 wi = 2 * cosH * h - wo;
        return wi.z > 0 ? wi : dvec3(0);
    }
    const double sine2 = (1 - cosH * cosH) / (eta * eta);
    if (sine2 >= 1) return dvec3(0);
    const dvec3 wi = (cosH / eta - std::sqrt(1 - sine2)) * h - wo / eta;
    return wi.z < 0 ? wi : dvec3(0);
}

/// Area that a unit of (s, phi) covers on the sphere of wi, by differences.
double areaElement(const shared::Lobe& lobe, dvec3 wo, double s, double phi, bool transmits) {
    const double step = 1e-6;
    const auto at = [&](double ds, double dphi) {
        return sendByFacet(lobe, wo, facetNormal(lobe, s + ds, phi + dphi), transmits);
    };
    const dvec3 ends[] = {at(step, 0), at(-step, 0), at(0, step), at(0, -step)};
    for (const dvec3& end : ends)
        if (end == dvec3(0)) return 0;
    return glm::length(glm::cross(ends[0] - ends[1], ends[2] - ends[3])) / (4 * step * step);
}

dvec3 facetBetween(const shared::Lobe& lobe, dvec3 wo, dvec3 wi) {
    const double eta = lobe.eta.r;
    const dvec3 h = wi.z > 0 ? wo + wi : -(wo + eta * wi);
    return glm::normalize(h.z > 0 ? h : -h);
}

dvec3 atCosine(double cosine) { return {std::sqrt(1 - cosine * cosine), 0, cosine}; }

/// Linear between the middles of equal steps.
double interpolate(const std::vector<double>& values, double cosine) {
    const double x = std::clamp(cosine * cosineSteps - 0.5, 0.0, cosineSteps - 1.0);
    const auto k = std::min(static_cast<size_t>(x), values.size() - 2);
    const double t = x - static_cast<double>(k);
    return (1 - t) * values[k] + t * values[k + 1];
}

} // namespace

shared::Lobe makeInterface(unsigned type, float eta, float alphaU, float alphaV) {
    shared::Lobe lobe = makeLobe(type);
    lobe.eta = {eta, eta, eta};
    lobe.alphaU = alphaU;
    lobe.alphaV = alphaV;
    return lobe;
}

std::vector<LobeCase> roughInterfaces() {
    std::vector<LobeCase> cases;
    const float roughness[][2] = {{0.02f, 0.02f}, {0.3f, 0.3f}, {1.0f, 1.0f}, {0.1f, 0.5f}};
    for (unsigned type : {LOBE_GGXDIELECTRIC, LOBE_BECKMANNDIELECTRIC})
        for (const auto& alpha : roughness)
            for (float eta : {1.5f, 1 / 1.5f})
                cases.push_back({fmt::format("{} {} {}, eta {}", type == LOBE_GGXDIELECTRIC ? "ggx" : "beckmann",
                                             alpha[0], alpha[1], eta),
                                 makeInterface(type, eta, alpha[0], alpha[1])});
    return cases;
}

double interfaceFormula(const shared::Lobe& lobe, dvec3 wo, dvec3 wi) {
    const double eta = lobe.eta.r;
    const dvec3 h = facetBetween(lobe, wo, wi);
    const double cosO = glm::dot(wo, h), cosI = glm::dot(wi, h);
    if (cosO <= 0 || cosI * wi.z <= 0) return 0;
    const double fresnel = reflectance(cosO, eta);
    const double scattering = microfacetDistribution(lobe, h) * microfacetShadowing(lobe, wo) *
                              microfacetShadowing(lobe, wi) / (wo.z * std::abs(wi.z));
    if (wi.z > 0) return fresnel * scattering / 4;
    return (1 - fresnel) * scattering * cosO * std::abs(cosI) / std::pow(cosO + eta * cosI, 2);
}

int interfaceCell(const shared::Lobe& lobe, dvec3 wo, dvec3 wi) {
    const dvec3 h = facetBetween(lobe, wo, wi);
    const double x = h.x / (lobe.alphaU * h.z), y = h.y / (lobe.alphaV * h.z);
    const double phi = std::atan2(y, x);
    const int cell = interfaceGrid.cell(1 - 1 / std::sqrt(1 + x * x + y * y), phi < 0 ? phi + interfaceGrid.v1 : phi);
    return cell + (wi.z < 0 || cell == interfaceGrid.cells() ? interfaceGrid.cells() : 0);
}

std::vector<InterfacePoint> interfaceQuadrature(const shared::Lobe& lobe, dvec3 wo, int pointsPerSide) {
    std::vector<InterfacePoint> points;
    for (const bool transmits : {false, true})
        for (const QuadraturePoint& p : gridQuadrature(interfaceGrid, pointsPerSide)) {
            const dvec3 wi = sendByFacet(lobe, wo, facetNormal(lobe, p.u, p.v), transmits);
            if (wi == dvec3(0)) continue;
            points.push_back({wi, areaElement(lobe, wo, p.u, p.v, transmits) * p.weight,
                              p.cell + (transmits ? interfaceGrid.cells() : 0)});
        }
    return points;
}

InterfaceShares interfaceShares(const shared::Lobe& lobe, dvec3 wo) {
    InterfaceShares shares;
    for (const InterfacePoint& p : interfaceQuadrature(lobe, wo, fineness))
        (p.wi.z > 0 ? shares.reflected : shares.transmitted) +=
            interfaceFormula(lobe, wo, p.wi) * std::abs(p.wi.z) * p.solidAngle;
    return shares;
}

BallRadiance::BallRadiance(const shared::Lobe& outside) : outside_(outside) {
    shared::Lobe back = outside;
    back.eta.r = 1 / outside.eta.r;
    std::vector<double> fromSky(cosineSteps);
    struct Reflected {
        double cosine, share;
    };
    std::vector<std::vector<Reflected>> reflected(cosineSteps);
    for (size_t k = 0; k < cosineSteps; ++k) {
        const dvec3 wo = atCosine((static_cast<double>(k) + 0.5) / cosineSteps);
        for (const InterfacePoint& p : interfaceQuadrature(back, wo, fineness / 2)) {
            const double share = interfaceFormula(back, wo, p.wi) * std::abs(p.wi.z) * p.solidAngle;
            if (p.wi.z > 0)
                reflected[k].push_back({p.wi.z, share});
            else
                fromSky[k] += share;
        }
    }
    inside_ = fromSky;
    for (int iteration = 0; iteration < 100; ++iteration) {
        std::vector<double> next = fromSky;
        for (size_t k = 0; k < cosineSteps; ++k)
            for (const Reflected& r : reflected[k]) next[k] += r.share * interpolate(inside_, r.cosine);
        inside_ = next;
    }
}

double BallRadiance::operator()(double cosine) const {
    double sum = 0;
    const dvec3 wo = atCosine(cosine);
    for (const InterfacePoint& p : interfaceQuadrature(outside_, wo, fineness)) {
        const double share = interfaceFormula(outside_, wo, p.wi) * std::abs(p.wi.z) * p.solidAngle;
        sum += share * (p.wi.z > 0 ? 1.0 : interpolate(inside_, -p.wi.z));
    }
    return sum;
}

} // namespace quasilux
