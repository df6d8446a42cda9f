#include "output/checkpoint_file.h"

#include "output/json_number.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstring>
#include <filesystem>

namespace quasilux {

static_assert(std::endian::native == std::endian::little, "numbers in checkpoints are little-endian");

namespace {

// Whoever changes the format changes the last digit.
constexpr std::array<char, 8> magic{'Q', 'L', 'X', 'C', 'K', 'P', 'T', '2'};
// At the end: bytes of the description, checksum of all before it.
constexpr uint64_t tailBytes = sizeof(uint64_t) + Checksum::bytes;
constexpr size_t bytesAtOnce = size_t(16) << 20;

} // namespace

std::string previousCheckpoint(const std::string& path) { return path + ".previous"; }

CheckpointWriter::CheckpointWriter(const std::string& path)
    : path_(path), file_(path, path + ".tmp"), stream_(file_, path) {
    put(magic.data(), magic.size());
}

void CheckpointWriter::put(const void* data, size_t bytes) {
    stream_.write(data, bytes);
    checksum_.add(data, bytes);
    written_ += bytes;
}

void CheckpointWriter::begin(const std::string& name) { arrays_.push_back({name, written_, 0}); }

void CheckpointWriter::write(const void* data, size_t bytes) {
    put(data, bytes);
    arrays_.back()[2] = arrays_.back()[2].get<uint64_t>() + bytes;
}

void CheckpointWriter::finish(nlohmann::json description) {
    description["arrays"] = arrays_;
    // Names of files may have any bytes.
    const std::string text = description.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    const uint64_t bytes = text.size();
    put(text.data(), text.size());
    put(&bytes, sizeof bytes);
    const std::string digest = checksum_.digest();
    stream_.write(digest.data(), digest.size());
    stream_.close();
    file_.commitKeeping(previousCheckpoint(path_));
}

CheckpointReader::CheckpointReader(const std::string& path) : path_(path), stream_(path, std::ios::binary) {
    const int why = errno;
    std::error_code status;
    const uint64_t bytes = std::filesystem::file_size(path, status);
    if (!stream_ || status)
        throw InputError("checkpoint " + path + ": cannot be read (" +
                         (status ? status.message() : std::string(std::strerror(why))) + ")");
    check(bytes);
}

void CheckpointReader::damaged(const std::string& why) const {
    const std::string previous = previousCheckpoint(path_);
    std::error_code status;
    throw InputError("checkpoint " + path_ + ": " + why +
                     (std::filesystem::exists(previous, status) ? "; the one before it is " + previous : ""));
}

void CheckpointReader::readAt(uint64_t offset, void* into, size_t bytes) const {
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(offset));
    stream_.read(static_cast<char*>(into), static_cast<std::streamsize>(bytes));
    if (!stream_) damaged("cannot be read to its end");
}

void CheckpointReader::check(uint64_t fileBytes) {
    std::array<char, magic.size()> first{};
    if (fileBytes >= first.size()) readAt(0, first.data(), first.size());
    if (first != magic) damaged("is no checkpoint of this version of quasilux, or its beginning is damaged");
    if (fileBytes < magic.size() + tailBytes) damaged("is damaged: truncated");
    const uint64_t covered = fileBytes - Checksum::bytes;
    Checksum checksum;
    std::vector<char> piece(std::min<uint64_t>(covered, bytesAtOnce));
    for (uint64_t at = 0; at < covered; at += piece.size()) {
        piece.resize(std::min<uint64_t>(piece.size(), covered - at));
        readAt(at, piece.data(), piece.size());
        checksum.add(piece);
    }
    std::string stored(Checksum::bytes, 0);
    readAt(covered, stored.data(), stored.size());
    if (stored != checksum.digest()) damaged("is damaged: its checksum is wrong, so it was truncated or altered");
    uint64_t bytes = 0;
    const uint64_t end = covered - sizeof bytes;
    readAt(end, &bytes, sizeof bytes);
    if (bytes > end - magic.size()) damaged("is damaged: its description has no room");
    describe(end, bytes);
}

// All is right by its checksum; what is wrong here was written so.
void CheckpointReader::describe(uint64_t end, uint64_t bytes) {
    std::string text(bytes, 0);
    readAt(end - bytes, text.data(), text.size());
    try {
        description_ = nlohmann::json::parse(text);
        for (const auto& row : description_.at("arrays")) {
            const Place found{wholeNumber<uint64_t>(row.at(1)), wholeNumber<uint64_t>(row.at(2))};
            if (found.offset > end - bytes || found.bytes > end - bytes - found.offset)
                damaged("is damaged: an array lies outside");
            places_[row.at(0).get<std::string>()] = found;
        }
    } catch (const nlohmann::json::exception& error) {
        damaged(std::string("its description cannot be read: ") + error.what());
    }
}

std::vector<std::string> CheckpointReader::names() const {
    std::vector<std::string> names;
    for (const auto& row : description_.at("arrays")) names.push_back(row.at(0).get<std::string>());
    return names;
}

const CheckpointReader::Place& CheckpointReader::place(const std::string& name) const {
    const auto found = places_.find(name);
    if (found == places_.end()) damaged("has no array '" + name + "': it is of another version of quasilux");
    return found->second;
}

void CheckpointReader::read(const std::string& name, uint64_t offset, void* into, size_t bytes) const {
    const Place& found = place(name);
    if (offset > found.bytes || bytes > found.bytes - offset) damaged("array '" + name + "' is too short");
    if (bytes > 0) readAt(found.offset + offset, into, bytes);
}

} // namespace quasilux
