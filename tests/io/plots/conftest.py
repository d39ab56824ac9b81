"""Pictures of few pixels: what they show is the same, and software draws each pixel of a scene."""

from __future__ import annotations

import pytest

from ssilang.io.plots import figure


@pytest.fixture(autouse=True)
def few_pixels(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(figure, "DPI", 60)
