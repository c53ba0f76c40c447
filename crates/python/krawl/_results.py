"""What the verbs give back. `data` of each is the JSON that the command line writes (docs/using/programs.md)."""

from __future__ import annotations

import html
import json
import os
import tempfile
from dataclasses import dataclass, field
from typing import Any, Optional

import numpy as np

from . import _krawl


class Shown:
    """A result that notebooks show as `krawl show` draws it, where there is something to draw."""

    data: dict

    def _repr_html_(self) -> Optional[str]:
        page = self._drawn("--html")
        return page and f'<iframe srcdoc="{html.escape(page)}" width="100%" height="600"></iframe>'

    def _repr_svg_(self) -> Optional[str]:
        return self._drawn("--svg")

    def _drawn(self, how: str) -> Optional[str]:
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "result.json")
            with open(path, "w", encoding="utf-8") as file:
                json.dump(self.data, file)
            code, output, _ = _krawl.call(["show", path, how, "-"])
        return output if code == 0 and output else None


@dataclass(frozen=True)
class Result(Shown):
    """What a verb of the command line gives: its JSON (docs/using/programs.md), whose keys are this one's, too."""

    data: dict = field(repr=False)
    #: The exit code: 0 done, others as the verb's help says.
    code: int
    #: What it would print on standard error.
    messages: str = ""

    @property
    def status(self) -> Optional[str]:
        return self.data.get("status")

    def __getitem__(self, key: str) -> Any:
        return self.data[key]


def _joints(objects: dict) -> dict:
    """Of objects the joints, each number as the middle of its box."""
    middle = lambda x: x[0] + 0.5 * (x[1] - x[0]) if isinstance(x, list) else x  # noqa: E731
    kept = lambda at: {key: middle(at[key]) for key in ("turn", "travel") if key in at}  # noqa: E731
    return {name: kept(at) for name, at in objects.items() if kept(at)}


@dataclass(frozen=True)
class Figure:
    """Points, each in a box."""

    #: The points' names, in the order of the rows.
    names: tuple
    #: Lower ends of the coordinates: an array of as many rows as points, and 2 or 3 columns.
    lower: np.ndarray = field(repr=False)
    #: Upper ends.
    upper: np.ndarray = field(repr=False)

    @property
    def points(self) -> np.ndarray:
        """The middles of the boxes."""
        return self.lower + 0.5 * (self.upper - self.lower)

    def __getitem__(self, name: str) -> np.ndarray:
        """The middle of a point's box, by the point's name."""
        row = self.names.index(name)
        return self.lower[row] + 0.5 * (self.upper[row] - self.lower[row])


@dataclass(frozen=True)
class Solution(Figure):
    """A figure that meets the dimensions: its boxes hold exactly one. (Of a float run: an observation.)"""

    data: dict = field(repr=False)

    @property
    def congruence_class(self) -> int:
        """Solutions of the same class are the same figure moved, or its mirror image."""
        return self.data["class"]

    @property
    def unknowns(self) -> dict:
        """The values of unknown numbers by name: the middles of their boxes (docs/using/algebra.md)."""
        objects = self.data.get("objects") or {}
        middle = lambda value: value[0] + 0.5 * (value[1] - value[0])  # noqa: E731
        return {name: middle(at["value"]) for name, at in objects.items() if "value" in at}

    @property
    def joints(self) -> dict:
        """By how many degrees each joint is turned (``turn``) and how far it is drawn out (``travel``), by name (docs/using/robots.md)."""
        return _joints(self.data.get("objects") or {})

    @property
    def folds(self) -> Optional[int]:
        """How often the path is proved to turn back before this solution; 0 is exact."""
        return self.data.get("folds")


@dataclass(frozen=True)
class Run(Shown):
    """What following the path through the sketch gave."""

    #: "closed", "open" or "stopped".
    status: str
    #: What is proved, or observed, in words.
    verdict: str
    solutions: list
    data: dict = field(repr=False)

    @property
    def reason(self) -> Optional[str]:
        """Why the run stopped."""
        return self.data.get("reason")

    @property
    def stopped_kind(self) -> Optional[str]:
        """What made the run stop, in a word (docs/using/programs.md)."""
        return self.data.get("stopped_kind")

    @property
    def frame(self) -> Optional[tuple]:
        """Origin and axes (rows) of the coordinates of the solutions, in those of the sketch."""
        frame = self.data.get("frame")
        return frame and (np.array(frame["origin"]), np.array(frame["axes"]))

    def in_sketch(self, points: np.ndarray) -> np.ndarray:
        """Points of a solution (rows) where the sketch is drawn."""
        frame = self.frame
        if frame is None:
            return points
        origin, axes = frame
        size = points.shape[1]
        return origin[:size] + points @ axes[:size, :size]


@dataclass(frozen=True)
class Complete(Shown):
    """All figures with the dimensions."""

    #: "complete": there is no other. "partial": parts are undecided. "flexible": there is a curve of them.
    status: str
    solutions: list
    data: dict = field(repr=False)

    @property
    def undecided(self) -> list:
        """The parts of the search that are undecided, and why."""
        return self.data["undecided"]

    @property
    def reason(self) -> Optional[str]:
        """Why there is none, where that is seen at once."""
        return self.data.get("reason")


@dataclass(frozen=True)
class Edited:
    """What came of an edit."""

    #: "reached", "limit", "passes" or "stopped".
    status: str
    #: The part of the way that was proved, an interval: 1, or where the limit is.
    t: tuple
    #: Per dimension that was to move its name, and the interval that its value lies in.
    dimensions: dict
    #: The figure there.
    figure: Figure
    data: dict = field(repr=False)

    @property
    def unknowns(self) -> dict:
        """The values of unknown numbers by name in the figure (docs/using/algebra.md)."""
        return self.data.get("unknowns", {})

    @property
    def joints(self) -> dict:
        """By how many degrees each joint is turned (``turn``) and how far it is drawn out (``travel``), by name (docs/using/robots.md)."""
        return _joints(self.data.get("joints") or {})

    @property
    def dragged(self) -> Optional[dict]:
        """Of points that were dragged: where each was wanted, and how far it is from there (docs/using/programs.md)."""
        return self.data.get("dragged")

    @property
    def reason(self) -> Optional[str]:
        """Why the edit was not reached, in words."""
        return self.data.get("reason")

    @property
    def stopped_kind(self) -> Optional[str]:
        """What made the edit stop, in a word (docs/using/programs.md)."""
        return self.data.get("stopped_kind")


@dataclass(frozen=True)
class Motion(Shown):
    """How a linkage moves."""

    #: "closed" of a loop, "open" of a way between two ends, "stopped" if it was followed only so far.
    status: str
    #: What is proved, in words.
    words: str
    #: Between which bounds what was measured stays: lengths, areas, degrees.
    bounds: dict
    #: Of angles that go through full turns, how many.
    turns: dict
    data: dict = field(repr=False)


@dataclass(frozen=True)
class Verdict:
    """What the checker says of a certificate. It is true where the proof holds and is about the problem."""

    #: "verified", "refuted", "not proved" or "incomplete".
    outcome: str
    #: The theorem, or what is wrong.
    theorem: str
    #: Whether the certificate is about the problem that was given.
    is_about_the_problem: bool = True

    def __bool__(self) -> bool:
        return self.outcome == "verified" and self.is_about_the_problem


def figure(points: dict, dimension: int, kind: Any = Figure, **more: Any) -> Any:
    """A figure from the JSON's points: per name the coordinates, each an interval."""
    boxes = np.array([place[:dimension] for place in points.values()], dtype=float)
    boxes = boxes.reshape(len(points), dimension, 2)
    return kind(
        names=tuple(points), lower=boxes[..., 0].copy(), upper=boxes[..., 1].copy(), **more
    )
