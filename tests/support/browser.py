"""A headless Chromium, if the machine has one, driven through its debugging pipe."""

import base64
import json
import os
import select
import shutil
import subprocess
import tempfile
from contextlib import contextmanager
from itertools import count
from pathlib import Path

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
OPTIONS = [
    *("--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"),
    *("--disable-background-networking", "--disable-component-update", "--disable-sync"),
    *(
        "--disable-dev-shm-usage",
        "--remote-debugging-pipe",
        "--host-resolver-rules=MAP * ~NOTFOUND",
    ),
]


PATIENCE = 60  # s


class Tab:
    """A page: `run` evaluates a script in it.

    complaints: its messages on the console; asked_for: addresses that it loaded.
    """

    def __init__(self, to, back):
        self._to, self._back, self._ids, self._session = to, back, count(1), None
        self._text = b""
        self.complaints, self.asked_for, self._loaded = [], [], False
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        attached = self.call("Target.attachToTarget", targetId=target, flatten=True)
        self._session = attached["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")

    def call(self, method, **parameters):
        """The result of a command of the protocol; events are sorted in on the way."""
        number = next(self._ids)
        message = {"id": number, "method": method, "params": parameters}
        if self._session:
            message["sessionId"] = self._session
        self._to.write(json.dumps(message).encode() + b"\0")
        self._to.flush()
        while True:
            answer = self._read()
            if answer.get("id") == number:
                assert "error" not in answer, answer
                return answer["result"]

    def _read(self):
        """The next message of the browser, which it has `PATIENCE` seconds to send."""
        while b"\0" not in self._text:
            ready, _, _ = select.select([self._back], [], [], PATIENCE)
            more = os.read(self._back.fileno(), 1 << 16) if ready else b""
            assert more, "the browser ended, or does not answer"
            self._text += more
        text, _, self._text = self._text.partition(b"\0")
        message = json.loads(text)
        self._take(message.get("method"), message.get("params", {}))
        return message

    def _take(self, event, told):
        self._loaded = self._loaded or event == "Page.loadEventFired"
        if event == "Runtime.exceptionThrown":
            self.complaints.append(told["exceptionDetails"])
        if event == "Log.entryAdded":
            self.complaints.append(told["entry"])
        if event == "Runtime.consoleAPICalled":
            self.complaints.append(told["args"])
        if event == "Network.requestWillBeSent":
            self.asked_for.append(told["request"]["url"])

    def open(self, path, width=1280, height=900, dark=False):
        """Load a file, in a window of this size."""
        self.call(
            "Emulation.setDeviceMetricsOverride",
            width=width,
            height=height,
            deviceScaleFactor=1,
            mobile=width < 600,
        )
        scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        self.call("Emulation.setEmulatedMedia", features=[scheme])
        self.complaints, self.asked_for, self._loaded = [], [], False
        self.call("Page.navigate", url=Path(path).resolve().as_uri())
        while not self._loaded:
            self._read()

    def run(self, script):
        """The value of an expression in the page; for a promise, its result."""
        later = script.startswith("new Promise")  # waiting takes forever if scripts are disabled
        told = self.call(
            "Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=later
        )
        assert "exceptionDetails" not in told, told
        return told["result"].get("value")

    def picture(self, path, whole=True):
        """Write a PNG of the page."""
        data = self.call("Page.captureScreenshot", captureBeyondViewport=whole)["data"]
        Path(path).write_bytes(base64.b64decode(data))


@contextmanager
def browser():
    """A tab of a browser that ends with the block."""
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        words = [f"{folder}/{name}" for name in ("to", "back")]
        for word in words:
            os.mkfifo(word)
        options = [CHROMIUM, *OPTIONS, f"--user-data-dir={folder}/user"]
        command = ["sh", "-c", 'exec "$@" 3<"$TO" 4>"$BACK" 2>/dev/null', "sh", *options]
        environment = {**os.environ, "TO": words[0], "BACK": words[1]}
        process = subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL)
        try:
            with open(words[0], "wb") as to, open(words[1], "rb", buffering=0) as back:
                yield Tab(to, back)
        finally:
            process.terminate()
            process.wait(timeout=20)
