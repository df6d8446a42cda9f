// What the page of the live view sends.
#include "fuzz/targets.h"

#include "view/edits.h"

namespace quasilux::fuzz {

void readEdits(std::string_view input) {
    try {
        parseEdits(std::string(input));
    } catch (const InputError&) { // what bad input is to end with
    }
}

} // namespace quasilux::fuzz
