"""A headless Chromium that opens a page, driven by the DevTools protocol over two pipes."""

import base64
import contextlib
import io
import itertools
import json
import os
import shutil
import subprocess
import time
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

PROGRAM = shutil.which("chromium") or shutil.which("chromium-browser")
_OPTIONS = (
    "--headless=new", "--no-sandbox", "--disable-gpu-sandbox", "--remote-debugging-pipe",
    "--use-angle=swiftshader", "--use-gl=angle", "--enable-unsafe-swiftshader",
    "--no-first-run", "--disable-extensions", "--hide-scrollbars", "--disable-dev-shm-usage",
    "--host-resolver-rules=MAP * ~NOTFOUND",  # no network: what asks for it fails
)  # fmt: skip


_LEFT = "navigated or closed"


class _LeftError(Exception):
    """The page that was asked is being left for another."""


class Chromium:
    """A browser with one page.

    Attributes
    ----------
    console : list of str
        Errors and warnings of the page so far, exceptions among them.
    requests : list of str
        Addresses other than those of the page's own data that it asked for.
    """

    def __init__(self, profile: Path, width: int = 1280, height: int = 900) -> None:
        assert PROGRAM is not None
        to_child, ours = os.pipe()
        theirs, from_child = os.pipe()
        self.ours, self.theirs = ours, theirs
        options = [*_OPTIONS, f"--user-data-dir={profile}", f"--window-size={width},{height}"]

        def pipes() -> None:
            a, b = os.dup(to_child), os.dup(from_child)
            os.dup2(a, 3)
            os.dup2(b, 4)

        self.process = subprocess.Popen(
            [PROGRAM, *options, "about:blank"], preexec_fn=pipes, close_fds=False,
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        os.close(to_child)
        os.close(from_child)
        self.numbers = itertools.count(1)
        self.rest = b""
        self.console: list[str] = []
        self.requests: list[str] = []
        self.session: str | None = None
        found = self.ask("Target.getTargets")["targetInfos"]
        page = next(t for t in found if t["type"] == "page")
        attached = self.ask("Target.attachToTarget", targetId=page["targetId"], flatten=True)
        self.session = attached["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.ask(f"{domain}.enable")

    def ask(self, method: str, **parameters: Any) -> Any:
        """One command and its answer; events on the way are taken down."""
        number = next(self.numbers)
        said: dict[str, Any] = {"id": number, "method": method, "params": parameters}
        if self.session is not None:
            said["sessionId"] = self.session
        os.write(self.ours, json.dumps(said).encode() + b"\0")
        while True:
            found = self._message()
            if found.get("id") == number:
                if _LEFT in str(found.get("error")):
                    raise _LeftError(found)
                assert "error" not in found, found
                return found["result"]
            self._event(found)

    def open(self, page: Path, width: int = 1280, height: int = 900, dark: bool = False) -> None:
        """Open a file in a window of that size."""
        self.ask(
            "Emulation.setDeviceMetricsOverride",
            width=width, height=height, deviceScaleFactor=1, mobile=width < 600,
        )  # fmt: skip
        shown = [{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}]
        self.ask("Emulation.setEmulatedMedia", features=shown)
        self.ask("Page.navigate", url=page.as_uri())
        self.until("document.readyState === 'complete'")

    def run(self, script: str) -> Any:
        """The value of an expression, a promise's when it is kept."""
        found = self.ask(
            "Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True
        )
        assert "exceptionDetails" not in found, found["exceptionDetails"]
        return found["result"].get("value")

    def until(self, script: str, seconds: float = 60.0) -> None:
        """Wait for an expression to hold, on the page that a link leads to as well."""
        end, held = time.monotonic() + seconds, False
        while not held:
            assert time.monotonic() < end, (script, self.console)
            with contextlib.suppress(_LeftError):
                held = bool(self.run(script))
            time.sleep(0.0 if held else 0.05)

    def picture(self, selector: str = "", whole: bool = False) -> npt.NDArray[np.uint8]:
        """Pixels (rows, columns, 3) of the window, of an element, or of the whole page."""
        from PIL import Image

        return np.asarray(Image.open(io.BytesIO(self.png(selector, whole))).convert("RGB"))

    def png(self, selector: str = "", whole: bool = False) -> bytes:
        """The same as a file."""
        more: dict[str, Any] = {}
        if whole:
            more = {"captureBeyondViewport": True}
            size = self.ask("Page.getLayoutMetrics")["cssContentSize"]
            more["clip"] = {**size, "scale": 1}
        if selector:
            box = self.run(
                f"(() => {{ const e = document.querySelector({selector!r}); e.scrollIntoView();"
                " const b = e.getBoundingClientRect(); return {x: b.x + scrollX, y: b.y + scrollY,"
                " width: b.width, height: b.height, scale: 1}; })()"
            )
            more = {"clip": box}
        return base64.b64decode(self.ask("Page.captureScreenshot", format="png", **more)["data"])

    def close(self) -> None:
        """End it."""
        with contextlib.suppress(OSError):
            self.session = None
            os.write(self.ours, b'{"id": 0, "method": "Browser.close"}\0')
        try:
            self.process.wait(10)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        os.close(self.ours)
        os.close(self.theirs)

    def _message(self) -> dict[str, Any]:
        while b"\0" not in self.rest:
            piece = os.read(self.theirs, 1 << 20)
            assert piece, "the browser has ended"
            self.rest += piece
        first, _, self.rest = self.rest.partition(b"\0")
        found: dict[str, Any] = json.loads(first)
        return found

    def _event(self, found: dict[str, Any]) -> None:
        method, told = found.get("method"), found.get("params", {})
        if method == "Runtime.exceptionThrown":
            details = told["exceptionDetails"]
            self.console.append(str(details.get("exception", details).get("description", details)))
        elif method == "Runtime.consoleAPICalled" and told["type"] in (
            "error",
            "warning",
            "assert",
        ):
            self.console.append(" ".join(str(a.get("value")) for a in told["args"]))
        elif method == "Log.entryAdded" and told["entry"]["level"] in ("error", "warning"):
            self.console.append(told["entry"]["text"])
        elif method == "Network.requestWillBeSent":
            address = told["request"]["url"]
            if not address.startswith(("data:", "blob:", "file:")):
                self.requests.append(address)
