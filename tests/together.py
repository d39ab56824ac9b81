"""Many quick cases as one test: each test of its own costs 7 ms beside what it does."""

import inspect
from collections.abc import Callable, Hashable, Iterable
from typing import Any

import pytest


def together(
    names: str, cases: Iterable[Any], by: Callable[[Any], Hashable] | None = None
) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """As `parametrize`, in one test, or one for each value of `by`; all cases that fail are told.

    Each case has a folder `tmp_path` and a `monkeypatch` of its own.
    """
    own = [n.strip() for n in names.split(",")]
    groups: dict[str, list[Any]] = {}
    for case in cases:
        groups.setdefault(str(by(case)) if by else "", []).append(case)
    assert groups, "no cases"

    def joined(check: Callable[..., None]) -> Callable[..., None]:
        def test(group: str = "", **fixtures: Any) -> None:
            errors: list[tuple[str, BaseException]] = []
            for number, case in enumerate(groups[group]):
                values = dict(zip(own, case if len(own) > 1 else (case,), strict=True))
                told = ", ".join(str(value)[:200] for value in values.values())
                if "tmp_path" in fixtures:
                    values["tmp_path"] = fixtures["tmp_path"] / str(number)
                    values["tmp_path"].mkdir()
                with pytest.MonkeyPatch.context() as patch:
                    if "monkeypatch" in fixtures:
                        values["monkeypatch"] = patch
                    try:
                        check(**fixtures | values)
                    except (Exception, pytest.fail.Exception) as error:
                        errors.append((told, error))
            if errors:
                lines = [f"{told}: {type(e).__name__}: {e}" for told, e in errors]
                said = "\n".join([f"{len(errors)} of {len(groups[group])} cases", *lines])
                raise AssertionError(said) from errors[0][1]

        vars(test).update(vars(check))  # its marks
        for name in ("__name__", "__qualname__", "__module__", "__doc__"):
            setattr(test, name, getattr(check, name))
        asked = inspect.signature(check)
        left = [p for n, p in asked.parameters.items() if n not in own]
        left += [inspect.Parameter("group", inspect.Parameter.KEYWORD_ONLY)] if by else []
        left = [p.replace(kind=inspect.Parameter.KEYWORD_ONLY) for p in left]
        test.__signature__ = asked.replace(parameters=left)  # type: ignore[attr-defined]
        return pytest.mark.parametrize("group", groups)(test) if by else test

    return joined
