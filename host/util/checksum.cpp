#include "util/checksum.h"

#include <new>
#define XXH_INLINE_ALL
#include <xxhash.h>

namespace quasilux {

struct Checksum::State {
    XXH3_state_t* state = XXH3_createState();

    State() {
        if (state == nullptr) throw std::bad_alloc();
        XXH3_128bits_reset(state);
    }
    ~State() { XXH3_freeState(state); }
    State(const State&) = delete;
    State& operator=(const State&) = delete;
};

Checksum::Checksum() : state_(std::make_unique<State>()) {}
Checksum::~Checksum() = default;

void Checksum::add(const void* data, size_t size) {
    if (size > 0) XXH3_128bits_update(state_->state, data, size);
}

std::string Checksum::digest() const {
    XXH128_canonical_t canonical;
    XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(state_->state));
    return {reinterpret_cast<const char*>(canonical.digest), sizeof canonical.digest};
}

std::string Checksum::text() const {
    std::string out;
    for (const char byte : digest())
        for (const unsigned shift : {4u, 0u})
            out += "0123456789abcdef"[static_cast<unsigned char>(byte) >> shift & 15u];
    return out;
}

} // namespace quasilux
