// What the page of the live view sends.
#include "fuzz/targets.h"

#include "view/edits.h"

namespace quasilux::fuzz {

void readEdits(std::string_view input) {
    expectInputErrors([&] { parseEdits(std::string(input)); });
}

} // namespace quasilux::fuzz
