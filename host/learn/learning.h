// What is learned of a scene before pass 0, by paths from the camera and rounds of photons with random numbers of their
// own (docs/method/learning.md): a function of scene, settings and seed.
#pragma once

#include "device/program.h"
#include "learn/guide.h"
#include "prepare/device_scene.h"

#include <functional>
#include <string>

namespace quasilux {

struct SceneBuffers {
    const Buffer<shared::BvhNode>& nodes;
    const Buffer<shared::PrimitiveBlock>& blocks;
    Buffer<uint32_t>& tables;
};

/// What a round of photons found.
struct RoundResult {
    std::vector<shared::PhotonRecord> photons;              ///< what each would bring to the image
    std::array<double, LIGHT_CLASSES> density{};            ///< sum of RegionCount::density over photons / their number
    std::array<double, DISTANCE_OCTAVES> densityByOctave{}; ///< likewise
    double seenShare = 1;                                   ///< of photons on surfaces: where importance paths gathered
};
/// Traces photons, numbered as a round, guided by what `scene` has learned so far.
using PhotonRound = std::function<RoundResult(unsigned round)>;

/// All that is learned. It can be given to other renders of the scene, whatever their settings: images keep their
/// means.
struct LearnedScene {
    LearnedTables tables; ///< without leaves: nothing was learned
    /// Photons of a class about what the camera sees, by area, for each photon of a pass: the mean over the camera's
    /// paths. 0: not known.
    std::array<double, LIGHT_CLASSES> density{};
    /// Of all classes together in a distance octave (ImportanceGrid::nearest): `arrived` / `gathered` is the density.
    struct Octave {
        double arrived = 0, gathered = 0;
    };
    std::array<Octave, DISTANCE_OCTAVES> octaves{};
    /// What a photon of the last round was worth to the image, times the number of photons; 0: photons are worth much
    /// the same, or it is not known.
    double usualWorth = 0;
    /// Share of the image's light that photons are to bring, as camera paths saw it: each pixel's relative to its
    /// brightness.
    double lightOfPhotons = 0;
    /// As many equal ones as have the same variance for that light, over the photons of the last round; below 0: not
    /// known.
    double effectiveShare = -1;
    double seconds = 0; ///< spent on it; 0 where it was read from a file
};

class Learning {
public:
    /// `program` has kernels/importance_paths.cl, importance_records.cl and importance_cells.cl; `params` as camera
    /// paths have them.
    Learning(Device& device, const Program& program, DeviceScene& scene, SceneBuffers buffers,
             const shared::CameraParams& params);

    /// Follows paths from the camera; `scene` then has what they found: the guide, the importance, how direct light is
    /// to be taken, of some emitters from photons if it may.
    void followImportance(bool directMayUsePhotons);
    /// Rounds of photons, each guided by all before.
    void traceRounds(const PhotonRound& round);

    const LearnedScene& learned() const { return learned_; }

private:
    std::vector<shared::EmissionPoint> invert(const std::vector<shared::EmissionRecord>& records,
                                              const std::vector<shared::GuideSource>& sources);
    std::vector<shared::ImportancePath> tracePaths(const Buffer<shared::ImportancePath>& buffer, unsigned count,
                                                   unsigned directEnvironment);
    std::vector<shared::ImportancePath> tracePathsByBetterEnvironment(const Buffer<shared::ImportancePath>& buffer,
                                                                      unsigned count);
    void makeImportance(const Buffer<shared::ImportancePath>& buffer, const std::vector<shared::ImportancePath>& paths,
                        const std::vector<double>& weights);
    void note(const RoundResult& result);
    void learnFrom(const std::vector<shared::PhotonRecord>& photons);
    void forget();
    bool windowsHold() const;
    void upload();

    Device& device_;
    const Program& program_;
    DeviceScene& scene_;
    SceneBuffers buffers_;
    shared::CameraParams params_;
    GuideLearner guide_;
    LearnedScene learned_;
    std::vector<uint32_t> seenCells_;
    double gathered_ = 0; ///< sum of what makes up ImportanceGrid's first values, times the cells' areas
};

} // namespace quasilux
