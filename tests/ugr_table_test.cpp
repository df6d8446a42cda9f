// UGR of a rendered room against the tabular method of CIE 117 and CIE 190: a room of 4 H x 8 H with reflectances of
// 70, 50 and 20 %, luminaires
// 0.25 H apart, eyes in the middle of two walls. docs/notes/validation.md has the figures.
#include "support/eye_readings.h"
#include "support/luminaire_files.h"
#include "support/meter_scenes.h"

#include <cmath>
#include <gmock/gmock.h>
#include <numbers>

namespace quasilux {
namespace {

using std::numbers::pi;

// Metres; H is the height of the luminaires above the eye.
constexpr double H = 2, eye = 1.2, width = 4 * H, depth = 8 * H, spacing = 0.25 * H, side = 0.3;
constexpr double ceilingReflectance = 0.7, wallReflectance = 0.5, floorReflectance = 0.2;

/// Candela of a luminaire by the cosine of the angle from straight down: 2618 lm.
double intensity(double cosine) { return 500 * cosine * (1 + cosine); }
constexpr double flux = 2 * pi * 500 * (1 / 2.0 + 1 / 3.0);

template <typename Do>
void forEachLuminaire(const Do& doIt) {
    for (double x = spacing / 2; x < width; x += spacing)
        for (double y = spacing / 2; y < depth; y += spacing) doIt(x, y);
}

// ---- the tabular method

/// Sum of L^2 omega / p^2, or wrongly without p, for an eye at x, y that looks along +y, or along +x.
double tabularStrength(double x, double y, bool alongX, bool withIndex = true) {
    double sum = 0;
    forEachLuminaire([&](double lampX, double lampY) {
        double right = lampX - x, ahead = lampY - y;
        if (alongX) std::swap(right, ahead);
        if (ahead <= 0) return;
        const double square = right * right + ahead * ahead + H * H, distance = std::sqrt(square),
                     cosine = H / distance;
        const double area = side * side * cosine, luminance = intensity(cosine) / area;
        const double sigma = std::acos(ahead / distance) * 180 / pi, tau = std::atan2(std::abs(right), H) * 180 / pi;
        const double index = std::exp((35.2 - 0.31889 * tau - 1.22 * std::exp(-2 * tau / 9)) * 1e-3 * sigma +
                                      (21 + 0.26667 * tau - 0.002963 * tau * tau) * 1e-5 * sigma * sigma);
        sum += luminance * luminance * area / square / (withIndex ? index * index : 1);
    });
    return sum;
}

/// Lumens that come straight to the rectangle `height` below the luminaires.
double directFlux(double height) {
    constexpr unsigned columns = 80, rows = 160;
    double sum = 0;
    for (unsigned i = 0; i < columns; ++i)
        for (unsigned j = 0; j < rows; ++j)
            forEachLuminaire([&](double lampX, double lampY) {
                const double x = (i + 0.5) * width / columns - lampX, y = (j + 0.5) * depth / rows - lampY,
                             square = x * x + y * y + height * height, cosine = height / std::sqrt(square);
                sum += intensity(cosine) * cosine / square;
            });
    return sum * width * depth / (columns * rows);
}

/// From a rectangle to the equal one opposite.
double oppositeFormFactor(double height) {
    const double x = width / height, y = depth / height, xx = std::sqrt(1 + x * x), yy = std::sqrt(1 + y * y);
    return 2 / (pi * x * y) *
           (std::log(xx * yy / std::sqrt(1 + x * x + y * y)) + x * yy * std::atan(x / yy) + y * xx * std::atan(y / xx) -
            x * std::atan(x) - y * std::atan(y));
}

/// Indirect illuminance of the walls, lx, with the light of ceiling, walls and floor each spread evenly, as the
/// transfer factors of CIE 40 and CIE 52 have it; `height`: from the luminaires to the floor, or, in the tables, to the
/// eye.
double indirectOnWalls(double height) {
    const double floorArea = width * depth, wallArea = 2 * height * (width + depth);
    const double down = directFlux(height), lamps = (width / spacing) * (depth / spacing);
    const double toFloor = oppositeFormFactor(height), toWalls = 1 - toFloor, // from floor or ceiling
        wallToFloor = toWalls * floorArea / wallArea, wallToWalls = 1 - 2 * wallToFloor;
    const double onFloor = down / floorArea, onWalls = (lamps * flux - down) / wallArea;
    double ceiling = 0, walls = 0, floor = 0; // lm/m^2 that they send
    for (int bounce = 0; bounce < 200; ++bounce) {
        const double c = ceilingReflectance * (toFloor * floor + toWalls * walls),
                     w = wallReflectance * (onWalls + wallToFloor * (floor + ceiling) + wallToWalls * walls),
                     f = floorReflectance * (onFloor + toFloor * ceiling + toWalls * walls);
        ceiling = c, walls = w, floor = f;
    }
    return wallToFloor * (floor + ceiling) + wallToWalls * walls;
}

double rated(double strength, double indirect) { return 8 * std::log10(0.25 * pi / indirect * strength); }

// ---- the room

Scene room(const test::SceneFiles& files) {
    test::IesText ies;
    ies.vertical.clear();
    for (double angle = 0; angle <= 90; ++angle) ies.vertical.push_back(angle);
    ies.size = fmt::format("{} {} 0", side, side);
    ies.candela = [](double v, double) { return intensity(std::cos(v * pi / 180)); };
    files.write("panel.ies", ies.text());
    std::string body;
    forEachLuminaire([&](double x, double y) {
        body +=
            test::luminaireXml("panel.ies", fmt::format("<transform name=\"to_world\"><rotate x=\"1\" angle=\"180\"/>"
                                                        "<translate x=\"{}\" y=\"{}\" z=\"{}\"/></transform>",
                                                        x, y, eye + H - 1e-3));
    });
    const double height = eye + H, x = width / 2, y = depth / 2, z = height / 2;
    const auto wall = [&](double halfX, double halfY, const std::string& turn, double atX, double atY, double atZ,
                          double reflectance) {
        body += test::rectangle(fmt::format("{},{},1", halfX, halfY), turn, fmt::format("{},{},{}", atX, atY, atZ),
                                test::diffuse(reflectance));
    };
    wall(x, y, "", x, y, 0, floorReflectance);
    wall(x, y, "<rotate x=\"1\" angle=\"180\"/>", x, y, height, ceilingReflectance);
    wall(z, y, "<rotate y=\"1\" angle=\"90\"/>", 0, y, z, wallReflectance);
    wall(z, y, "<rotate y=\"1\" angle=\"-90\"/>", width, y, z, wallReflectance);
    wall(x, z, "<rotate x=\"1\" angle=\"-90\"/>", x, 0, z, wallReflectance);
    wall(x, z, "<rotate x=\"1\" angle=\"90\"/>", x, depth, z, wallReflectance);
    return loadScene(files.write(
        "scene.xml",
        fmt::format("<scene version=\"3.0.0\">{}{}<?quasilux observer position=\"{},0.01,{}\" direction=\"0,1,0\"?>"
                    "<?quasilux observer position=\"0.01,{},{}\" direction=\"1,0,0\"?></scene>",
                    test::minimalSensor, body, x, eye, y, eye)));
}

TEST(UgrTable, RenderedRoomIsRatedAsTheTabularMethodDoes) {
    const test::SceneFiles files;
    const Scene scene = room(files);
    const double ofTable = indirectOnWalls(H), ofRoom = indirectOnWalls(eye + H);
    for (const size_t k : {0u, 1u}) {
        const Observer& observer = scene.observers.at(k);
        const ObserverFigures figures = test::figuresOf(scene, observer, 12);
        const double strength = tabularStrength(observer.position.x, observer.position.y, k == 1);
        const double rating = figures.rating.value, error = figures.rating.standardError;
        ::testing::Test::RecordProperty(
            fmt::format("figures{}", k),
            fmt::format("rendered {:.3f} +- {:.3f}, Ei {:.0f} lx; table {:.3f}, Ei {:.0f} lx; room {:.3f}, {:.0f} lx",
                        rating, error, figures.indirect.value, rated(strength, ofTable), ofTable,
                        rated(strength, ofRoom), ofRoom));
        EXPECT_NEAR(figures.sources.strength(), strength, 0.01 * strength) << "the near panels are no points";
        EXPECT_LT(error, 0.05) << "too noisy to decide anything";
        // 4 standard errors: 1 in 16,000 by chance. The method takes the light of walls as even.
        EXPECT_NEAR(figures.indirect.value, ofRoom, 0.04 * ofRoom + 4 * figures.indirect.standardError);
        EXPECT_NEAR(rating, rated(strength, ofRoom), 0.15 + 4 * error);
        EXPECT_NEAR(rating, rated(strength, ofTable), 0.3 + 4 * error) << "the eye's plane as the floor";
        // Wrong rules: light of the lamps in the background; no position index.
        EXPECT_GT(std::abs(rating - rated(strength, ofRoom + figures.direct.value)), 1);
        const double withoutIndex =
            tabularStrength(observer.position.x, observer.position.y, k == 1, /*withIndex=*/false);
        EXPECT_GT(std::abs(rating - rated(withoutIndex, ofRoom)), 1);
    }
}

} // namespace
} // namespace quasilux
