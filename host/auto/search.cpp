#include "auto/search.h"

#include "util/error.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace quasilux {

namespace {

constexpr unsigned stages[] = {2, 4, 8, 16, 32, 64, 128, 256};
// Passes before a candidate may win; more for one whose camera paths scatter on: few passes may miss its bright pixels.
constexpr unsigned fewestToWin = 4, fewestToWinWithMorePaths = 8;
// More passes than fewestToWin are for what few passes leave open, as long as they leave time for other candidates.
constexpr double shareOfOneDuel = 1.0 / 8; // of the time for pilots
// Passes up to this share of that time are rendered before the first judgement: two passes alone often err.
constexpr double shareOfFirstStage = 1.0 / 12;
constexpr double smallGain = 0.05;  // in the logarithm of relMSE: not worth another pass
constexpr double surelyWorse = 1.5; // standard errors
// Before the first judgement only what is that much worse, surely, is given up.
constexpr double hopeless = 0.7, surelyHopeless = 3; // logarithm of relMSE; standard errors
constexpr double surelyBetter = 2;                   // standard errors beyond smallGain
// How much cheaper passes will grow is known to some 20 % from the first ones (docs/auto.md): two candidates that come
// out so close after so many passes, which took next to no time, go on.
constexpr double closeCall = 0.25; // logarithm of relMSE
constexpr unsigned fewestOfCloseCall = 16;
constexpr double clockError = 0.1;       // of the logarithm of the time that one pass takes
constexpr double leastSeconds = 1;       // renders shorter than this are not worth a search
constexpr double longestHorizon = 86400; // seconds, where only an error was asked for
// Kernels not in the runtime's cache take so many times longer to open than those that are; whether the first ones
// were, is not told, so no more than coldSeconds are expected of others (docs/auto.md).
constexpr double coldOverWarm = 10, coldSeconds = 4;
// Radius and photons are tried first where the ratio of bias to noise (both squared) says that it may pay: with noise at most
// as 1 / radius^2 and bias as radius^2.8, radiusStep gains nothing between these bounds where photons make a third of the
// noise or more.
constexpr double littleBias = 0.3, muchBias = 0.5, biasForPhotons = 0.2;
// Photons are tried, too, where they take nearly all of a pass's time, or next to none.
constexpr double fewPhotons = 0.3, manyPhotons = 0.7;
constexpr double mostlyPhotons = 0.5; // of the time; then they are tried before all else

bool isNumber(Coordinate coordinate) { return coordinate == Coordinate::photons || coordinate == Coordinate::radius; }

RenderSettings seededFor(RenderSettings settings, uint64_t seed, size_t row) {
    // Images that are added must not share random numbers.
    settings.seed = seed + 0x9E3779B97F4A7C15ull * row;
    return settings;
}

} // namespace

Search::Search(SearchWorld world, const Scene& scene, Freedom freedom, const StopRule& stop)
    : world_(std::move(world)), scene_(scene), freedom_(freedom), stop_(stop) {
    if (!stop_.seconds && !stop_.passes && !stop_.relativeError) stop_.seconds = defaultSeconds;
}

SearchResult Search::run(const RenderSettings& settings, std::unique_ptr<Pilot> start) {
    report_.freedom = freedom_;
    best_ = {settings, std::move(start), {}, {}, 0};
    startPhotons_ = best_.pilot->photonsPerPass();
    startRadius_ = settings.radiusScale;
    enter(best_);
    const bool begun = renderUpTo(best_, stages[0]);
    began_ = world_.clock();
    ofBest_ = 0;
    if (begun) {
        measure(best_);
        note(best_, "start");
        // Where photons take most of a pass, fewer may make all other candidates cheaper.
        if (best_.measure.photonShare > mostlyPhotons) tryNeighbours(Coordinate::photons);
        while (tryRound(settings) || (!std::exchange(triesAll_, true) && tryRound(settings))) {
        }
        measure(best_);
    }
    note(best_, report_.rows[best_.row].outcome);
    report_.seconds = spent();
    report_.horizon = horizon();
    for (const PilotRow& row : report_.rows) report_.passes += row.passes;
    report_.passes -= report_.rows[report_.chosen].passes;
    return {best_.settings, std::move(best_.pilot), report_};
}

bool Search::tryRound(const RenderSettings& start) {
    const size_t before = report_.rows.size();
    for (const Coordinate coordinate : searchOrder(start)) tryNeighbours(coordinate);
    return report_.rows.size() > before;
}

double Search::spent() const { return world_.clock() - began_ - ofBest_; }

double Search::secondsAllowed() const { return stop_.seconds.value_or(longestHorizon); }

double Search::horizon() const {
    const double limit = secondsAllowed();
    if (!stop_.relativeError || best_.measure.passes < 2) return limit;
    return std::min(limit, world_.clock() + secondsToError(best_.measure, *stop_.relativeError, limit));
}

double Search::secondsLeft() const { return std::max(0.0, horizon() - world_.clock()); }

bool Search::fits(double seconds) const {
    const double end = horizon();
    return end >= leastSeconds && spent() + seconds <= pilotShare * end;
}

bool Search::affords(double seconds) {
    const bool can = fits(seconds);
    if (!can) report_.outOfTime = true;
    return can;
}

bool Search::renderUpTo(Contender& contender, unsigned passes) {
    const double start = world_.clock();
    while (contender.pilot->passes() < passes && !interrupted() && world_.clock() < secondsAllowed()) {
        contender.pilot->renderPass();
        if (world_.onPass) world_.onPass(contender.pilot->passes());
    }
    if (&contender == &best_) ofBest_ += world_.clock() - start;
    return contender.pilot->passes() >= passes;
}

void Search::measure(Contender& contender) {
    if (contender.measure.passes == contender.pilot->passes()) return;
    contender.measure = contender.pilot->measure();
    contender.stages.emplace(contender.measure.passes, contender.measure);
}

void Search::enter(Contender& contender) {
    contender.row = report_.rows.size();
    PilotRow row;
    row.settings = contender.settings;
    row.photonsPerPass = contender.pilot->photonsPerPass();
    report_.rows.push_back(row);
}

void Search::note(const Contender& contender, const std::string& outcome) {
    PilotRow& row = report_.rows[contender.row];
    row.passes = contender.pilot->passes();
    row.outcome = outcome;
    row.openingSeconds = contender.pilot->openingSeconds();
    row.secondsPerPass = contender.measure.secondsPerPass;
    if (contender.measure.passes > 1)
        row.predictedError = predictAfter(contender.measure, secondsLeft()).relativeError();
    const std::string key = kernelKey(contender.settings, scene_);
    if (!opening(key)) openings_.emplace_back(key, row.openingSeconds);
}

std::optional<double> Search::opening(const std::string& key) const {
    for (const auto& [known, seconds] : openings_)
        if (known == key) return seconds;
    return std::nullopt;
}

double Search::openingCost(const RenderSettings& settings) const {
    // Kernels compiled before come from the runtime's cache, in no more than they took then.
    if (const auto known = opening(kernelKey(settings, scene_))) return *known;
    if (openings_.size() > 1) return openings_.back().second;
    const double first = openings_.front().second;
    return std::max(first, std::min(coldOverWarm * first, coldSeconds));
}

bool Search::isWorthTrying(Coordinate coordinate, const RenderSettings& settings) const {
    if (!isNumber(coordinate)) return true;
    const double photons = settings.photonsPerPass, scale = settings.radiusScale / startRadius_;
    const bool byRadius = coordinate == Coordinate::radius;
    if (byRadius && (scale > 2.1 || scale < 0.45)) return false;
    if (!byRadius && (photons > mostPhotons * startPhotons_ || photons < std::floor(startPhotons_ / mostPhotons)))
        return false;
    if (triesAll_ && !byRadius) return true;
    const Prediction now = predictAfter(best_.measure, secondsLeft());
    const bool sharper =
        byRadius ? settings.radiusScale < best_.settings.radiusScale : photons > best_.pilot->photonsPerPass();
    const bool isBiased = tellsBias(best_.measure);
    if (byRadius) return sharper ? isBiased && now.bias > muchBias * now.noise : now.bias < littleBias * now.noise;
    const double photonShare = best_.measure.photonShare;
    return sharper ? (isBiased && now.bias > biasForPhotons * now.noise) || photonShare < fewPhotons
                   : now.bias < littleBias * now.noise || photonShare > manyPhotons;
}

void Search::tryNeighbours(Coordinate coordinate) {
    const unsigned photons = best_.pilot->photonsPerPass();
    for (const auto& next : neighbours(coordinate, best_.settings, photons, scene_, freedom_)) {
        if (interrupted()) return;
        if (!tryCandidate(coordinate, next)) continue;
        if (isNumber(coordinate)) return tryNeighbours(coordinate); // the next step the same way
        if (coordinate != Coordinate::split) return;
        const unsigned bdd = best_.settings.bdd;
        if (bdd > 0) tryNeighbours(Coordinate::bdd); // with this split shorter paths may do
        if (best_.settings.bdd != bdd) return tryNeighbours(Coordinate::split);
    }
}

bool Search::tryCandidate(Coordinate coordinate, const RenderSettings& settings) {
    const std::string key = text(settings, settings.photonsPerPass);
    if (std::find(tried_.begin(), tried_.end(), key) != tried_.end() || !isWorthTrying(coordinate, settings))
        return false;
    const double share =
        settings.photonsPerPass == 0 ? 1 : double(settings.photonsPerPass) / best_.pilot->photonsPerPass();
    const double pass = std::max(1.0, share) * best_.measure.secondsPerPass;
    if (!affords(openingCost(settings) + stages[0] * pass)) return false;
    tried_.push_back(text(best_.settings, best_.settings.photonsPerPass));
    tried_.push_back(key);
    Contender challenger;
    challenger.settings = settings;
    const auto seeded = seededFor(settings, report_.rows.front().settings.seed, report_.rows.size());
    // There may be too little memory for another renderer beside the best one.
    if (refusal([&] { challenger.pilot = world_.open(seeded); })) return false;
    enter(challenger);
    const Verdict verdict = duel(challenger);
    note(challenger, verdict == Verdict::better ? "better" : verdict == Verdict::worse ? "worse" : "undecided");
    if (verdict == Verdict::better) {
        report_.chosen = challenger.row;
        std::swap(best_, challenger);
        note(challenger, report_.rows[challenger.row].outcome);
    }
    challenger.pilot.reset();
    return verdict == Verdict::better;
}

unsigned Search::fewestToWinAgainst(const Contender& best, const Contender& challenger) {
    return challenger.settings.bdd > best.settings.bdd ? fewestToWinWithMorePaths : fewestToWin;
}

ErrorRatio Search::against(const Contender& challenger) const {
    const unsigned passes = challenger.measure.passes;
    const auto stage = best_.stages.find(passes);
    const PilotMeasure& best = stage == best_.stages.end() ? best_.measure : stage->second;
    ErrorRatio found = errorRatio(challenger.measure, best, secondsLeft());
    found.standardError = std::hypot(found.standardError, clockError * std::sqrt(2.0 / (passes - 1)));
    return found;
}

bool Search::isHopeless(const Contender& challenger) const {
    if (challenger.measure.passes < fewestToWin) return false;
    const ErrorRatio found = against(challenger);
    return found.logRatio - surelyHopeless * found.standardError > hopeless;
}

bool Search::isCloseCall(const Contender& challenger) const {
    return challenger.measure.passes >= fewestOfCloseCall && std::abs(against(challenger).logRatio) < closeCall;
}

Search::Verdict Search::judge(const Contender& challenger, bool isLast) const {
    const Prediction predicted = predictAfter(challenger.measure, secondsLeft());
    if (!(predicted.noise > 0)) return Verdict::undecided; // it has seen nothing, or there is nothing to gain
    const ErrorRatio found = against(challenger);
    const unsigned passes = challenger.measure.passes;
    const bool fewerPaths = challenger.settings.bdd < best_.settings.bdd; // wins where both are alike: it hides nothing
    const bool mayWin = passes >= fewestToWinAgainst(best_, challenger);
    const double error = found.standardError;
    if (found.logRatio - surelyWorse * error > -smallGain) return Verdict::worse;
    if (passes >= fewestToWin && found.logRatio > (fewerPaths ? 0 : -smallGain)) return Verdict::worse;
    const double margin = isLast ? (fewerPaths ? 0 : error) : surelyBetter * error + smallGain;
    return mayWin && found.logRatio + margin < 0 ? Verdict::better : Verdict::undecided;
}

Search::Verdict Search::duel(Contender& challenger) {
    Verdict verdict = Verdict::undecided;
    const double share = pilotShare * horizon();
    for (const unsigned passes : stages) {
        const double more = (passes - challenger.pilot->passes()) * challenger.measure.secondsPerPass;
        const bool isLong = passes > fewestToWinAgainst(best_, challenger) && more > shareOfOneDuel * share;
        if (verdict != Verdict::undecided && (isLong || !fits(more))) return verdict;
        if (more > 0 && (!affords(more) || isLong)) return judge(challenger, true);
        // As many of the best one: it may be the one whose bright pixels are rare.
        const bool isWhole = renderUpTo(challenger, passes) && renderUpTo(best_, passes);
        if (challenger.pilot->passes() < 2) return Verdict::undecided; // interrupted
        measure(challenger);
        measure(best_);
        const bool isLast = !isWhole || passes == stages[std::size(stages) - 1];
        const double next = 2 * passes * challenger.measure.secondsPerPass;
        const bool isEarly = !isLast && next < shareOfFirstStage * share;
        if (isEarly && !isHopeless(challenger) && fits(next)) continue;
        verdict = judge(challenger, isLast);
        const bool goesOn = verdict == Verdict::undecided || isCloseCall(challenger);
        if (!isWhole || !goesOn) return verdict;
    }
    return verdict;
}

} // namespace quasilux
