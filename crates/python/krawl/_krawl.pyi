"""The compiled part of krawl: problems as text, results as JSON."""

from typing import Any, Callable, Optional

__version__: str

class Error(ValueError):
    """Bad input: what is wrong, where, and what to do."""

def solve(
    text: str,
    name: str,
    *,
    mode: str,
    space: Optional[str],
    reverse: bool,
    extended: bool,
    samples: int,
    certificate: Optional[str],
    progress: Optional[Callable[[int, float, int], Any]],
) -> str: ...
def complete_set(
    text: str,
    name: str,
    *,
    threads: int,
    time: Optional[float],
    certificate: Optional[str],
    progress: Optional[Callable[[float, int], Any]],
) -> str: ...
def motion(text: str, name: str, *, free: list[str], measure: list[str]) -> str: ...
def call(arguments: list[str]) -> tuple[int, str, str]: ...
def verify(path: str, problem: Optional[tuple[str, str]]) -> tuple[str, str, bool]: ...

class Session:
    def __init__(self, text: str, name: str) -> None: ...
    def edit(self, settings: list[str]) -> str: ...
    def drag(self, places: list[str]) -> str: ...
    def points(self) -> list[tuple[str, list[float], list[float]]]: ...
