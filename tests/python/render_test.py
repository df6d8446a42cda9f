#!/usr/bin/env python3
"""The Python package against the program: the same bits; and as Python code is used to: exceptions, Ctrl-C, threads, memory.
render_test.py PROGRAM SOURCE_FOLDER [FAILING_OPENCL]. Renders have a seed, so that figures are the same on every run."""

import ctypes
import gc
import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
import traceback
import unittest
import warnings
from pathlib import Path

import numpy

import quasilux as ql
from scenes import GRID, cornell_phong, layers_of, lit_floor

PROGRAM, SOURCE = sys.argv[1:3]
FAILING_OPENCL = sys.argv[3] if len(sys.argv) > 3 else None  # tests/shims/failing_opencl.cpp
CORNELL = SOURCE + "/scenes/cornell_phong.xml"
SIZE = 48
CHOICE = {"photons": 4000, "seed": 7}  # of renders that are compared with each other
OF_PROGRAM = ["--photons", "4000", "--seed", "7", "--quiet"]


def program(*arguments):
    return subprocess.run([PROGRAM, *arguments], check=True, capture_output=True, text=True).stdout


def cornell():
    return ql.load(CORNELL, parameters={"resolution": SIZE})


def same_bits(a, b):
    return a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes()


def without_times(record):
    """What does not differ from run to run."""
    record["sceneReport"]["learned"].pop("seconds")
    record["sceneReport"]["forecast"].pop("hostPeakBytes")  # of the process
    record["auto"] = {key: value for key, value in record["auto"].items() if not key.endswith("Seconds")}
    return {key: value for key, value in record.items() if key not in ("kernels", "phases", "peakHostBytes", "gatheredPhotons")}


class AgainstTheProgram(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.picture = ql.render(cornell(), passes=5, **CHOICE)
        program("render", CORNELL, "-D", f"resolution={SIZE}", "--passes", "5", *OF_PROGRAM, "-o", str(cls.folder / "program.exr"),
                "--png", str(cls.folder / "program.png"), "--stats", str(cls.folder / "program.json"))
        cls.layers = layers_of(cls.folder / "program.exr")

    def test_same_bits(self):
        for channel, letter in enumerate("RGB"):
            self.assertTrue(same_bits(self.layers[letter], numpy.ascontiguousarray(self.picture.image[:, :, channel])), letter)
            for name, layer in self.picture.layers.items():
                self.assertTrue(same_bits(self.layers[f"{name}.{letter}"], numpy.ascontiguousarray(layer[:, :, channel])), name)
        self.assertEqual(len(self.layers), 3 + 3 * len(self.picture.layers), "every layer of the file is there")
        self.assertIn("direct", self.picture.components)
        self.assertIs(self.picture.stderr, self.picture.layers["stderr"])
        self.assertIs(self.picture.bias, self.picture.layers["bias"])

    def test_another_seed_gives_other_bits(self):
        other = ql.render(cornell(), passes=5, photons=4000, seed=8)
        self.assertFalse(same_bits(self.picture.image, other.image), "control")

    def test_the_scene_as_a_dict_gives_the_same_bits(self):
        picture = ql.render(ql.load(cornell_phong(SIZE)), passes=5, **CHOICE)
        self.assertTrue(same_bits(self.picture.image, picture.image))
        turned = cornell_phong(SIZE)
        turned["tall"]["to_world"] = turned["tall"]["to_world"] @ ql.rotate((0, 1, 0), 1)
        self.assertFalse(same_bits(self.picture.image, ql.render(ql.load(turned), passes=5, **CHOICE).image), "control")

    def test_a_gltf_file_gives_the_same_bits(self):
        scene = SOURCE + "/tests/data/lit_floor.gltf"
        picture = ql.render(ql.load(scene), passes=2, **CHOICE)
        program("render", scene, "--passes", "2", *OF_PROGRAM, "-o", str(self.folder / "floor.exr"))
        for channel, letter in enumerate("RGB"):
            self.assertTrue(same_bits(layers_of(self.folder / "floor.exr")[letter], numpy.ascontiguousarray(picture.image[:, :, channel])))
        self.assertGreater(picture.image.mean(), 0)

    def test_same_record(self):
        written = json.loads((self.folder / "program.json").read_text())
        self.assertEqual(without_times(dict(self.picture.record)), without_times(written))

    def test_same_files(self):
        for name in ("python.exr", "python.png", "python.json", "PYTHON.EXR"):
            self.picture.save(self.folder / name)
        saved = layers_of(self.folder / "python.exr")
        self.assertEqual(sorted(saved), sorted(self.layers))
        self.assertTrue(all(same_bits(saved[name], self.layers[name]) for name in saved))
        self.assertEqual(json.loads((self.folder / "python.json").read_text()), json.loads(self.picture._core.record()))
        self.assertEqual(self.picture._repr_png_()[:4], b"\x89PNG")
        for wrong in ("picture", "picture.jpg", "picture.csv", "no/such/folder/picture.exr"):
            with self.assertRaises(ql.InputError):
                self.picture.save(self.folder / wrong)

    def test_comparison(self):
        path = str(self.folder / "python.exr")
        self.picture.save(path)
        other = ql.render(cornell(), passes=5, photons=4000, seed=8)
        other.save(self.folder / "other.exr")
        said = json.loads(program("compare", path, str(self.folder / "other.exr"), "--json", "--quiet"))
        for image, reference in ((self.picture, other), (path, other), (Path(path), self.folder / "other.exr")):
            self.assertEqual(ql.compare(image, reference)["regions"], said["regions"])
        plain = ql.compare(self.picture.image, other.image)["regions"][0]
        self.assertEqual(plain["relMSE"], said["regions"][0]["relMSE"])
        self.assertIsNone(plain["referenceNoise"], "arrays have no standard error")
        self.assertEqual(ql.compare(other, other)["regions"][0]["relMSE"], 0)
        for wrong in (numpy.zeros((4, 4)), numpy.zeros((SIZE, SIZE, 3), int), numpy.zeros(3), "missing.exr"):
            with self.assertRaises(ql.InputError):
                ql.compare(self.picture, wrong)

    def test_devices(self):
        self.assertEqual(ql.devices(), json.loads(program("devices", "--json")))


class Memory(unittest.TestCase):
    def test_arrays_are_those_of_the_render_and_outlive_it(self):
        picture = ql.render(cornell(), passes=2, **CHOICE)
        core = picture._core
        self.assertTrue(numpy.shares_memory(core.image, core.image), "no copies")
        self.assertTrue(numpy.shares_memory(core.layers["direct"], core.components["direct"]))
        self.assertEqual(picture.image.dtype, numpy.float32)
        self.assertEqual(picture.image.shape, (SIZE, SIZE, 3))
        with self.assertRaises(ValueError):
            picture.image[0, 0, 0] = 1
        kept, bits = picture.image, picture.image.tobytes()
        address = kept.__array_interface__["data"][0]
        del picture, core
        gc.collect()
        ql.render(cornell(), passes=1, **CHOICE)  # would take the memory if it were free
        self.assertEqual(ctypes.string_at(address, kept.nbytes), bits)

    def test_components_add_up(self):
        picture = ql.render(cornell(), passes=2, **CHOICE)
        total = sum(picture.components.values())
        numpy.testing.assert_allclose(total, picture.image, rtol=1e-5, atol=1e-6)


class Meters(unittest.TestCase):
    def test_grid(self):
        scene = ql.load(lit_floor(8, quasilux=GRID))
        reading = ql.meter(scene, passes=4, **CHOICE)
        self.assertEqual(reading.value.shape, (3, 4))
        numpy.testing.assert_allclose(reading.points[0, 0], (-0.75, 0.1, 1 - 1 / 3))
        # A point of intensity 30 W/sr at a height of 2.9: E = I cos / r^2, and 683 lm/W.
        away = numpy.array([0, 3, 0]) - reading.points
        distance = numpy.linalg.norm(away, axis=2)
        direct = 683 * 30 * away[:, :, 1] / distance**3
        numpy.testing.assert_allclose(reading.value, direct, rtol=0.02)
        self.assertAlmostEqual(reading.summary["illuminance"], reading.value.mean(), delta=1e-6 * reading.value.mean())
        self.assertIn("U0", reading.summary["grid"])
        with tempfile.TemporaryDirectory() as folder:
            reading.save(folder + "/grid.csv")
            rows = [line for line in Path(folder, "grid.csv").read_text().splitlines() if not line.startswith("#")]
        self.assertEqual(len(rows), 1 + 12)
        self.assertAlmostEqual(float(rows[1].split(",")[8]), reading.value[0, 0], delta=1e-6 * reading.value[0, 0])

    def test_meter_on_a_shape_and_daylight(self):
        sensor = {"type": "irradiancemeter", "film": {"type": "hdrfilm", "width": 1, "height": 1, "rfilter": {"type": "box"}}}
        plate = {"type": "rectangle", "sensor": sensor}
        scene = {"type": "scene", "sky": {"type": "quasilux_cie_sky"}, "plate": plate}
        reading = ql.meter(ql.load(scene), passes=4, daylight_factor=True, **CHOICE)
        self.assertIsNone(reading.points)
        self.assertAlmostEqual(reading.summary["daylightFactor"], 100, delta=5)
        with self.assertRaisesRegex(ql.InputError, "nothing to measure"):
            ql.meter(ql.load(lit_floor(8)))


class Behaviour(unittest.TestCase):
    def test_options(self):
        scene = cornell()
        for options, said in (({"bdd": -1}, "bdd"), ({"variant": "best"}, "variant"), ({"time": 0}, "time"),
                              ({"quasi_specular": "sphere", "passes": 1}, "sphere"), ({"auto": True, "fixed": True}, "fixed"),
                              ({"camera_paths": 0}, "camera_paths")):
            with self.assertRaisesRegex(ql.InputError, said, msg=str(options)):
                ql.render(scene, **options)
        with self.assertRaisesRegex(TypeError, "seeed"):
            ql.render(scene, seeed=3)
        self.assertEqual(ql.render(scene, passes=(3, 5), **CHOICE).passes, 2)
        self.assertNotIn("bias", ql.render(scene, passes=1, without=["components", "bias"], **CHOICE).layers)

    def test_callback(self):
        seen = []

        def watch(progress):
            seen.append((progress.passes, progress.seconds, progress.error, progress.phase))
            return progress.passes < 6

        picture = ql.render(cornell(), passes=1000, fixed=True, callback=watch, **CHOICE)
        self.assertEqual([passes for passes, *_ in seen], [1, 2, 3, 4, 5, 6])
        self.assertEqual(picture.passes, 6)
        self.assertTrue(picture.interrupted)
        self.assertIsNone(seen[0][2], "no error is known after a pass")
        self.assertTrue(all(0 < a[1] < b[1] for a, b in zip(seen, seen[1:])))
        self.assertEqual({phase for *_, phase in seen}, {"rendering"})

    def test_exceptions_of_the_callback_come_out(self):
        def fail(progress):
            raise LookupError("nothing there")

        try:
            ql.render(cornell(), passes=1000, fixed=True, callback=fail, **CHOICE)
            self.fail("no exception")
        except LookupError as error:
            self.assertIn("fail", [frame.name for frame in traceback.extract_tb(error.__traceback__)])

    def test_other_threads_go_on(self):
        turns, stop = [0], threading.Event()

        def count():
            while not stop.is_set():
                turns[0] += 1
                time.sleep(0.001)

        thread = threading.Thread(target=count)
        thread.start()
        before = turns[0]
        start = time.monotonic()
        ql.render(cornell(), time=0.5, fixed=True, **CHOICE)
        seconds = time.monotonic() - start
        rate = (turns[0] - before) / seconds
        stop.set()
        thread.join()
        self.assertGreater(rate, 20, "turns per second while a render goes on; none at all if it held the lock")

    def test_two_renders_at_once(self):
        alone = ql.render(cornell(), passes=4, **CHOICE)
        pictures = [None, None]

        def render(index):
            pictures[index] = ql.render(cornell(), passes=4, **CHOICE)

        threads = [threading.Thread(target=render, args=(index,)) for index in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertTrue(all(same_bits(alone.image, picture.image) for picture in pictures))

    def test_control_c(self):
        handler = signal.getsignal(signal.SIGINT)

        def press(progress):
            if progress.passes == 3:
                os.kill(os.getpid(), signal.SIGINT)

        with self.assertRaises(ql.Interrupted) as caught:
            ql.render(cornell(), time=600, fixed=True, callback=press, **CHOICE)
        self.assertIsInstance(caught.exception, KeyboardInterrupt)
        self.assertIn(caught.exception.result.passes, (3, 4))
        self.assertTrue(caught.exception.result.interrupted)
        self.assertIs(signal.getsignal(signal.SIGINT), handler)
        timer = threading.Timer(1, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            ql.render(cornell(), time=600, fixed=True, **CHOICE)  # without a callback
        with self.assertRaises(KeyboardInterrupt, msg="Python's own handler is in place"):
            os.kill(os.getpid(), signal.SIGINT)
            time.sleep(1)

    def test_control_c_while_it_prepares(self):
        timer = threading.Timer(0.02, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            ql.render(cornell(), time=600, fixed=True, bdd=3, **CHOICE)

    def test_control_c_while_the_device_is_opened(self):
        """In a process that has not opened one yet: the runtime must not get hold of the signal."""
        ask = f"ql.render(ql.load({CORNELL!r}), time=600, fixed=True)"
        for delay, what in ((0.0, ask), (0.03, ask), (0.06, ask), (0.1, ask), (0.2, ask), (0.0, "ql.devices(); os.kill(os.getpid(), 2); time.sleep(1)")):
            code = "\n".join([
                "import os, threading, time",
                "import quasilux as ql",
                "try:",
                f"    threading.Timer({delay}, os.kill, (os.getpid(), 2)).start()" if what is ask else "",
                f"    {what}",
                "except KeyboardInterrupt:",
                "    print('caught')",
            ])
            done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stdout), (0, "caught\n"), (delay, done.stderr))

    @unittest.skipUnless(FAILING_OPENCL, "the library of failing calls is not built")
    def test_device_that_fails(self):
        """From a certain launch on, after some passes, or at once."""
        code = "\n".join([
            "import quasilux as ql",
            "try:",
            f"    ql.render(ql.load({CORNELL!r}, parameters={{'resolution': 32}}), passes=100000, fixed=True, photons=4000)",
            "except ql.DeviceError as error:",
            "    print(error, '|', getattr(error, 'result', None))",
        ])
        for at, found in (("40", "<quasilux.Render 32 x 32, "), ("2", "None")):
            # Both for all: Python loads modules, and what they need, each for itself.
            environment = {**os.environ, "LD_PRELOAD": FAILING_OPENCL + " libOpenCL.so.1", "QUASILUX_FAIL_CALL": "clEnqueueNDRangeKernel",
                           "QUASILUX_FAIL_KERNEL": "tracePhotons", "QUASILUX_FAIL_AT": at}
            done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=environment)
            self.assertIn("tracePhotons", done.stdout, done.stderr)
            self.assertIn(found, done.stdout.split("|")[1], done.stderr)

    def test_warnings(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            scene = ql.load(lit_floor(8, extra={"type": "diffuse"}))
        self.assertEqual([warning.category for warning in caught], [ql.SceneWarning])
        self.assertIn("bsdf 'extra' is used by no shape", str(caught[0].message))
        self.assertEqual(caught[0].filename, __file__)
        self.assertEqual(scene.warnings, [str(caught[0].message)])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
