#!/usr/bin/python3
"""Error of an image of scenes/cornell_phong.xml against its reference, by region of the scene.

    scripts/relmse.py IMAGE.exr

relMSE is the mean over pixels and channels of (I - R)^2 / (R^2 + 0.01 mean(R)^2), on linear RGB; no pixel is dropped.
The reference is noisy too and its noise adds to the relMSE of any image, so it is subtracted ("net"). "mean" is the
signed relative difference of the region's mean luminance: what is left of it when noise is averaged away is bias.
Needs Debian's python3-numpy and python3-openimageio.
"""
import json
import pathlib
import sys
from dataclasses import dataclass

import numpy as np
import OpenImageIO as oiio

REFERENCES = pathlib.Path(__file__).resolve().parent.parent / "scenes" / "references"
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])  # ITU-R BT.709
REGION_STEP = 30  # regions.png holds 30 * region
SURFACES = {"floor": 1, "ceiling": 2, "back": 3, "left": 4, "right": 5, "short box": 6, "tall box": 7}
SEEN_THROUGH_LIGHT = 8  # ceiling seen through the light
WALLS = [1, 2, 3, 4, 5, SEEN_THROUGH_LIGHT]
BOXES = [6, 7]


@dataclass
class Error:
    """relMSE of a region, the same net of the reference's noise, and the relative difference of mean luminance."""

    relmse: float
    net: float
    mean: float


def read_channels(path, names):
    """Pixels as (height, width, len(names)) doubles; ends the program where a file or a channel is missing."""
    file = oiio.ImageInput.open(str(path))
    if not file:
        sys.exit(f"{path}: {oiio.geterror()}")
    spec = file.spec()
    missing = [name for name in names if name not in spec.channelnames]
    if missing:
        sys.exit(f"{path}: no channel {', '.join(missing)} among {', '.join(spec.channelnames)}")
    pixels = np.asarray(file.read_image("float"), np.float64).reshape(spec.height, spec.width, spec.nchannels)
    return pixels[..., [spec.channelnames.index(name) for name in names]]


def read_regions():
    """Number of the region of each pixel."""
    file = oiio.ImageInput.open(str(REFERENCES / "regions.png"))
    if not file:
        sys.exit(f"{REFERENCES / 'regions.png'}: {oiio.geterror()}")
    spec = file.spec()
    gray = np.asarray(file.read_image("uint8")).reshape(spec.height, spec.width, spec.nchannels)[..., 0]
    return np.rint(gray / REGION_STEP).astype(int)


class Reference:
    """The converged image, its regions and the share of its own noise in the relMSE of each region."""

    def __init__(self):
        self.pixels = read_channels(REFERENCES / "cornell_phong_reference.exr", ["R", "G", "B"])
        self.weight = 1 / (self.pixels**2 + 0.01 * self.pixels.mean() ** 2)
        ids = read_regions()
        self.masks = {"all": np.ones(ids.shape, bool), "walls": np.isin(ids, WALLS), "boxes": np.isin(ids, BOXES)}
        self.masks |= {name: ids == number for name, number in SURFACES.items()}
        self.noise = self._own_noise(ids)

    def _own_noise(self, ids):
        """Known for the whole image and for the boxes; what is outside the boxes has the rest."""
        own = json.loads((REFERENCES / "cornell_phong_reference.json").read_text())["own_relMSE"]
        boxes = np.isin(ids, BOXES)
        rest = (own["all"] - own["boxes"] * boxes.mean()) / (1 - boxes.mean())
        return np.where(boxes, own["boxes"], rest)

    def errors(self, image):
        """Error by region name of an image of the reference's size."""
        if image.shape != self.pixels.shape:
            sys.exit(f"the image has {image.shape[1]}x{image.shape[0]} pixels, expected {self.pixels.shape[1]}x{self.pixels.shape[0]}")
        squares = ((image - self.pixels) ** 2 * self.weight).mean(axis=2)
        result = {}
        for name, mask in self.masks.items():
            relmse = squares[mask].mean()
            mean = (image @ LUMINANCE)[mask].mean() / (self.pixels @ LUMINANCE)[mask].mean() - 1
            result[name] = Error(relmse, relmse - self.noise[mask].mean(), mean)
        return result


def main():
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    image = read_channels(sys.argv[1], ["R", "G", "B"])
    print(f"samples that are not finite: {int((~np.isfinite(image)).sum())}")
    for name, error in Reference().errors(image).items():
        print(f"{name:10s} relMSE {error.relmse:.3e}  net {error.net:.3e}  mean {100 * error.mean:+.2f} %")


if __name__ == "__main__":
    main()
