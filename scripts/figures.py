"""What the scripts that draw figures share: rendering by a method and time, tone mapping, the line on the machine."""
import argparse
import json
import os
import pathlib
import subprocess

import numpy as np

from relmse import read_channels

ROOT = pathlib.Path(__file__).resolve().parent.parent
FIGURES = ROOT / "docs" / "figures"


def argument_parser(description, seconds):
    """Of a figure whose pictures take that many seconds each."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("seconds", nargs="?", type=float, default=seconds, help=f"rendering time of each picture (default {seconds})")
    parser.add_argument("--program", default=str(ROOT / "build" / "release" / "quasilux"), help="the built program")
    return parser


class Renders:
    """Renders one scene by several methods (name: options) into out/NAME/."""

    def __init__(self, program, name, scene, methods):
        self.program, self.scene, self.methods = program, ROOT / "scenes" / scene, methods
        self.folder = ROOT / "out" / name
        self.folder.mkdir(parents=True, exist_ok=True)

    def warm_up(self):
        """Compiles the kernels of every method, so that no picture pays for it: the OpenCL runtime keeps them."""
        for options in self.methods.values():
            command = [self.program, "render", self.scene, "--quiet", "--passes", "1", *options]
            subprocess.run([*command, "--output", self.folder / "warm-up.exr"], check=True)

    def render(self, method, seconds):
        """The image and its statistics."""
        stem = method.replace(", ", "_").replace(" ", "-") + f"_{seconds:g}s"
        image, statistics = self.folder / f"{stem}.exr", self.folder / f"{stem}.json"
        command = [self.program, "render", self.scene, "--quiet", "--fixed", "--time", f"{seconds:g}", *self.methods[method]]
        subprocess.run([*command, "--output", image, "--stats", statistics], check=True)
        return read_channels(image, ["R", "G", "B"]), json.loads(statistics.read_text())


def tone_map(radiance, exposure):
    """sRGB in 0 .. 1: radiance scaled and clamped, then the curve of IEC 61966-2-1."""
    x = np.clip(exposure * radiance, 0, 1)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)


def measured_on(statistics, seconds, load):
    """Machine of a render that took `seconds`; `load`: os.getloadavg() before."""
    device = f"{statistics['device']['name']}, {statistics['device']['computeUnits']} compute units"
    return f"{seconds:g} s each on {device}; load average {load[0]:.1f} before, {os.getloadavg()[0]:.1f} after"
