#include "output/merge_checkpoints.h"

#include "render/film_merge.h"
#include "render/render_counters.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

namespace {

struct PartFile {
    std::unique_ptr<CheckpointReader> reader;
    Checkpoint checkpoint;
};

struct NamedRange {
    PassRange range;
    std::string path;
};

std::vector<PartFile> openParts(const std::vector<std::string>& paths) {
    std::vector<PartFile> parts;
    for (const auto& path : paths) {
        PartFile part{std::make_unique<CheckpointReader>(path), {}};
        part.checkpoint = checkpointOf(*part.reader);
        if (part.checkpoint.passes.empty())
            throw InputError(fmt::format("checkpoint {}: it has no pass yet: resume it first", path));
        if (!parts.empty())
            if (const auto difference = differenceOfImage(part.checkpoint, parts.front().checkpoint);
                !difference.empty())
                throw InputError(
                    fmt::format("checkpoint {}: not of the same image as {}: {}", path, paths.front(), difference));
        parts.push_back(std::move(part));
    }
    std::stable_sort(parts.begin(), parts.end(), [](const PartFile& a, const PartFile& b) {
        return a.checkpoint.passes.front().first < b.checkpoint.passes.front().first;
    });
    return parts;
}

/// All passes in their order. Throws InputError where two have one in common.
std::vector<PassRange> unionOf(const std::vector<PartFile>& parts) {
    std::vector<NamedRange> all;
    for (const PartFile& part : parts)
        for (const PassRange& range : part.checkpoint.passes) all.push_back({range, part.reader->path()});
    std::sort(all.begin(), all.end(),
              [](const NamedRange& a, const NamedRange& b) { return a.range.first < b.range.first; });
    std::vector<PassRange> ranges;
    for (size_t k = 0; k < all.size(); ++k) {
        const PassRange& range = all[k].range;
        if (k > 0 && range.first < all[k - 1].range.end) {
            const PassRange common{range.first, std::min(range.end, all[k - 1].range.end)};
            throw InputError(fmt::format("{} and {} both have passes {}: each pass may be there once", all[k - 1].path,
                                         all[k].path, text({common})));
        }
        ranges.push_back(range);
    }
    return joined(std::move(ranges));
}

} // namespace

MergedPasses::MergedPasses(const std::vector<std::string>& paths) {
    auto parts = openParts(paths);
    const auto passes = unionOf(parts);
    for (const PartFile& part : parts) add(*part.reader, part.checkpoint);
    checkpoint_.passes = passes;
    checkpoint_.stop = {};
    checkpoint_.stop.firstPass = passes.front().first;
    checkpoint_.stop.passes = passes.back().end;
    last_ = std::move(std::max_element(parts.begin(), parts.end(), [](const PartFile& a, const PartFile& b) {
                          return a.checkpoint.passes.back().end < b.checkpoint.passes.back().end;
                      })->reader);
}

void MergedPasses::add(const CheckpointReader& reader, const Checkpoint& part) {
    const size_t pixels = size_t(part.width) * part.height, floats = part.film.floatsPerPixel();
    reader.requireBytes("film", pixels * floats * sizeof(float));
    const auto counts = reader.record<FilmCounts>("film counts");
    if (sums_.empty()) {
        sums_ = reader.array<float>("film");
        counts_ = counts;
        checkpoint_ = part;
        return;
    }
    std::vector<float> piece;
    const size_t pixelsAtOnce = valuesAtOnce / floats;
    for (size_t first = 0; first < pixels; first += pixelsAtOnce) {
        const size_t count = std::min(pixelsAtOnce, pixels - first);
        piece.resize(count * floats);
        reader.read("film", first * floats * sizeof(float), piece.data(), piece.size() * sizeof(float));
        mergeFilmSums(sums_.data() + first * floats, counts_, piece.data(), counts, count, part.film);
    }
    counts_ = mergedCounts(counts_, counts);
    addCounts(checkpoint_.counters, part.counters);
    checkpoint_.seconds += part.seconds;
    addTimings(checkpoint_.timings, part.timings);
}

FilmImage MergedPasses::develop() const {
    FilmImage image;
    image.width = checkpoint_.width;
    image.height = checkpoint_.height;
    FilmDeveloper developer(checkpoint_.film, counts_, static_cast<unsigned>(checkpoint_.counters.passes), image);
    developer.develop(sums_.data(), 0, size_t(image.width) * image.height);
    developer.finish();
    return image;
}

void MergedPasses::write(const std::string& path) const {
    CheckpointWriter writer(path);
    for (const auto& name : last_->names()) {
        if (name == "film")
            writer.array(name, sums_);
        else if (name == "film counts")
            writer.record(name, counts_);
        else
            writer.array(name, last_->array<char>(name));
    }
    writer.finish(describe(checkpoint_));
}

} // namespace quasilux
