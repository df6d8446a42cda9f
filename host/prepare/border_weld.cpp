// Makes vertices that coincide within float rounding one: a sweep along a direction that no usual mesh lies across.
#include "prepare/border_weld.h"

#include "prepare/border_surface.h"
#include "prepare/border_union_find.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace quasilux {
namespace {

/// How far a vertex may move: what rounding may have moved it, and what would spoil its triangles.
struct Slack {
    double rounding = 0;
    double limit = std::numeric_limits<double>::infinity();

    void add(const Slack& other) {
        rounding = std::max(rounding, other.rounding);
        limit = std::min(limit, other.limit);
    }
};

struct SweepVertex {
    double along = 0;
    glm::vec3 position{};
    Slack slack;
    unsigned original = 0;
};

double largestCoordinate(const glm::vec3& p) {
    const glm::vec3 magnitude = glm::abs(p);
    return std::max({magnitude.x, magnitude.y, magnitude.z});
}

std::vector<Slack> slackOfVertices(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles) {
    std::vector<Slack> slack(positions.size());
    for (const glm::uvec3& triangle : triangles) {
        Slack here;
        for (int i = 0; i < 3; ++i) {
            const glm::vec3 &p = positions[triangle[i]], &q = positions[triangle[(i + 1) % 3]];
            here.rounding = std::max(here.rounding, borderRounding * largestCoordinate(p));
            const double edge = glm::distance(glm::dvec3(p), glm::dvec3(q));
            if (edge > 0) here.limit = std::min(here.limit, 0.1 * edge);
        }
        for (int i = 0; i < 3; ++i) slack[triangle[i]].add(here);
    }
    return slack;
}

std::vector<SweepVertex> sortAlongSweep(const std::vector<glm::vec3>& positions, const std::vector<Slack>& slack) {
    const glm::dvec3 direction = glm::normalize(glm::dvec3(0.5377, 0.6431, 0.5459));
    std::vector<SweepVertex> sweep(positions.size());
    for (unsigned i = 0; i < sweep.size(); ++i)
        sweep[i] = {glm::dot(direction, glm::dvec3(positions[i])), positions[i], slack[i], i};
    std::sort(sweep.begin(), sweep.end(), [](const SweepVertex& a, const SweepVertex& b) {
        return std::tie(a.along, a.position.x, a.position.y, a.position.z, a.original) <
               std::tie(b.along, b.position.x, b.position.y, b.position.z, b.original);
    });
    return sweep;
}

/// Keeps one of each run of equal positions, so that a vertex stored a thousand times costs no million comparisons.
std::vector<SweepVertex> uniteEqual(const std::vector<SweepVertex>& sorted, std::vector<unsigned>& vertexOf) {
    std::vector<SweepVertex> unique;
    for (const SweepVertex& vertex : sorted) {
        if (unique.empty() || unique.back().position != vertex.position)
            unique.push_back(vertex);
        else
            unique.back().slack.add(vertex.slack);
        vertexOf[vertex.original] = unsigned(unique.size() - 1);
    }
    return unique;
}

bool coincide(const SweepVertex& a, const SweepVertex& b) {
    const double tolerance = std::min({std::max(a.slack.rounding, b.slack.rounding), a.slack.limit, b.slack.limit});
    return glm::distance(glm::dvec3(a.position), glm::dvec3(b.position)) <= tolerance;
}

} // namespace

WeldedVertices weldVertices(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles) {
    WeldedVertices welded;
    welded.vertexOf.resize(positions.size());
    const std::vector<SweepVertex> unique =
        uniteEqual(sortAlongSweep(positions, slackOfVertices(positions, triangles)), welded.vertexOf);

    UnionFind sets(unique.size());
    for (unsigned i = 0; i < unique.size(); ++i) {
        const double window = std::min(unique[i].slack.rounding, unique[i].slack.limit);
        for (unsigned j = i + 1; j < unique.size() && unique[j].along - unique[i].along <= window; ++j)
            if (coincide(unique[i], unique[j])) sets.unite(i, j);
        for (unsigned j = i; j-- > 0 && unique[i].along - unique[j].along <= window;)
            if (coincide(unique[i], unique[j])) sets.unite(i, j);
    }

    std::vector<unsigned> number(unique.size());
    for (unsigned i = 0; i < unique.size(); ++i) {
        const unsigned root = sets.find(i); // the least, so numbered already
        if (root == i) {
            number[i] = unsigned(welded.positions.size());
            welded.positions.emplace_back(unique[i].position);
        } else {
            number[i] = number[root];
        }
    }
    for (unsigned& vertex : welded.vertexOf) vertex = number[vertex];
    return welded;
}

} // namespace quasilux
