"""Forms that are meant in the plane, or in space."""

from __future__ import annotations

from ssilang.language.registry import When
from ssilang.operators.workspace import workspace

IN_PLANE = When(lambda s: workspace(s).dimension < 3, "in the plane")
IN_SPACE = When(lambda s: workspace(s).dimension == 3, "in space")
