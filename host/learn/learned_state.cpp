#include "learn/learned_state.h"

namespace quasilux {

namespace {

// All that is no array. Without gaps, so that equal scenes have equal bytes.
struct Numbers {
    std::array<double, LIGHT_CLASSES> density;
    std::array<LearnedScene::Octave, DISTANCE_OCTAVES> octaves;
    double usualWorth, lightOfPhotons, effectiveShare, typicalFlux;
    shared::ImportanceGrid importance;
    uint32_t isGuided, lightBlockSize, directEnvironment, unused;
};

} // namespace

void saveLearned(StateSink& sink, const LearnedScene& learned) {
    const LearnedTables& tables = learned.tables;
    Numbers numbers{};
    numbers.density = learned.density;
    numbers.octaves = learned.octaves;
    numbers.usualWorth = learned.usualWorth;
    numbers.lightOfPhotons = learned.lightOfPhotons;
    numbers.effectiveShare = learned.effectiveShare;
    numbers.typicalFlux = tables.guide.typicalFlux;
    numbers.importance = tables.importance;
    numbers.isGuided = tables.guide.isGuided;
    numbers.lightBlockSize = tables.lightBlockSize;
    numbers.directEnvironment = tables.directEnvironment;
    sink.record("learned", numbers);
    sink.array("learned: sources", tables.guide.sources);
    sink.array("learned: leaves", tables.guide.leaves);
    sink.array("learned: direct by photons",
               std::vector<uint8_t>(tables.directByPhotons.begin(), tables.directByPhotons.end()));
    sink.array("learned: lights", tables.lights);
    sink.array("learned: later lights", tables.laterLights);
    sink.array("learned: aims", tables.aims);
    sink.array("learned: importance", tables.importanceCells);
    sink.array("learned: seen cells", tables.seenCells);
}

LearnedScene restoreLearned(const StateSource& source) {
    const auto numbers = source.record<Numbers>("learned");
    LearnedScene learned;
    learned.density = numbers.density;
    learned.octaves = numbers.octaves;
    learned.usualWorth = numbers.usualWorth;
    learned.lightOfPhotons = numbers.lightOfPhotons;
    learned.effectiveShare = numbers.effectiveShare;
    LearnedTables& tables = learned.tables;
    tables.guide.typicalFlux = numbers.typicalFlux;
    tables.guide.isGuided = numbers.isGuided != 0;
    tables.guide.sources = source.array<shared::GuideSource>("learned: sources");
    tables.guide.leaves = source.array<shared::GuideLeaf>("learned: leaves");
    const auto direct = source.array<uint8_t>("learned: direct by photons");
    tables.directByPhotons.assign(direct.begin(), direct.end());
    tables.lights = source.array<shared::LightChoice>("learned: lights");
    tables.laterLights = source.array<shared::LightChoice>("learned: later lights");
    tables.lightBlockSize = numbers.lightBlockSize;
    tables.directEnvironment = numbers.directEnvironment;
    tables.aims = source.array<shared::AimSource>("learned: aims");
    tables.importance = numbers.importance;
    tables.importanceCells = source.array<uint32_t>("learned: importance");
    tables.seenCells = source.array<uint32_t>("learned: seen cells");
    return learned;
}

} // namespace quasilux
