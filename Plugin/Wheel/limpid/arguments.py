# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Checks of arguments. A message says what is wrong (why it matters) and what to do."""

from __future__ import annotations

import math
import operator
import reprlib
import sys
import warnings
from typing import Any, Iterable


def warn(text: str) -> None:
    """A UserWarning about the line from which the package was called."""
    level = 1
    while sys._getframe(level).f_globals.get("__name__", "").partition(".")[0] in (
            __package__, "dataclasses"):
        level += 1
    warnings.warn(text, stacklevel=level + 1)


def number(name: str, value: Any, why: str, advice: str) -> float:
    """`value` as a finite float. `why` and `advice` complete the message of the ValueError."""
    try:
        result = float(value)
    except (TypeError, ValueError):
        result = math.nan
    if not math.isfinite(result):
        raise ValueError(f"{name} is {reprlib.repr(value)} ({why}). {advice}")
    return result


def number_between(name: str, value: Any, least: float, most: float, why: str,
                   advice: str) -> float:
    """`value` as a float in [least, most]."""
    result = number(name, value, why, advice)
    if not least <= result <= most:
        raise ValueError(f"{name} is {result:g} ({why}). {advice}")
    return result


def whole_number(name: str, value: Any, least: int, most: int, why: str, advice: str) -> int:
    """`value` as an int in [least, most]."""
    try:
        result = operator.index(value)
    except TypeError:
        result = None
    if result is None or not least <= result <= most:
        raise ValueError(f"{name} is {reprlib.repr(value)} ({why}). {advice}")
    return result


def vector(name: str, value: Any, why: str) -> tuple[float, float, float]:
    """`value` as a tuple of three finite floats."""
    try:
        result = tuple(map(float, value))
    except (TypeError, ValueError):
        result = ()
    if len(result) != 3 or not all(map(math.isfinite, result)):
        raise ValueError(f"{name} is {reprlib.repr(value)} ({why}). Give three finite numbers, "
                         "like (1, 2, 3).")
    return result


def require_choice(name: str, value: Any, choices: Iterable[str]) -> None:
    """Raises ValueError unless `value` is one of the choices."""
    if value not in choices:
        raise ValueError(f"{name} is {value!r} (this is not a valid choice). Choose one of "
                         f"{', '.join(map(repr, choices))}.")


def choice(name: str, value: Any, enumeration: Any) -> Any:
    """The member of an enumeration of the core that has this name."""
    require_choice(name, value, enumeration.__members__)
    return enumeration.__members__[value]
