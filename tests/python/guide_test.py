#!/usr/bin/env python3
"""The Python code of the documents runs: blocks of docs/guide/python.md and cells of the notebook, in their order.
guide_test.py PROGRAM SOURCE_FOLDER."""

import contextlib
import io
import json
import os
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(sys.argv[2])


def blocks_of(markdown):
    pieces = markdown.split("\n```python\n")[1:]
    return [piece.split("\n```")[0] for piece in pieces]


def run(blocks):
    """In a folder with the scenes; what they print."""
    names, said = {"__name__": "guide"}, io.StringIO()
    before = os.getcwd()
    with tempfile.TemporaryDirectory() as folder:
        os.symlink(SOURCE / "scenes", Path(folder) / "scenes")
        os.mkdir(Path(folder) / "out")
        os.chdir(folder)
        try:
            with contextlib.redirect_stdout(said):
                for number, block in enumerate(blocks, 1):
                    exec(compile(block, f"block {number}", "exec"), names)
        finally:
            os.chdir(before)
    return said.getvalue()


class Documents(unittest.TestCase):
    def test_guide(self):
        blocks = blocks_of((SOURCE / "docs/guide/python.md").read_text())
        self.assertGreater(len(blocks), 7)
        said = run(blocks)
        self.assertIn("<quasilux.Render 64 x 64, 8 passes", said)
        self.assertIn("scene.ball.radius: parameter 'radius' of shape 'sphere' is -1; it must be greater than 0.", said)

    def test_notebook(self):
        notebook = json.loads((SOURCE / "docs/guide/first-notebook.ipynb").read_text())
        self.assertEqual(notebook["nbformat"], 4)
        cells = ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
        self.assertGreater(len(cells), 3)
        run(cells)

    def test_a_wrong_block_is_noticed(self):
        with self.assertRaises(NameError):
            run(["nothing_like_that"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
