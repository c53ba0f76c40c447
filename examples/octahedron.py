"""A path and its figures, drawn. Run it cell by cell in an editor that knows `# %%`, or as a whole:

    pip install .[plot]
    python examples/octahedron.py
"""

# %% The path through the sketch, with proof, and figures along it
import krawl
import matplotlib.pyplot as plt
import numpy as np

run = krawl.solve("problems/octahedron.toml", samples=400)
print(run.verdict)

# %% t along the path: where it is 1, the dimensions are met
samples = run.data["samples"]
path = np.array([[sample["at"], sample["t"]] for sample in samples])
figure, (left, right) = plt.subplots(1, 2, figsize=(11, 5))
left.plot(path[:, 0], path[:, 1])
left.axhline(1, color="0.7", linewidth=1)
for solution in run.solutions:
    left.plot(solution.data["arc"], 1, "o")
left.set_xlabel("length of the path")
left.set_ylabel("t")

# %% The figures, seen from above
for solution in run.solutions:
    for bar in run.data["constraints"]:
        ends = np.array([solution[name] for name in bar["items"]])
        right.plot(ends[:, 0], ends[:, 1], color=f"C{solution.congruence_class}", linewidth=1)
right.set_aspect("equal")
figure.savefig("octahedron.png", dpi=120)

# %% How sure is each coordinate?
width = max(float((s.upper - s.lower).max()) for s in run.solutions)
print(f"every coordinate is enclosed to {width:.1e}")

# %% All figures there are, on this path or not
everything = krawl.complete("problems/octahedron.toml")
print(f"{len(run.solutions)} on the path, {len(everything.solutions)} in all: {everything.status}")
