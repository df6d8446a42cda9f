#include "auto/search.h"

#include "render/adaptive_radius.h"
#include "render/renderer.h"
#include "util/error.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace quasilux {

namespace {

constexpr unsigned fewestPasses = 2; // for an estimate of their noise
// Numbers next to each other differ by little, and show it only when radii by pixel have been chosen.
constexpr unsigned fewestOfNumbers = 4 * passesOfEqualRadius;
// Of relMSE: the uncertainty of so few passes; photons by pixels and this radius are known to serve most scenes
constexpr double leastGainOfNumbers = 1.2;
constexpr unsigned mostPasses = 256; // of a contender: those to come are better spent on the image
constexpr unsigned mostAtFirst = 32; // before any is given up
// Of the time for pilots, the rest is for numbers: a wrong method costs more than a wrong number.
constexpr double shareOfMethods = 0.75;
constexpr double farWorse = 4; // times the least relMSE: given up whatever the others have
constexpr double mostPhotonsFactor = 16, mostRadiusFactor = 2; // either way from where the search starts
// Of the time that is left, for the pilot of camera paths by pixel, and as much again for that of the image.
constexpr double shareOfSamplingPilot = 0.03;
// The gain is known to some 5 %, and both probes may take 6 % of the time.
constexpr double leastGainOfSampling = 1.1;
// The time of a render, in passes and in camera paths of all pixels that gather nothing, from which on it may lose a
// few passes.
constexpr double leastPassesOfTime = 16, leastPathsOfTime = 64;
constexpr double leastSeconds = 1;       // renders shorter than this are not worth a search
constexpr double longestHorizon = 86400; // seconds, where only an error was asked for

constexpr uint64_t pilotSeed = 0x9E3779B97F4A7C15ull; // added: what decides must be no part of the image

/// What an action failed with, unless the whole render is given up.
std::optional<std::string> failureUnlessAbandoned(const std::function<void()>& action) {
    bool isAbandoned = false;
    auto why = failureOf([&] {
        try {
            action();
        } catch (const RenderAbandoned&) {
            isAbandoned = true;
        }
    });
    if (isAbandoned) throw RenderAbandoned();
    return why;
}

bool isWithin(double factor, double most) { return factor < most * 1.05 && factor * most > 1 / 1.05; }

} // namespace

Search::Search(SearchWorld world, const Scene& scene, Freedom freedom, const StopRule& stop)
    : world_(std::move(world)), scene_(scene), freedom_(freedom), stop_(stop) {
    if (!stop_.seconds && !stop_.passes && !stop_.relativeError) stop_.seconds = defaultSeconds;
}

SearchResult Search::run(const RenderSettings& settings, std::unique_ptr<Pilot> start) {
    start_ = settings;
    startPhotons_ = start->photonsPerPass();
    report_.freedom = freedom_;
    const double limit = stop_.seconds.value_or(longestHorizon);
    report_.horizon = limit;
    Contender first{settings, std::move(start), {}, rowOf(settings, startPhotons_)};
    bool begun = false;
    std::unique_ptr<Pilot> kept = renderFirst(first, begun);
    if (begun && stop_.relativeError)
        report_.horizon = std::min(limit, world_.clock() + secondsToError(first.measure, *stop_.relativeError, limit));
    startPassSeconds_ = first.measure.secondsPerPass;
    startPathSeconds_ = first.pilot->secondsOfPath();
    note(first, "chosen");
    report_.chosen = first.row;

    const auto all = methods(start_, scene_, freedom_);
    const double time = pilotShare * report_.horizon, ofMethods = shareOfMethods * time;
    const bool hasOthers =
        all.size() > 1 || freedom_.cameraPaths || !numbersBeside(start_, startPhotons_, freedom_).empty();
    report_.interrupted = !begun && interrupted();
    report_.outOfTime = hasOthers && 2 * fewestPasses * startPassSeconds_ > ofMethods;
    if (!begun || !hasOthers || report_.outOfTime || report_.horizon < leastSeconds)
        return kept && begun ? withItsPaths(first, std::move(kept))
                             : SearchResult{start_, report_, kept ? std::move(kept) : std::move(first.pilot)};
    kept.reset();
    first.pilot.reset();

    report_.rows[first.row].passes = 0;
    const double began = world_.clock();
    if (all.size() > 1 || freedom_.cameraPaths) race(all, fewestPasses, 1, ofMethods);
    chooseCameraPaths();
    // Each step that pays is followed by the next one.
    while (!interrupted() && raceOfNumbers(time - (world_.clock() - began))) {
    }
    chooseCameraPaths();
    report_.seconds = world_.clock() - began;
    for (const PilotRow& row : report_.rows) report_.passes += row.passes;
    report_.interrupted = !best_.pilot && interrupted();
    if (!best_.pilot) return {start_, report_, nullptr}; // interrupted, or there was no time
    note(best_, "chosen");
    report_.chosen = best_.row;
    RenderSettings& chosen = best_.settings;
    chosen.cameraSampling = report_.rows[best_.row].settings.cameraSampling =
        samplingOf(best_, best_.measure, chosen.cameraPaths);
    chosen.seed = settings.seed;
    return {chosen, report_, nullptr};
}

// Passes by which settings are chosen are no part of the image. Where a pass, or opening another renderer, takes a
// large part of the time, those of the start are to be kept: nothing is chosen then. Its first pass, which shows that,
// is of the image if it is kept.
bool Search::mayDiscard(Contender& start) {
    if (!freedom_.cameraPaths || report_.horizon < leastSeconds || world_.mostOpen < 2 ||
        2 * start.pilot->secondsToPrepare() > pilotShare * report_.horizon ||
        leastPathsOfTime * start.pilot->secondsOfPath() >= report_.horizon)
        return false;
    const double began = world_.clock();
    return renderUpTo(start, 1) && leastPassesOfTime * (world_.clock() - began) < report_.horizon;
}

// The passes that show whether there is time, of a pilot of its own random numbers if they may be lost; null, and
// `start` has them itself, if they may not, or there is too little memory.
std::unique_ptr<Pilot> Search::renderFirst(Contender& start, bool& begun) {
    std::unique_ptr<Pilot> kept;
    if (mayDiscard(start)) {
        RenderSettings settings = start.settings;
        settings.seed += pilotSeed;
        kept = std::move(start.pilot);
        const auto why = failureUnlessAbandoned([&] {
            start.pilot = world_.open(settings);
            begun = renderUpTo(start, fewestPasses);
        });
        if (!why) return kept;
        start.pilot = std::move(kept);
    }
    begun = renderUpTo(start, fewestPasses);
    return nullptr;
}

// Of a search that had time for `first` alone: at least how many camera paths serve the image best is known. `kept`:
// the start.
SearchResult Search::withItsPaths(Contender& first, std::unique_ptr<Pilot> kept) {
    RenderSettings& chosen = report_.rows[first.row].settings;
    chosen.cameraPaths = cameraPathsOf(first);
    chosen.cameraSampling = samplingOf(first, withPaths(first, chosen.cameraPaths), chosen.cameraPaths);
    report_.passes += first.pilot->passes();
    if (chosen.cameraPaths == start_.cameraPaths && chosen.cameraSampling == start_.cameraSampling)
        return {start_, report_, std::move(kept)};
    return {chosen, report_, nullptr};
}

CameraSampling Search::samplingOf(Contender& contender, const PilotMeasure& measure, unsigned cameraPaths) {
    const CameraSampling before = contender.settings.cameraSampling;
    const double ofPath = (measure.secondsPerPass - measure.secondsOfPhotons) / cameraPaths;
    if (!freedom_.cameraSampling || cameraPaths == 1 || interrupted() ||
        contender.pilot->pathsOfSamplingGain(cameraPaths) * ofPath > shareOfSamplingPilot * secondsLeft())
        return before;
    SamplingGain gain;
    if (failureUnlessAbandoned([&] { gain = contender.pilot->samplingGain(cameraPaths); })) return before;
    return gainOfSampling(measure, gain) > leastGainOfSampling ? CameraSampling::adaptive : CameraSampling::even;
}

// Known from a pilot's noise and times alone, without rendering.
unsigned Search::cameraPathsOf(const Contender& contender) const {
    return freedom_.cameraPaths ? bestCameraPaths(contender.measure, contender.settings.cameraPaths, secondsLeft())
                                : contender.settings.cameraPaths;
}

PilotMeasure Search::withPaths(const Contender& contender, unsigned cameraPaths) {
    return withCameraPaths(contender.measure, double(cameraPaths) / contender.settings.cameraPaths);
}

PilotMeasure Search::atItsBest(const Contender& contender) const {
    return withPaths(contender, cameraPathsOf(contender));
}

// Two of its passes may not know the noise well; with those of a race of numbers it is chosen anew.
void Search::chooseCameraPaths() {
    if (!best_.pilot) return;
    const unsigned paths = cameraPathsOf(best_);
    best_.measure = withPaths(best_, paths); // not by a second choice: the clock runs on
    best_.settings.cameraPaths = report_.rows[best_.row].settings.cameraPaths = paths;
}

bool Search::raceOfNumbers(double seconds) {
    const RenderSettings base = best_.pilot ? best_.settings : start_;
    if (base.caustics == CausticLight::paths) return false; // no photons
    const unsigned photons = best_.pilot ? best_.pilot->photonsPerPass() : startPhotons_;
    auto candidates = untried(numbersBeside(base, photons, freedom_));
    if (candidates.empty()) return false;
    candidates.insert(candidates.begin(), base);
    if (2 * fewestOfNumbers * passCost(base) > seconds) {
        report_.outOfTime = true;
        return false;
    }
    race(candidates, fewestOfNumbers, leastGainOfNumbers, seconds);
    return best_.pilot && text(best_.settings, best_.pilot->photonsPerPass()) != text(base, photons);
}

void Search::race(const std::vector<RenderSettings>& candidates, unsigned fewest, double leastGain, double seconds) {
    const double end = world_.clock() + seconds, middle = world_.clock() + seconds / 2;
    Field field = enter(candidates, fewest, leastGain, middle, end);
    // What must win by some gain wins against the first or not at all: there may be no memory for that beside the best.
    const auto name = [](const RenderSettings& settings) { return text(settings, settings.photonsPerPass); };
    if (leastGain > 1 && (field.empty() || name(field.front().settings) != name(candidates.front()))) return;
    renderAll(field, fewest, mostAtFirst, field.size() > 2 ? middle : end);
    halve(field, end);
    if (field.empty()) return;
    best_ = std::move(field.front());
}

// In their order, as many of them as the time until the `middle` allows; two wherever that until the `end` does.
Search::Field Search::enter(const std::vector<RenderSettings>& candidates, unsigned passes, double leastGain,
                            double middle, double end) {
    Field field;
    for (const auto& candidate : candidates) {
        if (interrupted()) break;
        const double needed = openingSeconds_ + passes * passCost(candidate);
        if (!field.empty() && world_.clock() + needed > (field.size() < 2 ? end : middle)) {
            report_.outOfTime = true;
            break;
        }
        openContender(field, candidate, passes, &candidate == &candidates.front() ? 1 : leastGain);
        if (const size_t most = std::max<size_t>(2, world_.mostOpen); field.size() > most) giveUpWorst(field, most);
    }
    return field;
}

bool Search::renderAll(Field& field, unsigned passes, unsigned most, double end) {
    double cost = 0;
    for (const auto& contender : field) cost += contender.measure.secondsPerPass;
    const double more = std::min<double>(most - passes, std::floor((end - world_.clock()) / cost));
    if (!(more >= 1)) return false;
    for (auto& contender : field) dare(contender, [&] { renderUpTo(contender, passes + static_cast<unsigned>(more)); });
    dropFailed(field);
    return true;
}

// Until one is left. All have the same time, so those that are left have twice as many passes each time, or more where
// there was little time before.
void Search::halve(Field& field, double end) {
    giveUpWorst(field, (field.size() + 1) / 2);
    while (field.size() > 1) {
        unsigned passes = mostPasses;
        for (const auto& contender : field) passes = std::min(passes, contender.measure.passes);
        const double rounds = std::ceil(std::log2(field.size())), now = world_.clock();
        const unsigned most = std::min(std::max(2 * passes, mostAtFirst), mostPasses);
        const bool goesOn = renderAll(field, passes, most, now + (end - now) / rounds);
        giveUpWorst(field, goesOn && !interrupted() ? (field.size() + 1) / 2 : 1);
    }
}

size_t Search::rowOf(const RenderSettings& settings, unsigned photons) {
    const auto found = std::find_if(report_.rows.begin(), report_.rows.end(), [&](const PilotRow& row) {
        return text(row.settings, row.photonsPerPass) == text(settings, photons);
    });
    if (found != report_.rows.end()) return static_cast<size_t>(found - report_.rows.begin());
    PilotRow row;
    row.settings = settings;
    row.photonsPerPass = photons;
    report_.rows.push_back(row);
    return report_.rows.size() - 1;
}

void Search::openContender(Field& field, const RenderSettings& settings, unsigned passes, double leastGain) {
    Contender contender;
    contender.leastGain = leastGain;
    contender.settings = settings;
    contender.settings.seed = start_.seed + pilotSeed;
    contender.settings.cameraPaths = pathsOfTrial(settings);
    // There may be too little memory for another renderer beside the others.
    if (!dare(contender, [&] { contender.pilot = world_.open(contender.settings); })) return;
    contender.row = rowOf(settings, contender.pilot->photonsPerPass());
    contender.earlierPasses = report_.rows[contender.row].passes;
    bool isKnown = false;
    if (!dare(contender, [&] {
            isKnown = renderUpTo(contender, passes) || contender.measure.passes >= fewestPasses;
            note(contender, "given up");
        }))
        return noteFailure(contender);
    openingSeconds_ = contender.pilot->openingSeconds();
    if (isKnown) field.push_back(std::move(contender));
}

// Without photons a pass of one path takes a fraction of the start's, and knows as little of light that paths seldom
// meet. So it has as many as the start's pass has time for.
unsigned Search::pathsOfTrial(const RenderSettings& settings) const {
    unsigned paths = settings.cameraPaths;
    if (settings.caustics != CausticLight::paths || !freedom_.cameraPaths) return paths;
    while (paths < mostCameraPaths && 2 * paths * startPathSeconds_ <= startPassSeconds_) paths *= 2;
    return paths;
}

bool Search::isWithinBounds(const RenderSettings& settings) const {
    const double photons = settings.photonsPerPass;
    return isWithin(photons == 0 ? 1 : photons / startPhotons_, mostPhotonsFactor) &&
           isWithin(settings.radiusScale / start_.radiusScale, mostRadiusFactor);
}

std::vector<RenderSettings> Search::untried(const std::vector<RenderSettings>& candidates) const {
    std::vector<RenderSettings> left;
    for (const auto& candidate : candidates) {
        const std::string name =
            text(candidate, candidate.photonsPerPass > 0 ? candidate.photonsPerPass : startPhotons_);
        const bool isNew = std::none_of(report_.rows.begin(), report_.rows.end(), [&](const PilotRow& row) {
            return text(row.settings, row.photonsPerPass) == name;
        });
        if (isNew && isWithinBounds(candidate)) left.push_back(candidate);
    }
    return left;
}

bool Search::renderUpTo(Contender& contender, unsigned passes) {
    while (contender.pilot->passes() < passes && !interrupted() &&
           world_.clock() < stop_.seconds.value_or(longestHorizon)) {
        contender.pilot->renderPass();
        if (world_.onPass) world_.onPass(contender.pilot->passes());
    }
    if (contender.pilot->passes() >= fewestPasses) contender.measure = measureOf(contender, {});
    return contender.pilot->passes() >= passes;
}

PilotMeasure Search::measureOf(const Contender& contender, const std::vector<float>& brightness) {
    PilotMeasure measure = contender.pilot->measure(brightness);
    if (contender.settings.caustics == CausticLight::paths)
        return withRareCaustics(measure, causticsByPaths_, contender.settings.cameraPaths);
    causticsByPaths_ = std::max(causticsByPaths_, measure.causticsByPaths);
    return measure;
}

// Relative to the mean of all their images: one that is noisy is too bright where it has its noise, and that would make
// it look better.
void Search::measureTogether(Field& field) {
    Brightness brightness;
    for (auto& contender : field)
        dare(contender, [&] { brightness.add(contender.pilot->radiance(), contender.measure); });
    for (auto& contender : field) dare(contender, [&] { contender.measure = measureOf(contender, brightness.mean()); });
    dropFailed(field);
}

bool Search::dare(Contender& contender, const std::function<void()>& action) {
    if (!contender.failure.empty()) return false;
    if (const auto why = failureUnlessAbandoned(action)) contender.failure = why->empty() ? "no reason given" : *why;
    return contender.failure.empty();
}

void Search::dropFailed(Field& field) {
    for (const auto& contender : field)
        if (!contender.failure.empty()) noteFailure(contender);
    std::erase_if(field, [](const Contender& contender) { return !contender.failure.empty(); });
}

// Keeps the best ones, in the order of their errors, and no more than so many.
void Search::giveUpWorst(Field& field, size_t kept) {
    measureTogether(field);
    if (field.empty()) return;
    std::vector<PilotMeasure> measures;
    for (const auto& contender : field) measures.push_back(atItsBest(contender));
    const auto errors = predictedErrors(measures, secondsLeft());
    std::vector<size_t> order(field.size());
    std::iota(order.begin(), order.end(), size_t{0});
    // One that has seen no light knows no noise; of two alike the one that was there before stays.
    const auto rank = [&](size_t k) { return errors[k] > 0 ? field[k].leastGain * errors[k] : INFINITY; };
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return rank(a) < rank(b); });
    Field left;
    for (const size_t k : order) {
        note(field[k], "given up");
        if (left.size() < kept && (left.empty() || rank(k) < farWorse * rank(order.front())))
            left.push_back(std::move(field[k]));
    }
    field = std::move(left);
}

void Search::note(const Contender& contender, const std::string& outcome) {
    PilotRow& row = report_.rows[contender.row];
    row.passes = contender.earlierPasses + contender.pilot->passes();
    row.outcome = outcome;
    row.openingSeconds = contender.pilot->openingSeconds();
    row.secondsPerPass = contender.measure.secondsPerPass;
    if (contender.measure.passes >= fewestPasses)
        row.predictedError = predictAfter(atItsBest(contender), secondsLeft()).relativeError();
}

void Search::noteFailure(const Contender& contender) {
    PilotRow& row = report_.rows[contender.row];
    row.passes = contender.earlierPasses + contender.pilot->passes();
    row.outcome = failedOutcome + contender.failure;
    row.predictedError = 0;
}

double Search::passCost(const RenderSettings& settings) const {
    const double photons = settings.photonsPerPass == 0 ? 1 : double(settings.photonsPerPass) / startPhotons_;
    const double usual = best_.pilot ? best_.measure.secondsPerPass : startPassSeconds_;
    const double usualPhotons = best_.pilot ? double(best_.pilot->photonsPerPass()) / startPhotons_ : 1;
    return std::max(1.0, photons / usualPhotons) * usual;
}

double Search::secondsLeft() const { return std::max(0.0, report_.horizon - world_.clock()); }

} // namespace quasilux
