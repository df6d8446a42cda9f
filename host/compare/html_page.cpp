// The page's parts. Radiance travels as shared exponents in a PNG, so the browser can show it at any exposure.
#include "compare/html_page.h"

#include "compare/error_picture.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace quasilux {

namespace {

/// With the width of pictures.
constexpr const char* style = R"(canvas, img {{ width: {}px; max-width: 95vw; background: #888; }}
canvas {{ image-rendering: pixelated; display: block; cursor: crosshair; }}
input {{ width: 320px; vertical-align: middle; }}
output {{ font-family: monospace; }}
)";

/// Canvases hold radiance decoded once; every change of exposure encodes it as sRGB anew.
constexpr const char* script = R"(<script>
"use strict";
const views = [...document.querySelectorAll("canvas")];
const slider = document.getElementById("exposure"), readout = document.getElementById("readout");
const names = views.map(v => v.dataset.name), radiance = [];

function decode(picture) {
  const w = picture.naturalWidth, h = picture.naturalHeight / 2, sheet = document.createElement("canvas");
  sheet.width = w; sheet.height = 2 * h;
  const pen = sheet.getContext("2d"), out = new Float32Array(3 * w * h);
  pen.drawImage(picture, 0, 0);
  const bytes = pen.getImageData(0, 0, w, 2 * h).data;
  for (let p = 0; p < w * h; ++p) {
    const exponent = bytes[4 * (p + w * h)];
    for (let c = 0; c < 3; ++c) out[3 * p + c] = exponent === 255 ? NaN : bytes[4 * p + c] * 2 ** (exponent - 136);
  }
  return out;
}
const encode = x => 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * Math.min(x, 1) ** (1 / 2.4) - 0.055);

function draw(view, values) {
  const pen = view.getContext("2d"), data = pen.createImageData(view.width, view.height);
  const scale = +view.dataset.scale * 2 ** +slider.value;
  for (let p = 0; p < view.width * view.height; ++p) {
    const broken = Number.isNaN(values[3 * p]);
    for (let c = 0; c < 3; ++c) data.data[4 * p + c] = broken ? [255, 0, 255][c] : encode(scale * values[3 * p + c]);
    data.data[4 * p + 3] = 255;
  }
  pen.putImageData(data, 0, 0);
}
function show(view, which) {
  draw(view, radiance[which]);
  view.nextElementSibling.textContent = names[which];
}
function showAll() {
  document.getElementById("stops").textContent = (slider.value > 0 ? "+" : "") + slider.value + " stops";
  views.forEach((view, i) => show(view, i));
}
function tell(view, event) {
  const box = view.getBoundingClientRect();
  const x = Math.min(Math.floor((event.clientX - box.left) / box.width * view.width), view.width - 1);
  const y = Math.min(Math.floor((event.clientY - box.top) / box.height * view.height), view.height - 1);
  const text = values => [0, 1, 2].map(c => values[3 * (y * view.width + x) + c].toPrecision(3)).join(" ");
  readout.textContent = `pixel ${x}, ${y}: ${names.map((name, i) => `${name} ${text(radiance[i])}`).join("   ")}`;
}
Promise.all(views.map(view => {
  const picture = new Image();
  picture.src = view.dataset.source;
  return picture.decode().then(() => decode(picture));
})).then(decoded => {
  radiance.push(...decoded);
  showAll();
  slider.addEventListener("input", showAll);
  views.forEach((view, i) => {
    view.addEventListener("pointerenter", () => show(view, 1 - i));
    view.addEventListener("pointerleave", () => show(view, i));
    view.addEventListener("pointermove", event => tell(view, event));
  });
});
</script></body></html>
)";

/// Brings the 90th percentile of the reference's luminance, over pixels that are not black, to 0.8.
double automaticScale(const RadianceImage& reference) {
    std::vector<double> lit;
    for (size_t i = 0; i < reference.radiance.size(); i += 3) {
        const double value = luminance(&reference.radiance[i]);
        if (std::isfinite(value) && value > 0) lit.push_back(value);
    }
    if (lit.empty()) return 1;
    const auto rank = lit.begin() + static_cast<std::ptrdiff_t>(9 * lit.size() / 10);
    std::nth_element(lit.begin(), rank, lit.end());
    return 0.8 / *rank;
}

std::string canvas(const RadianceImage& image, const std::string& name, double scale) {
    return fmt::format("<figure><canvas width=\"{}\" height=\"{}\" data-name=\"{}\" data-scale=\"{:.6g}\" "
                       "data-source=\"{}\"></canvas><figcaption>{}</figcaption></figure>\n",
                       image.width, image.height, name, scale,
                       pngDataUri(sharedExponentPicture(image), image.width, 2 * image.height), name);
}

} // namespace

std::string htmlPage(const RadianceImage& image, const RadianceImage& reference, const Comparison& comparison,
                     const PageText& text) {
    std::string out = htmlHead(text.title, fmt::format(style, std::clamp(image.width, 256u, 640u)));
    out += fmt::format("<h1>{}</h1>\n", htmlEscaped(text.title));
    for (const auto& remark : text.remarks) out += fmt::format("<p>{}</p>\n", htmlEscaped(remark));
    out += htmlTable(text.regions);
    out += "<p><label>Exposure <input id=\"exposure\" type=\"range\" min=\"-10\" max=\"10\" step=\"0.25\" value=\"0\">"
           "</label> <output id=\"stops\"></output> Put the pointer on one image to see the other one in its place."
           "<br><output id=\"readout\">&nbsp;</output></p>\n";
    const double scale = automaticScale(reference);
    out += canvas(image, "image", scale) + canvas(reference, "reference", scale) + "<br>\n";
    const auto figure = [&](const Picture& picture, const std::string& caption) {
        out += htmlFigure(picture, image.width, image.height, caption);
    };
    figure(signedPicture(image, reference),
           fmt::format("relative difference of luminance: blue -{0:g} %, white 0, red +{0:g} %", 100 * signedScale));
    figure(squarePicture(comparison),
           fmt::format("relMSE, logarithmic: black {:g}, red, yellow, white {:g}", squareScaleFrom, squareScaleTo));
    if (const Picture errors = standardErrorPicture(image, reference); !errors.empty())
        figure(errors,
               fmt::format("difference in standard errors: blue -{0:g}, white 0, red +{0:g}", standardErrorScale));
    out += "<p>Magenta: pixels that are not finite.</p>\n<h2>Worst pixels</h2>\n" + htmlTable(text.worst);
    return out + script;
}

} // namespace quasilux
