#!/usr/bin/env python3
"""What `cmake --install` puts somewhere: a program that runs there, and libraries that another project finds and uses. The Debian package, from what
is built already, and what `pip install .` takes of the source: as far as no compiler is needed (scripts/debian_package.sh and python_package.sh do all).
package_test.py BUILD_FOLDER SOURCE_FOLDER CMAKE COMPILER"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest
from pathlib import Path

BUILD, SOURCE, CMAKE, COMPILER = sys.argv[1:5]


def run(*command, **more):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **more)
    assert done.returncode == 0, f"{command}: {done.stdout}{done.stderr}"
    return done.stdout


def folder_of(case, what):
    """A temporary folder that is gone when the tests of the class `case` are over."""
    temporary = tempfile.TemporaryDirectory(prefix=f"quasilux-{what}-")
    case.addClassCleanup(temporary.cleanup)
    return Path(temporary.name)


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.root = folder_of(cls, "install")
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


class DebianPackage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.root = folder_of(cls, "package")
        run(Path(CMAKE).with_name("cpack"), "-G", "DEB", "--config", Path(BUILD) / "CPackConfig.cmake", "-B", cls.root / "made")
        cls.package, = (cls.root / "made").glob("quasilux_*.deb")
        run("dpkg-deb", "-x", cls.package, cls.root / "unpacked")
        cls.usr = cls.root / "unpacked/usr"

    def test_program_runs_where_it_is_unpacked(self):
        self.assertEqual(run(self.usr / "bin/quasilux", "--version"), run(Path(BUILD) / "quasilux", "--version"))
        run(self.usr / "bin/quasilux", "info", Path(SOURCE) / "scenes/furnace_sky.xml")

    def test_it_has_the_program_alone(self):
        files = {path.relative_to(self.usr).as_posix() for path in self.usr.rglob("*") if path.is_file()}
        wanted = {"bin/quasilux", "share/man/man1/quasilux-render.1", "share/bash-completion/completions/quasilux", "share/doc/quasilux/LICENSE"}
        self.assertLessEqual(wanted, files)
        self.assertFalse([name for name in files if name.startswith(("include/", "lib/"))])

    def test_it_says_what_it_needs(self):
        depends = run("dpkg-deb", "-f", self.package, "Depends")
        for library in ["libc6", "libembree3", "libopenimageio", "ocl-icd-libopencl1"]:
            self.assertIn(library, depends)
        self.assertIn("pocl-opencl-icd", run("dpkg-deb", "-f", self.package, "Recommends"))
        version = run("dpkg-deb", "-f", self.package, "Version").strip()
        self.assertIn(version, run(self.usr / "bin/quasilux", "--version"))


@unittest.skipUnless((Path(BUILD) / "python/quasilux/__init__.py").exists(), "this build has no Python package")
class PythonPackage(unittest.TestCase):
    """Of what pip is told by pyproject.toml."""

    @classmethod
    def setUpClass(cls):
        cls.told = tomllib.loads((Path(SOURCE) / "pyproject.toml").read_text())["tool"]["scikit-build"]
        cls.root = folder_of(cls, "source")

    def configure(self, left_out):
        """CMake as scikit-build-core calls it, on the source without these folders. Its build folder."""
        source, build = self.root / "source", self.root / "build"
        for folder in source, build:
            shutil.rmtree(folder, ignore_errors=True)
        ignored = {(Path(SOURCE) / name).resolve() for name in [*left_out, "build", ".git", "shared"]}
        shutil.copytree(SOURCE, source, symlinks=True, ignore=lambda folder, names: [name for name in names if (Path(folder) / name).resolve() in ignored])
        definitions = [f"-D{name}={value}" for name, value in self.told["cmake"]["define"].items()]
        run(CMAKE, "-S", source, "-B", build, "-G", "Ninja", f"-DCMAKE_CXX_COMPILER={COMPILER}", "-DCMAKE_BUILD_TYPE=Release", "-DSKBUILD=2",
            f"-DSKBUILD_SCRIPTS_DIR={self.root}/scripts", "-DPython_EXECUTABLE=/usr/bin/python3", *definitions)
        return build

    def test_source_distribution_configures(self):
        build = self.configure(self.told["sdist"]["exclude"])
        targets = {line.partition(":")[0] for line in run("ninja", "-C", build, "-t", "targets", "all").splitlines()}
        self.assertLessEqual(set(self.told["build"]["targets"]), targets)
        installed = (build / "cmake_install.cmake").read_text()
        self.assertRegex(installed, r"/quasilux/_core\.[^\"]*so")
        self.assertIn(f"{self.root}/scripts/quasilux", installed)
        with self.assertRaises(AssertionError):  # control
            self.configure([*self.told["sdist"]["exclude"], "cmake"])

    def test_version_is_the_programs(self):
        rule = self.told["metadata"]["version"]
        found = re.search(rule["regex"], (Path(SOURCE) / rule["input"]).read_text())
        self.assertEqual(run(Path(BUILD) / "quasilux", "--version").split(), ["quasilux", found["value"]])

    def test_all_modules_are_in_the_package(self):
        folder, = self.told["wheel"]["packages"]
        names = {path.name for path in (Path(SOURCE) / folder).iterdir() if path.is_file()}
        built = {path.name for path in (Path(BUILD) / "python/quasilux").iterdir() if path.is_file() and not path.name.startswith("_core.c")}
        self.assertEqual(names, built)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
