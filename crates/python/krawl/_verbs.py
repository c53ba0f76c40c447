"""The verbs, as functions."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Iterable, Mapping
from typing import Any, Callable, Optional

import numpy as np

from . import _krawl
from ._krawl import Error
from ._problem import text_and_name
from ._results import Complete, Edited, Figure, Motion, Result, Run, Solution, Verdict, figure


def solve(
    problem: Any,
    *,
    mode: str = "certified",
    space: Optional[str] = None,
    reverse: bool = False,
    extended: bool = True,
    samples: int = 0,
    certificate: Any = None,
    progress: Optional[Callable[[int, float, int], Any]] = None,
) -> Run:
    """Follows the path through the sketch and gives the figures on it that meet the dimensions, with proof.

    mode: "certified", or "float" for the same without proof.
    space: "full" or "reduced"; the suitable one otherwise.
    reverse: sets out in the other direction.
    extended: goes on in extended precision where doubles do not suffice.
    samples: so many figures along the path are in `data["samples"]`.
    certificate: where to leave the proof, for `verify`.
    progress: called about ten times a second with the number of steps, t, and the number of solutions.

    Ctrl-C ends the run. Bad input raises `krawl.Error`.
    """
    text, name = text_and_name(problem)
    answer = _krawl.solve(
        text,
        name,
        mode=mode,
        space=space,
        reverse=reverse,
        extended=extended,
        samples=samples,
        certificate=_beside(problem, certificate),
        progress=progress,
    )
    data = json.loads(answer)
    return Run(data["status"], data["verdict"], _solutions(data, data["dimension"]), data)


def complete(
    problem: Any,
    *,
    threads: int = 0,
    time: Optional[float] = None,
    certificate: Any = None,
    progress: Optional[Callable[[float, int], Any]] = None,
    **options: Any,
) -> Complete:
    """All figures with the dimensions, up to motions and reflections, and the proof that there is no other.

    threads: 0 for one per processor.
    time: ends the search after so many seconds; what is proved by then is kept.
    certificate: where to leave the proof, for `verify`.
    progress: called now and then with the share of the search that is done, and the number of its parts.
    options: of `krawl all`, such as ``within="x=0..2"`` and ``digits=50``; then nobody is told of progress.
    """
    cert = _beside(problem, certificate)
    if options:
        data = _told("all", problem, dict(options, threads=threads or None, time=time, cert=cert)).data
    else:
        text, name = text_and_name(problem)
        answer = _krawl.complete_set(
            text, name, threads=threads, time=time, certificate=cert, progress=progress
        )
        data = json.loads(answer)
    return Complete(data["status"], _solutions(data, None), data)


def motion(problem: Any, *, free: Iterable[str] = (), measure: Iterable[str] = ()) -> Motion:
    """Follows a linkage with one degree of freedom all the way round, with proof, past every dead centre.

    free: dimensions to leave out so that it can move, such as "a-b" and "angles:a-b-c".
    measure: what to bound over all of it, such as "a-b", "angle a b c", "turn a b c", "x a", "area a b c".
    """
    text, name = text_and_name(problem)
    data = json.loads(_krawl.motion(text, name, free=list(free), measure=list(measure)))
    bounds = {}
    for measured in data["measured"]:
        if "least" in measured:
            bounds[measured["name"]] = (measured["least"]["value"][0], measured["greatest"]["value"][1])
    turns = {measured["name"]: measured["turns"] for measured in data["measured"] if "turns" in measured}
    return Motion(data["status"], data["words"], bounds, turns, data)


def complex(problem: Any, **options: Any) -> Result:
    """All complex solutions: ``krawl.complex(system, digits=30)["solutions"]``.

    Options of this function and of those that follow are those of the command line, with ``_`` in place of ``-`` (and behind it
    where Python has the word for itself: ``from_``): a list for one that is given several times, a dictionary for `set`, ``True``
    for one without a value.
    """
    return _told("complex", problem, options)


def limits(problem: Any, **options: Any) -> Result:
    """How far each dimension can go: ``krawl.limits("plate.toml", only="C-D")["ranges"]``."""
    return _told("limits", problem, options)


def sweep(problem: Any, **options: Any) -> Result:
    """A dimension through a range, frame by frame: ``krawl.sweep("bars.toml", vary="A-B", from_=1, to=2)["frames"]``."""
    return _told("sweep", problem, options)


def tolerance(problem: Any, **options: Any) -> Result:
    """What tolerances add up to: ``krawl.tolerance("plate.toml", default=0.1, measure="B-E")["measured"]``."""
    return _told("tolerance", problem, options)


def explore(problem: Any, **options: Any) -> Result:
    """More figures from new sketches: ``krawl.explore("k33.toml", store="parts", time=60)``."""
    return _told("explore", problem, options)


def compare(problem: Any, **options: Any) -> Result:
    """All modes and spaces beside each other, timed and judged."""
    return _told("compare", problem, options)


def check(problem: Any, **options: Any) -> str:
    """What was understood, what is missing or too much, in words."""
    _, output, _ = _called("check", problem, options)
    return output


def export(problem: Any, to: str, **options: Any) -> str:
    """The equations for another program: ``krawl.export(system, "msolve")``."""
    _, output, _ = _called("export", problem, dict(options, to=to))
    return output


def verify(certificate: Any, problem: Any = None) -> Verdict:
    """Proves a certificate again, with the checker's own arithmetic; and compares it with a problem."""
    about = None if problem is None else text_and_name(problem)
    return Verdict(*_krawl.verify(os.fspath(certificate), about))


def edit(problem: Any, dimensions: Mapping) -> Edited:
    """Changes dimensions of a figure and keeps the figure, with proof, or says how far it can go.

    >>> krawl.edit("plate.toml", {"C-D": 40}).status        # doctest: +SKIP
    'reached'
    """
    return Session(problem).edit(dimensions)


def drag(problem: Any, places: Mapping) -> Edited:
    """Leads points to where they are wanted, all dimensions staying what they are, or as near as they can: with proof.

    >>> krawl.drag("arm.toml", {"C": (40, 30)}).dragged["is_there"]        # doctest: +SKIP
    True
    """
    return Session(problem, drag=True).drag(places)


class Session:
    """A figure that is edited again and again: set up once, and each edit starts from the last one reached.

    ``drag``: its points are to be dragged, though it has no place of its own.
    """

    def __init__(self, problem: Any, *, drag: bool = False) -> None:
        self._session = _krawl.Session(*text_and_name(problem), drag)

    def edit(self, dimensions: Mapping) -> Edited:
        """Changes dimensions, given by name. The figure stays what it is if they are not reached."""
        settings = [f"{name}={_number(value)}" for name, value in dimensions.items()]
        return _edited(json.loads(self._session.edit(settings)))

    def drag(self, places: Mapping) -> Edited:
        """Leads points, by name, to where they are wanted. The figure is then the one that was come to."""
        wanted = [f"{name}={','.join(_number(x) for x in place)}" for name, place in places.items()]
        return _edited(json.loads(self._session.drag(wanted)))

    @property
    def figure(self) -> Figure:
        """The figure as it is now, where the sketch is drawn."""
        points = self._session.points()
        lower, upper = (np.array([point[k] for point in points]) for k in (1, 2))
        return Figure(tuple(point[0] for point in points), lower, upper)


def _edited(data: dict) -> Edited:
    places = figure(data["points"], _dimension(data["points"]))
    return Edited(data["status"], tuple(data["t"]), data["dimensions"], places, data)


def _solutions(data: dict, dimension: Optional[int]) -> list:
    return [
        figure(one["points"], dimension or _dimension(one["points"]), Solution, data=one)
        for one in data["solutions"]
    ]


def _dimension(points: dict) -> int:
    return max((len(place) for place in points.values()), default=3)


def _beside(problem: Any, certificate: Any) -> Optional[str]:
    """Where a certificate goes, which must not be the problem itself."""
    if certificate is None:
        return None
    if isinstance(problem, (str, os.PathLike)) and os.path.exists(certificate):
        if os.path.samefile(problem, certificate):
            raise Error(f"{certificate}: is the problem itself; name another file for the certificate")
    return os.fspath(certificate)


def _number(value: Any) -> str:
    if hasattr(value, "tolist"):
        value = value.tolist()
    return repr(value) if isinstance(value, float) else str(value)


def _told(verb: str, problem: Any, options: Mapping) -> Result:
    """What a verb of the command line writes as JSON."""
    code, output, messages = _called(verb, problem, dict(options, json="-"))
    return Result(json.loads(output), code, messages)


def _called(verb: str, problem: Any, options: Mapping) -> tuple[int, str, str]:
    """Runs a verb as the command line does. What it refuses is an error."""
    with tempfile.TemporaryDirectory() as folder:
        if isinstance(problem, Mapping):
            text, name = text_and_name(problem)
            path = os.path.join(folder, "problem.toml")
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
        elif isinstance(problem, (str, os.PathLike)):
            name = path = os.fspath(problem)
        else:
            text_and_name(problem)
        code, output, messages = _krawl.call([verb, path, *_words(options)])
    messages = messages.replace(path, name).strip()
    if not output:
        raise Error(messages)
    return code, output, messages


def _words(options: Mapping) -> Iterable[str]:
    """Options as the command line has them."""
    for key, value in options.items():
        flag = "--" + key.strip("_").replace("_", "-")
        if isinstance(value, Mapping):
            value = [f"{name}={_number(one)}" for name, one in value.items()]
        for one in value if isinstance(value, (list, tuple)) else [value]:
            if one is True:
                yield flag
            elif one is not None and one is not False:
                yield f"{flag}={os.fspath(one) if isinstance(one, os.PathLike) else _number(one)}"
