#!/usr/bin/env python3
"""Checks a krawl certificate, from certs/README.md alone, with another method than krawl's own checker.

Distances only; paths and edits. Numbers are intervals of whole multiples of 2^-B. Every tube is cut into pieces, each proved
with a matrix of its own. Prints VERIFIED or why not; exit codes as those of `krawl verify`.

Usage: checker.py CERTIFICATE
"""
import hashlib, math, struct, sys, tomllib
from fractions import Fraction

B = 110
ONE = 1 << B


class NotProved(Exception):
    pass


def need(fact, what):
    if not fact:
        raise NotProved(what)


# Intervals (low, high) of multiples of 2^-B.
def exact(x):
    x = Fraction(x) * ONE
    return (math.floor(x), math.ceil(x))


def add(a, b): return (a[0] + b[0], a[1] + b[1])
def sub(a, b): return (a[0] - b[1], a[1] - b[0])
def hull(a, b): return (min(a[0], b[0]), max(a[1], b[1]))
def mag(a): return max(abs(a[0]), abs(a[1]))
def ball(r): return (-r, r)
def up(x): return -((-x) >> B)


def mul(a, b):
    p = (a[0] * b[0], a[0] * b[1], a[1] * b[0], a[1] * b[1])
    return (min(p) >> B, up(max(p)))


def div(a, b):
    need(b[0] > 0, "a division")
    q = [(x << B, y) for x in a for y in b]
    return (min(x // y for x, y in q), max(-(-x // y) for x, y in q))


def root(a): return (math.isqrt(a[0] << B), math.isqrt(a[1] << B) + 1)
def number(a): return (a[0] + a[1]) / 2 / ONE
def dot(v, w):
    lo = hi = 0
    for a, b in zip(v, w):
        p = mul(a, b)
        lo, hi = lo + p[0], hi + p[1]
    return (lo, hi)


def length(square, wanted, c=(0, 0)):
    """a(t), t^0 first, from the root of one number to that of another."""
    start, end = root(exact(square)), root(exact(wanted))
    if square == wanted:
        end = start
        return [start, c, sub((0, 0), c)]
    return [start, add(sub(end, start), c), sub((0, 0), c)]


class Problem:
    def __init__(self, text, unit):
        # Numbers keep all of their digits.
        data = tomllib.loads(text, parse_float=Fraction)
        self.d = d = data["dimension"]
        names = list(data["points"])
        at = [[Fraction(x) for x in data["points"][p]] for p in names]
        choices, rules = data["homotopy"], data["constraints"]
        known = {"distances", "squared_distances"}
        need(set(rules) <= known, "constraints other than distances are not for this checker")
        scale = Fraction(2) ** -unit
        reference = [names.index(p) for p in choices["reference"]]
        self.free, self.index = [], {}
        for p in range(len(names)):
            for axis in range(reference.index(p) if p in reference else d):
                self.index[p, axis] = len(self.free)
                self.free.append((p, axis))
        self.m = len(self.free)
        self.edges, self.squares = [], []
        for key in ("distances", "squared_distances"):
            for a, b, target in rules.get(key, []):
                i, j = names.index(a), names.index(b)
                square = sum((x - y) ** 2 for x, y in zip(at[i], at[j])) * scale**2
                target = Fraction(target)
                wanted = (target if key == "squared_distances" else target**2) * scale**2
                bends = {a, b} == set(choices["bend"])
                c = exact(Fraction(choices["bend_coefficient"]) * scale) if bends else (0, 0)
                ends = [(self.index.get((i, k)), self.index.get((j, k))) for k in range(d)]
                self.edges.append((ends, length(square, wanted, c)))
                self.squares.append((square, wanted))
        self.scale = scale
        need(len(self.edges) == self.m, "as many distances as free coordinates")
        self.sketch = self.gauge(at, reference, scale) + [(0, 0)]
        self.axes = [axis for _, axis in self.free]

    def gauge(self, at, reference, scale):
        def seen(p): return [exact((x - y) * scale) for x, y in zip(at[p], at[reference[0]])]
        def unit(v):
            length = root(dot(v, v))
            return [div(x, length) for x in v]
        def cross(a, b):
            return [sub(mul(a[i - 2], b[i - 1]), mul(a[i - 1], b[i - 2])) for i in range(3)]
        e1 = unit(seen(reference[1]))
        if self.d == 2:
            frame = [e1, [sub((0, 0), e1[1]), e1[0]]]
        else:
            e3 = unit(cross(e1, seen(reference[2])))
            frame = [e1, cross(e3, e1), e3]
        return [dot(frame[axis], seen(p)) for p, axis in self.free]

    # Polynomials in a parameter are lists of coefficients; z[i] is one.
    def along(self, z):
        """The coefficients of F, per equation."""
        out = []
        for ends, a in self.edges:
            f = []
            for i, j in ends:
                x = difference(z, i, j)
                f = plus(f, times(x, x))
            t = z[self.m]
            length = plus([a[0]], times(t, plus([a[1]], times(t, [a[2]]))))
            f = plus(f, [sub((0, 0), x) for x in times(length, length)])
            out.append([half(x) for x in f])
        return out

    def jacobian(self, z):
        """Rows as {unknown: entry}, for z in intervals."""
        rows = []
        for ends, a in self.edges:
            row = {}
            for i, j in ends:
                x = sub(z[i] if i is not None else (0, 0), z[j] if j is not None else (0, 0))
                if i is not None:
                    row[i] = x
                if j is not None:
                    row[j] = sub((0, 0), x)
            t = z[self.m]
            length = add(a[0], mul(t, add(a[1], mul(t, a[2]))))
            slope = add(a[1], mul(t, add(a[2], a[2])))
            row[self.m] = sub((0, 0), mul(length, slope))
            rows.append(row)
        return rows


def half(a): return (a[0] // 2, -(-a[1] // 2))
def difference(z, i, j):
    x = z[i] if i is not None else []
    y = [sub((0, 0), a) for a in z[j]] if j is not None else []
    return plus(x, y)


def plus(p, q):
    short, long = sorted((p, q), key=len)
    return [add(a, b) for a, b in zip(short, long)] + long[len(short):]


def times(p, q):
    out = [(0, 0)] * max(len(p) + len(q) - 1, 0)
    for i, a in enumerate(p):
        if a != (0, 0):
            for j, b in enumerate(q):
                out[i + j] = add(out[i + j], mul(a, b))
    return out


def at(p, s):
    out = (0, 0)
    for a in reversed(p):
        out = add(mul(out, s), a)
    return out


def moved(p, s):
    """p(s + x) as a polynomial in x."""
    out = []
    for a in reversed(p):
        out = plus(times(out, [s, exact(1)]), [a])
    return out


def inverse(rows, c, n):
    """A float inverse of a Jacobian's middle with the row c: any matrix will do."""
    a = [[number(row.get(i, (0, 0))) for i in range(n)] for row in rows] + [list(c)]
    for k, row in enumerate(a):
        row.extend(float(k == i) for i in range(n))
    for k in range(n):
        p = max(range(k, n), key=lambda i: abs(a[i][k]))
        a[k], a[p] = a[p], a[k]
        need(a[k][k] != 0.0, "a singular matrix")
        pivot = a[k][k]
        a[k] = [x / pivot for x in a[k]]
        for i in range(n):
            if i != k and a[i][k] != 0.0:
                f = a[i][k]
                a[i] = [x - f * y for x, y in zip(a[i], a[k])]
    return [[exact(x) for x in row[n:]] for row in a]


class Piece:
    """A part of a tube, with a matrix of its own: |I - Y [J; c] U| <= q on the box of radius r."""

    def __init__(self, tube, a, b, most):
        self.tube, self.a, self.b = tube, a, b
        problem, n = tube.problem, tube.n
        middle = (a + b) // 2
        d = max(b - middle, middle - a)
        z = [moved(p, (middle, middle)) for p in tube.z]
        here = [at(p, (0, 0)) for p in z]
        self.z = [at(p, ball(d)) for p in z]
        self.y = inverse(problem.jacobian(here), tube.c_float, n)
        self.q = self.contraction([add(x, ball(up(tube.r * u))) for x, u in zip(self.z, tube.u)])
        need(self.q < most, "a contraction")
        f = problem.along(z)
        power, bound = ONE, [0] * n
        for k in range(max(map(len, f))):
            column = [p[k] if k < len(p) else (0, 0) for p in f]
            for i, row in enumerate(self.y):
                bound[i] += up(mag(dot(row, column)) * power)
            power = up(power * d)
        eta = max(-(-(x << B) // u) for x, u in zip(bound, tube.u))
        need(eta < (ONE - self.q) * tube.r >> B, "a box mapped into itself")
        self.distance = -(-(eta << B) // (ONE - self.q))
        # The sum first: but for the first coefficients it is next to nothing.
        across = [dot(tube.c, column) for column in zip(*z)]
        advance = at(derivative(across), ball(d))
        need(advance[0] > 0, "cross-sections in order")
        self.advance = advance

    def contraction(self, box):
        rows, n, u = self.tube.problem.jacobian(box), self.tube.n, self.tube.u
        rows.append(dict(enumerate(self.tube.c)))
        most = 0
        for i, y in enumerate(self.y):
            entries = [(-ONE, -ONE) if j == i else (0, 0) for j in range(n)]
            for x, row in zip(y, rows):
                for j, value in row.items():
                    entries[j] = add(entries[j], mul(x, value))
            total = sum(up(mag(x) * w) for x, w in zip(entries, u))
            most = max(most, -(-(total << B) // u[i]))
        return most

    def solved(self, x):
        """At most |w|_u for DG w = x, with DG of the box."""
        size = max(-(-(mag(dot(y, x)) << B) // u) for y, u in zip(self.y, self.tube.u))
        return -(-(size << B) // (ONE - self.q))

    def tangent(self, box, steps=5):
        """The direction of the path at its points in a box, c T = 1: near any v, brought nearer in steps."""
        tube = self.tube
        v = [row[-1] for row in self.y]
        rows = tube.problem.jacobian(box)
        for _ in range(steps):
            v = [((x[0] + x[1]) // 2,) * 2 for x in v]
            off = [dot([v[j] for j in row], row.values()) for row in rows]
            off.append(sub(dot(tube.c, v), exact(1)))
            r, w = self.solved(off), v
            v = [sub(x, dot(y, off)) for x, y in zip(v, self.y)]
        v = w
        return [add(x, ball(up(r * u))) for x, u in zip(v, tube.u)]


def derivative(p): return [mul(exact(k), a) for k, a in enumerate(p)][1:]


class Tube:
    def __init__(self, problem, z0, c, u, h, r, s):
        # Of z0 in two parts the sum.
        self.problem, self.n = problem, problem.m + 1
        self.c_float, self.c = c, [exact(x) for x in c]
        self.u = [w * ONE >> 16 for w in u]
        self.h, self.r, self.s = exact(h)[0], exact(r)[0], exact(s)[0]
        zero = [exact(x) for x in z0]
        zero = [(x[0], x[0]) for x in zero]
        # A polynomial in s near the path: any would do.
        y = inverse(problem.jacobian(zero), c, self.n)
        self.z = [[x] for x in zero]
        for k in range(1, 6):
            f = [p[k] if k < len(p) else (0, 0) for p in problem.along(self.z)]
            f = [sub((0, 0), x) for x in f] + [exact(int(k == 1))]
            for p, row in zip(self.z, y):
                x = dot(row, f)[0]
                p.append((x, x))
        self.pieces = []
        self.cut(-self.h, self.h, 4)

    def cut(self, a, b, depth):
        try:
            need(depth < 4, "two pieces at least")
            # Better short pieces and good bounds, if that can be had.
            self.pieces.append(Piece(self, a, b, ONE // 2 if depth else ONE))
        except NotProved:
            if depth == 0:
                raise
            middle = (a + b) // 2
            self.cut(a, middle, depth - 1)
            self.cut(middle, b, depth - 1)

    def piece(self, s):
        return next(p for p in self.pieces if p.a <= s <= p.b)

    def exit(self, at_s=None, digits=20, most=8):
        """A box around the point where the path leaves, or is at another parameter, and its direction there."""
        at_s = self.s if at_s is None else at_s
        s = (at_s, at_s)
        piece = self.piece(at_s)
        start = [at(p, s) for p in self.z]
        w = [(0, 0)] * self.n
        for step in range(most):
            f = self.value([add(x, y) for x, y in zip(start, w)]) + [dot(self.c, w)]
            radius = piece.solved(f)
            need(all(mag(x) < up(self.r * u) for x, u in zip(w, self.u)), "an exit")
            if radius < self.r >> digits or step == most - 1:
                break
            off = [dot(y, f) for y in piece.y]
            w = [((x[0] - y[0]),) * 2 for x, y in zip(w, off)]
        box = [add(add(x, y), ball(up(radius * u))) for x, y, u in zip(start, w, self.u)]
        return box, piece.tangent(box, 5 if most == 8 else most)

    def value(self, z):
        return [f[0] for f in self.problem.along([[x] for x in z])]

    def locate(self, z):
        """The parameters of a zero of F in a box."""
        advance = self.pieces[0].advance
        for piece in self.pieces:
            advance = hull(advance, piece.advance)
        s = div(dot(self.c, [sub(x, p[0]) for x, p in zip(z, self.z)]), advance)
        if mag(s) > self.h:
            return None
        off = [mag(sub(x, at(p, s))) for x, p in zip(z, self.z)]
        return s if all(x < self.r * u >> B for x, u in zip(off, self.u)) else None

    def box(self, s):
        """Where the path is for parameters s; with the pieces that hold these."""
        pieces = [p for p in self.pieces if p.a <= s[1] and p.b >= s[0]]
        distance = max(p.distance for p in pieces)
        middle = (s[0] + s[1]) // 2
        d = max(s[1] - middle, middle - s[0])
        z = [at(moved(p, (middle, middle)), ball(d)) for p in self.z]
        return [add(x, ball(up(distance * u))) for x, u in zip(z, self.u)], pieces

    def rises(self, s):
        """The sign of dt/ds where it has one."""
        box, pieces = self.box(s)
        slopes = [p.tangent(box, 2)[-1] for p in pieces]
        if all(x[0] > 0 for x in slopes):
            return 1
        return -1 if all(x[1] < 0 for x in slopes) else 0

    def climbs(self, a, b, depth=30):
        """t rises between two parameters."""
        if self.rises((a, b)) == 1:
            return
        need(depth > 0 and b > a, "t rises")
        self.climbs(a, (a + b) // 2, depth - 1)
        self.climbs((a + b) // 2, b, depth - 1)

    def keeps(self, a, b, signs, depth=20):
        """Triangles or tetrahedra keep their signs between two parameters."""
        if not signs:
            return
        box = self.box((a, b))[0]
        left = [x for x in signs if determinant(self.problem, box, x[0])[x[1] == 0] * (1 if x[1] else -1) <= 0]
        need(depth > 0 or not left, "signs are kept")
        if left:
            self.keeps(a, (a + b) // 2, left, depth - 1)
            self.keeps((a + b) // 2, b, left, depth - 1)

    def turn(self, entry, fold, signs):
        """t rises up to a fold in the claimed box: t'' < 0 where the sign of t' is not known, and t' changes there."""
        need(self.exit(entry[1])[1][-1][0] > 0 or self.rises(entry) == 1, "t rises at the entry")
        a, b = entry[1], self.h
        # Where t' is certainly positive up to, and where certainly negative: first coarsely.
        steps = 256
        places = [a + (b - a) * k // steps for k in range(steps + 1)]
        k = next((k for k in range(1, steps + 1) if self.exit(places[k])[1][-1][1] < 0), None)
        need(k, "t falls behind the fold")
        high = places[k]
        for back in (2, 4, 8, 16, 32, 64, 128, 256):
            low = places[k - back] if k > back else entry[0]
            try:
                if k > back:
                    self.climbs(entry[0], low, 12)
                self.bends_down(low, high, 8)
                break
            except NotProved:
                need(k > back, "t rises up to the fold")
        self.keeps(entry[0], high, signs)
        for _ in range(80):
            middle = (low + high) // 2
            slope = self.exit(middle, 60, 80)[1][-1]
            if slope[0] > 0:
                low = middle
            elif slope[1] < 0:
                high = middle
            else:
                break
        # The fold is between the two.
        centre, radius, t, t_radius = fold
        box, _ = self.exit(low, 60, 80)
        pieces = self.box((low, high))[0]
        span = (0, high - low)
        tangent = [p.tangent(pieces, 2) for p in self.pieces if p.a <= high and p.b >= low]
        for i, x in enumerate(box):
            reach = x
            for v in tangent:
                reach = hull(reach, add(x, mul(v[i], span)))
            middle, room = (exact(t), exact(t_radius)) if i == self.n - 1 else (exact(centre[i]), exact(radius))
            need(mag(sub(reach, middle)) < room[0], "the fold is in its box")

    def bends_down(self, a, b, depth=20):
        """t'' < 0 between two parameters, of the curve by its own: J phi'' = -(second derivatives of F along phi')."""
        box, pieces = self.box((a, b))
        ok = True
        for piece in pieces:
            v = piece.tangent(box, 2)
            t = box[-1]
            f = []
            for ends, length in self.problem.edges:
                total = (0, 0)
                for i, j in ends:
                    x = sub(v[i] if i is not None else (0, 0), v[j] if j is not None else (0, 0))
                    total = add(total, mul(x, x))
                a0, a1, a2 = length
                value, slope = add(a0, mul(t, add(a1, mul(t, a2)))), add(a1, mul(t, add(a2, a2)))
                bend = add(mul(slope, slope), mul(value, add(a2, a2)))
                f.append(sub(mul(bend, mul(v[-1], v[-1])), total))
            f.append((0, 0))
            # Near Y f, and how far: of what is left of the equations.
            w = [(x[0] + x[1]) // 2 for x in (dot(y, f) for y in piece.y)]
            w = [(x, x) for x in w]
            rows = self.problem.jacobian(box)
            off = [sub(dot([w[j] for j in row], row.values()), x) for row, x in zip(rows, f)]
            off.append(dot(self.c, w))
            r = piece.solved(off)
            ok = ok and add(w[-1], ball(up(r * self.u[-1])))[1] < 0
        if ok:
            return
        need(depth > 0 and b - a > 1, "t turns")
        self.bends_down(a, (a + b) // 2, depth - 1)
        self.bends_down((a + b) // 2, b, depth - 1)

    def account(self, a, b, solutions, depth=60):
        """t = 1 between two parameters only at these solutions' parameters."""
        t = self.box((a, b))[0][-1]
        if not t[0] <= ONE <= t[1]:
            return
        if any(self.rises(hull((a, b), s)) for s in solutions):
            return
        if self.rises((a, b)):
            ends = [self.box((x, x))[0][-1] for x in (a, b)]
            if all(x[1] < ONE for x in ends) or all(x[0] > ONE for x in ends):
                return
        need(depth > 0, f"t = 1 between {a / self.h:.6f} and {b / self.h:.6f} of the half length")
        self.account(a, (a + b) // 2, solutions, depth - 1)
        self.account((a + b) // 2, b, solutions, depth - 1)


def solution(problem, centre, radius):
    """Proves that a box holds exactly one figure with t = 1: a narrow box around that."""
    m, r = problem.m, exact(radius)[0]
    middle = [(exact(x)[0],) * 2 for x in centre] + [exact(1)]
    last = [0.0] * m + [1.0]
    y = inverse(problem.jacobian(middle), last, m + 1)
    box = [add(x, ball(r)) for x in middle[:m]] + [exact(1)]
    rows = problem.jacobian(box)
    q = 0
    for i in range(m):
        entries = [(-ONE, -ONE) if j == i else (0, 0) for j in range(m)]
        for x, row in zip(y[i], rows):
            for j, value in row.items():
                if j < m:
                    entries[j] = add(entries[j], mul(x, value))
        q = max(q, sum(mag(x) for x in entries))
    f = [p[0] for p in problem.along([[x] for x in middle])]
    eta = max(mag(dot(row[:m], f)) for row in y[:m])
    need(q < ONE and eta < (ONE - q) * r >> B, "a solution's box")
    narrow = -(-(eta << B) // (ONE - q))
    return box, [add(x, ball(narrow)) for x in middle[:m]] + [exact(1)]


def determinant(problem, z, points):
    """Of the differences of some points from the first."""
    def side(p, axis):
        def of(p): return z[problem.index[p, axis]] if (p, axis) in problem.index else (0, 0)
        return sub(of(p), of(points[0]))
    rows = [[side(p, axis) for axis in range(problem.d)] for p in points[1:]]
    def minor(v, w, i, j): return sub(mul(v[i], w[j]), mul(v[j], w[i]))
    if problem.d == 2:
        return minor(rows[0], rows[1], 0, 1)
    u, v, w = rows
    total = mul(u[0], minor(v, w, 1, 2))
    return add(add(total, mul(u[1], minor(v, w, 2, 0))), mul(u[2], minor(v, w, 0, 1)))


def apart(a, b): return any(x[1] < y[0] or y[1] < x[0] for x, y in zip(a, b))


def congruent(problem, a, b):
    for mask in range(1, 1 << problem.d):
        image = [sub((0, 0), x) if mask >> axis & 1 else x for x, axis in zip(a, problem.axes)]
        if not apart(image, b):
            return True
    return False


class File:
    def __init__(self, data): self.data, self.at = data, 0
    def read(self, form):
        size = struct.calcsize("<" + form)
        values = struct.unpack_from("<" + form, self.data, self.at)
        self.at += size
        return values
    def text(self):
        (size,) = self.read("I")
        self.at += size
        return self.data[self.at - size:self.at]


def check(data):
    file = File(data)
    assert file.read("18s")[0] == b"krawl certificate\n", "no certificate"
    assert file.read("I")[0] == 3, "another version"
    file.text()
    (digest,) = file.read("32s")
    text = file.text()
    assert hashlib.sha256(text).digest() == digest, "another problem's hash"
    problem = Problem(text.decode(), file.read("h")[0])
    m, n = problem.m, problem.m + 1
    records = []
    while True:
        (tag,) = file.read("B")
        if tag in (1, 8):
            z = [Fraction(x) for x in file.read(f"{n}d")]
            if tag == 8:
                z = [x + Fraction(y) for x, y in zip(z, file.read(f"{n}d"))]
            c, u = file.read(f"{n}f"), file.read(f"{n}H")
            records.append(("tube", (z, c, u, *file.read("dfd"))))
        elif tag in (2, 6):
            records.append(({2: "solution", 6: "reached"}[tag], (file.read(f"{m}d"), file.read("f")[0])))
        elif tag == 4:
            records.append(("turn", None))
        elif tag == 5:
            led = []
            for _ in range(file.read("I")[0]):
                (index,) = file.read("I")
                led.append((index, Fraction(file.text().decode())))
            signs = []
            for _ in range(file.read("I")[0]):
                signs.append((file.read(f"{problem.d + 1}I"), file.read("B")[0]))
            records.append(("arc", (led, signs)))
        elif tag == 7:
            records.append(("fold", (file.read(f"{m}d"), *file.read("fdf"))))
        else:
            assert tag == 3, "no such record"
            break
    (ending,) = file.read("B")
    for _ in range(ending):
        file.text()
    count, solutions = file.read("QI")
    classes = file.read(f"{solutions}I")
    kinds = [kind for kind, _ in records]
    assert file.at == len(data) and count == kinds.count("tube")
    need(ending != 1, "the run stopped")
    if "arc" in kinds:
        assert ending == 0 and kinds[0] == "arc" and solutions == 0, "the order of records"
        edits(problem, records)
        return count, f"{kinds.count('arc')} edits"
    assert (ending == 2) == ("turn" in kinds), "the order of records"

    listed, met, before, first = [], set(), None, None
    turned = False
    for position, (kind, claim) in enumerate(records):
        if kind == "turn":
            need(before is not None and not turned, "one turn")
            before, turned = None, True
        if kind != "tube":
            continue
        tube = Tube(problem, *claim)
        following = position + 1
        while following < len(records) and records[following][0] == "solution":
            listed.append(solution(problem, *records[following][1]))
            following += 1
        closes = following == len(records) and not turned
        entry, direction = enter(tube, before, problem.sketch)
        if before is None:
            if turned:
                need(dot(first, tube.c)[1] < 0, "the other way")
            else:
                first = direction
        leave = (tube.s, tube.s)
        if closes:
            need(before is not None, "more than one tube")
            leave = tube.locate(problem.sketch)
            need(leave, "the sketch in the last tube")
            need(dot(first, tube.c)[0] > 0, "the direction of the start")
        need(entry[1] < leave[0], "an exit behind the entry")
        here = []
        for k, (_, narrow) in enumerate(listed):
            s = tube.locate(narrow)
            if s:
                # A tube of an arc reaches beyond its last exit; that is not of the arc.
                if "turn" not in kinds or entry[1] <= s[0] and s[1] <= leave[0]:
                    met.add(k)
                here.append(s)
        tube.account(entry[0], leave[1], here)
        before = None if closes else tube.exit()
    need((before is None) != turned and records, "the end")
    need(met == set(range(solutions)), "solutions that are met")
    numbers = []
    for k, (box, narrow) in enumerate(listed):
        same = None
        for j, (other, other_narrow) in enumerate(listed[:k]):
            need(apart(box, other), "disjoint boxes")
            if congruent(problem, narrow, other_narrow):
                same = numbers[j]
        numbers.append(max(numbers, default=-1) + 1 if same is None else same)
    need(tuple(numbers) == classes, "the classes")
    return count, f"{solutions} solutions"


def enter(tube, before, start):
    """Where the path comes into a tube; at the beginning also its direction there."""
    if before is not None:
        box, direction = before
        entry = tube.locate(box)
        need(entry, "a link")
        need(dot(direction, tube.c)[0] > 0, "a link's direction")
        return entry, None
    entry = tube.locate(start)
    need(entry, "where it begins, in the first tube")
    # It may be where two pieces meet.
    pieces = [p for p in tube.pieces if p.a <= entry[1] and p.b >= entry[0]]
    tangents = [p.tangent(start) for p in pieces]
    direction = tangents[0]
    for other in tangents[1:]:
        direction = [hull(x, y) for x, y in zip(direction, other)]
    return entry, direction


def edits(problem, records):
    """Arcs one after the other."""
    start, before, signs, number = problem.sketch, None, [], 0
    now = [a for a, _ in problem.squares]
    for position, (kind, claim) in enumerate(records):
        if kind == "arc":
            led, signs = claim
            number += 1
            wanted = [b for _, b in problem.squares] if number == 1 else list(now)
            if number == 1 and led:
                need(now == wanted, "the sketch meets its dimensions")
            for index, value in led:
                wanted[index] = (value * problem.scale) ** 2
            problem.edges = [(ends, length(a, b)) for (ends, _), a, b in zip(problem.edges, now, wanted)]
            now, before = wanted, None
        if kind != "tube":
            continue
        tube = Tube(problem, *claim)
        entry, direction = enter(tube, before, start)
        if before is None:
            need(direction[-1][0] > 0, "t rises at the beginning")
        what, end = records[position + 1] if position + 1 < len(records) else ("", None)
        if what == "fold":
            tube.turn(entry, end, signs)
            need(position + 2 == len(records), "nothing behind a fold")
            continue
        leave = (tube.s, tube.s)
        if what == "reached":
            box, narrow = solution(problem, *end)
            leave = tube.locate(narrow)
            need(leave, "the figure in the last tube")
            start = narrow[:-1] + [(0, 0)]
        need(entry[1] < leave[0], "an end behind the entry")
        tube.climbs(entry[0], leave[1])
        tube.keeps(entry[0], leave[1], signs)
        before = tube.exit() if what == "tube" else None
        need(what in ("tube", "reached"), "every arc has an end")


if __name__ == "__main__":
    try:
        with open(sys.argv[1], "rb") as file:
            tubes, solutions = check(file.read())
        print(f"VERIFIED: {tubes} tubes, {solutions}")
    except NotProved as fault:
        print(f"NOT PROVED: {fault}")
        sys.exit(3)
    except (AssertionError, struct.error) as fault:
        print(f"no certificate: {fault}")
        sys.exit(2)
