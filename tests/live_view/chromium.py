"""Drives Debian's Chromium by its remote debugging protocol: just enough to open a page, run scripts in it and look at it."""

import base64
import json
import os
import subprocess
import tempfile
import time

import websocket

FLAGS = ["--headless=new", "--no-first-run", "--disable-gpu", "--disable-extensions", "--disable-background-networking",
         "--disable-component-update", "--disable-sync", "--mute-audio", "--remote-debugging-port=0", "--remote-allow-origins=*"]

CHOOSE = """(() => {{ const element = document.getElementById('{name}'); element.value = '{value}';
    for (const kind of ['input', 'change']) element.dispatchEvent(new Event(kind)); return true; }})()"""


class Chromium:
    """One page of a browser without a window."""

    def __init__(self, width=1200, height=800):
        self.folder = tempfile.TemporaryDirectory(prefix="quasilux-chromium-", ignore_cleanup_errors=True)
        flags = FLAGS + ["--user-data-dir=" + self.folder.name, f"--window-size={width},{height}"]
        if os.geteuid() == 0:
            flags.append("--no-sandbox")  # its sandbox refuses root
        self.process = subprocess.Popen(["chromium", *flags, "about:blank"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.number = 0
        self.socket = websocket.create_connection(self._debugger(), timeout=20)
        targets = self.call("Target.getTargets")["targetInfos"]
        page = next(target for target in targets if target["type"] == "page")
        self.session = self.call("Target.attachToTarget", targetId=page["targetId"], flatten=True)["sessionId"]
        self.call("Page.enable")
        self.problems = []  # exceptions and errors on the page's console
        self.call("Runtime.enable")

    def _debugger(self):
        port_file = os.path.join(self.folder.name, "DevToolsActivePort")
        end = time.monotonic() + 20
        while time.monotonic() < end:
            if os.path.exists(port_file):
                with open(port_file, encoding="ascii") as file:
                    lines = file.read().split("\n")
                if len(lines) >= 2 and lines[1]:
                    return f"ws://127.0.0.1:{lines[0]}{lines[1]}"
            time.sleep(0.05)
        raise RuntimeError("chromium did not start")

    def close(self):
        try:
            self.call("Browser.close")
        except (RuntimeError, OSError, websocket.WebSocketException):
            self.process.terminate()
        self.socket.close()
        self.process.wait(20)
        self.folder.cleanup()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def call(self, method, **parameters):
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if hasattr(self, "session"):
            message["sessionId"] = self.session
        self.socket.send(json.dumps(message))
        while True:
            answer = json.loads(self.socket.recv())
            if answer.get("method") == "Runtime.exceptionThrown":
                self.problems.append(answer["params"]["exceptionDetails"])
            if answer.get("id") == self.number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']['message']}")
                return answer["result"]

    def open(self, address):
        self.call("Page.navigate", url=address)
        self.wait("document.readyState === 'complete'")

    def run(self, script):
        """The value of an expression in the page; promises are waited for."""
        result = self.call("Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in result:
            raise RuntimeError(f"{script}: {result['exceptionDetails']}")
        return result["result"].get("value")

    def wait(self, condition, seconds=10):
        """Until an expression is true; what it is then."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            value = self.run(condition)
            if value:
                return value
            time.sleep(0.05)
        raise RuntimeError(f"after {seconds} s not true: {condition}")

    def choose(self, name, value):
        """As a person would, so that the page hears of it."""
        self.run(CHOOSE.format(name=name, value=value))

    def screenshot(self, path):
        data = self.call("Page.captureScreenshot", format="png")["data"]
        with open(path, "wb") as file:
            file.write(base64.b64decode(data))

    def resize(self, width, height, mobile=False):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=mobile)

    def mouse(self, kind, x, y, buttons=0):
        button = "left" if kind != "mouseMoved" else "none"
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button=button, buttons=buttons, clickCount=1)

    def key(self, key):
        """A key that is typed."""
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=key)
