"""Makes angles.FCStd, kept.FCStd, external.FCStd and seen.json beside this file, in FreeCAD 0.20 (freecadcmd make.py): sketches, and where
FreeCAD has them after one dimension is set."""
import json, math, os
import FreeCAD as App, Part, Sketcher
V = App.Vector
HERE = os.path.dirname(os.path.abspath(__file__)) if "__file__" in globals() else os.getcwd()
seen = {}


def at(point, length, degrees):
    angle = math.radians(degrees)
    return (point[0] + length * math.cos(angle), point[1] + length * math.sin(angle))


def line(sketch, a, b):
    return sketch.addGeometry(Part.LineSegment(V(*a, 0), V(*b, 0)))


def say(sketch, *what):
    return sketch.addConstraint(Sketcher.Constraint(*what))


def dimension(sketch, name, *what):
    sketch.renameConstraint(say(sketch, *what), name)


def place(sketch, geometry, position):
    point = sketch.getPoint(geometry, position)
    return (point.x, point.y)


def far(a, b):
    return round(math.hypot(a[0] - b[0], a[1] - b[1]), 3)


def places(sketch):
    out = {}
    for k, drawn in enumerate(sketch.Geometry):
        names = {"LineSegment": ["start", "end"], "ArcOfCircle": ["start", "end", "center"]}.get(type(drawn).__name__, [])
        for position, name in enumerate(names):
            out["e%d.%s" % (k + 1, name)] = [round(x, 10) for x in place(sketch, k, position + 1)]
    return out


def save(document, sketch, settings):
    assert sketch.solve() == 0
    document.recompute()
    document.saveAs(os.path.join(HERE, document.Name + ".FCStd"))
    for name, value, unit in settings:
        number = [c.Name for c in sketch.Constraints].index(name)
        old = sketch.Constraints[number].Value
        sketch.setDatum(name, App.Units.Quantity("%s %s" % (value, unit)))
        assert sketch.solve() == 0
        seen.setdefault(document.Name, {})["%s=%s" % (name, value)] = places(sketch)
        sketch.setDatum(name, App.Units.Quantity("%r %s" % (math.degrees(old) if unit == "deg" else old, unit)))
        assert sketch.solve() == 0


# Angles below 0, above 180, of 0, of an arc, and an arc with its normal downwards.
document = App.newDocument("angles")
sketch = document.addObject("Sketcher::SketchObject", "Sketch")
p = at((0, 0), 10, -35)
q = at(p, 8, -35 + 180 + 190)
a, b, c = line(sketch, (0, 0), p), line(sketch, p, q), line(sketch, q, (q[0] + 6, q[1]))
say(sketch, "Coincident", a, 1, -1, 1)
dimension(sketch, "long", "Distance", a, 10.0)
dimension(sketch, "down", "Angle", a, math.radians(-35))
say(sketch, "Coincident", b, 1, a, 2)
dimension(sketch, "next", "Distance", b, 8.0)
dimension(sketch, "wide", "Angle", a, 2, b, 1, math.radians(190))
say(sketch, "Coincident", c, 1, b, 2)
dimension(sketch, "last", "Distance", c, 6.0)
dimension(sketch, "level", "Angle", c, 0.0)
circle = Part.Circle(V(q[0] + 6, q[1] + 5, 0), V(0, 0, 1), 5)
arc = sketch.addGeometry(Part.ArcOfCircle(circle, -math.pi / 2, -math.pi / 2 + math.radians(200)))
say(sketch, "Tangent", c, 2, arc, 1)
dimension(sketch, "r", "Radius", arc, 5.0)
dimension(sketch, "round", "Angle", arc, math.radians(200))
arc = sketch.addGeometry(Part.ArcOfCircle(Part.Circle(V(-20, 3, 0), V(0, 0, -1), 4), 0.3, 2.0))
dimension(sketch, "x1", "DistanceX", arc, 1, round(place(sketch, arc, 1)[0], 3))
dimension(sketch, "y1", "DistanceY", arc, 1, round(place(sketch, arc, 1)[1], 3))
dimension(sketch, "x2", "DistanceX", arc, 2, round(place(sketch, arc, 2)[0], 3))
dimension(sketch, "x", "DistanceX", arc, 3, -20.0)
dimension(sketch, "y", "DistanceY", arc, 3, 3.0)
save(document, sketch, [("down", -50, "deg"), ("wide", 200, "deg"), ("wide", 170, "deg"), ("level", 20, "deg"),
                        ("level", -20, "deg"), ("round", 150, "deg"), ("round", 240, "deg"), ("x2", -23, "mm")])

# An ellipse and a B-spline in a rectangle, and a line from the ellipse.
document = App.newDocument("kept")
sketch = document.addObject("Sketcher::SketchObject", "Sketch")
corners = [(0, 0), (40, 0), (40, 30), (0, 30)]
sides = [line(sketch, corners[k], corners[(k + 1) % 4]) for k in range(4)]
for k in range(4):
    say(sketch, "Coincident", sides[k], 2, sides[(k + 1) % 4], 1)
    say(sketch, "Horizontal" if k % 2 == 0 else "Vertical", sides[k])
say(sketch, "Coincident", sides[0], 1, -1, 1)
dimension(sketch, "w", "Distance", sides[0], 40.0)
dimension(sketch, "h", "Distance", sides[1], 30.0)
ellipse = sketch.addGeometry(Part.Ellipse(V(28, 15, 0), V(20, 18, 0), V(20, 15, 0)))
sketch.exposeInternalGeometry(ellipse)
dimension(sketch, "middle", "DistanceX", -1, 1, ellipse, 3, 20.0)
end = line(sketch, (20, 18), (32, 18))
say(sketch, "PointOnObject", end, 1, ellipse)
say(sketch, "Horizontal", end)
dimension(sketch, "l", "DistanceX", end, 1, end, 2, 12.0)
spline = Part.BSplineCurve()
spline.buildFromPoles([V(2, 25, 0), V(8, 28, 0), V(14, 22, 0), V(18, 26, 0)])
sketch.addGeometry(spline)
save(document, sketch, [("w", 50, "mm"), ("h", 32, "mm")])

# A sketch in a plane that is turned and moved, with edges and a corner of a padded outline.
document = App.newDocument("external")
body = document.addObject("PartDesign::Body", "Body")
body.Placement = App.Placement(V(5, -7, 2), App.Rotation(V(0, 0, 1), 25))
base = document.addObject("Sketcher::SketchObject", "Base")
body.addObject(base)
base.Placement = App.Placement(V(3, 2, 1), App.Rotation(V(1, 1, 0.3), 70))
for k in range(4):
    line(base, corners[k], corners[(k + 1) % 4])
for k in range(4):
    say(base, "Coincident", k, 2, (k + 1) % 4, 1)
base.fillet(0, 1, 6.0)
base.addGeometry(Part.Circle(V(25, 18, 0), V(0, 0, 1), 5))
document.recompute()
pad = document.addObject("PartDesign::Pad", "Pad")
body.addObject(pad)
pad.Profile, pad.Length = base, 8
document.recompute()
sketch = document.addObject("Sketcher::SketchObject", "Sketch")
body.addObject(sketch)
turned = base.Placement.Rotation.multiply(App.Rotation(V(0, 0, 1), 40)).multiply(App.Rotation(V(1, 0, 0), 180))
sketch.Placement = App.Placement(base.Placement.multVec(V(4, 5, 8)), turned)
document.recompute()
above = [base.Placement.inverse().multVec(edge.CenterOfMass).z for edge in pad.Shape.Edges]
kinds = [(type(edge.Curve).__name__, len(edge.Vertexes)) for edge in pad.Shape.Edges]
top = [k for k, z in enumerate(above) if abs(z - 8) < 1e-6 and kinds[k] == ("Line", 2)]
upright = [k for k, z in enumerate(above) if abs(z - 4) < 1e-6 and kinds[k] == ("Line", 2)]
for k in [top[0], top[1], kinds.index(("Circle", 2)), kinds.index(("Circle", 1)), upright[0]]:
    sketch.addExternal("Pad", "Edge%d" % (k + 1))
sketch.addExternal("Pad", "Vertex3")
side, other, rounded, hole, edge, corner = range(-3, -9, -1)
s, t, f = place(sketch, side, 1), place(sketch, side, 2), place(sketch, hole, 3)
middle = ((s[0] + t[0]) / 2, (s[1] + t[1]) / 2)
a = line(sketch, middle, (middle[0] + 10, middle[1] + 4))
say(sketch, "PointOnObject", a, 1, side)
dimension(sketch, "long", "Distance", a, 11.0)
dimension(sketch, "to_hole", "Distance", a, 2, hole, 3, far(place(sketch, a, 2), f))
dimension(sketch, "from_edge", "Distance", a, 1, edge, 1, far(place(sketch, edge, 1), place(sketch, a, 1)))
round_ = sketch.addGeometry(Part.Circle(V(f[0] + 9, f[1] + 1, 0), V(0, 0, 1), 4))
say(sketch, "Tangent", round_, hole)
dimension(sketch, "r", "Radius", round_, 4.0)
dimension(sketch, "to_corner", "Distance", round_, 3, corner, 1, far(place(sketch, corner, 1), (f[0] + 9, f[1] + 1)))
e = place(sketch, rounded, 1)
b = line(sketch, e, (e[0] + 3, e[1] + 9))
say(sketch, "Coincident", b, 1, rounded, 1)
dimension(sketch, "next", "Distance", b, 9.0)
dimension(sketch, "angle", "Angle", b, 1, other, 1, math.radians(20))
save(document, sketch, [("long", 12.5, "mm"), ("r", 5, "mm"), ("next", 10, "mm"), ("angle", 35, "deg")])

with open(os.path.join(HERE, "seen.json"), "w") as out:
    json.dump(seen, out, indent=1)
print("made", HERE)
