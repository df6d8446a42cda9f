// Instances whose boxes meet others are looked at: those of their primitives that may cut something are carried to the
// world.
#include "prepare/instance_cuts.h"

#include "prepare/border_intersections.h"
#include "prepare/border_pairs.h"
#include "prepare/pack.h"
#include "scene/origin.h"

#include <cmath>

namespace quasilux {

namespace {

/// A group's surface, and the tree over what may be cut.
struct GroupSurface {
    explicit GroupSurface(const Surface& of) : surface(of), candidates(collectCandidates(of)), tree(candidates.boxes) {}
    GroupSurface(const GroupSurface&) = delete;
    GroupSurface& operator=(const GroupSurface&) = delete;

    const Surface& surface;
    CutCandidates candidates;
    BoxTree tree;
};

Box intersection(const Box& a, const Box& b) { return {glm::max(a.lower, b.lower), glm::min(a.upper, b.upper)}; }

/// A surface of primitives in the world, whose `primitive` is the number of their patch.
class CarriedSurface {
public:
    void add(const GroupSurface& group, const Instance& instance, unsigned firstPatch,
             const std::vector<unsigned>& patchOfPrimitive, const Box& within) {
        const glm::dmat4 toWorld(instance.toWorld);
        group.tree.visitOverlapping(carried(within, glm::dmat4x3(glm::inverse(toWorld))), [&](unsigned k) {
            const auto triangles = unsigned(group.candidates.triangles.size());
            if (k < triangles) {
                const SurfaceTriangle& own = *group.candidates.triangles[k];
                addTriangle(own, group.surface, toWorld, firstPatch + patchOfPrimitive[own.primitive]);
            } else {
                const SurfaceSphere& own = *group.candidates.spheres[k - triangles];
                const double scale = std::cbrt(std::abs(glm::determinant(glm::dmat3(toWorld))));
                const Sphere sphere{glm::vec3(toWorld * glm::dvec4(own.center, 1)), float(scale * own.radius)};
                surface.spheres.push_back(makeSurfaceSphere(sphere, firstPatch + patchOfPrimitive[own.primitive]));
            }
        });
    }

    void addWorld(const Surface& world, const CutCandidates& candidates, unsigned index,
                  const std::vector<unsigned>& patchOfPrimitive) {
        const auto triangles = unsigned(candidates.triangles.size());
        if (index < triangles) {
            const SurfaceTriangle& own = *candidates.triangles[index];
            addTriangle(own, world, glm::dmat4(1), patchOfPrimitive[own.primitive]);
        } else {
            surface.spheres.push_back(*candidates.spheres[index - triangles]);
            surface.spheres.back().primitive = patchOfPrimitive[surface.spheres.back().primitive];
        }
    }

    Surface surface;

private:
    void addTriangle(SurfaceTriangle triangle, const Surface& from, const glm::dmat4& toWorld, unsigned patch) {
        for (int k = 0; k < 3; ++k) {
            surface.vertices.emplace_back(toWorld * glm::dvec4(from.vertices[triangle.corner[k]], 1));
            triangle.corner[k] = unsigned(surface.vertices.size() - 1);
        }
        triangle.primitive = patch;
        measureTriangle(triangle, surface.vertices);
        surface.triangles.push_back(triangle);
    }
};

/// Cuts between what is of the one and what is of the other; patches of the other begin with `firstPatch`.
void cutBetween(const Surface& surface, unsigned firstPatch, unsigned endPatch, std::vector<BorderSegment>& segments) {
    const CutCandidates candidates = collectCandidates(surface);
    const auto isOther = [&](unsigned patch) { return patch >= firstPatch && patch < endPatch; };
    const auto patchOf = [&](unsigned k) {
        const size_t triangles = candidates.triangles.size();
        return k < triangles ? candidates.triangles[k]->primitive : candidates.spheres[k - triangles]->primitive;
    };
    std::vector<CutSegment> cuts;
    forEachOverlappingPair(candidates.boxes, [&](unsigned i, unsigned j) {
        if (isOther(patchOf(i)) == isOther(patchOf(j))) return;
        cuts.clear();
        const auto [a, b] = cutPair(surface, candidates, i, j, cuts);
        for (const CutSegment& cut : cuts)
            segments.push_back({pack(cut.a), pack(cut.b), std::min(a, b), std::max(a, b)}); // the world's first
    });
}

} // namespace

void cutInstances(const Scene& scene, const Surface& world, const std::vector<Surface>& groups,
                  SurfaceBorders& borders) {
    const CutCandidates ofWorld = collectCandidates(world);
    const auto worldCount = unsigned(ofWorld.boxes.size());
    const std::vector<unsigned> first = firstPatches(scene, borders);
    std::vector<std::unique_ptr<GroupSurface>> prepared;
    prepared.reserve(groups.size());
    for (const Surface& group : groups) prepared.push_back(std::make_unique<GroupSurface>(group));
    std::vector<Box> boxes = ofWorld.boxes;
    boxes.reserve(worldCount + scene.instances.size());
    for (const Instance& instance : scene.instances) boxes.push_back(boxOf(scene, instance));

    const auto add = [&](unsigned instance, const Box& within, CarriedSurface& to) {
        const unsigned group = scene.instances[instance].group;
        to.add(*prepared[group], scene.instances[instance], first[instance], borders.groups[group].patchOfPrimitive,
               within);
    };
    forEachOverlappingPair(boxes, [&](unsigned i, unsigned j) {
        if (j < worldCount) return;
        const Box within = intersection(boxes[i], boxes[j]);
        const unsigned instance = j - worldCount;
        CarriedSurface both;
        add(instance, within, both);
        if (both.surface.triangles.empty() && both.surface.spheres.empty()) return;
        if (i < worldCount)
            both.addWorld(world, ofWorld, i, borders.patchOfPrimitive);
        else
            add(i - worldCount, within, both);
        const unsigned patches = borders.groups[scene.instances[instance].group].patchCount;
        cutBetween(both.surface, first[instance], first[instance] + patches, borders.segments);
    });
}

} // namespace quasilux
