"""Problems as text: files as they are, dictionaries as TOML."""

from __future__ import annotations

import decimal
import json
import numbers
import os
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ._krawl import Error


def text_and_name(problem: Any) -> tuple[str, str]:
    """The text of a problem, and the name for messages about it."""
    if isinstance(problem, Mapping):
        return "".join(_table(problem, [])), str(problem.get("name", "problem"))
    if isinstance(problem, (str, os.PathLike)):
        path = Path(problem)
        try:
            return path.read_text(encoding="utf-8"), str(path)
        except UnicodeDecodeError:
            raise Error(f"{path}: is not a text file") from None
    kind = type(problem).__name__
    raise Error(f"a problem is the path of a file or a dictionary with its keys, and not a {kind}")


def system(
    equations: Any,
    unknowns: Mapping[str, Any] | None = None,
    parameters: Mapping[str, Any] | None = None,
    *,
    name: str = "system",
) -> dict:
    """A problem of unknown numbers and equations of one's own, which every verb takes (docs/using/algebra.md).

    `equations`: texts such as ``"x**2 + y**2 = a"``, or what SymPy has: expressions that are to be zero, and ``Eq``.
    `unknowns`: for each its value in the sketch, where a path begins, or between which numbers it is sought, ``(0, 2)``. Left out, they
    are all names in the equations that are no parameters.
    `parameters`: for each its value, or ``{"value": 4, "from": 2.5}`` for one that the path leads from elsewhere.

    >>> import krawl
    >>> circle = krawl.system(["x**2 + y**2 - a", "x*y = 1"], {"x": 1.2, "y": 0.5}, {"a": 4})
    >>> len(krawl.complete(circle).solutions)
    4
    """

    def text(equation: Any) -> str:
        sides = [getattr(equation, side, None) for side in ("lhs", "rhs")]
        return str(equation) if None in sides else f"{sides[0]} = {sides[1]}"

    texts = [text(equation) for equation in equations]
    if unknowns is None:
        found = re.findall(r"(?<![\w.])[^\W\d]\w*", " ".join(texts))
        known = {"sqrt", *map(str, parameters or {})}
        names = [one for one in dict.fromkeys(found) if one not in known]
        unknowns = {one: (31 + 37 * k % 100) / 100 for k, one in enumerate(names)}
    problem = {
        "name": name,
        "equations": texts,
        "unknowns": {str(unknown): value for unknown, value in unknowns.items()},
    }
    if parameters:
        problem["parameters"] = {str(key): value for key, value in parameters.items()}
    return problem


def _table(table: Mapping, path: list[str]):
    """The lines of a table: its values first, then the tables in it."""
    for key, value in table.items():
        if not isinstance(value, Mapping):
            yield f"{_key(key)} = {_value(value, [*path, key])}\n"
    for key, value in table.items():
        if isinstance(value, Mapping):
            # Objects in a table are written on one line; only the file's own tables have headings.
            if path:
                yield f"{_key(key)} = {_value(value, [*path, key])}\n"
            else:
                yield f"\n[{_key(key)}]\n"
                yield from _table(value, [key])


def _key(key: Any) -> str:
    return json.dumps(str(key), ensure_ascii=False)


def _value(value: Any, path: list[str]) -> str:
    # Arrays and numbers of NumPy's become lists and numbers of Python's.
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, float):
        return repr(value)
    if isinstance(value, decimal.Decimal):
        return format(value, "f")
    if isinstance(value, Mapping):
        entries = (f"{_key(k)} = {_value(v, [*path, k])}" for k, v in value.items())
        return "{ " + ", ".join(entries) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(item, path) for item in value) + "]"
    place = ".".join(map(str, path))
    raise Error(f"{place}: a {type(value).__name__} has no place in a problem")
