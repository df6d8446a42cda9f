// Geometry that is kept between renders: a scene whose camera, lamps or settings change is flattened to the same bits
// as without.
#include "prepare/scene_geometry.h"

#include "prepare/device_scene.h"
#include "render/scene_report.h"
#include "support/scene_files.h"
#include "view/edits.h"

#include <gtest/gtest.h>

namespace quasilux {
namespace {

const std::string shapes =
    R"(<?quasilux instances="two-level"?><bsdf type="roughconductor" id="metal"><float name="alpha" value="0.1"/></bsdf>
    <shape type="shapegroup" id="group"><shape type="cube"><ref id="metal"/></shape><shape type="cube"><transform name="to_world">
    <scale value="0.5"/><rotate x="1" y="1" angle="40"/><translate x="1"/></transform></shape></shape>
    <shape type="instance"><transform name="to_world"><translate x="5"/></transform><ref id="group"/></shape>
    <shape type="instance"><transform name="to_world"><rotate y="1" angle="30"/><translate x="-5"/></transform><ref id="group"/></shape>
    <shape type="cube"/><shape type="sphere"><point name="center" value="1, 0, 0"/></shape>
    <shape type="rectangle"><transform name="to_world"><translate y="0.1"/></transform></shape>)";
const std::string lamps =
    R"(<shape type="rectangle"><transform name="to_world"><translate z="9"/></transform><emitter type="area"/></shape>
    <shape type="sphere"><point name="center" value="0, 9, 0"/><emitter type="area"/></shape>)";

/// All that is made of a scene.
void expectTheSame(const DeviceScene& known, const DeviceScene& fresh) {
    EXPECT_EQ(checksumsOf(known, -1), checksumsOf(fresh, -1));
    EXPECT_EQ(known.bvh.depth, fresh.bvh.depth);
    EXPECT_EQ(known.patches, fresh.patches);
    EXPECT_EQ(known.borderSegments, fresh.borderSegments);
    EXPECT_EQ(known.features.options(), fresh.features.options());
    EXPECT_EQ(known.warnings, fresh.warnings);
}

TEST(SceneGeometry, ServesOtherCamerasLampsAndSettings) {
    EditedScene edited(test::loadBody(shapes + lamps));
    const SceneGeometry geometry = prepareGeometry(edited.scene());
    ASSERT_EQ(geometry.borderTrees.size(), 2u);
    ASSERT_GT(geometry.borderTrees[0].segmentCount, 12u) << "shapes pass through each other";
    EXPECT_TRUE(geometry.borders.segments.empty()) << "they are in the trees";
    const auto before = flattenScene(edited.scene());
    const SurfaceBorders found = findBorders(edited.scene());
    EXPECT_EQ(before.borderSegments, found.segments.size() + found.groups.at(0).segments.size());
    ViewEdits edits;
    edits.camera = {0.3, 0.2, 1, 0.1, 0};
    edits.lamps = {0, 2, 3}; // that of the first shape is off
    FlattenSettings settings;
    settings.quasiSpecular = "none";
    settings.photons = 1000;
    settings.overridesScene = true;
    for (const FlattenSettings& now : {FlattenSettings{}, settings}) {
        edited.apply({});
        expectTheSame(flattenScene(edited.scene(), now, &geometry), flattenScene(edited.scene(), now));
        edited.apply(edits);
        const auto fresh = flattenScene(edited.scene(), now);
        expectTheSame(flattenScene(edited.scene(), now, &geometry), fresh);
        EXPECT_NE(checksumsOf(fresh, -1), checksumsOf(before, -1)) << "control: edits change the scene";
    }
}

TEST(SceneGeometry, OfOtherShapesIsAnotherOne) {
    const Scene scene = test::loadBody(shapes), moved = test::loadBody(shapes + "<shape type=\"disk\"/>");
    const SceneGeometry other = prepareGeometry(moved);
    EXPECT_NE(checksumsOf(flattenScene(moved, {}, &other), -1), checksumsOf(flattenScene(scene), -1));
    EXPECT_EQ(checksumsOf(flattenScene(moved, {}, &other), -1), checksumsOf(flattenScene(moved), -1));
}

TEST(SceneGeometry, SaysWhatOverlaps) {
    const Scene scene =
        test::loadBody("<shape type=\"rectangle\"/><shape type=\"rectangle\"><transform name=\"to_world\"><translate "
                       "x=\"0.5\" y=\"0.3\"/></transform></shape>");
    const SceneGeometry geometry = prepareGeometry(scene);
    EXPECT_EQ(flattenScene(scene, {}, &geometry).warnings.size(), 1u);
    EXPECT_EQ(flattenScene(scene, {}, &geometry).warnings, flattenScene(scene).warnings);
}

} // namespace
} // namespace quasilux
