"""What colours Mitsuba 3 makes of spectra, as tests/spectrum_test.cpp has them: python3 scripts/spectrum_values.py, with the Python of scripts/mitsuba.sh.

Lists by wavelength in its RGB mode. That refuses `blackbody` when it renders; a black body's radiance is taken from its spectral mode:
the mean over a sensor's wavelengths, which is what a pixel shows.
"""
import mitsuba as mi
import numpy as np

LISTS = {"falling": ([400, 500, 600, 700], [0.78, 0.3, 0.9, 0.1]), "narrow": ([540, 550, 560], [0, 1, 0]),
         "bright": ([400, 700], [1.5, 2.5]), "all": ([300, 900], [0.25, 0.25])}


def lists():
    mi.set_variant("scalar_rgb")
    for name, (wavelengths, values) in LISTS.items():
        row = {use: [float(c) for c in mi.spectrum_list_to_srgb(wavelengths, values, bounded, d65)]
               for use, bounded, d65 in (("reflectance", True, True), ("unbounded", False, True), ("emission", False, False))}
        print(name, row)


def black_bodies():
    mi.set_variant("scalar_spectral")
    steps = np.linspace(360, 830, 200001)
    for kelvin in (2856, 6500):
        texture = mi.load_dict({"type": "blackbody", "temperature": kelvin})
        si = mi.SurfaceInteraction3f()
        xyz = np.zeros(3)
        for chunk in steps[:200000:4].reshape(-1, 4):
            si.wavelengths = chunk
            for wavelength, value in zip(chunk, np.array(texture.eval(si)).ravel()):
                xyz += np.array(mi.cie1931_xyz(float(wavelength))).ravel() * value
        xyz *= 470 / len(steps[:200000:4]) * mi.MI_CIE_Y_NORMALIZATION
        print(f"blackbody {kelvin} K", [float(c) for c in np.array(mi.xyz_to_srgb([float(c) for c in xyz])).ravel()])


if __name__ == "__main__":
    lists()
    black_bodies()
