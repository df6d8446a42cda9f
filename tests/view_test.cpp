// Parts of the live view that need no device: who may ask, half precision, changes, errands between passes.
#include "util/error.h"
#include "view/access.h"
#include "view/edits.h"
#include "view/errands.h"
#include "view/frame.h"
#include "view/frame_pace.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <thread>

namespace quasilux {
namespace {

using testing::HasSubstr;

TEST(Access, TokensDifferAndOnlyTheirOwnIsTaken) {
    const Access one("127.0.0.1"), other("127.0.0.1");
    EXPECT_EQ(one.token().size(), 32u);
    EXPECT_NE(one.token(), other.token());
    EXPECT_TRUE(one.isToken(one.token()));
    EXPECT_FALSE(one.isToken(other.token()));
    EXPECT_FALSE(one.isToken(one.token().substr(1)));
    EXPECT_FALSE(one.isToken(""));
    for (size_t k = 0; k < one.token().size(); ++k) {
        std::string almost = one.token();
        almost[k] = almost[k] == '0' ? '1' : '0';
        EXPECT_FALSE(one.isToken(almost)) << k;
    }
}

TEST(Access, HostIsThisComputer) {
    const Access loopback("127.0.0.1"), everywhere("0.0.0.0");
    for (const char* host : {"127.0.0.1:8080", "localhost:8080", "[::1]:8080"})
        EXPECT_TRUE(loopback.isOurHost(host, 8080)) << host;
    for (const char* host : {"evil.example:8080", "127.0.0.1", "127.0.0.1:80800", "192.168.0.2:8080", ":8080", ""})
        EXPECT_FALSE(loopback.isOurHost(host, 8080)) << host;
    EXPECT_TRUE(everywhere.isOurHost("192.168.0.2:8080", 8080));
    EXPECT_TRUE(everywhere.isOurHost(computerName() + ":8080", 8080));
    EXPECT_FALSE(everywhere.isOurHost("evil.example:8080", 8080)) << "a name may be made to mean this computer";
    EXPECT_TRUE(isLoopback("127.1.2.3"));
    EXPECT_FALSE(isLoopback("127.evil.example"));
}

float fromHalf(uint16_t half) {
    const int exponent = half >> 10 & 31, fraction = half & 1023;
    const float size = exponent > 0 ? std::ldexp(1024.f + static_cast<float>(fraction), exponent - 25)
                                    : std::ldexp(static_cast<float>(fraction), -24);
    return half & 0x8000 ? -size : size;
}

TEST(Half, IsTheNearestOne) {
    for (unsigned half = 0; half < 0x7bffu; ++half) { // all finite ones but the largest
        const float value = fromHalf(static_cast<uint16_t>(half)), next = fromHalf(static_cast<uint16_t>(half + 1));
        ASSERT_EQ(toHalf(value), half);
        ASSERT_EQ(toHalf(-value), half | 0x8000u);
        const float middle = (value + next) / 2;
        ASSERT_EQ(toHalf(middle), half % 2 == 0 ? half : half + 1) << "ties go to even";
        ASSERT_EQ(toHalf(std::nextafter(middle, value)), half);
        ASSERT_EQ(toHalf(std::nextafter(middle, next)), half + 1);
    }
    EXPECT_EQ(toHalf(1e9f), 0x7bff);
    EXPECT_EQ(toHalf(-std::numeric_limits<float>::infinity()), 0xfbff);
    EXPECT_GT(toHalf(std::numeric_limits<float>::quiet_NaN()) & 0x7fff, 0x7c00);
}

// Looks along -z from (0, 1, 5), y up.
glm::dmat4 plainCamera() { return {{-1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, -1, 0}, {0, 1, 5, 1}}; }

void expectNear(const glm::dvec3& found, const glm::dvec3& expected) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[k], expected[k], 1e-12) << k;
}

TEST(Camera, TurnsAboutThePointBeforeIt) {
    const double quarter = std::acos(0.0);
    CameraMove move;
    move.yaw = quarter;
    glm::dmat4 camera = moved(plainCamera(), move, 5, false);
    expectNear(glm::dvec3(camera[3]), {5, 1, 0});
    expectNear(glm::dvec3(camera[2]), {-1, 0, 0});
    expectNear(glm::dvec3(camera[1]), {0, 1, 0});
    move = {};
    move.pitch = quarter / 3;
    camera = moved(plainCamera(), move, 5, false);
    expectNear(glm::dvec3(camera[3]), {0, 1 + 5 * std::sin(quarter / 3), 5 * std::cos(quarter / 3)});
    move.pitch = 100; // not over the top
    EXPECT_GT(moved(plainCamera(), move, 5, false)[1].y, 0);
    move = {};
    move.nearer = 1;
    move.right = 0.2;
    expectNear(glm::dvec3(moved(plainCamera(), move, 5, false)[3]), {0.5, 1, 2.5});
    EXPECT_EQ(moved(plainCamera(), {}, 5, false), plainCamera());
}

// As by <scale x="-1"/> before <lookat>: camera and moves are those of the mirrored world.
TEST(Camera, AMirroredOneMovesAsItsMirrorImage) {
    glm::dmat4 mirror(1);
    mirror[0][0] = -1;
    const glm::dmat4 plain = moved(plainCamera(), {0.2, 0.3, 0, 0, 0}, 5, false), mirrored = mirror * plain;
    for (const CameraMove& move :
         {CameraMove{}, CameraMove{0.4, 0.5, 1, 0.2, 0.1}, CameraMove{0, 100, 0, 0, 0}, CameraMove{0, -100, 0, 0, 0}}) {
        const glm::dmat4 found = moved(mirrored, move, 5, false), expected = mirror * moved(plain, move, 5, false);
        for (int k = 0; k < 4; ++k) expectNear(glm::dvec3(found[k]), glm::dvec3(expected[k]));
        EXPECT_GT(found[1].y, 0) << "not over the top";
    }
    EXPECT_GT(moved(mirrored, {0, 0.5, 0, 0, 0}, 5, false)[3].y, mirrored[3].y) << "it rises";
}

TEST(Camera, PitchesEndWhereItStays) {
    const glm::dmat4 raised = moved(plainCamera(), {0, 0.6, 0, 0, 0}, 5, false);
    const PitchRange range = pitchRange(raised);
    EXPECT_NEAR(range.highest - range.lowest, 3.1, 1e-12);
    EXPECT_NEAR(range.highest, 0.95, 1e-12);
    const auto height = [&](double pitch) { return moved(raised, {0, pitch, 0, 0, 0}, 5, false)[3].y; };
    EXPECT_EQ(height(range.highest), height(range.highest + 1));
    EXPECT_EQ(height(range.lowest), height(range.lowest - 1));
    EXPECT_LT(height(range.highest - 0.01), height(range.highest)) << "and not before";
}

TEST(Camera, OfParallelRaysShowsLessInsteadOfComingNearer) {
    CameraMove move;
    move.nearer = 1;
    const glm::dmat4 camera = moved(plainCamera(), move, 5, true);
    expectNear(glm::dvec3(camera[3]), {0, 1, 5});
    expectNear(glm::dvec3(camera[0]), {-0.5, 0, 0});
}

Scene twoLamps() {
    Scene scene;
    ShapeDescription shape;
    shape.id = "panel";
    shape.sphere = Sphere{};
    shape.emitter = AreaEmitter{{1, 2, 3}, {}, false, {}};
    scene.shapes.push_back(shape);
    PointEmitter point;
    point.id = "bulb";
    point.intensity = {4, 4, 4};
    scene.pointEmitters.push_back(point);
    scene.sensor.toWorld = plainCamera();
    return scene;
}

TEST(EditedScene, LampsHaveTheirFactorsOfTheFileNotOfTheLastChange) {
    EditedScene edited(twoLamps());
    ASSERT_EQ(edited.lamps().size(), 2u);
    EXPECT_EQ(edited.lamps()[1].id, "bulb");
    ViewEdits edits;
    edits.lamps = {2, 0};
    for (int repeat = 0; repeat < 2; ++repeat) {
        edited.apply(edits);
        EXPECT_EQ(edited.scene().shapes[0].emitter->radiance.g, 4);
        EXPECT_TRUE(edited.scene().pointEmitters.empty());
    }
    edits.lamps = {0};
    edited.apply(edits);
    EXPECT_FALSE(edited.scene().shapes[0].emitter);
    EXPECT_EQ(edited.scene().pointEmitters[0].intensity.r, 4);
    edits.lamps = {0, 0};
    EXPECT_THROW(edited.apply(edits), InputError);
    EXPECT_EQ(edited.lamps().size(), 2u) << "they can be switched on again";
}

TEST(Edits, AreReadOrRefused) {
    const auto edits =
        parseEdits(nlohmann::json::parse(R"({"bdd": 2, "variant": null, "camera": {"yaw": 1}, "lamps": [0.5]})"));
    EXPECT_EQ(edits.bdd, 2u);
    EXPECT_FALSE(edits.variant);
    EXPECT_EQ(edits.camera.yaw, 1);
    EXPECT_EQ(edits.lamps, std::vector<double>{0.5});
    for (const char* wrong : {R"({"bdd": 1.5})", R"({"camera": {"yaw": "left"}})", R"({"camera": {"nearer": 99}})",
                              R"({"lamps": 1})", R"({"map": "both"})", R"({"quasiSpecular": 1})", "[]"})
        EXPECT_THROW(parseEdits(nlohmann::json::parse(wrong)), InputError) << wrong;
}

TEST(Edits, AreWrittenAsTheyAreRead) {
    const auto expectTheSame = [](const std::string& text) {
        const auto given = nlohmann::json::parse(text), written = toJson(parseEdits(text));
        EXPECT_EQ(toJson(parseEdits(written)), written);
        for (const auto& [key, value] : given.items()) EXPECT_EQ(written.at(key), value) << key;
    };
    expectTheSame("{}");
    expectTheSame(R"({"camera": {"yaw": 0.1, "pitch": -0.2, "nearer": 1.5, "right": 0.3, "up": 0.4}, "lamps": [0, 2.5],
        "bdd": 3, "variant": "main", "direct": "photons", "map": "camera", "quasiSpecular": "level:1", "isDraft": true})");
    expectTheSame(R"({"bdd": null, "variant": null, "direct": null, "map": null, "quasiSpecular": null})");
}

// After a single batch of passes standard errors are 0.
TEST(Frame, ErrorsAreKnownOrSaidNotToBe) {
    FilmCutChoice errors;
    errors.content = FilmCutChoice::Content::errors;
    FilmImage cut;
    cut.width = cut.height = 1;
    cut.resize(3, true, true);
    const auto isKnown = [&](const std::string& layer, const FilmCutChoice& choice, unsigned batches) {
        cut.batches = batches;
        FrameWish wish;
        wish.layer = layer;
        return makeFrame(wish, choice, cut, 0).isKnown;
    };
    for (const char* layer : {"stderr", "relative_error"}) {
        EXPECT_FALSE(isKnown(layer, errors, 1)) << layer;
        EXPECT_TRUE(isKnown(layer, errors, 2)) << layer;
    }
    EXPECT_TRUE(isKnown("bias", errors, 1)) << "a mean";
    EXPECT_TRUE(isKnown("image", {}, 1));
}

// The moment's renderer and settings are not looked at here.
RenderMoment momentOf(uint64_t number) {
    static const AutoRender none;
    return {reinterpret_cast<const Renderer&>(none), none, number};
}

// Who writes out what is nested recurses: that deep it would end the program.
TEST(Edits, DeeplyNestedAreRefused) {
    const auto message = [](const std::string& text) { return refusal([&] { parseEdits(text); }).value_or(""); };
    EXPECT_THAT(message(std::string(200000, '[')), testing::HasSubstr("at most 8 levels"));
    const std::string deep = std::string(100000, '[') + std::string(100000, ']');
    EXPECT_THAT(message(deep), testing::HasSubstr("at most 8 levels"));
    EXPECT_THAT(message("{\"lamps\":" + deep + "}"), testing::HasSubstr("at most 8 levels"));
    EXPECT_THAT(message("{\"lamps\":[1}"), testing::HasSubstr("expected JSON"));
    EXPECT_EQ(parseEdits(std::string("{\"bdd\":2}")).bdd, 2u); // control
}

// However slow the machine is, pictures of a large film come as often as they may and take 3 % of the time, by fewer
// pixels.
TEST(FramePace, PicturesHaveAsManyPixelsAsTimeAllows) {
    using Seconds = std::chrono::duration<double>;
    const auto pauseOf = [](double secondsPerPixel) {
        FramePace pace;
        const FramePace::Clock::time_point start{};
        const auto after = [&](double seconds) {
            return start + std::chrono::duration_cast<FramePace::Clock::duration>(Seconds(seconds));
        };
        pace.note(1, pace.mostPixels(), start, after(2)); // has compiled the kernel: no sign of what pixels cost
        EXPECT_EQ(Seconds(pace.next(1) - start).count(), secondsBetweenFrames);
        EXPECT_EQ(pace.mostPixels(), size_t{1} << 20);
        for (int picture = 0; picture < 20; ++picture)
            pace.note(1, pace.mostPixels(), start, after(secondsPerPixel * static_cast<double>(pace.mostPixels())));
        EXPECT_EQ(pace.next(2), FramePace::Clock::time_point{}) << "of another render";
        return Seconds(pace.next(1) - start).count();
    };
    for (const double slow : {1e-9, 3e-8, 1e-7}) EXPECT_NEAR(pauseOf(slow), 0.25, 1e-3) << slow;
    EXPECT_NEAR(pauseOf(1e-6), 65536 * 1e-6 / 0.03, 1e-3)
        << "with the fewest pixels: at most 3 % of the time all the same";
}

TEST(Errands, AreDoneByTheOtherThreadWhenTheyAreDue) {
    Errands errands;
    std::thread::id doneBy;
    uint64_t doneAt = 0;
    std::atomic<bool> isOver{false}, inPass{false};
    std::thread renders([&] {
        for (uint64_t number = 1; !isOver; ++number) {
            RenderMoment moment = momentOf(number);
            moment.inPass = inPass;
            errands.doDue(moment);
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    });
    const auto id = renders.get_id();
    const auto note = [&](const RenderMoment& moment) {
        doneBy = std::this_thread::get_id();
        doneAt = moment.number;
    };
    const std::chrono::seconds patience(10);
    EXPECT_TRUE(errands.run(note, {5, {}}, patience));
    EXPECT_EQ(doneBy, id);
    EXPECT_GT(doneAt, 5u);
    const auto later = Errands::Clock::now() + std::chrono::milliseconds(30);
    EXPECT_TRUE(errands.run(note, {0, later}, patience));
    EXPECT_GE(Errands::Clock::now(), later);
    EXPECT_FALSE(errands.run(note, {UINT64_MAX, {}}, std::chrono::milliseconds(5))) << "never due";
    inPass = true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_FALSE(errands.run(note, {}, std::chrono::milliseconds(20))) << "needs the whole film";
    EXPECT_TRUE(errands.run(note, {0, {}, true}, patience));
    inPass = false;
    EXPECT_THROW(errands.run([](const RenderMoment&) { throw InputError("no"); }, {}, patience), InputError);
    std::thread closes([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        errands.close();
    });
    EXPECT_FALSE(errands.run(note, {UINT64_MAX, {}}, patience)) << "woken by close()";
    EXPECT_FALSE(errands.run(note, {}, patience)) << "and not begun any more";
    closes.join();
    isOver = true;
    renders.join();
}

} // namespace
} // namespace quasilux
