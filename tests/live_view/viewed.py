"""A program that serves its live view, for the tests: started in a folder of its own, asked by HTTP."""

import http.client
import json
import re
import shutil
import subprocess
import tempfile
import time
from pathlib import Path
from urllib.parse import urlencode, urlsplit

import numpy

PATIENCE = 20  # seconds


class Viewed:
    """`command`: view or render. The scene is a copy, such as scene.xml, in `folder`."""

    def __init__(self, program, scene, *options, command="view"):
        self.temporary = tempfile.TemporaryDirectory(prefix="quasilux-view-")
        self.folder = Path(self.temporary.name)
        self.scene = self.folder / ("scene" + Path(scene).suffix)
        shutil.copy(scene, self.scene)
        arguments = [program, command, self.scene.name, "--no-browser", *options]
        self.process = subprocess.Popen(arguments, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        stream = self.process.stdout if command == "view" else self.process.stderr
        self.address = re.search(r"http://\S+", stream.readline()).group(0)
        parts = urlsplit(self.address)
        self.host, self.port, self.token = parts.hostname, parts.port, parts.path.strip("/")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.send_signal(2)
        self.process.communicate(timeout=PATIENCE)
        self.temporary.cleanup()

    def ask(self, path, body=None, headers=None, method=None):
        """Status, headers and body of the answer."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE)
        method = method or ("GET" if body is None else "POST")
        connection.request(method, path, body, headers or {})
        answer = connection.getresponse()
        content = answer.read()
        connection.close()
        return answer.status, answer.headers, content

    def get(self, name, **parameters):
        return self.ask(f"/{self.token}/{name}?{urlencode(parameters)}")

    def state(self, seen=0):
        return json.loads(self.get("state", seen=seen)[2])

    def wait(self, condition, seconds=PATIENCE):
        """The first state of which `condition` is true."""
        end, seen = time.monotonic() + seconds, 0
        while time.monotonic() < end:
            state = self.state(seen)
            if condition(state):
                return state
            seen = state["version"]
        raise AssertionError(f"did not come about; last state: {state}")

    def frame(self, **wish):
        """The header, and the values as an array of rows, columns and channels; (None, None) where there is nothing new."""
        status, headers, body = self.get("frame", **wish)
        if status == 204:
            return None, None
        assert status == 200, body
        header = json.loads(headers["X-Frame"])
        halves = numpy.frombuffer(body, numpy.float16).astype(numpy.float64)
        return header, halves.reshape(header["height"], header["width"], header["channels"]) / header["scale"]

    def post(self, name, **values):
        status, _, body = self.ask(f"/{self.token}/{name}", json.dumps(values), {"Content-Type": "application/json"})
        return status, json.loads(body)

    def edit(self, **edits):
        """Sends changes; the render that has them, when it is done."""
        before = self.state()["render"]
        status, answer = self.post("edit", **edits)
        assert status == 200, answer
        return self.wait(lambda state: state["render"] > before and state["phase"] == "done")

    def break_scene(self):
        """Saves a scene with an unknown plugin; the line of it, and the text of before."""
        good = self.scene.read_text()
        place = good.index('<shape type="') + len('<shape type="')
        self.scene.write_text(good[:place] + "no" + good[place:])
        return 1 + good[:place].count("\n"), good
