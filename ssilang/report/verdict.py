"""What a run did to its footings: the figures of @BILANSSI as a part of the page."""

import re
from collections.abc import Sequence
from typing import Any

from ssilang.messages.message import Teller
from ssilang.report.charts import Chart, charts_html
from ssilang.report.html import codes, number, table, text
from ssilang.report.results import Results

_LIMITS = {"TAUX": ("above", 1.0), "RENVERSEMENT": ("below", 1.0), "GLISSEMENT": ("below", 1.0)}
"""Beyond which a figure is marked."""
_TOP = 1000.0


def is_endless(name: str, value: float) -> bool:
    """Whether a figure is a factor cut at its top: there is no moment or shear."""
    return _LIMITS.get(re.sub(r"_\d+$", "", name), ("", 0.0))[0] == "below" and value >= _TOP


def verdict_html(results: Results, charts: Sequence[Chart], told: Teller) -> str:
    """Tables of each verdict, then their pictures; nothing without any."""
    verdicts = results.summary.get("statistics", {}).get("verdicts", [])
    made = []
    for i, verdict in enumerate(verdicts, 1):
        if len(verdicts) > 1:
            made.append(f"<h3>{text(told('report.footing-number', number=i))}</h3>")
        rows = []
        for name, peak in verdict["peaks"].items():
            said = text(told(codes()["peaks"][name]))
            rows.append((said, _marked(name, peak["value"]), number(peak["time"])))
        for name, value in verdict["left"].items():
            rows.append((text(told(codes()["left"][name])), number(value), ""))
        rows.append((text(told("report.area")), number(verdict["area"]), ""))
        for key, code in codes()["given"].items():
            if verdict[key] is not None:
                rows.append((text(told(code)), number(verdict[key]), ""))
        heads = (told("report.quantity"), told("report.value"), told("report.time"))
        made.append(table(heads, rows, (1, 2)))
        if verdict["floors"]:
            made.append(_floors(verdict["floors"], told))
    return "".join(made) + charts_html(charts, "verdict", told)


def _marked(name: str, value: float | None) -> str:
    """A figure; good or bad where there is a limit."""
    if name not in _LIMITS or value is None:
        return number(value)
    side, limit = _LIMITS[name]
    bad = value > limit if side == "above" else value < limit
    shown = f"> {_TOP:g}" if side == "below" and value >= _TOP else number(value)
    return f'<b class="{"bad" if bad else "good"}">{shown}</b>'


def _floors(floors: list[dict[str, Any]], told: Teller) -> str:
    rows = [
        (
            number(f["floor"]), text(f["component"]), text(f["damping"]),
            number(f["acceleration"]), number(f["frequency"]),
        )
        for f in floors
    ]  # fmt: skip
    heads = list(map(told, codes()["heads"]["floors"]))
    return table(heads, rows, (0, 3, 4))
