#!/usr/bin/python3
"""clang-tidy over the sources of a build folder (preset ci): scripts/static_analysis.py [FOLDER]. Exit code 0 if nothing is found.

Sources are analysed by the dozen, as the preset joins them (CMAKE_UNITY_BUILD): most of the time goes into the headers of libraries.
By the name of UnifiedSource clang's analyzer knows that the sources which such a file includes are no headers. Headers of host/ are
checked with them (.clang-tidy). GCC's own flags and precompiled headers are unknown to clang. The analyzer follows 20,000 states of a
function, not 225,000, which took four fifths of the time; and half of what is left goes into one check of parameters by value, which is
for editors and reviews.

Files that are clean are remembered in ~/.cache/quasilux/clang-tidy (XDG_CACHE_HOME), by a hash of all that clang reads of them, of the
checks and of the version: only what has changed is analysed again.
"""
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

ROOT = pathlib.Path(__file__).resolve().parent.parent
CACHE = pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache") / "quasilux" / "clang-tidy"
OPTIONS = ["--quiet", "--checks=-performance-unnecessary-value-param", "--extra-arg=-Wno-unknown-warning-option"] + [
    f"--extra-arg={word}" for word in ("-Xclang", "-analyzer-config", "-Xclang", "max-nodes=20000")]


def commands(build):
    """Entries of compile_commands.json that are analysed, as clang reads them."""
    for entry in json.loads((build / "compile_commands.json").read_text()):
        file = pathlib.Path(entry["file"])
        if "Unity" not in file.parts and ROOT / "host" not in file.parents:
            continue
        command = re.sub(r"-Winvalid-pch -include \S*/cmake_pch\.hxx ", "", entry["command"])
        if file.name.startswith("unity_"):
            unified = file.with_name(file.name.replace("unity_", "UnifiedSource_", 1))
            unified.write_text(file.read_text())
            command = command.replace(str(file), str(unified))
            file = unified
        yield {"directory": entry["directory"], "file": str(file), "command": command}


def key(entry, version):
    """Of everything that the result depends on; the project's own folder may lie anywhere."""
    words = shlex.split(entry["command"])
    output = words.index("-o")
    command = ["clang++", "-w", "-E", "-C", *words[1:output], entry["file"]]
    text = subprocess.run(command, cwd=entry["directory"], check=True, capture_output=True).stdout
    settings = "\0".join([version, (ROOT / ".clang-tidy").read_text(), *OPTIONS, *words[1:output]])
    return hashlib.sha256((settings.encode() + text).replace(str(ROOT).encode(), b".")).hexdigest()


def analyse(entry, folder, version):
    """What is found in one file."""
    known = CACHE / key(entry, version)
    if known.exists():
        known.touch()
        return ""
    found = subprocess.run(["clang-tidy", "-p", folder, *OPTIONS, entry["file"]], capture_output=True, text=True, check=False)
    if found.returncode == 0:
        known.touch()
        return ""
    return found.stdout + found.stderr


def main():
    build = (pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build" / "ci").resolve()
    entries = list(commands(build))
    if not entries:
        sys.exit(f"static_analysis.py: {build} has no sources to analyse; build with preset ci first")
    folder = build / "analysis"
    folder.mkdir(exist_ok=True)
    (folder / "compile_commands.json").write_text(json.dumps(entries))
    CACHE.mkdir(parents=True, exist_ok=True)
    version = subprocess.run(["clang-tidy", "--version"], capture_output=True, text=True, check=True).stdout
    with ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        found = [text for text in pool.map(lambda entry: analyse(entry, folder, version), entries) if text]
    print("\n".join(line for line in "\n".join(found).splitlines() if not re.search(r"warnings? generated", line)), end="\n" if found else "")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
