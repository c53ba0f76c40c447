"""Figures that must be right: sketches led to their dimensions, with proof.

>>> import krawl
>>> triangle = {
...     "dimension": 2,
...     "points": {"a": [0, 0], "b": [4, 0], "c": [0.5, 2.9]},
...     "constraints": {"distances": [["a", "b", 5], ["b", "c", 4], ["c", "a", 3]]},
...     "homotopy": {"reference": ["a", "b"]},
... }
>>> run = krawl.solve(triangle)
>>> run.status
'closed'
>>> float(run.solutions[0].lower[2, 1]) <= 2.4 <= float(run.solutions[0].upper[2, 1])
True

A problem is the path of a file, or a dictionary with the keys of such a file (docs/using/problem-files.md). Numbers are
exact: a float stands for its shortest decimal, 0.1 for one tenth, and `decimal.Decimal` for itself.

Every box is given as two arrays, `lower` and `upper`, whose floats enclose the exact numbers.
"""

from ._krawl import Error, __version__
from ._problem import system
from ._results import Complete, Edited, Figure, Motion, Result, Run, Solution, Verdict
from ._verbs import (
    Session,
    check,
    compare,
    complete,
    complex,
    drag,
    edit,
    explore,
    export,
    limits,
    motion,
    solve,
    sweep,
    tolerance,
    verify,
)

__all__ = [
    "Complete",
    "Edited",
    "Error",
    "Figure",
    "Motion",
    "Result",
    "Run",
    "Session",
    "Solution",
    "Verdict",
    "__version__",
    "check",
    "compare",
    "complete",
    "complex",
    "drag",
    "edit",
    "explore",
    "export",
    "limits",
    "motion",
    "solve",
    "sweep",
    "system",
    "tolerance",
    "verify",
]
