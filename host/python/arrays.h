// What a render came to as NumPy arrays (docs/guide/python.md).
#pragma once

#include "compare/image_file.h"
#include "python/rendered.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

namespace quasilux {

using RenderedPointer = std::shared_ptr<const Rendered>;

/// (height, width, channels), without a copy and not writable: the array keeps `owner` alive, whose `values` it shows.
/// None where there are none.
pybind11::object imageArray(const RenderedPointer& owner, const std::vector<float>& values, size_t channels = 3);

/// By name, "direct" …, those that there are.
pybind11::dict componentArrays(const RenderedPointer& owner);
/// Layers of the EXR beside the image, by the names that they have there: components, errors, what integrator `aov`
/// and alpha add; not what is made of R, G and B.
pybind11::dict layerArrays(const RenderedPointer& owner);

/// Of the film, or of each grid: its name or None; of each pixel in lx or cd/m^2 value and standard error, (height,
/// width), double precision; and of grids the points, (height, width, 3), scene units, or None.
pybind11::list readingsOf(const Rendered& rendered);

/// An array (height, width, 3), or (height, width) for grey.
RadianceImage radianceOf(const pybind11::array_t<float, pybind11::array::c_style | pybind11::array::forcecast>& array,
                         const std::string& name);
RadianceImage radianceOf(const Rendered& rendered, const std::string& name);

} // namespace quasilux
