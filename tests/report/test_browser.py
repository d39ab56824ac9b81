"""The report in a real browser: scenes are drawn, sliders move them, curves zoom, nothing fails."""

from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest
from chromium import Chromium

READY = "document.getElementById('scene-view').dataset.ready === '1'"
WINDOW, PHONE = (480, 420), (390, 700)
Pixels = npt.NDArray[np.uint8]


@pytest.fixture(scope="module")
def page(browser: Chromium, rocking: Path) -> Chromium:
    """The report of the rocking tower, opened once."""
    browser.open(rocking / "report.html", *WINDOW)
    browser.until(READY)
    return browser


@pytest.fixture
def opened(page: Chromium) -> Iterator[Chromium]:
    """The same; what is done to it must find no fault and ask for nothing."""
    yield page
    page.run("0")  # what it has to say by now
    assert page.console == []
    assert page.requests == []


def drawn(pixels: Pixels) -> float:
    """Share of the pixels that differ from that of the corner."""
    inner = pixels[8:-8, 8:-8].astype(int)
    return float((np.abs(inner - inner[2, 2]).sum(axis=2) > 30).mean())


def changed(before: Pixels, after: Pixels) -> float:
    """Share of the pixels that differ."""
    assert before.shape == after.shape
    return float((np.abs(before.astype(int) - after).sum(axis=2) > 30).mean())


def slide(browser: Chromium, name: str, value: float) -> Pixels:
    """Put a slider somewhere, as a hand does; the scene after it."""
    browser.run(
        f"(() => {{ const s = document.getElementById('{name}'); s.value = {value};"
        " s.dispatchEvent(new Event('input')); })()"
    )
    return browser.picture("#scene-view")


def test_the_scene_is_drawn_turns_warps_and_moves(opened: Chromium) -> None:
    first = opened.picture("#scene-view")
    assert drawn(first) > 0.1
    plain = slide(opened, "scene-warp", 0)
    assert changed(first, plain) > 0.005
    assert opened.run("document.getElementById('scene-factor').textContent") == "× 0"
    warped = slide(opened, "scene-warp", 230)
    assert changed(plain, warped) > 0.01
    start = slide(opened, "scene-time", 0)
    later = slide(opened, "scene-time", 30)
    assert changed(start, later) > 0.01
    assert opened.run("document.getElementById('scene-now').textContent") != "0"
    opened.run("document.getElementById('scene-view').focus()")
    opened.ask("Input.dispatchKeyEvent", type="keyDown", key="ArrowRight")
    assert changed(later, opened.picture("#scene-view")) > 0.01


def test_the_keyboard_moves_the_time_and_it_plays(opened: Chromium) -> None:
    slide(opened, "scene-time", 3)
    opened.run("document.getElementById('scene-time').focus()")
    opened.ask(
        "Input.dispatchKeyEvent", type="rawKeyDown", key="ArrowRight", windowsVirtualKeyCode=39
    )
    assert opened.run("document.getElementById('scene-time').value") == "4"
    opened.run("document.getElementById('scene-play').click()")
    opened.until("+document.getElementById('scene-time').value > 6")
    opened.run("document.getElementById('scene-play').click()")
    assert opened.run("document.getElementById('scene-play').getAttribute('aria-pressed')") == (
        "false"
    )


def test_colours_follow_what_is_chosen(opened: Chromium) -> None:
    offered = opened.run("[...document.getElementById('scene-colour').options].map(o => o.value)")
    assert {"plain", "magnitude", "uy", "opening", "pressure", "stress_mises"} <= set(offered)
    shown = []
    for name in ("plain", "uy", "opening", "stress_mises"):
        opened.run(
            f"(() => {{ const s = document.getElementById('scene-colour'); s.value = '{name}';"
            " s.dispatchEvent(new Event('change')); })()"
        )
        shown.append(opened.picture("#scene-view"))
    for before, after in pairwise(shown):
        assert changed(before, after) > 0.0005
    # one colour, without edges: the ground has one
    opened.run("document.getElementById('scene-edges').click()")
    assert changed(shown[-1], opened.picture("#scene-view")) > 0.001


def test_curves_are_drawn_and_zoom(opened: Chromium) -> None:
    figures = opened.run("document.querySelectorAll('figure.chart').length")
    for i in range(figures):
        opened.run(f"document.querySelectorAll('figure.chart')[{i}].scrollIntoView()")
        opened.until(f"!!document.querySelectorAll('figure.chart')[{i}].plot")
    span = "(s => s.max - s.min)(document.querySelector('figure.chart').plot.scales.x)"
    whole = opened.run(span)
    assert whole == pytest.approx(0.4)
    opened.run("document.querySelector('figure.chart .tools button').click()")
    opened.until(f"Math.abs({span} - {whole / 2}) < 1e-9")
    box = opened.run(
        "(() => { const o = document.querySelector('figure.chart').plot.over; o.scrollIntoView();"
        " const b = o.getBoundingClientRect(); return [b.x, b.y, b.width, b.height]; })()"
    )
    y = box[1] + box[3] / 2
    for kind, part in (("mousePressed", 0.25), ("mouseMoved", 0.5), ("mouseReleased", 0.5)):
        opened.ask(
            "Input.dispatchMouseEvent", type=kind, x=box[0] + part * box[2], y=y,
            button="left", buttons=1, clickCount=1,
        )  # fmt: skip
    opened.until(f"Math.abs({span} / {whole} - 0.125) < 0.01")
    loops = opened.run(
        "[...document.querySelectorAll('figure.chart')].filter(f => f.plot.mode === 2).map(f => {"
        " const c = f.querySelector('canvas'), d = c.getContext('2d')"
        ".getImageData(0, 0, c.width, c.height).data; let n = 0;"
        " for (let i = 0; i < d.length; i += 4) n += d[i + 2] > 120 && d[i] < 60 && d[i + 3] > 99;"
        " return n; })"
    )
    assert loops
    assert min(loops) > 100  # blue pixels of each loop


def test_a_phone_in_the_dark_shows_all_of_it(browser: Chromium, rocking: Path) -> None:
    browser.open(rocking / "report.html", *PHONE, dark=True)
    browser.until(READY)
    assert browser.run("document.documentElement.scrollWidth") == PHONE[0]
    scene = browser.picture("#scene-view")
    assert scene.shape[1] > 0.85 * PHONE[0]
    assert drawn(scene) > 0.1
    ground = browser.picture()[2, 2].astype(int)
    assert ground.mean() < 60
    assert browser.console == []


def test_modes_swing_in_space(browser: Chromium, modes: Path) -> None:
    browser.open(modes / "report.html", *WINDOW)
    browser.until(READY)
    first = browser.picture("#scene-view")
    assert drawn(first) > 0.02
    assert "Hz" in browser.run("document.getElementById('scene-now').textContent")
    assert changed(first, slide(browser, "scene-time", 2)) > 0.005
    browser.run("document.getElementById('scene-play').click()")
    before = browser.picture("#scene-view")
    browser.run("new Promise(r => setTimeout(r, 400))")
    assert changed(before, browser.picture("#scene-view")) > 0.001
    assert browser.console == []
