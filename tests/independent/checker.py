#!/usr/bin/env python3
"""Checks a krawl certificate after docs/how/certificates.md, with another method than krawl's own checker.

Paths, and edits of distances; of other constraints those of the section *Other constraints*. Numbers are intervals of whole
multiples of 2^-B. Every tube is cut into pieces, each proved with a matrix of its own. Prints VERIFIED or why not; exit codes as
those of `krawl verify`.

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
    if b[0] == b[1]:
        a, b = b, a
    x = a[0]
    if x == a[1]:
        return (x * b[0] >> B, up(x * b[1])) if x >= 0 else (x * b[1] >> B, up(x * b[0]))
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


def row_times(y, v):
    """Of a row of whole multiples, exactly."""
    lo = hi = 0
    for a, b in zip(y, v):
        if a >= 0:
            lo, hi = lo + a * b[0], hi + a * b[1]
        else:
            lo, hi = lo + a * b[1], hi + a * b[0]
    return (lo >> B, up(hi))


def goes(start, end):
    """From one number to another, t^0 first."""
    return [start] if start == end else [start, sub(end, start)]


def length(square, wanted, c=(0, 0)):
    """a(t) from the root of one number to that of another."""
    start, end = root(exact(square)), root(exact(wanted))
    if square == wanted:
        end = start
    slope = add(sub(end, start), c)
    return [start, slope, sub((0, 0), c)] if c != (0, 0) else [start, slope][:1 + (square != wanted)]


def cosine(degrees):
    """The sum of the first terms, and a ball of the size of the next one."""
    def arctan_of_reciprocal(n):
        terms = [Fraction((-1) ** k, (2 * k + 1) * n ** (2 * k + 1)) for k in range(B)]
        return sum(terms), Fraction(1, n ** (2 * B))
    (a, off), (b, other) = arctan_of_reciprocal(5), arctan_of_reciprocal(239)
    half_turn, off = 16 * a - 4 * b, 16 * off + 4 * other
    x = mul(exact(degrees / 180), hull(exact(half_turn - off), exact(half_turn + off)))
    square, term, total = mul(x, x), exact(1), (0, 0)
    for k in range(1, 60):
        total = add(total, term)
        term = mul(term, mul(square, exact(Fraction(-1, (2 * k - 1) * 2 * k))))
    return add(total, ball(mag(term)))


def f_dot(v, w): return sum(x * y for x, y in zip(v, w))
def f_minus(v, w): return [x - y for x, y in zip(v, w)]
def f_cross(a, b): return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]


class Problem:
    """Its equations: sums of factor * form * form, which are 2 E(t). Forms are differences of two unknowns, None being 0, or the
    number 1, which is None."""

    def __init__(self, text, unit):
        # Numbers keep all of their digits.
        data = tomllib.loads(text, parse_float=Fraction)
        self.d = d = data["dimension"]
        self.names = names = list(data["points"])
        self.scale = scale = Fraction(2) ** -unit
        known = {"name", "dimension", "source", "published", "labels", "points", "lines", "planes", "constraints", "homotopy"}
        need(set(data) <= known, "objects that are not for this checker")
        self.at = at = [[Fraction(x) * scale for x in data["points"][p]] + [Fraction(0)] * (3 - d) for p in names]
        choices, self.rules = data["homotopy"], data["constraints"]
        need(choices.get("reference"), "a reference")
        self.detour = Fraction(choices.get("detour", 0))
        self.reference = reference = [names.index(p) for p in choices["reference"]]
        self.free, self.index = [], {}
        # What reverses the sign of each unknown: an axis, or the direction of a line or normal of a plane.
        self.turned = []
        for p in range(len(names)):
            for axis in range(reference.index(p) if p in reference else d):
                self.index[p, axis] = len(self.free)
                self.free.append((p, axis))
                self.turned.append({axis})
        self.axes_of_gauge()
        self.sketch = [self.seen(f_minus(at[p], at[reference[0]]), axis) for p, axis in self.free]
        self.equations, self.squares, self.given = [], [], {}
        others = []
        for key in ("distances", "squared_distances"):
            for entry in self.rules.get(key, []):
                if len(entry) != 3 or not {entry[0], entry[1]} <= set(names):
                    others.append(entry)
                    continue
                a, b, target = entry
                i, j = names.index(a), names.index(b)
                square = f_dot(f_minus(at[i], at[j]), f_minus(at[i], at[j]))
                target = Fraction(target)
                wanted = (target if key == "squared_distances" else target**2) * scale**2
                bends = {a, b} == set(choices.get("bend", []))
                c = exact(Fraction(choices["bend_coefficient"]) * scale) if bends else (0, 0)
                way = length(square, wanted, c)
                self.given[frozenset((i, j))] = way
                forms = [(self.index.get((i, k)), self.index.get((j, k))) for k in range(d)]
                self.equations.append(([(1, f, f) for f in forms], times(way, way), None))
                self.squares.append((square, wanted))
        # Unknowns that are positive, and vectors that are not zero, along the path.
        self.positive, self.nonzero = [], []
        self.is_general = bool(others or data.get("lines") or data.get("planes") or set(self.rules) - {"distances", "squared_distances"})
        Constraints(self, data, others)
        self.sketch.append((0, 0))
        self.m = len(self.turned)
        need(len(self.equations) == self.m, "as many equations as unknowns")
        self.prepare()

    def axes_of_gauge(self):
        """Vectors along the axes of the gauge, exactly."""
        p = [self.at[k] for k in self.reference]
        along = f_minus(p[1], p[0])
        if self.d == 2:
            self.axes = [along, [-along[1], along[0], Fraction(0)]]
        else:
            normal = f_cross(along, f_minus(p[2], p[0]))
            self.axes = [along, f_cross(normal, along), normal]

    def seen(self, v, axis):
        along = self.axes[axis]
        product = f_dot(v, along)
        return div(exact(product), root(exact(f_dot(along, along)))) if product else (0, 0)

    def prepare(self):
        """Lists of forms, and of the terms of derivatives."""
        self.forms, number = [], {}
        self.products, self.gradient = [], []
        for terms, _, _ in self.equations:
            products, gradient = [], {}
            for factor, left, right in terms:
                for form in (left, right):
                    if form not in number:
                        number[form] = len(self.forms)
                        self.forms.append(form)
                l, r = number[left], number[right]
                products.append((factor, l, r))
                for of, by in ((left, r), (right, l)):
                    for i, sign in zip(of or (), (1, -1)):
                        if i is not None:
                            gradient.setdefault(i, []).append((factor * sign, by))
            self.products.append(products)
            self.gradient.append(gradient)

    def of_form(self, z, form):
        if form is None:
            return exact(1)
        i, j = form
        return sub(z[i] if i is not None else (0, 0), z[j] if j is not None else (0, 0))

    # Polynomials in a parameter are lists of coefficients; z[i] is one.
    def along(self, z):
        """The coefficients of F, per equation."""
        forms = [[exact(1)] if form is None else difference(z, *form) for form in self.forms]
        t, out = z[self.m], []
        for products, (_, right, _) in zip(self.products, self.equations):
            f = []
            for factor, l, r in products:
                f = plus(f, [(factor * a, factor * b)[::1 if factor > 0 else -1] for a, b in times(forms[l], forms[r])])
            e = []
            for x in reversed(right):
                e = plus(times(e, t), [x])
            out.append([half(x) for x in plus(f, [sub((0, 0), x) for x in e])])
        return out

    def jacobian(self, z):
        """Rows as {unknown: entry}, for z in intervals."""
        forms, t, rows = [self.of_form(z, form) for form in self.forms], z[self.m], []
        for gradient, (_, right, _) in zip(self.gradient, self.equations):
            row = {}
            for i, terms in gradient.items():
                lo = hi = 0
                for factor, form in terms:
                    a, b = forms[form]
                    lo, hi = (lo + factor * a, hi + factor * b) if factor > 0 else (lo + factor * b, hi + factor * a)
                row[i] = half((lo, hi))
            if len(right) > 1:
                row[self.m] = half(sub((0, 0), at(derivative(right), t)))
            rows.append(row)
        return rows

    def bend(self, z, v):
        """The second derivatives of F along v."""
        forms, t, out = [self.of_form(v, form) if form else (0, 0) for form in self.forms], z[self.m], []
        for products, (_, right, _) in zip(self.products, self.equations):
            total = sub((0, 0), mul(at(derivative(derivative(right)), t), mul(v[-1], v[-1])))
            for factor, l, r in products:
                x = mul(forms[l], forms[r]) if l != r else square(forms[l])
                total = add(total, mul(exact(2 * factor), x))
            out.append(half(total))
        return out


class Vector:
    """forms: its coordinates; at: these in the sketch, in the file's axes; given: its length as a polynomial, or None; turned: what
    reverses its sign beside what the axes do; power: of the unit of length."""

    def __init__(self, key, forms, at, given, turned, power):
        self.key, self.forms, self.at, self.given, self.turned, self.power = key, forms, at, given, turned, power


class Constraints:
    """Adds the unknowns and equations of all that is no distance between two points."""

    def __init__(self, problem, data, distances):
        self.p, self.d = problem, problem.d
        self.lengths, self.crosses, self.objects = {}, {}, {}
        known = {"distances", "squared_distances", "angles", "coplanar", "parallel", "perpendicular"}
        need(set(problem.rules) <= known, "constraints that are not for this checker")
        self.origin = problem.at[problem.reference[0]]
        for table in ("lines", "planes"):
            for name, shape in data.get(table, {}).items():
                self.objects[name] = (table, shape if isinstance(shape, list) else self.own(table, name, shape))
        for entry in distances:
            self.distance(entry[:-1], Fraction(entry[-1]) * problem.scale)
        for entry in problem.rules.get("angles", []):
            self.angle(entry[:-1], Fraction(entry[-1]))
        for entry in problem.rules.get("coplanar", []):
            self.coplanar([problem.names.index(p) for p in entry])
        for key in ("parallel", "perpendicular"):
            for entry in problem.rules.get(key, []):
                (u, one), (v, other) = self.directions(entry)
                if (one == other) == (key == "perpendicular"):
                    self.perpendicular(u, v)
                else:
                    self.parallel(u, v)

    # Unknowns and equations.
    def unknown(self, sketch, turned=frozenset()):
        self.p.sketch.append(sketch)
        self.p.turned.append(set(turned))
        return len(self.p.turned) - 1

    def equate(self, terms, right, ends_at_zero):
        terms = [(2 * factor, l, r) for factor, l, r in terms if l != (None, None) and r != (None, None)]
        self.p.equations.append((terms, [add(x, x) for x in right], ends_at_zero))

    def coordinates(self, seen, turned):
        return [self.unknown(x, {axis} ^ turned) for axis, x in enumerate(seen)]

    def own(self, table, name, shape):
        """The base, or level, and the direction or normal of an object of its own."""
        p, d = self.p, self.d
        padded = lambda v: [Fraction(x) for x in v] + [Fraction(0)] * (3 - d)
        at = f_minus([x * p.scale for x in padded(shape["point"])], self.origin)
        along = padded(shape["direction" if table == "lines" else "normal"])
        square = f_dot(along, along)
        seen = [p.seen(along, axis) for axis in range(d)]
        if table == "lines":
            base = f_minus(at, [f_dot(at, along) / square * x for x in along])
            b = [(i, None) for i in self.coordinates([p.seen(base, axis) for axis in range(d)], set())]
        forms = [(i, None) for i in self.coordinates(seen, {name})]
        self.equate([(1, f, f) for f in forms], [exact(square)], False)
        vector = Vector(name, forms, along, [root(exact(square))], {name}, 0)
        if table == "lines":
            self.equate([(1, f, g) for f, g in zip(b, forms)], [(0, 0)], True)
            return ([f[0] for f in b], base), vector
        level = f_dot(along, at)
        return (self.unknown(exact(level), {name}), level), vector

    def span(self, a, b):
        forms = [(self.p.index.get((b, k)), self.p.index.get((a, k))) for k in range(self.d)]
        given = self.p.given.get(frozenset((a, b)))
        return Vector((a, b), forms, f_minus(self.p.at[b], self.p.at[a]), given, set(), 1)

    def cross(self, u, v):
        key = (u.key, v.key)
        if key not in self.crosses:
            at, turned = f_cross(u.at, v.at), u.turned ^ v.turned ^ {0, 1, 2}
            w = self.coordinates([self.p.seen(at, axis) for axis in range(3)], turned)
            for k in range(3):
                i, j = (k + 1) % 3, (k + 2) % 3
                terms = [(1, (w[k], None), None), (-1, u.forms[i], v.forms[j]), (1, u.forms[j], v.forms[i])]
                self.equate(terms, [(0, 0)], True)
            self.crosses[key] = Vector(key, [(i, None) for i in w], at, None, turned, u.power + v.power)
        return self.crosses[key]

    def length(self, v):
        if v.key not in self.lengths:
            i = self.unknown(sketch_length(v))
            if v.given:
                self.equate([(1, (i, None), None)], v.given, False)
            else:
                self.equate([(1, f, f) for f in v.forms] + [(-1, (i, None), (i, None))], [(0, 0)], True)
                self.p.positive.append(i)
            self.lengths[v.key] = (i, None)
        return self.lengths[v.key]

    # Ways to say something. Terms are those of P, start is its value in the sketch.
    def way_to_zero(self, start, power):
        if start != (0, 0):
            return [start, sub((0, 0), start)]
        by = exact(self.p.detour * self.p.scale**power)
        return [(0, 0), by, sub((0, 0), by)] if by != (0, 0) else [(0, 0)]

    def vanish(self, terms, start, power):
        self.equate(terms, self.way_to_zero(start, power), True)

    def number(self, start, target, vectors):
        """Of P, the product of the vectors' lengths and a number, this number."""
        for v in vectors:
            start = div(start, sketch_length(v)) if start != (0, 0) else start
        return goes(start, target)

    def measure(self, terms, start, target, vectors):
        right, left = self.number(exact(start), target, vectors), []
        for v in vectors:
            if v.given:
                right = times(right, v.given)
            else:
                left.append(v)
        if not left:
            return self.equate(terms, right, False)
        size = [self.length(v) for v in left]
        if len(left) == 2:
            both = self.unknown(mul(*(sketch_length(v) for v in left)))
            self.equate([(1, (both, None), None), (-1, *size)], [(0, 0)], True)
            size = [(both, None)]
        number = self.unknown(right[0])
        self.equate([(1, (number, None), None)], right, False)
        self.equate(terms + [(-1, (number, None), size[0])], [(0, 0)], True)

    def not_zero(self, v):
        if not v.given:
            self.p.nonzero.append(v.forms)

    def perpendicular(self, u, v):
        self.not_zero(u)
        self.not_zero(v)
        self.vanish(product(1, u, v), exact(f_dot(u.at, v.at)), u.power + v.power)

    def parallel(self, u, v):
        self.not_zero(u)
        self.not_zero(v)
        if self.d == 2:
            start = u.at[0] * v.at[1] - u.at[1] * v.at[0]
            return self.vanish(product_in_plane(u, v.forms), exact(start), u.power + v.power)
        factor = f_dot(u.at, v.at) / f_dot(u.at, u.at)
        rest = f_minus(v.at, [factor * x for x in u.at])
        k = self.unknown(exact(factor), u.turned ^ v.turned)
        for axis in range(3):
            start = self.p.seen(rest, axis)
            way = [start, sub((0, 0), start)] if start != (0, 0) else [start]
            self.equate([(1, v.forms[axis], None), (-1, (k, None), u.forms[axis])], way, True)

    # What entries name: point numbers, or lines and planes.
    def point(self, items): return self.p.names.index(items.pop(0))
    def sort(self, items): return "points" if items[0] in self.p.names else self.objects[items[0]][0]

    def line(self, items):
        """Base, where that is in the sketch, and direction."""
        shape = None if self.sort(items) == "points" else self.objects[items.pop(0)][1]
        if shape is None or isinstance(shape, list):
            a, b = map(self.p.names.index, shape or [items.pop(0), items.pop(0)])
            return self.place(a), self.span(a, b)
        (base, at), along = shape
        return (base, [x + o for x, o in zip(at, self.origin)]), along

    def plane(self, items):
        """The normal; the terms of the height of a place; and that in the sketch."""
        shape = None if self.sort(items) == "points" else self.objects[items.pop(0)][1]
        if shape is None or isinstance(shape, list):
            a, b, c = map(self.p.names.index, shape or [items.pop(0) for _ in range(3)])
            normal, (base, at) = self.cross(self.span(a, b), self.span(a, c)), self.place(a)
            height = lambda x: [(1, n, (i, j)) for n, i, j in zip(normal.forms, x, base)]
            return normal, height, lambda x: f_dot(normal.at, f_minus(x, at))
        (level, at), normal = shape
        height = lambda x: [(1, n, (i, None)) for n, i in zip(normal.forms, x)] + [(-1, (level, None), None)]
        return normal, height, lambda x: f_dot(normal.at, f_minus(x, self.origin)) - at

    def place(self, p): return [self.p.index.get((p, k)) for k in range(self.d)], self.p.at[p]

    def directions(self, entry):
        """Two directions or normals, and whether they are normals."""
        items, out = list(entry), []
        while items:
            ahead = next((k for k, x in enumerate(items) if x not in self.p.names), len(items))
            is_plane = self.sort(items) == "planes" or self.d == 3 and ahead in (3, 6)
            out.append((self.plane(items)[0], True) if is_plane else (self.line(items)[1], False))
        return out

    # Kinds.
    def distance(self, entry, target):
        items = list(entry)
        if self.sort(items) == "points":
            point = self.point(items)
        elif self.sort(items) == "planes" or len(items) == 2 and items[1] in self.p.names:
            point = self.p.names.index(items.pop())
        else:
            (b, b_at), u = self.line(items)
            (c, c_at), v = self.line(items)
            w = self.cross(u, v)
            start = f_dot(w.at, f_minus(c_at, b_at))
            terms = [(1, n, (i, j)) for n, i, j in zip(w.forms, c, b)]
            return self.measure(terms, start, like(start, exact(target)), [w])
        x, at = self.place(point)
        if self.sort(items) == "planes" or self.d == 3 and len(items) == 3:
            normal, height, in_sketch = self.plane(items)
            start = in_sketch(at)
            return self.measure(height(x), start, like(start, exact(target)), [normal])
        (base, base_at), u = self.line(items)
        across, off = [(i, j) for i, j in zip(x, base)], f_minus(at, base_at)
        if self.d == 2:
            start = u.at[0] * off[1] - u.at[1] * off[0]
            return self.measure(product_in_plane(u, across), start, like(start, exact(target)), [u])
        size, along = self.length(u), f_dot(u.at, off)
        q = self.unknown(div(exact(along), sketch_length(u)), u.turned)
        terms = [(-1, f, g) for f, g in zip(u.forms, across)] + [(1, (q, None), size)]
        self.equate(terms, [(0, 0)], True)
        square = f_dot(off, off) - along**2 / f_dot(u.at, u.at)
        way = length(square, target**2)
        self.equate([(1, f, f) for f in across] + [(-1, (q, None), (q, None))], times(way, way), False)

    def opposite(self, a, b, c, target):
        """The angle at b, with the cosine's target, by the square of the side opposite; None: it vanishes."""
        u, v = self.span(b, a), self.span(b, c)
        start = exact(f_dot(u.at, v.at))
        if target is None:
            inner = self.way_to_zero(start, 2)
        else:
            inner = times(times(self.number(start, target, [u, v]), u.given), v.given)
        squares = plus(times(u.given, u.given), times(v.given, v.given))
        # Of |a - c|^2, without the halves on either side.
        right = plus(squares, [sub((0, 0), add(x, x)) for x in inner])
        self.p.equations.append(([(1, f, f) for f in self.span(a, c).forms], right, False))

    def angle(self, entry, degrees):
        names, target = self.p.names, None if degrees == 90 else cosine(degrees)
        if len(entry) == 3 and entry[0] in names:
            a, b, c = map(names.index, entry)
            u, v = self.span(b, a), self.span(b, c)
            if u.given and v.given:
                return self.opposite(a, b, c, target)
            if target is None:
                return self.perpendicular(u, v)
            return self.measure(product(1, u, v), f_dot(u.at, v.at), target, [u, v])
        (u, one), (v, other) = self.directions(entry)
        if one != other:
            target = cosine(90 - degrees)
        start = f_dot(u.at, v.at)
        if target is not None and start:
            target = like(start, (abs_low(target), mag(target)))
        ends = [x.key for x in (u, v) if isinstance(x.key, tuple) and isinstance(x.key[0], int)]
        common = [(i, j) for i in (0, 1) for j in (0, 1) if len(ends) == 2 and ends[0][i] == ends[1][j]]
        if common and u.given and v.given:
            i, j = common[0]
            if i != j and target is not None:
                target = sub((0, 0), target)
            return self.opposite(ends[0][1 - i], ends[0][i], ends[1][1 - j], target)
        if target is None:
            return self.perpendicular(u, v)
        self.measure(product(1, u, v), start, target, [u, v])

    def coplanar(self, points):
        p, reference = self.p, self.p.reference
        if set(reference) <= set(points):
            for x in points:
                if x not in reference:
                    start = p.seen(f_minus(p.at[x], self.origin), 2)
                    self.vanish([(1, (p.index[x, 2], None), None)], start, 1)
            return
        a, b = points[:2]
        off = [k for k in range(2, len(points)) if any(f_cross(self.span(a, b).at, self.span(a, points[k]).at))]
        if off:
            points[2], points[off[0]] = points[off[0]], points[2]
        w = self.cross(self.span(a, b), self.span(a, points[2]))
        if len(points) > 4:
            self.not_zero(w)
        for x in points[3:]:
            across = self.span(a, x)
            self.vanish(product(1, w, across), exact(f_dot(w.at, across.at)), w.power + 1)


def product(factor, u, v): return [(factor, f, g) for f, g in zip(u.forms, v.forms)]
def product_in_plane(u, forms): return [(1, u.forms[0], forms[1]), (-1, u.forms[1], forms[0])]
def sketch_length(v): return root(exact(f_dot(v.at, v.at)))
def abs_low(a): return 0 if a[0] <= 0 <= a[1] else min(abs(a[0]), abs(a[1]))
def square(a): return (abs_low(a) ** 2 >> B, up(mag(a) ** 2))


def like(start, number):
    """A number with the sign of another, not 0."""
    need(start, "a side on which it is in the sketch")
    return number if start > 0 else sub((0, 0), number)


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
    need(all(math.isfinite(x) for row in a for x in row), "a regular matrix")
    return [[int(math.ldexp(x, B)) for x in row[n:]] for row in a]


def off_identity(y, rows, u):
    """At least |Y J - I| u, row by row."""
    out = []
    for i, factors in enumerate(y):
        lows, highs = [0] * len(u), [0] * len(u)
        lows[i] = highs[i] = -ONE << B
        for x, row in zip(factors, rows):
            for j, (a, b) in row.items():
                if x < 0:
                    a, b = b, a
                lows[j] += x * a
                highs[j] += x * b
        out.append(sum(up(up(max(abs(a), abs(b))) * w) for a, b, w in zip(lows, highs, u)))
    return out


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
                bound[i] += up(mag(row_times(row, column)) * power)
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
        return max(-(-(off << B) // w) for off, w in zip(off_identity(self.y, rows, u), u))

    def solved(self, x):
        """At most |w|_u for DG w = x, with DG of the box."""
        size = max(-(-(mag(row_times(y, x)) << B) // u) for y, u in zip(self.y, self.tube.u))
        return -(-(size << B) // (ONE - self.q))

    def tangent(self, box, steps=5):
        """The direction of the path at its points in a box, c T = 1: near any v, brought nearer in steps."""
        tube = self.tube
        v = [(row[-1],) * 2 for row in self.y]
        rows = tube.problem.jacobian(box)
        for _ in range(steps):
            v = [((x[0] + x[1]) // 2,) * 2 for x in v]
            off = [dot([v[j] for j in row], row.values()) for row in rows]
            off.append(sub(dot(tube.c, v), exact(1)))
            r, w = self.solved(off), v
            v = [sub(x, row_times(y, off)) for x, y in zip(v, self.y)]
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
                x = row_times(row, f)[0]
                p.append((x, x))
        for smaller in range(2, -1, -1):
            self.pieces = []
            try:
                return self.cut(-self.h, self.h, 0)
            except NotProved:
                if smaller == 0:
                    raise
                self.r >>= 2

    def cut(self, a, b, depth):
        try:
            need(depth > 0, "two pieces at least")
            # Better short pieces and good bounds.
            self.pieces.append(Piece(self, a, b, ONE * 7 // 8))
        except NotProved:
            if depth == 9:
                raise
            middle = (a + b) // 2
            self.cut(a, middle, depth + 1)
            self.cut(middle, b, depth + 1)

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
            off = [row_times(y, f) for y in piece.y]
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

    def stands(self, a, b, depth=20):
        """Lengths are positive, and vectors are not zero, between two parameters."""
        problem = self.problem
        if not problem.positive and not problem.nonzero:
            return
        box = self.box((a, b))[0]
        def is_off(form): return not (lambda x: x[0] <= 0 <= x[1])(problem.of_form(box, form))
        if all(box[i][0] > 0 for i in problem.positive) and all(any(map(is_off, v)) for v in problem.nonzero):
            return
        need(depth > 0, "a positive length, or a vector that is not zero")
        self.stands(a, (a + b) // 2, depth - 1)
        self.stands((a + b) // 2, b, depth - 1)

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
            need(i < self.n - 1 or reach[1] < exact(1.0)[0], "t is below 1 at the fold")

    def bends_down(self, a, b, depth=20):
        """t'' < 0 between two parameters, of the curve by its own: J phi'' = -(second derivatives of F along phi')."""
        box, pieces = self.box((a, b))
        ok = True
        for piece in pieces:
            v = piece.tangent(box, 2)
            f = [sub((0, 0), x) for x in self.problem.bend(box, v)] + [(0, 0)]
            # Near Y f, and how far: of what is left of the equations.
            w = [(x[0] + x[1]) // 2 for x in (row_times(y, f) for y in piece.y)]
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
    rows = [{j: x for j, x in row.items() if j < m} for row in rows]
    y = [row[:m] for row in y[:m]]
    q = max(off_identity(y, rows, [ONE] * m))
    f = [p[0] for p in problem.along([[x] for x in middle])]
    eta = max(mag(row_times(row, f)) for row in y)
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
    """Whether a figure, narrowly enclosed, is moved or mirrored to the one in another box (box, narrow)."""
    box, narrow = b
    for k, p in enumerate(problem.reference[1:]):
        i = problem.index[p, k]
        need(all(not x[0] <= 0 <= x[1] for x in (a[i], narrow[i])), "reference points apart")
    axes = set(range(problem.d))
    objects = set().union(*problem.turned) - axes
    mirrors = all(symmetric(problem, {axis}) for axis in axes)
    choices = list(axes) + sorted(objects)
    need(len(choices) <= 12, "few lines and planes")
    for mask in range(1, 1 << len(choices)):
        turns = {x for k, x in enumerate(choices) if mask >> k & 1}
        if len(turns & axes) % 2 and not mirrors or not symmetric(problem, turns):
            continue
        image = [sub((0, 0), x) if len(turned & turns) % 2 else x for x, turned in zip(a, problem.turned)]
        if apart(image, narrow):
            continue
        need(all(w[0] <= x[0] and x[1] <= w[1] for x, w in zip(image, box)), "congruent, or not")
        return True
    return False


def symmetric(problem, turns):
    """Whether the equations with t = 1 stay true where signs are reversed."""
    def sign(i): return len(problem.turned[i] & turns) % 2
    for terms, _, ends_at_zero in problem.equations:
        signs = set()
        for _, left, right in terms:
            ends = [{sign(i) for i in form or () if i is not None} for form in (left, right)]
            if any(len(x) > 1 for x in ends):
                return False
            signs.add(sum(sum(x) for x in ends) % 2)
        if len(signs) > 1 or 1 in signs and not ends_at_zero:
            return False
    return True


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
        elif tag == 9:
            raise NotProved("edits of problems with other constraints are not for this checker")
        elif tag in (10, 11):
            raise NotProved("equations with heights divided by 1 - t are not for this checker")
        elif tag in (5, 15):
            if tag == 15 and problem.is_general:
                raise NotProved("motions of problems with other constraints are not for this checker")
            led = []
            for _ in range(file.read("I")[0]):
                (index,) = file.read("I")
                led.append((index, Fraction(file.text().decode())))
            signs = []
            for _ in range(file.read("I")[0]):
                signs.append((file.read(f"{problem.d + 1}I"), file.read("B")[0]))
            records.append(({5: "arc", 15: "motion"}[tag], (led, signs)))
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
    start, what = problem.sketch, ""
    if kinds[:1] in (["arc"], ["motion"]):
        at = kinds.index("motion") if "motion" in kinds else len(kinds)
        start = edits(problem, records[:at + 1])
        if at == len(kinds):
            assert ending == 0 and solutions == 0, "the order of records"
            return count, f"{kinds.count('arc')} edits"
        led, signs = records[at][1]
        assert "arc" not in kinds[at:] and kinds.count("motion") == 1 and len(led) == 1 and not signs, "the order of records"
        assert not any(kind == "arc" and claim[0] for kind, claim in records[:at]), "nothing is led before a motion"
        records, kinds, what = records[at + 1:], kinds[at + 1:], "a motion, "
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
        entry, direction = enter(tube, before, start)
        if before is None:
            if turned:
                need(dot(first, tube.c)[1] < 0, "the other way")
            else:
                first = direction
        leave = (tube.s, tube.s)
        if closes:
            need(before is not None, "more than one tube")
            leave = tube.locate(start)
            need(leave, "the sketch in the last tube")
            need(dot(first, tube.c)[0] > 0, "the direction of the start")
        need(entry[1] < leave[0], "an exit behind the entry")
        tube.stands(entry[0], leave[1])
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
            if congruent(problem, narrow, (other, other_narrow)):
                same = numbers[j]
        numbers.append(max(numbers, default=-1) + 1 if same is None else same)
    need(tuple(numbers) == classes, "the classes")
    return count, f"{what}{solutions} solutions"


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
    """Arcs one after the other, and the equations of a motion behind them: where the last one ends."""
    start, before, signs, number = problem.sketch, None, [], 0
    now = [a for a, _ in problem.squares]
    for position, (kind, claim) in enumerate(records):
        if kind in ("arc", "motion"):
            led, signs = claim
            number += 1
            wanted = [b for _, b in problem.squares] if number == 1 else list(now)
            if number == 1 and led:
                need(now == wanted, "the sketch meets its dimensions")
            for index, value in led:
                wanted[index] = (value * problem.scale) ** 2
            ways = [length(a, b) for a, b in zip(now, wanted)]
            problem.equations = [(terms, times(a, a), None) for (terms, _, _), a in zip(problem.equations, ways)]
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
    return start


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
