// What several devices' passes leave behind where the render ends before the first of them. One device stands for all.
#include "support/lit_plate.h"

#include "cli/pass_sharing.h"
#include "device/device.h"
#include "util/temporary_folder.h"

#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace quasilux {
namespace {

using testing::HasSubstr;

class PassSharingTest : public testing::Test {
protected:
    PassSharingTest() {
        const std::string file = (folder.path() / "scene.xml").string();
        std::ofstream(file) << test::litPlate();
        scene = std::make_shared<const Scene>(loadScene(file));
        options.checkpoint = (folder.path() / "a.ckpt").string();
    }

    /// What is said of a render that is interrupted before its first pass, during its search or after it.
    std::string saidOf(bool duringSearch) {
        const std::function<void(const Progress&)> onProgress;
        const std::atomic<bool> interrupted = true;
        AutoRender soFar;
        soFar.search.interrupted = duringSearch;
        const auto device = std::make_shared<Device>(0);
        CheckpointKeeper keeper(options, *device, checkpointOf(options, *scene, {}), {});
        const SharedDevices devices{device, ownDevices(options), scene};
        const ChosenRender chosen{
            soFar, std::make_shared<Renderer>(*device, *scene, soFar.settings), {}, 0, onProgress, interrupted};
        testing::internal::CaptureStderr();
        PassSharing(options, devices, keeper, {}).run(chosen);
        return testing::internal::GetCapturedStderr();
    }

    TemporaryFolder folder;
    RenderOptions options;
    std::shared_ptr<const Scene> scene;
};

// As of a render on one device: who is to go on from a checkpoint has to know that there is none.
TEST_F(PassSharingTest, SaysThatNoCheckpointIsThere) {
    EXPECT_THAT(saidOf(true), HasSubstr("warning: no checkpoint is written: the render was interrupted before its "
                                        "settings were chosen"));
    EXPECT_FALSE(std::filesystem::exists(options.checkpoint));
    EXPECT_EQ(saidOf(false), "");
    EXPECT_TRUE(std::filesystem::exists(options.checkpoint)) << "what was searched is not lost";
}

} // namespace
} // namespace quasilux
