#!/usr/bin/python3
"""Error of an image of a scene in scenes/ against its reference, by region of the scene.

    scripts/relmse.py IMAGE.exr [SCENE, cornell_phong (default) or plate_checker]

relMSE is the mean over pixels and channels of (I - R)^2 / (R^2 + 0.01 mean(R)^2), on linear RGB; no pixel is dropped.
The reference is noisy too and its noise adds to the relMSE of any image, so it is subtracted ("net"). Of the plate, whose
reference has 9 % of noise a pixel, "net" is divided by the mean R of the eight neighbours: R itself in the denominator
would add 6 times the square of the reference's own relMSE (docs/method/accuracy.md). "mean" is the signed relative difference of
the region's mean luminance: what is left of it when noise is averaged away is bias.
The scripts that draw figures import this; `quasilux compare` measures the same of any two images, with standard errors.
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

# Camera and plate of scenes/plate_checker.xml, mm and degrees.
PLATE_EYE, PLATE_TARGET, PLATE_FIELD = np.array([0.0, -180.0, 183.0]), np.array([0.0, 0.0, 3.0]), 35.0
PLATE_INSIDE = 55.0  # half the side of its top, 5 mm inside its border


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


def by_block(pixels, side):
    """Means over whole blocks of side x side pixels, by channel."""
    height, width = (size - size % side for size in pixels.shape[:2])
    return pixels[:height, :width].reshape(height // side, side, width // side, side, -1).mean(axis=(1, 3))


def read_regions():
    """Number of the region of each pixel."""
    file = oiio.ImageInput.open(str(REFERENCES / "regions.png"))
    if not file:
        sys.exit(f"{REFERENCES / 'regions.png'}: {oiio.geterror()}")
    spec = file.spec()
    gray = np.asarray(file.read_image("uint8")).reshape(spec.height, spec.width, spec.nchannels)[..., 0]
    return np.rint(gray / REGION_STEP).astype(int)


def relmse_weight(pixels, scale=None):
    """What squared differences from the reference `pixels` are multiplied with; `scale` stands for it in the denominators."""
    return 1 / ((pixels if scale is None else scale) ** 2 + 0.01 * pixels.mean() ** 2)


def mean_about(pixels, with_centre=True):
    """Mean of the 3 x 3 pixels about each one, of fewer at the border. Without the centre it knows nothing of the pixel's own noise,
    where the filter was a box."""
    padded = np.pad(np.dstack([pixels, np.ones(pixels.shape[:2])]), ((1, 1), (1, 1), (0, 0)))
    windows = [(v, u) for v in range(3) for u in range(3) if with_centre or (v, u) != (1, 1)]
    sums = sum(padded[v : v + pixels.shape[0], u : u + pixels.shape[1]] for v, u in windows)
    return sums[..., :-1] / sums[..., -1:]


class Reference:
    """The converged image, its regions, and of each pixel the weight of squared differences in `net` and the share of the reference's
    own noise in it."""

    def __init__(self, pixels, masks, noise, weight=None):
        self.pixels, self.masks, self.noise = pixels, masks, noise
        self.weight = relmse_weight(pixels) if weight is None else weight

    def errors(self, image):
        """Error by region name of an image of the reference's size."""
        if image.shape != self.pixels.shape:
            sys.exit(f"the image has {image.shape[1]}x{image.shape[0]} pixels, expected {self.pixels.shape[1]}x{self.pixels.shape[0]}")
        squares = (image - self.pixels) ** 2
        relmse_of, net_of = ((squares * weight).mean(axis=2) for weight in (relmse_weight(self.pixels), self.weight))
        result = {}
        for name, mask in self.masks.items():
            relmse, net = relmse_of[mask].mean(), net_of[mask].mean() - self.noise[mask].mean()
            mean = (image @ LUMINANCE)[mask].mean() / (self.pixels @ LUMINANCE)[mask].mean() - 1
            result[name] = Error(relmse, net, mean)
        return result


def box_noise(ids):
    """Known for the whole image and for the boxes; what is outside the boxes has the rest."""
    own = json.loads((REFERENCES / "cornell_phong_reference.json").read_text())["own_relMSE"]
    boxes = np.isin(ids, BOXES)
    rest = (own["all"] - own["boxes"] * boxes.mean()) / (1 - boxes.mean())
    return np.where(boxes, own["boxes"], rest)


def box_reference():
    """Of scenes/cornell_phong.xml."""
    ids = read_regions()
    masks = {"all": np.ones(ids.shape, bool), "walls": np.isin(ids, WALLS), "boxes": np.isin(ids, BOXES)}
    masks |= {name: ids == number for name, number in SURFACES.items()}
    return Reference(read_channels(REFERENCES / "cornell_phong_reference.exr", ["R", "G", "B"]), masks, box_noise(ids))


def plate_mask(height, width):
    """Pixels whose centre sees the top of the plate, away from its border."""
    forward = (PLATE_TARGET - PLATE_EYE) / np.linalg.norm(PLATE_TARGET - PLATE_EYE)
    right = np.cross(forward, [0, 0, 1])
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    half = np.tan(np.deg2rad(PLATE_FIELD / 2))  # of the image's width at distance 1
    row, column = np.mgrid[0:height, 0:width]
    x = ((column + 0.5) / width * 2 - 1) * half
    y = (1 - (row + 0.5) / height * 2) * half * height / width
    ray = forward + x[..., None] * right + y[..., None] * up
    seen = PLATE_EYE + ray * ((PLATE_TARGET[2] - PLATE_EYE[2]) / ray[..., 2])[..., None]
    return (abs(seen[..., 0]) < PLATE_INSIDE) & (abs(seen[..., 1]) < PLATE_INSIDE)


def plate_reference():
    """Of scenes/plate_checker.xml, which is grey."""
    pixels = np.repeat(read_channels(REFERENCES / "plate_checker_reference.exr", ["Y"]), 3, axis=2)
    stderr = np.repeat(read_channels(REFERENCES / "plate_checker_reference_stderr.exr", ["Y"]), 3, axis=2)
    masks = {"all": np.ones(pixels.shape[:2], bool), "plate": plate_mask(*pixels.shape[:2])}
    weight = relmse_weight(pixels, mean_about(pixels, with_centre=False))
    return Reference(pixels, masks, (stderr**2 * weight).mean(axis=2), weight)


REFERENCE_OF = {"cornell_phong": box_reference, "plate_checker": plate_reference}


def main():
    arguments = sys.argv[1:]
    scene = arguments[1] if len(arguments) == 2 else "cornell_phong"
    if len(arguments) not in (1, 2) or arguments[0].startswith("-") or scene not in REFERENCE_OF:
        sys.exit(__doc__)
    image = read_channels(arguments[0], ["R", "G", "B"])
    print(f"samples that are not finite: {int((~np.isfinite(image)).sum())}")
    for name, error in REFERENCE_OF[scene]().errors(image).items():
        print(f"{name:10s} relMSE {error.relmse:.3e}  net {error.net:.3e}  mean {100 * error.mean:+.2f} %")


if __name__ == "__main__":
    main()
