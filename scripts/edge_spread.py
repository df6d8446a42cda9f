#!/usr/bin/python3
"""How far a turbid plate spreads an edge of black and white paper (scenes/edge_45.xml): 10-90 % and 25-75 %, in mm.

    scripts/edge_spread.py [SECONDS, default 30] [--seeds N] [-- OPTIONS of quasilux render]

The edge runs up the image, so all rows show the same profile and are averaged. What is left is the noise of photons that
enter the plate, as strong over millimetres as from pixel to pixel. It is the same in a render with black and white
swapped and the same seed, so each seed takes two renders A and B with as many passes, and

    (A - B) / (A + B)

is odd about the edge, with a tenth of the noise. Its two halves are folded into one and smoothed by least squares of

    D(x) = height (1 - exp(-(x / length)^shape)),

which is monotone and holds an exponential (shape 1) and almost a Gaussian edge. The sum dips at the edge, since white
paper lights itself; its fit, S(x) = far (1 + dip exp(-(x / length)^shape)), gives the profile back: S (1 +- D) / 2. The
spread is read off that. All is fitted to the mean over seeds; the standard error is a jackknife over them. As a check
that assumes no form of D, the same with the monotone regression of the folded profile, whose plateau is its mean beyond
14 mm. On made-up edges of five forms both read the spread within 2 %.

Expected 10-90 %: 9.54 mm, 25-75 %: 4.17 mm (independent Monte Carlo simulation, +- 0.05 mm).
"""
import json
import re
import subprocess
import sys

import numpy as np

from figures import ROOT, argument_parser
from relmse import read_channels

SCENE = ROOT / "scenes" / "edge_45.xml"
FOLDER = ROOT / "out" / "edge_spread"
REFLECTANCE = re.compile(r'(<rgb name="reflectance" value=")([^"]*)(")')
HALF_WIDTH = 20.0  # mm from the edge to the border of the image
EXPECTED = {"10-90 %": (0.1, 9.54), "25-75 %": (0.25, 4.17)}  # share of the step where the spread begins; mm
TOLERANCE = 0.05
PLATEAU_FROM = 14.0  # mm from the edge: what is left of the step there is below 1 %
ITERATIONS = 200


def write_swapped_scene():
    """The scene with black and white paper swapped; its path."""
    text = SCENE.read_text()
    values = [match[1] for match in REFLECTANCE.findall(text)]
    if len(values) != 2:
        sys.exit(f"{SCENE} has {len(values)} reflectances, expected two")
    swapped = FOLDER / "edge_45_swapped.xml"
    swapped.write_text(REFLECTANCE.sub(lambda match: match[1] + values.pop() + match[3], text))
    return swapped


def render(options, scene, seed, stop):
    """Mean radiance of the columns, and the number of passes."""
    image, statistics = FOLDER / f"{scene.stem}_{seed}.exr", FOLDER / f"{scene.stem}_{seed}.json"
    command = [options.program, "render", scene, "--quiet", *stop, *options.render_options, "--seed", str(seed)]
    subprocess.run([*command, "--output", image, "--stats", statistics], check=True)
    return read_channels(image, ["R", "G", "B"]).mean(axis=(0, 2)), json.loads(statistics.read_text())["counters"]["passes"]


def render_pair(options, swapped, seed):
    """Profiles of the scene and of the swapped one, as rows of an array, and the number of passes of each."""
    profile, passes = render(options, SCENE, seed, ["--fixed", "--time", f"{options.seconds:g}"])
    return np.array([profile, render(options, swapped, seed, ["--passes", str(passes)])[0]]), passes


def folded_step(pair):
    """Distance from the edge (mm); relative step, odd, and sum, even, there."""
    total = pair.sum(axis=0)
    step = (pair[0] - pair[1]) / total
    half = step.size // 2
    folded = (step[half:] - step[:half][::-1]) / 2
    return (np.arange(half) + 0.5) / half * HALF_WIDTH, folded * np.sign(folded.sum()), (total[half:] + total[:half][::-1]) / 2


def fit_curve(x, step):
    """Height, length and shape, by Levenberg-Marquardt; begins with an exponential of the plate's thickness."""
    parameters = np.array([step[x > PLATEAU_FROM].mean(), np.log(3.0), 0.0])  # height, logarithms of the others

    def curve(p):
        return p[0] * (1 - np.exp(-((x / np.exp(p[1])) ** np.exp(p[2]))))

    damping, residual, nudge = 1e-3, step - curve(parameters), 1e-5
    for _ in range(ITERATIONS):
        slopes = np.array([(curve(parameters + e) - curve(parameters - e)) / (2 * nudge) for e in nudge * np.eye(3)])
        normal = slopes @ slopes.T
        change = np.linalg.solve(normal + damping * np.diag(np.diag(normal) + 1e-12), slopes @ residual)
        trial = parameters + np.clip(change, -0.5, 0.5)
        trial[1:] = np.clip(trial[1:], np.log([0.3, 0.4]), np.log([12, 3]))
        left = step - curve(trial)
        better = left @ left < residual @ residual
        damping = damping / 3 if better else min(4 * damping, 1e9)
        if better:
            parameters, residual = trial, left
    return parameters[0], np.exp(parameters[1]), np.exp(parameters[2])


def rising(values):
    """Monotone regression: pools neighbours that fall (Ayer et al. 1955)."""
    pools = []  # mean, count
    for value in values:
        pools.append((value, 1))
        while len(pools) > 1 and pools[-2][0] > pools[-1][0]:
            (a, m), (b, n) = pools[-2:]
            pools[-2:] = [((m * a + n * b) / (m + n), m + n)]
    return np.repeat([mean for mean, _ in pools], [count for _, count in pools])


def spread_of(x, step, total):
    """Between the places where the profile total (1 +- step) / 2, the last of `x` being far away, passes each share."""
    profile = np.concatenate([(total * (1 - step))[::-1], total * (1 + step)]) / 2
    share = (profile - profile[0]) / (profile[-1] - profile[0])
    place = np.concatenate([-x[::-1], x])
    return [np.interp(1 - begin, share, place) - np.interp(begin, share, place) for begin, _ in EXPECTED.values()]


def measure(pairs):
    """Of the mean of some pairs: spreads by the curve, then by regression, as in EXPECTED; dip of the sum at the edge."""
    x, step, total = folded_step(np.mean(pairs, axis=0))
    height, length, shape = fit_curve(x, step)

    def rest(distance):
        return np.exp(-((distance / length) ** shape))

    far, dip = np.linalg.lstsq(np.array([np.ones_like(x), rest(x)]).T, total, rcond=None)[0]
    fine = np.linspace(0, 10 * HALF_WIDTH, 20001)
    by_curve = spread_of(fine, height * (1 - rest(fine)), far + dip * rest(fine))
    plateau = step[x > PLATEAU_FROM].mean()
    regression = np.minimum(rising(np.concatenate([[0], step])), plateau)  # ends at the plateau
    by_regression = spread_of(fine, np.interp(fine, np.concatenate([[0], x]), regression, right=plateau) + 1e-9 * fine, far + dip * rest(fine))
    return np.array([*by_curve, *by_regression, dip / far])


def with_jackknife(pairs):
    """What `measure` says of all pairs, and its standard error."""
    without = np.array([measure(pairs[:k] + pairs[k + 1 :]) for k in range(len(pairs))])
    return measure(pairs), without.std(axis=0) * np.sqrt(len(pairs) - 1)


def main():
    own, rest = sys.argv[1:], []
    if "--" in own:
        own, rest = own[: own.index("--")], own[own.index("--") + 1 :]
    parser = argument_parser(__doc__.splitlines()[0], 30)
    parser.add_argument("--seeds", type=int, default=4, help="independent pairs of renders, at least 2 (default 4)")
    options = parser.parse_args(own)
    options.render_options = rest
    if options.seeds < 2:
        parser.error("--seeds: a standard error needs at least 2")
    FOLDER.mkdir(parents=True, exist_ok=True)
    swapped = write_swapped_scene()
    runs = [render_pair(options, swapped, seed) for seed in range(1, options.seeds + 1)]
    values, errors = with_jackknife([pair for pair, _ in runs])

    print(f"{options.seeds} pairs, passes {', '.join(str(passes) for _, passes in runs)}; options: {' '.join(rest) or 'those of the scene'}")
    count = len(EXPECTED)
    for k, (name, (_, expected)) in enumerate(EXPECTED.items()):
        print(
            f"{name}: {values[k]:.2f} +- {errors[k]:.2f} mm, expected {expected} ({100 * (values[k] / expected - 1):+.1f} %);"
            f" by monotone regression {values[count + k]:.2f} +- {errors[count + k]:.2f} mm"
        )
    print(f"sum of both at the edge: {100 * values[-1]:+.1f} +- {100 * errors[-1]:.1f} % of that far from it")
    expected = EXPECTED["10-90 %"][1]
    if errors[0] > TOLERANCE / 2 * expected:
        print("the error is too large to decide: more seconds, seeds or photons are needed")
    else:
        print(f"10-90 % is within {100 * TOLERANCE:g} %: {'yes' if abs(values[0] - expected) <= TOLERANCE * expected else 'no'}")


if __name__ == "__main__":
    main()
