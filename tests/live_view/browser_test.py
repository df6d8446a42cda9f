#!/usr/bin/env python3
"""The live view as people see it, in Chromium without a window: browser_test.py PROGRAM SOURCE_FOLDER."""

import sys
import unittest

import numpy
import OpenImageIO

from chromium import Chromium
from viewed import Viewed

PROGRAM, SOURCE = sys.argv[1:3]
SCENE = SOURCE + "/scenes/cornell_phong.xml"


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.view = Viewed(PROGRAM, SCENE, "-D", "resolution=48", "--photons", "4000")
        cls.addClassCleanup(cls.view.__exit__)
        cls.browser = Chromium()
        cls.addClassCleanup(cls.browser.close)

    def setUp(self):
        before = self.view.state()["render"]
        self.view.post("edit")  # begins anew, whatever the test before has left
        self.view.wait(lambda state: state["render"] > before)
        self.browser.resize(1200, 800)
        self.browser.open(self.view.address)
        self.browser.wait("document.body.dataset.passes > 0")

    def tearDown(self):
        self.assertEqual(self.browser.problems, [])

    def choose(self, name, value):
        self.browser.choose(name, value)

    def box(self):
        return self.browser.run("(b => [b.left, b.top, b.width, b.height])(document.getElementById('picture').getBoundingClientRect())")

    def picture(self):
        """What is seen of it, 0 to 255, by rows, columns and R, G, B."""
        path = str(self.view.folder / "seen.png")
        self.browser.screenshot(path)
        image = OpenImageIO.ImageInput.open(path)
        pixels = image.read_image(0, 3, OpenImageIO.UINT8).astype(float)
        image.close()
        left, top, width, height = map(round, self.box())
        return pixels[top:top + height, left:left + width]

    def wait_for_the_last_picture(self):
        """Of a render that was stopped."""
        passes = self.view.wait(lambda state: state["phase"] == "stopped")["passes"]
        self.browser.wait(f"document.body.dataset.passes == {passes} && /stopped/.test(document.getElementById('status').textContent)")
        self.assertEqual(self.browser.run("document.getElementById('phase').textContent"), "stopped", "what a screen reader says")

    def test_the_picture_appears_and_sharpens(self):
        seen = self.picture()
        self.assertGreater((seen.max(axis=2) > 40).mean(), 0.4, "most of the canvas is the lit box")
        self.choose("layer", "relative_error")
        self.browser.wait("!document.getElementById('legend').hidden")
        self.browser.wait("document.body.dataset.passes > 50")
        self.browser.run("document.getElementById('again').click()")
        self.browser.wait("document.body.dataset.passes < 50")
        self.browser.wait("document.body.dataset.passes > 1")  # of one pass no error is known
        first, passes = self.picture().mean(), int(self.browser.run("document.body.dataset.passes"))
        self.browser.wait(f"document.body.dataset.passes > {6 * passes}")
        self.assertLess(self.picture().mean(), 0.95 * first, "less error is darker")
        self.browser.wait("document.querySelector('#chart .curve') && /error/.test(document.getElementById('status').textContent)")

    def test_exposure_and_curve_change_the_picture(self):
        self.browser.run("document.getElementById('stop').click()")
        self.wait_for_the_last_picture()
        before = self.picture().mean()
        self.choose("exposure", -2)
        darker = self.picture().mean()
        self.assertLess(darker, 0.8 * before)
        self.assertIn("exposure=", self.browser.run("document.getElementById('save-png').href"))
        self.choose("exposure", 0)
        self.assertAlmostEqual(self.picture().mean(), before, delta=1, msg="control: and back")
        self.choose("curve", "linear")
        self.assertGreater(abs(self.picture().mean() - before), 2)

    def test_a_change_of_the_method_begins_anew(self):
        renders = self.view.state()["render"]
        self.choose("bdd", 1)
        self.view.wait(lambda state: state["render"] > renders and state["settings"]["bdd"] == 1 and state["passes"] > 0)
        self.browser.wait("/bdd 1/.test(document.getElementById('settings').textContent)")
        self.choose("bdd", "")
        self.view.wait(lambda state: state["settings"]["bdd"] == 0)

    def test_two_methods_side_by_side_at_equal_time(self):
        run = self.browser.run
        self.browser.wait("document.body.dataset.passes > 10")
        run("document.getElementById('keep').click()")
        kept = self.view.state()
        self.choose("exposure", 1)  # holds for both
        self.choose("bdd", 2)
        self.choose("split", 100)
        stopped = self.view.wait(lambda state: state["render"] > kept["render"] and state["phase"] == "stopped")
        self.assertAlmostEqual(stopped["seconds"], kept["seconds"], delta=1.5)
        self.wait_for_the_last_picture()
        left = self.picture()
        self.choose("split", 0)
        right = self.picture()
        self.choose("split", 50)
        both, middle = self.picture(), left.shape[1] // 2
        numpy.testing.assert_array_equal(both[:, :middle - 4], left[:, :middle - 4])
        numpy.testing.assert_array_equal(both[:, middle + 4:], right[:, middle + 4:])
        self.assertGreater(numpy.abs(left - right).mean(), 1, "they differ")
        self.assertIn("BDD 0", run("document.getElementById('kept').textContent"))
        self.assertIn("BDD 2", run("document.getElementById('now').textContent"))
        run("document.getElementById('forget').click()")
        numpy.testing.assert_array_equal(self.picture(), right)
        self.choose("bdd", "")

    def test_dragging_turns_the_camera_and_keys_zoom(self):
        renders = self.view.state()["render"]
        left, top, width, height = self.box()
        x, y = left + width / 2, top + height / 2
        self.browser.mouse("mousePressed", x, y, 1)
        self.browser.mouse("mouseMoved", x + 50, y, 1)
        self.browser.mouse("mouseReleased", x + 50, y)
        self.assertNotEqual(float(self.browser.run("document.getElementById('yaw').value")), 0)
        self.assertIn("move the camera", self.browser.run("document.getElementById('pointer-help').textContent"))
        self.browser.run("document.getElementById('drag-camera').click()")
        self.assertIn("moves the picture", self.browser.run("document.getElementById('pointer-help').textContent"))
        self.browser.run("document.getElementById('drag-camera').click()")
        self.view.wait(lambda state: state["render"] > renders and state["passes"] > 0)
        self.browser.wait("document.getElementById('pixel').tBodies[0].rows.length > 1")
        for place in ([3, 4], [40, 30]):  # the second one while the first is still asked for
            self.choose("pixel-x", place[0])
            self.choose("pixel-y", place[1])
        self.browser.wait("document.getElementById('pixel').dataset.place === '40,30' && !document.getElementById('pixel').classList.contains('waiting')")
        self.browser.run("document.getElementById('camera-reset').click(), document.getElementById('picture').focus()")
        before = self.picture()
        self.browser.key("+")
        self.assertGreater(numpy.abs(self.picture() - before).mean(), 5)

    def drag(self, x, y):
        left, top, width, height = self.box()
        middle = left + width / 2, top + height / 2
        self.browser.mouse("mousePressed", *middle, 1)
        self.browser.mouse("mouseMoved", middle[0] + x, middle[1] + y, 1)
        self.browser.mouse("mouseReleased", middle[0] + x, middle[1] + y)

    def camera_after(self, action):
        """What the program has of it when the page has sent what `action` does."""
        before = self.view.state()["edits"]["number"]
        action()
        return self.view.wait(lambda state: state["edits"]["number"] > before and not state["edits"]["isDraft"])["edits"]["camera"]

    def test_the_camera_has_no_dead_zone_beyond_its_limits(self):
        limits = self.view.state()["cameraLimits"]
        self.assertEqual(self.camera_after(lambda: self.drag(0, 300))["pitch"], limits["pitch"][1])
        self.assertAlmostEqual(self.camera_after(lambda: self.drag(0, -100))["pitch"], limits["pitch"][1] - 0.6, delta=0.02)
        wheel = "document.getElementById('picture').dispatchEvent(new WheelEvent('wheel', {deltaY: %d}))"
        self.assertEqual(self.camera_after(lambda: self.browser.run(wheel % -30000))["nearer"], limits["nearer"][1])
        self.assertEqual(self.camera_after(lambda: self.browser.run(wheel % 15000))["nearer"], limits["nearer"][1] - 30)
        self.assertEqual(self.browser.run("document.getElementById('problem').textContent"), "")
        self.assertAlmostEqual(self.camera_after(lambda: self.drag(-400, 0))["yaw"], 2.4, delta=0.02)
        self.assertAlmostEqual(self.camera_after(lambda: self.drag(-400, 0))["yaw"], 4.8 - 2 * numpy.pi, delta=0.02)

    def test_the_page_shows_changes_that_it_did_not_make(self):
        edits = {"camera": {"yaw": 0.5, "nearer": 1}, "bdd": 1, "variant": "main", "quasiSpecular": "none", "lamps": [3]}
        self.view.post("edit", **edits)
        shown = "['bdd', 'variant', 'quasiSpecular', 'yaw', 'lamp-0'].map(id => document.getElementById(id)?.value).join()"
        expected = "1,main,none,0.5,1.5"
        self.browser.wait(f"{shown} === '{expected}'")
        self.assertIn("× 3", self.browser.run("document.getElementById('lamps').textContent"))
        self.browser.open(self.view.address)
        self.browser.wait(f"{shown} === '{expected}'")
        self.choose("bdd", 2)  # is sent with all others
        state = self.view.wait(lambda state: state["edits"]["bdd"] == 2)
        self.assertEqual((state["edits"]["camera"]["yaw"], state["edits"]["lamps"], state["edits"]["variant"]), (0.5, [3], "main"))

    def test_what_is_typed_is_not_overwritten(self):
        self.browser.run("document.getElementById('quasiSpecular').focus()")
        self.browser.run("(field => { field.value = 'al'; field.dispatchEvent(new Event('input')); })(document.getElementById('quasiSpecular'))")
        number = self.view.post("edit", bdd=1)[1]["number"]
        self.view.wait(lambda state: state["edits"]["number"] == number)
        self.browser.wait("/bdd 1/.test(document.getElementById('settings').textContent)")
        self.assertEqual(self.browser.run("document.getElementById('quasiSpecular').value"), "al")
        self.browser.run("document.getElementById('quasiSpecular').blur()")
        self.browser.wait("document.getElementById('bdd').value === '1'")

    def test_a_broken_scene_shows_its_line(self):
        line, good = self.view.break_scene()
        self.browser.wait(f"document.querySelector('#problem:not([hidden])')?.textContent.includes('scene.xml:{line}:')")
        self.view.scene.write_text(good)
        self.browser.wait("document.getElementById('problem').hidden")

    def test_a_wrong_token_is_refused(self):
        self.browser.open(self.view.address.replace(self.view.token, "0" * 32))
        self.assertIn("token", self.browser.run("document.body.textContent"))
        self.assertFalse(self.browser.run("!!document.getElementById('picture')"))

    def test_everything_has_a_name_and_fits_a_phone(self):
        tree = self.browser.call("Accessibility.getFullAXTree")["nodes"]
        value = lambda node, key: node.get(key, {}).get("value", "")
        focusable = [node for node in tree if any(p["name"] == "focusable" and p["value"]["value"] for p in node.get("properties", []))]
        controls = [node for node in focusable if value(node, "role") != "RootWebArea"]
        self.assertGreater(len(controls), 15)
        self.assertEqual([value(node, "role") for node in controls if not value(node, "name")], [])
        roles = {value(node, "role") for node in tree}
        self.assertLessEqual({"application", "status", "complementary", "slider", "combobox", "spinbutton"}, roles)
        self.browser.resize(360, 740, mobile=True)
        self.assertLessEqual(self.browser.run("document.documentElement.scrollWidth"), 360)


class OtherRenders(unittest.TestCase):
    def opened(self, *options):
        view = Viewed(PROGRAM, SCENE, *options)
        self.addCleanup(view.__exit__)
        browser = Chromium()
        self.addCleanup(browser.close)
        browser.resize(1200, 800)
        browser.open(view.address)
        browser.wait("document.body.dataset.passes > 0 && /done/.test(document.getElementById('status').textContent)", 60)
        return view, browser

    def colours(self, browser):
        """Those of the canvas, rows by columns by R, G, B, A."""
        width, height, pixels = browser.run("""(canvas => [canvas.width, canvas.height,
            [...canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data]])(document.getElementById('picture'))""")
        return numpy.array(pixels, numpy.uint8).reshape(height, width, 4)

    def test_errors_of_one_pass_are_unknown(self):
        view, browser = self.opened("-D", "resolution=48", "--photons", "4000", "--passes", "1")
        table = "document.getElementById('pixel').tBodies[0].textContent"
        browser.wait(f"/± errorunknown/.test({table})")
        for layer in ("stderr", "relative_error"):
            browser.choose("layer", layer)
            browser.wait("/unknown/.test(document.getElementById('legend-marks').textContent)")
            seen = self.colours(browser)
            self.assertEqual(numpy.unique(seen[seen[:, :, 3] > 0][:, :3]).tolist(), [128], "plain grey")
        browser.choose("layer", "bias")
        browser.wait("!/unknown/.test(document.getElementById('legend-marks').textContent)")
        self.assertEqual(browser.problems, [])

    def test_the_kept_picture_of_a_large_film_is_the_render_s_own(self):
        view, browser = self.opened("-D", "resolution=1536", "--photons", "4000", "--passes", "2")
        browser.run("document.getElementById('picture').focus()")
        browser.key("1")  # a part of the film is looked at from now on
        browser.wait("document.body.dataset.step === '1'")
        before = view.state()["render"]
        browser.choose("lamp-0", -3)
        view.wait(lambda state: state["render"] > before and state["phase"] == "done", 60)
        browser.wait(f"Number(document.body.dataset.render) > {before} && document.body.dataset.passes === '2'", 60)
        browser.run("document.getElementById('keep').click()")
        browser.wait("/2 passes/.test(document.getElementById('kept').textContent)")
        browser.key("0")
        browser.wait("document.body.dataset.step === '2'")
        browser.choose("split", 100)
        kept = self.colours(browser)
        browser.choose("split", 0)
        numpy.testing.assert_array_equal(kept, self.colours(browser))
        self.assertGreater(kept[:, :, :3].max(), 40, "control: there is something")
        self.assertEqual(browser.problems, [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
