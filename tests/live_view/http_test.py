#!/usr/bin/env python3
"""The live view by plain requests: who may ask, that the picture is the image, that it sharpens, that changes begin anew.
http_test.py PROGRAM SOURCE_FOLDER. Renders have a seed, so that figures are the same on every run."""

import json
import socket
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import numpy
import OpenImageIO

from viewed import Viewed

PROGRAM, SOURCE = sys.argv[1:3]
SCENE = SOURCE + "/scenes/cornell_phong.xml"
SMALL = ["-D", "resolution=48", "--photons", "4000"]
PASSES = 6


def pixels_of(content, kind=".exr", names=("R", "G", "B")):
    """Channels of an image that came by HTTP."""
    with tempfile.NamedTemporaryFile(suffix=kind) as file:
        file.write(content)
        file.flush()
        image = OpenImageIO.ImageInput.open(file.name)
        channels = [image.spec().channelindex(name) for name in names]
        pixels = image.read_image(OpenImageIO.FLOAT)
        image.close()
    return pixels[:, :, channels]


def channels_of(content):
    """All channels of an EXR that came by HTTP, by name."""
    with tempfile.NamedTemporaryFile(suffix=".exr") as file:
        file.write(content)
        file.flush()
        image = OpenImageIO.ImageInput.open(file.name)
        names = image.spec().channelnames
        pixels = image.read_image(0, len(names), OpenImageIO.FLOAT)
        image.close()
    return {name: pixels[:, :, k] for k, name in enumerate(names)}


class Addresses(unittest.TestCase):
    def test_one_that_others_reach_takes_the_token_too(self):
        with Viewed(PROGRAM, SCENE, *SMALL, "--listen", "0.0.0.0") as view:
            host = {"Host": f"{view.host}:{view.port}"}
            self.assertEqual(view.ask("/", headers=host)[0], 403)
            self.assertEqual(view.ask(f"/{view.token}/state", headers=host)[0], 200, "control")
            socket.create_connection(("127.0.0.2", view.port), 5).close()

    def test_the_usual_one_is_the_loopback_alone(self):
        with Viewed(PROGRAM, SCENE, *SMALL) as view:
            with self.assertRaises(ConnectionRefusedError):
                socket.create_connection(("127.0.0.2", view.port), 5)
            socket.create_connection(("127.0.0.1", view.port), 5).close()  # control


class DoneRender(unittest.TestCase):
    """Of a render that has come to its end, which stays until something is changed."""

    @classmethod
    def setUpClass(cls):
        cls.view = Viewed(PROGRAM, SCENE, *SMALL, "--passes", str(PASSES))
        cls.addClassCleanup(cls.view.__exit__)
        cls.view.wait(lambda state: state["phase"] == "done")

    def setUp(self):
        self.view.edit()  # without changes

    def test_only_who_has_the_token_is_answered(self):
        view = self.view
        almost = view.token[:-1] + ("0" if view.token[-1] != "0" else "1")
        for path in ["/", "/state", f"/{almost}/", f"/{almost}/state", f"/{view.token}", f"//{view.token}/state"]:
            self.assertEqual(view.ask(path)[0], 403, path)
        self.assertEqual(view.ask(f"/{almost}/stop", "{}")[0], 403)
        self.assertEqual(view.ask(f"/{view.token}/state")[0], 200, "control")

    def test_only_under_its_own_name(self):
        path = f"/{self.view.token}/state"
        for host in ["evil.example", f"evil.example:{self.view.port}", "127.0.0.1", "127.0.0.1:1", f"127.0.0.1.evil.example:{self.view.port}", ""]:
            self.assertEqual(self.view.ask(path, headers={"Host": host})[0], 403, host)
        for host in [f"127.0.0.1:{self.view.port}", f"localhost:{self.view.port}"]:
            self.assertEqual(self.view.ask(path, headers={"Host": host})[0], 200, host)

    def test_no_request_reads_a_file(self):
        for name in ["scene.xml", "../scene.xml", "..%2fscene.xml", "%2e%2e/%2e%2e/etc/passwd", "/etc/passwd", "view.cpp"]:
            self.assertIn(self.view.get(name)[0], (403, 404), name)
        status, headers, _ = self.view.get("view.js")
        self.assertEqual(status, 200, "control: a file of the page")
        self.assertIn("script-src 'self'", headers["Content-Security-Policy"])
        self.assertEqual(headers["X-Content-Type-Options"], "nosniff")

    def test_changes_are_only_taken_as_json_of_the_page(self):
        path = f"/{self.view.token}/edit"
        self.assertEqual(self.view.ask(path, "{}", {"Content-Type": "text/plain"})[0], 415)
        for wrong in ['{"bdd": -1}', '{"bdd": 1001}', '{"variant": "best"}', '{"camera": 3}', '{"lamps": [-1]}', '{"lamps": ["x"]}', "[]", "{"]:
            status, _, body = self.view.ask(path, wrong, {"Content-Type": "application/json"})
            self.assertEqual(status, 400, wrong)
            self.assertTrue(json.loads(body)["error"])
        self.assertEqual(self.view.get("frame", layer="stdrr")[0], 400)
        self.assertEqual(self.view.get("frame", step="-1")[0], 400)
        self.assertEqual(self.view.get("pixel", x=48, y=0)[0], 400)

    def test_picture_and_pixel_are_those_of_the_image(self):
        image = pixels_of(self.view.get("image.exr")[2])
        header, frame = self.view.frame()
        self.assertEqual((header["passes"], frame.shape), (PASSES, image.shape))
        numpy.testing.assert_allclose(frame, image, rtol=2 ** -11, atol=2 ** -25 / header["scale"])
        pixel = json.loads(self.view.get("pixel", x=20, y=30)[2])
        self.assertEqual(pixel["value"], image[30, 20].tolist())
        errors = pixels_of(self.view.get("image.exr")[2], names=("stderr.R", "stderr.G", "stderr.B"))
        self.assertEqual(pixel["stderr"], errors[30, 20].tolist())
        self.assertGreater(min(pixel["stderr"]), 0)

    def test_the_png_has_the_exposure_that_is_asked_for(self):
        dark, bright = (pixels_of(self.view.get("image.png", exposure=scale)[2], ".png").mean() for scale in (0.25, 4))
        self.assertLess(1.5 * dark, bright)

    def test_thinned_pictures_are_means_of_blocks(self):
        image = pixels_of(self.view.get("image.exr")[2])
        header, frame = self.view.frame(x=3, y=5, width=12, height=8, step=4)
        self.assertEqual((header["x"], header["y"], header["step"]), (3, 5, 4))
        blocks = image[5:13, 3:15].reshape(2, 4, 3, 4, 3).mean(axis=(1, 3))
        numpy.testing.assert_allclose(frame, blocks, rtol=2 ** -10)

    def test_components_add_up(self):
        layers = self.view.state()["layers"]
        self.assertEqual(layers, ["image", "direct", "caustic", "quasi_caustic", "diffuse", "emission", "stderr", "bias", "relative_error"])
        total = sum(self.view.frame(layer=layer)[1] for layer in layers[1:6])
        numpy.testing.assert_allclose(total, self.view.frame()[1], rtol=2 ** -9, atol=1e-6)

    def test_nothing_new_is_waited_for_in_vain(self):
        header, _ = self.view.frame()
        self.assertEqual(self.view.frame(after=header["moment"]), (None, None))

    def test_method_and_back(self):
        _, before = self.view.frame()
        state = self.view.edit(bdd=1, variant="alternative")
        self.assertEqual((state["settings"]["bdd"], state["settings"]["variant"]), (1, "alternative"))
        self.assertFalse(numpy.array_equal(self.view.frame()[1], before))
        self.view.edit()
        numpy.testing.assert_array_equal(self.view.frame()[1], before)

    def test_layers_are_those_that_the_film_has(self):
        self.assertNotIn("bias", self.view.edit(map="camera")["layers"])
        self.assertEqual(self.view.get("frame", layer="bias")[0], 400)
        self.assertIn("bias", self.view.edit()["layers"])

    def test_a_lamp_of_twice_the_power(self):
        _, before = self.view.frame()
        self.view.edit(lamps=[2])
        self.assertAlmostEqual(self.view.frame()[1].mean() / before.mean(), 2, delta=0.02)
        self.view.post("edit", lamps=[0])
        self.view.wait(lambda state: "all lamps are off" in state["problem"])

    def test_camera_turns_about_the_scene(self):
        _, before = self.view.frame()
        self.view.edit(camera={"yaw": 0.3, "pitch": 0.2})
        _, turned = self.view.frame()
        self.assertGreater(numpy.abs(turned - before).mean(), 0.1 * before.mean())
        self.view.edit(camera={"yaw": 0})
        numpy.testing.assert_array_equal(self.view.frame()[1], before)

    def test_the_state_says_what_is_changed(self):
        self.assertEqual(self.view.edit()["edits"]["lamps"], [])
        edits = {"camera": {"yaw": 0.3, "pitch": 0.2, "nearer": -1, "right": 0, "up": 0}, "lamps": [2], "bdd": 1, "variant": "main",
                 "direct": None, "map": None, "quasiSpecular": "none", "isDraft": False}
        number = self.view.post("edit", **edits)[1]["number"]
        state = self.view.wait(lambda state: state["edits"]["number"] == number)
        self.assertEqual(state["edits"], {**edits, "number": number})
        self.assertEqual(self.view.edit()["edits"]["number"], number + 1)

    def test_the_state_says_how_far_the_camera_goes(self):
        limits = self.view.state()["cameraLimits"]
        self.assertEqual(self.view.post("edit", camera={"nearer": limits["nearer"][1]})[0], 200)
        self.assertEqual(self.view.post("edit", camera={"nearer": limits["nearer"][1] + 0.01})[0], 400)
        self.view.edit(camera={"pitch": limits["pitch"][1]})
        _, highest = self.view.frame()
        self.view.edit(camera={"pitch": limits["pitch"][1] + 1})
        numpy.testing.assert_array_equal(self.view.frame()[1], highest)

    def test_a_picture_says_what_it_is_of(self):
        state = self.view.edit(bdd=1)
        header, _ = self.view.frame()
        self.assertEqual({key: header[key] for key in ("render", "settings", "seconds", "passes")},
                         {key: state[key] for key in ("render", "settings", "seconds", "passes")})

    def test_what_cannot_be_rendered_is_said(self):
        before = self.view.state()["render"]
        self.view.post("edit", quasiSpecular="nowhere")
        state = self.view.wait(lambda state: state["render"] > before and state["problem"])
        self.assertIn("nowhere", state["problem"])
        self.assertEqual(self.view.state()["phase"], "failed")
        for name in ("frame", "image.exr"):  # there is no picture, and nobody waits for one
            self.assertEqual(self.view.get(name)[0], 204)
        self.assertEqual(self.view.edit()["problem"], "")

    def test_a_broken_scene_shows_its_line_and_the_picture_stays(self):
        before = self.view.state()["render"]
        line, good = self.view.break_scene()
        state = self.view.wait(lambda state: state["problem"])
        self.assertIn(f"scene.xml:{line}:", state["problem"])
        self.assertEqual(state["render"], before)
        self.assertEqual(self.view.frame()[0]["passes"], PASSES)
        self.view.scene.write_text(good)
        self.view.wait(lambda state: state["render"] > before and state["phase"] == "done" and not state["problem"])

    def test_a_file_of_the_scene_that_is_saved_is_loaded_again(self):
        scene, good, before = self.view.scene, self.view.scene.read_text(), self.view.state()["render"]
        part = self.view.folder / "part.xml"
        part.write_text('<texture version="3.0.0" type="checkerboard" id="unused"/>')
        scene.write_text(good.replace("</scene>", '<include filename="part.xml"/></scene>'))
        done = lambda state: state["render"] > before and state["phase"] == "done" and not state["problem"]
        before = self.view.wait(done)["render"]
        part.write_text('<texture version="3.0.0" type="checkerbord" id="unused"/>')
        self.assertIn("part.xml:1:", self.view.wait(lambda state: state["problem"])["problem"])
        part.write_text('<texture version="3.0.0" type="checkerboard" id="mended"/>')
        before = self.view.wait(done)["render"]
        scene.write_text(good)
        self.view.wait(done)


class SinglePass(unittest.TestCase):
    def test_its_errors_are_not_known(self):
        for passes in (1, 2):
            with Viewed(PROGRAM, SCENE, *SMALL, "--passes", str(passes)) as view:
                view.wait(lambda state: state["phase"] == "done")
                pixel = json.loads(view.get("pixel", x=20, y=30)[2])
                is_known = passes > 1  # control
                self.assertGreater(min(pixel["value"]), 0)
                self.assertEqual([pixel[key] is not None for key in ("stderr", "bias", "biasStderr")], [is_known, True, is_known])
                for layer in ("stderr", "relative_error"):
                    self.assertEqual(view.frame(layer=layer)[0]["isKnown"], is_known, layer)
                self.assertTrue(view.frame(layer="bias")[0]["isKnown"])


class GltfScene(unittest.TestCase):
    def test_it_is_seen_and_loaded_again_when_it_is_saved(self):
        with Viewed(PROGRAM, SOURCE + "/tests/data/lit_floor.gltf", "--passes", "2", "--photons", "4000") as view:
            done = view.wait(lambda state: state["phase"] == "done")
            self.assertEqual(done["scene"], "scene.gltf")
            self.assertEqual([lamp["kind"] for lamp in done["lamps"]], ["area"])
            before = view.frame()[1].mean()
            good = view.scene.read_text()
            view.scene.write_text(good.replace('"emissiveStrength": 8', '"emissiveStrength": 16'))
            view.wait(lambda state: state["render"] > done["render"] and state["phase"] == "done")
            self.assertAlmostEqual(view.frame()[1].mean() / before, 2, delta=0.02)
            view.scene.write_text(good.replace('"camera": 0', '"camera": 7'))
            self.assertIn("scene.gltf: nodes[2]", view.wait(lambda state: state["problem"])["problem"])


class FurtherLayers(unittest.TestCase):
    """Of a scene with an integrator `aov` and alpha."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.scene = Path(cls.folder.name) / "layers.xml"
        text = Path(SCENE).read_text()
        path = text[text.index("<integrator"):text.index("</integrator>") + len("</integrator>")]
        aov = f'<integrator type="aov"><string name="aovs" value="dd:depth,nn:sh_normal,al:albedo"/>{path}</integrator>'
        cls.scene.write_text(text.replace(path, aov).replace('name="pixel_format" value="rgb"', 'name="pixel_format" value="rgba"'))

    def rendered(self, folder, passes, *options, scene=None):
        """What the program writes, by channel."""
        command = [PROGRAM, "render", str(scene or self.scene), *SMALL, "--fixed", "--passes", str(passes), "--quiet", "-o", "out.exr", *options]
        subprocess.run(command, cwd=folder, check=True)
        return channels_of((folder / "out.exr").read_bytes())

    def test_the_exr_is_the_one_that_the_program_writes(self):
        with Viewed(PROGRAM, self.scene, *SMALL, "--passes", str(PASSES)) as view:
            view.wait(lambda state: state["phase"] == "done")
            saved = channels_of(view.get("image.exr")[2])
            expected = self.rendered(view.folder, PASSES)
            self.assertEqual(view.state()["problem"], "")
        self.assertLess({"A", "dd.T", "nn.X", "nn.Y", "nn.Z", "al.R", "al.G", "al.B", "stderr.R"}, saved.keys())
        self.assertEqual(list(saved), list(expected))
        for name, values in expected.items():
            numpy.testing.assert_array_equal(saved[name], values, name)
        self.assertGreater(numpy.ptp(saved["dd.T"]), 1, "control: depths differ")

    def test_what_is_kept_between_changes_leaves_no_trace(self):
        """Tree, borders and paces of launches are kept: each image is the one of a program that begins anew."""
        with Viewed(PROGRAM, self.scene, *SMALL, "--passes", str(PASSES)) as view:
            view.wait(lambda state: state["phase"] == "done")
            brighter = view.folder / "brighter.xml"
            brighter.write_text(self.scene.read_text().replace("100,100,100", "200,200,200"))
            images = []
            for edits, options, scene in [({"bdd": 1, "variant": "alternative"}, ["--bdd", "1", "--variant", "alternative"], None),
                                          ({"map": "camera"}, ["--map", "camera"], None), ({"lamps": [2]}, [], brighter)]:
                view.edit(**edits)
                images.append(channels_of(view.get("image.exr")[2]))
                for name, values in self.rendered(view.folder, PASSES, *options, scene=scene).items():
                    numpy.testing.assert_array_equal(images[-1][name], values, f"{edits} {name}")
        self.assertFalse(numpy.array_equal(images[0]["R"], images[1]["R"]), "control: changes change the image")

    def test_those_of_a_moved_camera(self):
        with Viewed(PROGRAM, self.scene, *SMALL, "--passes", str(PASSES)) as view:
            view.wait(lambda state: state["phase"] == "done")
            before = channels_of(view.get("image.exr")[2])["dd.T"]
            view.edit(camera={"nearer": 1})
            after = channels_of(view.get("image.exr")[2])["dd.T"]
        # The back wall: the camera, 3.9 before the middle of the scene, goes half the way.
        self.assertAlmostEqual(before[20, 28] - after[20, 28], 1.95, delta=0.1)

    def test_a_running_render_is_not_changed_by_saving(self):
        options = [*SMALL, "--fixed", "--passes", "200", "-o", "out.exr"]
        with Viewed(PROGRAM, self.scene, *options, "--view", command="render") as view:
            saved = channels_of(view.get("image.exr")[2])
            view.process.wait(60)
            watched = channels_of((view.folder / "out.exr").read_bytes())
            alone = self.rendered(view.folder, 200)
        self.assertIn("nn.X", saved)
        self.assertFalse(numpy.array_equal(saved["R"], watched["R"]), "control: it was saved before the end")
        for name, values in alone.items():
            numpy.testing.assert_array_equal(watched[name], values, name)


class RunningRender(unittest.TestCase):
    def test_it_sharpens_and_stops(self):
        with Viewed(PROGRAM, SCENE, *SMALL) as view:
            view.wait(lambda state: state["passes"] >= 2)  # after one no error is known
            early, noise_early = view.frame(layer="relative_error")
            view.wait(lambda state: state["passes"] >= 16 * early["passes"])
            late, noise_late = view.frame(layer="relative_error")
            # The noise falls by the root of the passes, to a quarter; less as radii shrink meanwhile.
            self.assertLess(noise_late.mean(), 0.6 * noise_early.mean())
            self.assertGreater(late["passes"], early["passes"])
            self.assertEqual(view.post("stop")[0], 200)
            stopped = view.wait(lambda state: state["phase"] == "stopped")
            self.assertIsNone(stopped["secondsLeft"])
            self.assertEqual(view.frame()[0]["passes"], stopped["passes"])

    def test_a_change_does_not_wait_for_the_end_of_a_pass(self):
        with Viewed(PROGRAM, SCENE, "-D", "resolution=1536", "--photons", "4000") as view:
            view.wait(lambda state: state["passes"] >= 1, 60)  # seconds where others use the machine, too
            view.get("frame")  # somebody looks on
            before = view.wait(lambda state: state["passes"] >= 2)
            self.assertEqual(view.post("edit", bdd=1)[0], 200)
            passes = before["passes"]
            while (state := view.state())["render"] == before["render"]:
                passes = max(passes, state["passes"])
            self.assertEqual(passes, before["passes"], "the pass that had begun is given up")
            self.assertEqual(view.state()["problem"], "")

    def test_a_watched_render_writes_the_same_image(self):
        options = [*SMALL, "--passes", "40", "-o", "out.exr"]
        with Viewed(PROGRAM, SCENE, *options, "--view", command="render") as view:
            self.assertEqual(view.post("edit", bdd=2)[0], 403, "only `view` can be changed")
            header, moment = {"moment": 0}, []
            while header:
                header, _ = view.frame(after=header["moment"]) if view.process.poll() is None else (None, None)
                moment.append(header and header["passes"])
                if header and header["passes"] >= 30:
                    break
            view.process.wait(20)
            watched = pixels_of((view.folder / "out.exr").read_bytes())
        self.assertGreater(len(moment), 1)
        with Viewed(PROGRAM, SCENE, *options, "--view", command="render") as view:
            view.process.wait(20)
            numpy.testing.assert_array_equal(pixels_of((view.folder / "out.exr").read_bytes()), watched)

    def test_who_sends_a_byte_now_and_then_keeps_no_image(self):
        options = [*SMALL, "--passes", "40", "-o", "out.exr"]
        with Viewed(PROGRAM, SCENE, *options, "--view", command="render") as view:
            with socket.create_connection((view.host, view.port), 5) as drip:
                drip.sendall(b"GET /")
                end = time.monotonic() + 40
                while view.process.poll() is None and time.monotonic() < end:
                    try:
                        drip.sendall(b"a")
                    except OSError:  # the connection is dropped
                        break
                    time.sleep(0.3)
                view.process.wait(20)
            self.assertEqual(view.process.returncode, 0)
            self.assertTrue((view.folder / "out.exr").exists())

    def test_a_change_ends_no_search_for_good(self):
        with Viewed(PROGRAM, SCENE, *SMALL, "--auto", "--time", "6") as view:
            view.wait(lambda state: state["phase"] == "pilot passes", 60)
            self.assertEqual(view.post("edit", lamps=[2])[0], 200)
            # It is searched once more.
            view.wait(lambda state: state["render"] > 0 and state["phase"] == "pilot passes", 60)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
