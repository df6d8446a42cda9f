// When a render that is watched is given up for an edit. What the page sees of it is tested from outside
// (live_view/http_test.py).
#include "view/live_view.h"

#include "render/film_cut.h"
#include "support/scene_files.h"
#include "support/test_kernels.h"

#include <gtest/gtest.h>
#include <thread>

namespace quasilux {
namespace {

const std::string shapes =
    R"(<shape type="rectangle"><transform name="to_world"><rotate x="1" angle="-90"/></transform></shape>
    <shape type="sphere"><bsdf type="dielectric"/></shape>)";

class Watched : public testing::Test {
protected:
    void SetUp() override {
        settings_.photonsPerPass = 20000;
        soFar_.settings = settings_;
        device_.keepPaces();
        Renderer before(device_, scene_, settings_); // knows how long launches take
        for (unsigned pass = 0; pass < 3; ++pass) before.renderPass(pass);
        device_.setLongestLaunch(1e-4);
        view_.begin(device_, scene_, settings_, {}, true);
        renderer_ = std::make_unique<Renderer>(device_, scene_, settings_);
        afterPass();
    }
    ~Watched() override { device_.watchLaunches({}); }

    void afterPass(bool isLast = false) { view_.afterPass(soFar_, *renderer_, 0, isLast); }
    void edit(bool isDraft = false) {
        ViewEdits edits;
        edits.isDraft = isDraft;
        view_.edit(edits);
    }
    uint64_t launches(const char* kernel) {
        const auto timings = device_.timings();
        return timings.count(kernel) ? timings.at(kernel).launches : 0;
    }

    const Scene scene_ = test::loadBody(shapes);
    RenderSettings settings_;
    AutoRender soFar_;
    std::atomic<bool> signalled_{false};
    Device device_{{}, testDevice().workGroupSize()};
    LiveView view_{{"127.0.0.1", 0, false}, signalled_};
    std::unique_ptr<Renderer> renderer_;
};

TEST_F(Watched, FirstLaunchesAreSplitWherePacesAreKnown) {
    const uint64_t photons = launches("tracePhotons"), paths = launches("traceCameraPaths");
    renderer_->renderPass(0);
    EXPECT_GT(launches("tracePhotons"), photons + 1);
    EXPECT_GT(launches("traceCameraPaths"), paths + 1);
}

TEST_F(Watched, PassesGoOnWithoutEdits) {
    for (unsigned pass = 0; pass < 2; ++pass) {
        EXPECT_NO_THROW(renderer_->renderPass(pass));
        EXPECT_NO_THROW(afterPass());
    }
}

TEST_F(Watched, PhotonTracingIsGivenUpForAnEdit) {
    renderer_->renderPass(0);
    afterPass();
    const uint64_t photons = launches("tracePhotons");
    edit(true);
    EXPECT_THROW(renderer_->renderPass(1), RenderAbandoned);
    EXPECT_EQ(launches("tracePhotons"), photons) << "by the launch that follows the edit";
}

TEST_F(Watched, FirstPassIsGivenUpAfterASecond) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1010));
    edit();
    EXPECT_THROW(renderer_->renderPass(0), RenderAbandoned);
}

TEST_F(Watched, FirstPassIsNotGivenUpForADraft) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1010));
    edit(true);
    EXPECT_NO_THROW(renderer_->renderPass(0));
    EXPECT_THROW(afterPass(), RenderAbandoned) << "but then";
}

TEST_F(Watched, LearningIsGivenUpAtOnce) {
    view_.begin(device_, scene_, settings_, {}, true);
    edit(true);
    EXPECT_THROW(Renderer(device_, scene_, settings_), RenderAbandoned);
}

TEST_F(Watched, AStopKeepsThePass) {
    renderer_->renderPass(0);
    afterPass();
    view_.stop();
    EXPECT_NO_THROW(renderer_->renderPass(1));
    EXPECT_NO_THROW(afterPass());
}

TEST_F(Watched, WhatIsSavedIsNotGivenUp) {
    renderer_->renderPass(0);
    edit();
    bool isSaved = false;
    const auto save = [&](const RenderMoment& now) {
        FilmCutChoice pixel;
        pixel.width = pixel.height = 1;
        isSaved = view_.cutter().develop(now.renderer.film(), 1, pixel).radiance.size() == 3;
    };
    std::thread page([&] { view_.errands().run(save, {}, std::chrono::minutes(1)); });
    while (!view_.errands().areAwaited()) std::this_thread::yield();
    EXPECT_THROW(afterPass(), RenderAbandoned);
    page.join();
    EXPECT_TRUE(isSaved);
}

TEST_F(Watched, NoImageIsMadeOfWhatIsGivenUp) {
    const auto after = [&](const Renderer&, double, bool isLast) {
        EXPECT_FALSE(isLast) << "nobody looks at it once more";
        if (renderer_->counters().passes == 2) edit();
        afterPass(isLast);
    };
    StopRule threePasses;
    threePasses.passes = 3;
    EXPECT_THROW(renderAsFarAsItGoes(*renderer_, threePasses, {}, view_.interrupted(), {}, after), RenderAbandoned);
    EXPECT_EQ(renderer_->counters().passes, 2u);
}

} // namespace
} // namespace quasilux
