// Headers of Radiance pictures (.hdr), of which OpenImageIO does not act on all.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace quasilux {

struct RadianceHeader {
    double exposure =
        1; ///< product of all EXPOSURE lines, by which radiance was multiplied; not a number where damaged
    /// How pixels are stored: column after column, each or the columns from the bottom or the right.
    bool byColumns = false, fromBottom = false, fromRight = false;
};

/// `content`: the file, or its first bytes.
RadianceHeader radianceHeader(std::string_view content);

/// From the order of the file, `width` x `height` as stored there, to rows from the top left.
void turnUpright(const RadianceHeader& header, unsigned& width, unsigned& height, std::vector<float>& values);

} // namespace quasilux
