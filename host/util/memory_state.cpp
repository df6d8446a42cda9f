#include "util/memory_state.h"

#include <cstring>

namespace quasilux {

namespace {

void append(std::vector<char>& to, const void* data, size_t bytes) {
    const auto* first = static_cast<const char*>(data);
    to.insert(to.end(), first, first + bytes);
}

void appendSized(std::vector<char>& to, const void* data, uint64_t bytes) {
    append(to, &bytes, sizeof bytes);
    append(to, data, bytes);
}

/// What appendSized() left at `at`, which goes on behind it.
std::vector<char> takeSized(const std::vector<char>& from, size_t& at) {
    const auto require = [&](uint64_t bytes) {
        if (from.size() - at < bytes) throw InputError("a state that was sent is truncated");
    };
    uint64_t bytes = 0;
    require(sizeof bytes);
    std::memcpy(&bytes, from.data() + at, sizeof bytes);
    at += sizeof bytes;
    require(bytes);
    const auto first = from.begin() + static_cast<std::ptrdiff_t>(at);
    at += bytes;
    return {first, first + static_cast<std::ptrdiff_t>(bytes)};
}

} // namespace

void MemoryState::begin(const std::string& name) {
    for (open_ = 0; open_ < arrays_.size(); ++open_)
        if (arrays_[open_].first == name) return arrays_[open_].second.clear();
    arrays_.emplace_back(name, Bytes());
}

void MemoryState::write(const void* data, size_t bytes) { append(arrays_.at(open_).second, data, bytes); }

const MemoryState::Bytes* MemoryState::find(const std::string& name) const {
    for (const auto& [key, bytes] : arrays_)
        if (key == name) return &bytes;
    return nullptr;
}

const MemoryState::Bytes& MemoryState::array(const std::string& name) const {
    const Bytes* found = find(name);
    if (!found) throw InputError("there is no array '" + name + "'");
    return *found;
}

void MemoryState::read(const std::string& name, uint64_t offset, void* into, size_t bytes) const {
    const Bytes& found = array(name);
    if (offset > found.size() || bytes > found.size() - offset) throw InputError("array '" + name + "' is too short");
    if (bytes > 0) std::memcpy(into, found.data() + offset, bytes);
}

void MemoryState::copyTo(StateSink& sink) const {
    for (const auto& [name, bytes] : arrays_) sink.array(name, bytes);
}

std::vector<char> MemoryState::packed() const {
    std::vector<char> all;
    for (const auto& [name, bytes] : arrays_) {
        appendSized(all, name.data(), name.size());
        appendSized(all, bytes.data(), bytes.size());
    }
    return all;
}

MemoryState MemoryState::unpacked(const std::vector<char>& bytes) {
    MemoryState state;
    for (size_t at = 0; at < bytes.size();) {
        const auto name = takeSized(bytes, at);
        state.arrays_.emplace_back(std::string(name.begin(), name.end()), takeSized(bytes, at));
    }
    return state;
}

} // namespace quasilux
