#!/usr/bin/env python3
"""What `cmake --install` puts somewhere: a program that runs there, and libraries that another project finds and uses.
package_test.py BUILD_FOLDER SOURCE_FOLDER CMAKE COMPILER"""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

BUILD, SOURCE, CMAKE, COMPILER = sys.argv[1:5]


def run(*command, **more):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **more)
    assert done.returncode == 0, f"{command}: {done.stdout}{done.stderr}"
    return done.stdout


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix="quasilux-install-")
        cls.addClassCleanup(cls.temporary.cleanup)
        cls.root = Path(cls.temporary.name)
        cls.prefix = cls.root / "prefix"
        run(CMAKE, "--install", BUILD, "--prefix", cls.prefix)

    def test_program_runs_where_it_is(self):
        self.assertRegex(run(self.prefix / "bin/quasilux", "--version"), r"^quasilux \d+\.\d+\.\d+\n$")
        for name in ["man/man1/quasilux-render.1", "bash-completion/completions/quasilux", "zsh/site-functions/_quasilux",
                     "fish/vendor_completions.d/quasilux.fish"]:
            self.assertTrue((self.prefix / "share" / name).is_file(), name)

    def test_nothing_refers_to_the_source_or_build_folder(self):
        names = [Path(SOURCE).resolve().as_posix().encode(), Path(BUILD).resolve().as_posix().encode()]
        files = [self.prefix / "bin/quasilux", *self.prefix.rglob("*.cmake"), *self.prefix.rglob("*.h")]
        self.assertGreater(len(files), 100)
        for file in files:
            content = file.read_bytes()
            for name in names:
                self.assertNotIn(name, content, file)
        self.assertIn(names[1], (Path(BUILD) / "CMakeCache.txt").read_bytes(), "control")

    def test_another_project_renders_with_the_libraries(self):
        environment = {**os.environ, "CMAKE_PREFIX_PATH": str(self.prefix)}
        consumer = self.root / "consumer"
        run(CMAKE, "-S", Path(SOURCE) / "tests/package", "-B", consumer, "-G", "Ninja", f"-DCMAKE_CXX_COMPILER={COMPILER}",
            env=environment)
        run(CMAKE, "--build", consumer)
        mean = float(run(consumer / "consumer", Path(SOURCE) / "scenes/furnace_sky.xml"))
        self.assertAlmostEqual(mean, 1, delta=0.05)  # a white furnace


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
