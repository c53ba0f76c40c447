"""The Python package, used as its users would: `pip install .[test]`, then `pytest tests/python`."""

import decimal
import doctest
import json
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import krawl
import numpy as np
import pytest

ROOT = Path(__file__).parents[2]
OCTAHEDRON = ROOT / "problems/octahedron.toml"
PLATE = ROOT / "docs/examples/plate.toml"


def triangle(**points):
    return {
        "dimension": 2,
        "points": {"a": [0, 0], "b": [4, 0], "c": [0.5, 2.9], **points},
        "constraints": {"distances": [["a", "b", 5], ["b", "c", 4], ["c", "a", 3]]},
        "homotopy": {"reference": ["a", "b"]},
    }


def test_documentation_runs():
    assert doctest.testmod(krawl).failed == 0


def test_solutions_are_boxes_in_arrays_that_meet_the_dimensions():
    run = krawl.solve(OCTAHEDRON)
    assert run.status == "closed" and len(run.solutions) == 4
    lengths = json.loads(json.dumps(run.data))["constraints"]
    for solution in run.solutions:
        assert solution.lower.shape == solution.upper.shape == (6, 3)
        assert solution.lower.dtype == np.float64
        assert (solution.lower <= solution.upper).all()
        for length in lengths:
            a, b = length["items"]
            distance = np.linalg.norm(solution[a] - solution[b])
            assert abs(distance - float(length["value"])) < 1e-12
    assert run.solutions[0].folds == 0


def test_problems_come_as_paths_text_free_dictionaries_and_arrays():
    listed = krawl.solve(triangle())
    arrays = krawl.solve(triangle(c=np.array([0.5, 2.9])))
    exact = krawl.solve(triangle(c=[decimal.Decimal("0.5"), decimal.Decimal("2.9")]))
    for other in (arrays, exact):
        assert len(other.solutions) == len(listed.solutions) > 0
        for one, two in zip(listed.solutions, other.solutions):
            assert (one.lower == two.lower).all() and (one.upper == two.upper).all()
    # The right angle of 3, 4, 5: c is 2.4 above a-b.
    height = listed.solutions[0]
    assert height.lower[2, 1] <= 2.4 <= height.upper[2, 1]


def test_figures_come_back_to_where_the_sketch_is():
    moved = triangle(a=[10, 20], b=[10, 24], c=[7, 20.5])
    run = krawl.solve(moved)
    there = run.in_sketch(run.solutions[0].points)
    assert np.allclose(there[0], [10, 20]) and np.allclose(there[1], [10, 25])
    assert there[2, 0] < 10


def test_float_runs_agree_with_proved_ones():
    proved = krawl.solve(OCTAHEDRON).solutions
    seen = krawl.solve(OCTAHEDRON, mode="float").solutions
    assert len(proved) == len(seen)
    for one, two in zip(proved, seen):
        assert np.allclose(one.points, two.points, atol=1e-9)


def test_certificates_verify_and_are_about_their_problem(tmp_path):
    proof = tmp_path / "octahedron.krawl"
    krawl.solve(OCTAHEDRON, certificate=proof)
    assert krawl.verify(proof)
    assert krawl.verify(proof, OCTAHEDRON)
    other = krawl.verify(proof, triangle())
    assert other.outcome == "verified" and not other.is_about_the_problem and not other
    damaged = proof.read_bytes().split(b"\n")
    del damaged[len(damaged) // 2]
    proof.write_bytes(b"\n".join(damaged))
    try:
        assert not krawl.verify(proof)
    except krawl.Error as error:
        assert str(proof) in str(error)


def test_a_certificate_never_overwrites_its_problem(tmp_path):
    problem = tmp_path / "octahedron.toml"
    text = OCTAHEDRON.read_text()
    problem.write_text(text)
    for verb in (krawl.solve, krawl.complete):
        with pytest.raises(krawl.Error, match="the problem itself"):
            verb(problem, certificate=problem)
    assert problem.read_text() == text


def test_complete_sets_and_their_covers(tmp_path):
    proof = tmp_path / "prism.cover"
    result = krawl.complete(ROOT / "problems/prism.toml", certificate=proof, threads=1)
    assert result.status == "complete" and len(result.solutions) == 12
    assert result.solutions[0].lower.shape == (6, 2)
    assert krawl.verify(proof).outcome == "verified"


def test_edits_reach_or_name_the_limit():
    session = krawl.Session(PLATE)
    reached = session.edit({"C-D": 40})
    assert reached.status == "reached" and reached.dimensions["C-D"] == [40, 40]
    before = session.figure
    assert np.linalg.norm(before["C"] - before["D"]) == pytest.approx(40, abs=1e-12)
    limit = session.edit({"C-D": np.float64(200)})
    assert limit.status == "limit"
    low, high = limit.dimensions["C-D"]
    assert 40 < low <= high < 200
    # An edit that is not reached changes nothing.
    assert (session.figure.lower == before.lower).all()
    assert krawl.edit(PLATE, {"C-D": "40"}).status == "reached"


@pytest.mark.parametrize(
    "problem, words",
    [
        ({"dimension": 4}, "dimension"),
        ({"dimension": object()}, "has no place"),
        (7, "path of a file or a dictionary"),
        (triangle(d=[1, 1]), "d"),
    ],
)
def test_bad_input_says_what_is_wrong(problem, words):
    with pytest.raises(krawl.Error, match=words):
        krawl.solve(problem)


def test_linkages_are_followed_all_the_way_round():
    found = krawl.motion(
        "problems/mechanisms/crank.toml", free=["turns:D-A-B"], measure=["angle A D C", "turn D A B"]
    )
    assert found.status == "closed" and found.turns["turn D A B"] == 1
    low, high = found.bounds["angle A D C"]
    assert 38.62 < low < 38.6249 and 78.5848 < high < 78.59
    with pytest.raises(krawl.Error, match="could not be set in motion"):
        krawl.motion("problems/mechanisms/crank.toml")


def test_points_are_dragged():
    edited = krawl.drag("docs/examples/arm.toml", {"C": (40, 30)})
    assert edited.status == "reached" and edited.dragged["is_there"]
    assert edited.data["points"]["C"] == [[40, 40], [30, 30]]
    session = krawl.Session("docs/examples/arm.toml", drag=True)
    assert not session.drag({"C": (80.5, 30)}).dragged["is_there"]
    with pytest.raises(krawl.Error, match="no point `X`"):
        session.drag({"X": (1, 2)})


def test_robots_and_joints():
    arm = {
        "name": "arm",
        "dimension": 3,
        "robots": {"r": [{"d": 0.4, "alpha": 90}, {"a": 0.3}, {"a": 0.2}]},
        "constraints": {"turns": [["r_j1", 30], ["r_j2", 20], ["r_j3", -50]]},
    }
    found = krawl.complete(arm)
    assert found.status == "complete" and len(found.solutions) == 1
    joints = found.solutions[0].joints
    assert [round(joints[f"r_j{k}"]["turn"], 9) for k in (1, 2, 3)] == [30, 20, -50]
    edited = krawl.edit("docs/examples/slider-crank.toml", {"O": 90})
    assert edited.status == "reached" and abs(edited.joints["S"]["travel"] - 8**0.5) < 1e-12


def test_bad_options_say_what_is_wrong():
    with pytest.raises(krawl.Error, match="space"):
        krawl.solve(OCTAHEDRON, space="outer")
    with pytest.raises(krawl.Error, match="certificates"):
        krawl.solve(OCTAHEDRON, mode="float", certificate="x")
    with pytest.raises(krawl.Error, match="time"):
        krawl.complete(OCTAHEDRON, time=-1)
    with pytest.raises(krawl.Error, match="A-Z"):
        krawl.edit(PLATE, {"A-Z": 3})
    with pytest.raises(FileNotFoundError):
        krawl.solve("no-such-file.toml")


def test_progress_is_told_and_other_threads_run_meanwhile():
    seen, ticks, done = [], [], threading.Event()

    def tick():
        while not done.wait(0.002):
            ticks.append(time.monotonic())

    clock = threading.Thread(target=tick)
    clock.start()
    result = krawl.complete(
        ROOT / "problems/icosahedron.toml", time=1.5, threads=1, progress=lambda *now: seen.append(now)
    )
    done.set()
    clock.join()
    assert result.status == "partial"
    assert len(seen) > 1 and all(0 <= share <= 1 for share, _ in seen)
    # With Python's lock held it would not have ticked at all.
    assert len(ticks) > 100


def test_the_example_draws(tmp_path):
    pytest.importorskip("matplotlib")
    (tmp_path / "problems").symlink_to(ROOT / "problems")
    run = subprocess.run(
        [sys.executable, ROOT / "examples/octahedron.py"],
        cwd=tmp_path,
        env={**os.environ, "MPLBACKEND": "Agg"},
        capture_output=True,
        text=True,
    )
    assert run.returncode == 0, run.stderr
    assert "4 on the path, 4 in all: complete" in run.stdout
    assert (tmp_path / "octahedron.png").stat().st_size > 10_000


def test_ctrl_c_ends_a_long_run():
    script = f"import krawl; print('begun', flush=True); krawl.complete({str(ROOT / 'problems/icosahedron.toml')!r})"
    with subprocess.Popen(
        [sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as run:
        assert run.stdout.readline() == "begun\n"
        time.sleep(0.5)
        run.send_signal(signal.SIGINT)
        _, errors = run.communicate(timeout=30)
    assert "KeyboardInterrupt" in errors


def test_equations_of_ones_own():
    circle = krawl.system(
        ["x**2 + y**2 - a", "x*y = 1"],
        {"x": 1.2, "y": 0.5},
        {"a": {"value": 4, "from": 2.5}},
    )
    every = krawl.complete(circle)
    assert every.status == "complete" and len(every.solutions) == 4
    for solution in every.solutions:
        x, y = solution.unknowns["x"], solution.unknowns["y"]
        assert abs(x * x + y * y - 4) < 1e-12 and abs(x * y - 1) < 1e-12
    edited = krawl.edit(circle, {"a": 5})
    assert edited.status == "reached"
    assert abs(edited.unknowns["x"] ** 2 + edited.unknowns["y"] ** 2 - 5) < 1e-9
    with pytest.raises(krawl.Error, match="no unknown or parameter `z`"):
        krawl.complete(krawl.system(["x + z"], {"x": 1}))


def test_verbs_of_the_command_line_give_what_it_writes():
    circle = krawl.system(["x**2 + y**2 - a", "x*y = 1"], parameters={"a": 4})
    found = krawl.complex(circle, digits=20)
    assert found.status == "complete" and len(found["solutions"]) == 4 and found.code == 0
    assert {"1.9318516525781365735"} <= {one["numbers"]["x"] for one in found["digits"]}
    assert len(krawl.complete(circle, within=["x=0..2"]).solutions) == 2
    boxed = krawl.system(["x**2 + y**2 - 4", "x*y - 1"], {"x": (0, 2), "y": 0.5})
    assert len(krawl.complete(boxed).solutions) == 2
    assert "2*u1*u2" in krawl.export(boxed, "msolve")
    assert "2, for 2 unknowns" in krawl.check(boxed)
    limits = krawl.limits(PLATE, only="C-D")
    assert limits.data["verb"] == "limits"
    assert "<svg" in krawl.solve(OCTAHEDRON)._repr_svg_()
    assert krawl.complete(boxed)._repr_html_().startswith("<iframe")
    swept = krawl.sweep(PLATE, vary="C-D", from_=49.5, to=48, frames=3)
    assert len(swept["frames"]) == 3
    assert krawl.tolerance(PLATE, default=0.1).data["verb"] == "tolerance"
    with pytest.raises(krawl.Error, match="no unknown `z`"):
        krawl.complete(boxed, within="z=0..1")
    with pytest.raises(krawl.Error, match="unexpected argument"):
        krawl.limits(PLATE, nothing=1)


def test_sympy_expressions_are_equations():
    sympy = pytest.importorskip("sympy")
    x, y = sympy.symbols("x y")
    both = krawl.system([sympy.Eq(x**2 + y**2, 4), x * y - 1])
    assert len(krawl.complete(both).solutions) == 4
