// Start and end tags that do not match, for the message about them: pugixml says only where it noticed.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace quasilux {

struct TagMismatch {
    std::string_view opened, closed; ///< names; nothing where there is no such tag
    size_t openedAt = 0;             ///< offset of the start tag
    size_t at = 0;                   ///< of the end tag, or of the end of the text
};

/// The first of a text that is no well-formed XML. Nothing if all tags match as far as they can be read: another error
/// comes first.
std::optional<TagMismatch> findTagMismatch(std::string_view text);

} // namespace quasilux
