// Images to compare, of any renderer: linear RGB in EXR, PFM, HDR or float TIFF, by OpenImageIO.
#pragma once

#include <string>
#include <vector>

namespace quasilux {

/// Interleaved RGB, width*height*3 values, the first row is the top.
struct RadianceImage {
    std::string path;
    unsigned width = 0, height = 0;
    std::vector<float> radiance;
    std::vector<float> standardError; ///< of `radiance`; empty = unknown
    std::string warning;              ///< empty = none

    size_t pixels() const { return size_t{width} * height; }
};

/// Channels R, G, B, or the one channel of a grey image three times; standard errors from `stderr.R`, `stderr.G`,
/// `stderr.B` if all are there. Of a file with several parts the first is taken. Values of a Radiance picture are
/// divided by its EXPOSURE. Throws InputError: no such file, missing channels (the message lists what there is),
/// whole-number pixels, which hold no linear radiance.
RadianceImage readRadiance(const std::string& path);

/// Standard errors that are not all finite and at least 0, as after a single pass, become unknown, with a warning.
void dropUnusableErrors(RadianceImage& image);

/// A file of standard errors: channels as of readRadiance(). Throws InputError, also for values that are not finite or
/// are negative and for another size than `image`'s. `option` is named in messages.
std::vector<float> readStandardError(const std::string& path, const RadianceImage& image, const std::string& option);

/// Throws InputError if sizes differ; the message gives both.
void requireEqualSizes(const RadianceImage& image, const RadianceImage& reference);

} // namespace quasilux
