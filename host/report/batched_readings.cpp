#include "report/batched_readings.h"

#include "scene/photometric_units.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace quasilux {

namespace {

// When there are so many, each two become one: at the end there are half as many to all of them.
constexpr size_t mostBatches = 64;
// Values that batches hold together at most; grids of very many points have fewer batches.
constexpr size_t mostValues = size_t{1} << 25;

size_t batchesOf(size_t values) {
    const size_t affordable = mostValues / std::max<size_t>(values, 1) / 2 * 2;
    return std::clamp(affordable, size_t{2 * fewestBatches}, mostBatches);
}

void addTo(BatchedReadings::Points& sums, const BatchedReadings::Points& more, double sign) {
    sums.resize(more.size());
    for (size_t k = 0; k < more.size(); ++k) sums[k] += sign * more[k];
}

} // namespace

bool Figure::isKnown() const { return std::isfinite(value) && std::isfinite(standardError); }

double Figure::halfWidth() const {
    if (!isKnown() || batches < 2) return std::numeric_limits<double>::infinity();
    const double freedom = batches - 1.0; // Cornish & Fisher's series, within 0.4 % from 7 on
    const double z = 1.959964, t = z + (z * z * z + z) / (4 * freedom) +
                                   (5 * std::pow(z, 5) + 16 * z * z * z + 3 * z) / (96 * freedom * freedom);
    return t * standardError;
}

double Figure::relativeHalfWidth() const {
    return value != 0 ? halfWidth() / std::abs(value) : std::numeric_limits<double>::infinity();
}

void BatchedReadings::add(const FilmImage& soFar) {
    if (soFar.passes <= passes_) return;
    const double factor = soFar.passes * (photometric_ ? 1.0 : luminousEfficacy);
    Points sums;
    for (size_t k = 0; k + 2 < soFar.radiance.size(); k += 3)
        sums.push_back(factor * luminanceOf(soFar.radiance[k], soFar.radiance[k + 1], soFar.radiance[k + 2]));
    addTo(open_.sums, sums, 1);
    if (passes_ > 0) addTo(open_.sums, sums_, -1);
    open_.passes += soFar.passes - passes_;
    passes_ = soFar.passes;
    sums_ = std::move(sums);
    if (open_.passes >= passesOfBatch_) close();
}

void BatchedReadings::close() {
    batches_.push_back(std::move(open_));
    open_ = {};
    if (batches_.size() < batchesOf(sums_.size())) return;
    for (size_t k = 0; k < batches_.size() / 2; ++k) {
        Batch both = std::move(batches_[2 * k]);
        addTo(both.sums, batches_[2 * k + 1].sums, 1);
        both.passes += batches_[2 * k + 1].passes;
        batches_[k] = std::move(both);
    }
    batches_.resize(batches_.size() / 2);
    passesOfBatch_ *= 2;
}

BatchedReadings::Points BatchedReadings::meansOf(const Points& sums, unsigned passes) {
    Points means = sums;
    for (double& value : means) value /= passes;
    return means;
}

std::pair<BatchedReadings::Points, BatchedReadings::Points> BatchedReadings::halves() const {
    Batch parts[2];
    for (size_t k = 0; k < batches_.size() / 2 * 2; ++k) {
        addTo(parts[k % 2].sums, batches_[k].sums, 1);
        parts[k % 2].passes += batches_[k].passes;
    }
    return {meansOf(parts[0].sums, parts[0].passes), meansOf(parts[1].sums, parts[1].passes)};
}

BatchedReadings::Points BatchedReadings::standardErrors() const {
    const auto n = static_cast<double>(batches_.size());
    Points sums(sums_.size()), squares(sums_.size());
    for (const Batch& batch : batches_)
        for (size_t k = 0; k < sums.size(); ++k) {
            const double mean = batch.sums[k] / batch.passes;
            sums[k] += mean;
            squares[k] += mean * mean;
        }
    Points errors(sums.size());
    for (size_t k = 0; k < sums.size(); ++k)
        errors[k] = std::sqrt(std::max(squares[k] - sums[k] * sums[k] / n, 0.0) / (n * (n - 1)));
    return errors;
}

Figure BatchedReadings::figure(const Rule& rule) const {
    Figure figure;
    if (passes_ == 0) return {std::nan(""), std::nan("")};
    figure.value = rule(means());
    figure.batches = static_cast<unsigned>(batches_.size());
    figure.standardError = std::nan("");
    if (figure.batches < fewestBatches) return figure;
    std::vector<double> without;
    double mean = 0;
    for (const Batch& batch : batches_) {
        Points sums = sums_;
        addTo(sums, batch.sums, -1);
        without.push_back(rule(meansOf(sums, passes_ - batch.passes)));
        mean += without.back() / figure.batches;
    }
    double squares = 0;
    for (const double value : without) squares += (value - mean) * (value - mean);
    figure.standardError = std::sqrt(squares * (figure.batches - 1) / figure.batches);
    return figure;
}

} // namespace quasilux
