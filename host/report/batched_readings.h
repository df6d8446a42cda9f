// What a meter reads, in batches of passes: the standard error of whatever follows from all points together.
#pragma once

#include "render/film_image.h"

#include <functional>
#include <vector>

namespace quasilux {

/// A figure with what is known of it.
struct Figure {
    double value = 0;
    double standardError = 0; ///< NaN: too few passes to say
    unsigned batches = 0;     ///< that the error is from
    /// Of extremes of noisy points: how much the noise itself lowers a minimum (above 0) or raises a maximum (below 0),
    /// at most.
    double bias = 0;

    bool isKnown() const;
    /// Half of the interval of 95 %, by Student's t of one batch less.
    double halfWidth() const;
    /// halfWidth() over the value; infinity where unknown.
    double relativeHalfWidth() const;
};

/// Illuminances of each point after each pass, lx. Passes are independent, points are not: they share photons. So
/// figures of several points take their error from batches, by the jackknife (Quenouille 1956; Tukey 1958): leave out
/// each in turn.
class BatchedReadings {
public:
    using Points = std::vector<double>;
    using Rule = std::function<double(const Points&)>;

    explicit BatchedReadings(bool photometric) : photometric_(photometric) {}

    /// The film as it is after one more pass, or several.
    void add(const FilmImage& soFar);

    unsigned passes() const { return passes_; }
    Points means() const { return meansOf(sums_, passes_); }
    /// Of each point's mean, from the batches; there must be two.
    Points standardErrors() const;
    /// Of every other batch, and of the rest; nothing is left out but what is no whole batch yet.
    std::pair<Points, Points> halves() const;
    Figure figure(const Rule& rule) const;

private:
    struct Batch {
        unsigned passes = 0;
        Points sums;
    };
    static Points meansOf(const Points& sums, unsigned passes);
    void close();

    bool photometric_;
    unsigned passes_ = 0, passesOfBatch_ = 1;
    Points sums_;
    std::vector<Batch> batches_; ///< of equal numbers of passes
    Batch open_;
};

/// Fewer batches say nothing of the error.
inline constexpr unsigned fewestBatches = 8;

} // namespace quasilux
