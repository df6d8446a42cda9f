"""Holds tests/data/mitsuba_plugins.txt against Mitsuba: does it know each plugin and each parameter? Run it by the Python that
scripts/mitsuba.sh makes: build/mitsuba/bin/python3 scripts/mitsuba_plugins.py. Exit code 1 where a name is unknown to Mitsuba, or a plugin
of Mitsuba is missing in the list."""
import os
import pathlib
import re
import shutil
import struct
import sys
import tempfile

import mitsuba

DATA = pathlib.Path(__file__).resolve().parent.parent / "tests" / "data"
UNKNOWN = re.compile(r'unreferenced|Plugin "[^"]*" not found')
NOT_IN_SCENES = {"blender"}  # a plugin of Mitsuba for other programs, not for scene files


def write_files(folder):
    """What the list names, but for those that no program here can write."""
    for name in ("quads.obj", "tetrahedron.ply"):
        shutil.copy(DATA / name, folder)
    (folder / "checker.ppm").write_bytes(b"P6\n2 2\n255\n" + bytes(range(12)))
    (folder / "curve.txt").write_text("0 0 0 0.1\n0 0 1 0.1\n0 0 2 0.1\n0 1 3 0.1\n")
    (folder / "grid.vol").write_bytes(b"VOL\3" + struct.pack("<5i6f8f", 1, 2, 2, 2, 1, 0, 0, 0, 1, 1, 1, *[0.5] * 8))


def plugins(text):
    for line in text.splitlines():
        if line.startswith("@"):
            plugin = {"kind": line.split()[1], "name": line.split()[2], "needed": "", "parameters": []}
            yield plugin
        elif line.startswith("="):
            plugin["needed"] = line[2:]
        elif line and not line.startswith("#"):
            at = line.index("<")
            plugin["parameters"].append((line[:at - 1], line[at:]))


def complaint(plugin, given):
    """What Mitsuba says where it does not know a name; other errors, such as of files, are none of this."""
    xml = f'<{plugin["kind"]} type="{plugin["name"]}" version="3.0.0">{plugin["needed"]}{given}</{plugin["kind"]}>'
    try:
        mitsuba.load_string(xml)
    except Exception as error:  # noqa: BLE001 (Mitsuba raises all kinds)
        text = re.sub(r"\s+", " ", str(error))
        return text if UNKNOWN.search(text) else None
    return None


def main():
    mitsuba.set_variant("llvm_ad_rgb")  # has the plugins in Python too
    mitsuba.set_log_level(mitsuba.LogLevel.Error)
    folder = pathlib.Path(tempfile.mkdtemp())
    write_files(folder)
    os.chdir(folder)
    listed = list(plugins((DATA / "mitsuba_plugins.txt").read_text()))
    faults = 0
    for plugin in listed:
        for name, given in [("", "")] + plugin["parameters"]:
            if said := complaint(plugin, given):
                faults += 1
                print(f'{plugin["kind"]} {plugin["name"]} {name}: {said[:300]}')
    libraries = (pathlib.Path(mitsuba.__file__).parent / "plugins").glob("*.so")
    missing = {file.stem for file in libraries} - {plugin["name"] for plugin in listed} - NOT_IN_SCENES
    if missing:
        faults += 1
        print("not in the list:", ", ".join(sorted(missing)))
    shutil.rmtree(folder)
    print(f"{len(listed)} plugins, {sum(len(p['parameters']) for p in listed)} parameters, {faults} faults")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
