"""Headless Chromium for tests, controlled through its debugging pipe: no port, no package.

    with Browser() as page:
        page.open("file:///tmp/run.html")
        page.evaluate("1 + 1")
"""
import base64
import contextlib
import json
import os
import pathlib
import select
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from waiting import TIMEOUT

PROGRAMS = ("chromium", "chromium-browser", "google-chrome", "chrome")
CODES = {" ": 32, "Tab": 9, "Enter": 13, "Escape": 27, "PageUp": 33, "PageDown": 34, "End": 35,
         "Home": 36, "ArrowLeft": 37, "ArrowUp": 38, "ArrowRight": 39, "ArrowDown": 40}
TEXTS = {"Enter": "\r"}
SHIFT = 8
NO_BROWSER = "no Chromium: scripts/setup --lab"
OWN_WORDS = "GPU stall due to ReadPixels"  # message of software rendering


def find_browser():
    """Path, or None."""
    return next((path for path in map(shutil.which, PROGRAMS) if path), None)


def folder_for_pictures():
    """Removes the second argument of a test and creates the folder; None: no argument."""
    if len(sys.argv) < 3 or sys.argv[2].startswith("-") or "." in sys.argv[2]:
        return None
    folder = pathlib.Path(sys.argv.pop(2))
    folder.mkdir(parents=True, exist_ok=True)
    return folder


class Browser:
    def __init__(self, width=1280, height=720, timeout=TIMEOUT, dark=False, scale=1):
        self.timeout = timeout
        self.scale = scale  # device pixel ratio: pixels cost time in software rendering
        self.errors = []  # console messages and exceptions
        self.requests = []  # besides the page itself
        self.waiting = b""
        self.events = []
        self.number = 0
        self.folder = tempfile.mkdtemp(prefix="twinarm-browser-")
        to_browser, ours = os.pipe()
        theirs, from_browser = os.pipe()
        # A file for all streams: an unread pipe would block.
        command = [find_browser(), "--headless=new", "--no-sandbox", "--disable-dev-shm-usage",
                   "--no-first-run", "--disable-extensions", "--disable-background-networking",
                   "--enable-unsafe-swiftshader",  # software rendering of WebGL
                   "--hide-scrollbars", f"--window-size={width},{height}",
                   f"--user-data-dir={self.folder}", "--remote-debugging-pipe", "about:blank"]

        def take_pipes():  # the browser reads 3 and writes 4
            os.setsid()
            a, b = os.dup(to_browser), os.dup(from_browser)
            os.dup2(a, 3)
            os.dup2(b, 4)
            os.set_inheritable(3, True)
            os.set_inheritable(4, True)

        self.process = subprocess.Popen(command, preexec_fn=take_pipes, close_fds=False,
                                        env=dict(os.environ, TMPDIR=self.folder),  # it leaves files there
                                        stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                        stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        self.pipe_in, self.pipe_out = theirs, ours
        self.session = None
        target = self.call("Target.createTarget", url="about:blank")
        attached = self.call("Target.attachToTarget", targetId=target["targetId"], flatten=True)
        self.session = attached["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")
        self.resize(width, height)
        self.prefer(dark)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()
        os.close(self.pipe_in)
        os.close(self.pipe_out)
        shutil.rmtree(self.folder, ignore_errors=True)

    def send(self, method, **values):
        self.number += 1
        message = {"id": self.number, "method": method, "params": values}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.pipe_out, json.dumps(message).encode() + b"\0")
        return self.number

    def receive(self, deadline):
        while b"\0" not in self.waiting:
            left = deadline - time.monotonic()
            if left <= 0 or not select.select([self.pipe_in], [], [], left)[0]:
                raise TimeoutError("the browser does not answer")
            got = os.read(self.pipe_in, 1 << 20)
            if not got:
                raise EOFError("the browser ended")
            self.waiting += got
        message, _, self.waiting = self.waiting.partition(b"\0")
        message = json.loads(message)
        self.note(message)
        return message

    def note(self, message):
        method, values = message.get("method"), message.get("params", {})
        if method == "Runtime.exceptionThrown":
            self.errors.append(json.dumps(values["exceptionDetails"])[:800])
        elif method == "Runtime.consoleAPICalled" and values["type"] in ("error", "warning", "assert"):
            self.errors.append(json.dumps(values["args"])[:800])
        elif (method == "Log.entryAdded" and values["entry"]["level"] in ("error", "warning")
              and OWN_WORDS not in values["entry"]["text"]):
            self.errors.append(values["entry"]["text"])
        elif method == "Network.requestWillBeSent":
            self.requests.append(values["request"]["url"][:200])

    def call(self, method, **values):
        number = self.send(method, **values)
        deadline = time.monotonic() + self.timeout
        while True:
            message = self.receive(deadline)
            if message.get("id") != number:
                continue
            if "error" in message:
                raise RuntimeError(f"{method}: {message['error']}")
            return message["result"]

    def resize(self, width, height, mobile=False):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height,
                  deviceScaleFactor=self.scale, mobile=mobile)

    def prefer(self, dark):
        self.call("Emulation.setEmulatedMedia", features=[
            {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])

    def evaluate(self, expression):
        result = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            raise RuntimeError(json.dumps(result["exceptionDetails"])[:800])
        return result["result"].get("value")

    def heap(self):
        """JavaScript heap after garbage collection, in bytes."""
        self.call("HeapProfiler.collectGarbage")
        return self.call("Runtime.getHeapUsage")["usedSize"]

    def wait_for(self, expression):
        deadline = time.monotonic() + self.timeout
        while not self.evaluate(expression):
            if time.monotonic() > deadline:
                raise TimeoutError(f"never true: {expression}; the console says {self.errors}")
            time.sleep(0.02)

    def open(self, url):
        """Opens an address and waits until the page is ready and has drawn."""
        self.call("Page.navigate", url="about:blank")
        self.requests.clear()
        self.errors.clear()
        self.call("Page.navigate", url=url)
        self.wait_for("document.documentElement?.dataset.ready === 'true'")
        self.frames(2)

    def frames(self, count):
        """Waits for a number of frames."""
        self.evaluate("new Promise(done => { let n = %d; const next = () => n-- > 0 ? "
                      "requestAnimationFrame(next) : done(true); next(); })" % count)

    def press(self, key, shift=False):
        code = "Space" if key == " " else key if len(key) > 1 else ""
        named = {"key": key, "code": code, "modifiers": SHIFT if shift else 0,
                 "windowsVirtualKeyCode": CODES.get(key, ord(key[0].upper()))}
        if text := TEXTS.get(key, key if len(key) == 1 else None):
            named["text"] = text
        self.call("Input.dispatchKeyEvent", type="keyDown", **named)
        self.call("Input.dispatchKeyEvent", type="keyUp", key=key, code=code)
        self.frames(2)

    def touch(self, kind, points, at=None):
        """touchStart, touchMove, touchEnd with all fingers on the screen; `at`: time stamp [s]."""
        self.call("Input.dispatchTouchEvent", type=kind, **({"timestamp": at} if at else {}),
                  touchPoints=[{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(points)])

    def drag(self, start, end, button="left"):
        def mouse(kind, at):
            self.call("Input.dispatchMouseEvent", type=kind, x=at[0], y=at[1], button=button, buttons=1, clickCount=1)
        mouse("mouseMoved", start)
        mouse("mousePressed", start)
        mouse("mouseMoved", [(a + b) / 2 for a, b in zip(start, end)])
        mouse("mouseMoved", end)
        mouse("mouseReleased", end)
        self.frames(2)

    def drop(self, name, text):
        """Drops a file on the page."""
        self.evaluate("""((name, text) => { const data = new DataTransfer();
            data.items.add(new File([text], name));
            for (const kind of ['dragenter', 'dragover', 'drop']) document.body.dispatchEvent(
                new DragEvent(kind, {bubbles: true, cancelable: true, dataTransfer: data}));
            })(%s, %s)""" % (json.dumps(name), json.dumps(text)))

    def colors(self, points):
        """(red, green, blue) at each (x, y) of a screenshot."""
        shot = self.call("Page.captureScreenshot", format="png")["data"]
        return self.evaluate("""(async () => {
            const image = new Image();
            image.src = 'data:image/png;base64,' + %s;
            await image.decode();
            const canvas = document.createElement('canvas');
            canvas.width = image.width;
            canvas.height = image.height;
            const context = canvas.getContext('2d');
            context.drawImage(image, 0, 0);
            return %s.map(([x, y]) => [...context.getImageData(x, y, 1, 1).data].slice(0, 3));
        })()""" % (json.dumps(shot), json.dumps(points)))

    def picture(self, file):
        shot = self.call("Page.captureScreenshot", format="png")
        with open(file, "wb") as out:
            out.write(base64.b64decode(shot["data"]))
