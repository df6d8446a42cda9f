// Spectra by wavelength, and the colours that stand for them (docs/reference/scene-language.md).
#pragma once

#include "scene/color.h"
#include "scene/load_context.h"

#include <functional>
#include <string>
#include <vector>

namespace quasilux {

/// Linear between its samples, zero outside of them.
struct Spectrum {
    std::vector<double> wavelengths; ///< nm, increasing, at least two
    std::vector<double> values;

    double at(double wavelength) const;
};

/// "400:0.78, 500:0.3, …". Throws InputError for anything else.
Spectrum parseSpectrum(const std::string& text, const SourceLocation& where, const std::string& what);

/// Text file of lines "wavelength value"; # begins a comment line. Throws InputError at its line, or at `where` if it
/// cannot be read.
Spectrum readSpectrumFile(const std::string& path, const SourceLocation& where);

/// That of an element by its attribute `value` or, where it has one, `filename`; `what` is for messages.
Spectrum spectrumOf(const Element& element, const std::string& what, LoadContext& context);

/// Throws InputError at `where` unless there are two wavelengths or more, increasing, and as many values.
void checkSpectrum(const Spectrum& spectrum, const SourceLocation& where, const std::string& what);

/// Linear sRGB of what has `values` at each wavelength: emitted as it is, otherwise under D65, so that 1 is white. As
/// in Mitsuba's RGB modes, negative channels become 0, and of bounded ones those above 1 become 1, with a warning.
Rgb colorOfSpectrum(const std::function<double(double)>& values, ColorUse use, const SourceLocation& where,
                    LoadContext& context);
Rgb colorOfSpectrum(const Spectrum& spectrum, ColorUse use, const SourceLocation& where, LoadContext& context);

} // namespace quasilux
