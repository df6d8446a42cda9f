// Drawings as pixels: lines with soft edges, texts by OpenImageIO.
#include "drawing/drawing.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>
#include <string_view>

namespace quasilux {

namespace {

/// OpenImageIO 2.4 draws other letters than ASCII's as wrong ones: these stand for those in use here, '?' for the rest.
std::string asciiOf(const std::string& text) {
    static const std::pair<std::string_view, std::string_view> plain[] = {{"²", "2"},  {"×", "x"}, {"≥", ">="},
                                                                          {"≤", "<="}, {"–", "-"}, {"°", " deg"}};
    std::string out;
    for (size_t at = 0; at < text.size();) {
        const std::string_view rest = std::string_view(text).substr(at);
        const auto* found = std::find_if(std::begin(plain), std::end(plain), [&](const auto& entry) {
            return rest.substr(0, entry.first.size()) == entry.first;
        });
        const bool isAscii = static_cast<unsigned char>(text[at]) < 0x80;
        out += isAscii ? rest.substr(0, 1) : found == std::end(plain) ? "?" : found->second;
        for (++at; at < text.size() && (static_cast<unsigned char>(text[at]) & 0xc0U) == 0x80U;) ++at;
    }
    return out;
}

class Raster {
public:
    explicit Raster(const Drawing& drawing)
        : width_(static_cast<int>(std::ceil(drawing.width))), height_(static_cast<int>(std::ceil(drawing.height))),
          pixels_(size_t(3) * width_ * height_, 255) {}

    void draw(const DrawnLine& line) {
        double along = 0;
        for (size_t k = 1; k < line.places.size(); ++k) {
            const Place &a = line.places[k - 1], &b = line.places[k];
            if (line.dashed)
                along = drawDashes(a, b, along, line);
            else
                drawSegment(a, b, line);
        }
    }

    void draw(const DrawnCircle& circle) {
        const double reach = circle.radius + circle.width;
        forEachPixel(circle.centre.x - reach, circle.centre.y - reach, circle.centre.x + reach, circle.centre.y + reach,
                     [&](int x, int y) {
                         const double r = std::hypot(x + 0.5 - circle.centre.x, y + 0.5 - circle.centre.y);
                         blend(x, y, circle.colour, 0.5 + circle.width / 2 - std::abs(r - circle.radius));
                     });
    }

    void draw(const DrawnBox& box) {
        forEachPixel(box.corner.x, box.corner.y, box.corner.x + box.width - 1, box.corner.y + box.height - 1,
                     [&](int x, int y) { blend(x, y, box.colour, 1); });
    }

    void draw(const DrawnPicture& picture) {
        const auto cell = [](double place, double size, unsigned count) {
            return static_cast<size_t>(std::clamp(std::floor(place / size * count), 0.0, count - 1.0));
        };
        forEachPixel(picture.corner.x, picture.corner.y, picture.corner.x + picture.width - 1,
                     picture.corner.y + picture.height - 1, [&](int x, int y) {
                         const size_t i = cell(x + 0.5 - picture.corner.x, picture.width, picture.columns),
                                      j = cell(y + 0.5 - picture.corner.y, picture.height, picture.rows);
                         std::copy_n(&picture.pixels[3 * (j * picture.columns + i)], 3, at(x, y));
                     });
    }

    void draw(const DrawnText& text) {
        if (text.haloed)
            for (const auto& [dx, dy] : {std::pair(-1, 0), {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, 1}, {-1, 1}, {1, -1}})
                write(text, white, dx, dy);
        write(text, text.colour, 0, 0);
        if (text.bold) write(text, text.colour, 1, 0);
    }

    std::vector<uint8_t> take() { return std::move(pixels_); }

private:
    uint8_t* at(int x, int y) { return &pixels_[3 * (static_cast<size_t>(y) * width_ + x)]; }

    template <typename Visit>
    void forEachPixel(double left, double top, double right, double bottom, const Visit& visit) {
        const int x0 = std::max(0, static_cast<int>(std::floor(left))),
                  x1 = std::min(width_ - 1, static_cast<int>(std::floor(right))),
                  y0 = std::max(0, static_cast<int>(std::floor(top))),
                  y1 = std::min(height_ - 1, static_cast<int>(std::floor(bottom)));
        for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x) visit(x, y);
    }

    void blend(int x, int y, Colour colour, double coverage) {
        const double share = std::clamp(coverage, 0.0, 1.0);
        const uint8_t channels[3] = {colour.r, colour.g, colour.b};
        for (int c = 0; c < 3; ++c)
            at(x, y)[c] = static_cast<uint8_t>(std::lround((1 - share) * at(x, y)[c] + share * channels[c]));
    }

    void drawSegment(const Place& a, const Place& b, const DrawnLine& line) {
        const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy, reach = line.width / 2 + 1;
        forEachPixel(std::min(a.x, b.x) - reach, std::min(a.y, b.y) - reach, std::max(a.x, b.x) + reach,
                     std::max(a.y, b.y) + reach, [&](int x, int y) {
                         const double px = x + 0.5 - a.x, py = y + 0.5 - a.y;
                         const double t = square > 0 ? std::clamp((px * dx + py * dy) / square, 0.0, 1.0) : 0;
                         blend(x, y, line.colour, 0.5 + line.width / 2 - std::hypot(px - t * dx, py - t * dy));
                     });
    }

    /// Dashes of 7 with gaps of 4, as in SVG; `along` the line from its beginning. Returns how far along b is.
    double drawDashes(const Place& a, const Place& b, double along, const DrawnLine& line) {
        constexpr double dash = 7, period = 11;
        const double length = std::hypot(b.x - a.x, b.y - a.y);
        const auto placeAt = [&](double at) {
            const double t = std::clamp((at - along) / length, 0.0, 1.0);
            return Place{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
        };
        const int last = static_cast<int>(std::ceil((along + length) / period));
        for (int k = static_cast<int>(std::floor(along / period)); k < last; ++k)
            if (k * period + dash > along) drawSegment(placeAt(k * period), placeAt(k * period + dash), line);
        return along + length;
    }

    void write(const DrawnText& text, Colour colour, int dx, int dy) {
        const OIIO::ImageSpec spec(width_, height_, 3, OIIO::TypeDesc::UINT8);
        OIIO::ImageBuf image(spec, pixels_.data());
        const auto align = text.anchor == TextAnchor::start    ? OIIO::ImageBufAlgo::TextAlignX::Left
                           : text.anchor == TextAnchor::middle ? OIIO::ImageBufAlgo::TextAlignX::Center
                                                               : OIIO::ImageBufAlgo::TextAlignX::Right;
        const float channels[3] = {colour.r / 255.0F, colour.g / 255.0F, colour.b / 255.0F};
        if (!OIIO::ImageBufAlgo::render_text(image, static_cast<int>(std::lround(text.place.x)) + dx,
                                             static_cast<int>(std::lround(text.place.y)) + dy, asciiOf(text.text),
                                             static_cast<int>(std::lround(text.size * 1.15)), "DejaVuSans", channels,
                                             align, OIIO::ImageBufAlgo::TextAlignY::Baseline))
            throw std::runtime_error(fmt::format(
                "cannot write text into a PNG: {}; install a font (Debian: fonts-dejavu-core), or write .svg",
                image.geterror()));
    }

    int width_, height_;
    std::vector<uint8_t> pixels_;
};

} // namespace

std::vector<uint8_t> pixelsOf(const Drawing& drawing) {
    Raster raster(drawing);
    for (const DrawnThing& thing : drawing.things) std::visit([&](const auto& one) { raster.draw(one); }, thing);
    return raster.take();
}

} // namespace quasilux
