"""Draws frames.svg, the figure of docs/NOTATION.md: `python3 docs/images/frames.py`."""

import math

from sketch import add, curve, dot, label, line, parts, save, symbol

WIDTH, HEIGHT = 960, 430
TITLE = (
    "Base frame, platform frame, points P, G, A and B, the vectors of cable i, "
    "and the plane of the cable with its forces"
)
def project(point):
    """Oblique view of the base frame: x to the right, y into the depth, z up."""
    x, y, z = point
    return (70 + 96 * (x + 0.42 * y), 372 - 96 * (z + 0.30 * y))


def rotated(v, angle=math.radians(-14)):
    x, y, z = v
    return (x * math.cos(angle) + z * math.sin(angle), y, -x * math.sin(angle) + z * math.cos(angle))


def platform():
    """The robot: base frame, platform frame, points and vectors of one cable."""
    o, p, b = (0, 0, 0), (3.0, 0.5, 1.15), (0.55, 0.9, 2.85)
    arm, center = rotated((-0.62, 0.35, 0.3)), rotated((0.2, 0.0, -0.12))
    a, g = add(p, arm), add(p, center)
    corner = {
        (i, j, k): project(add(p, rotated((0.62 * i, 0.35 * j, 0.3 * k))))
        for i in (-1, 1)
        for j in (-1, 1)
        for k in (-1, 1)
    }
    faces = [
        [(-1, -1, -1), (1, -1, -1), (1, -1, 1), (-1, -1, 1)],
        [(-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)],
        [(1, -1, -1), (1, 1, -1), (1, 1, 1), (1, -1, 1)],
    ]
    for face in faces:
        points = " ".join("{:.1f},{:.1f}".format(*corner[key]) for key in face)
        parts.append(f'<polygon points="{points}" class="solid"/>')
    for axis, name, shift in [
        ((1, 0, 0), "x_b", (14, 6)),
        ((0, 1.1, 0), "y_b", (12, 0)),
        ((0, 0, 1), "z_b", (-14, 4)),
    ]:
        line(project(o), project(axis))
        label(add(project(axis), shift), symbol(name))
    label(add(project(o), (-4, 20)), symbol("O"))
    for axis, name, shift in [
        ((0.95, 0, 0), "x_p", (16, 8)),
        ((0, 0.95, 0), "y_p", (14, 2)),
        ((0, 0, 0.8), "z_p", (14, 0)),
    ]:
        end = add(p, rotated(axis))
        line(project(p), project(end), width=1.3)
        label(add(project(end), shift), symbol(name))
    line(project(o), project(p), "thin")
    label(add(project(add(o, p, 0.55)), (8, 18)), symbol("p"))
    line(project(o), project(b), "thin")
    label(add(project(add(o, b, 0.6)), (-16, -2)), symbol("b_i"))
    line(project(p), project(a))
    label(add(project(add(p, arm, 0.5)), (-14, 17)), symbol("s_i"))
    line(project(b), project(a), "thin", dash="5 4")
    label(add(project(add(b, add(a, b, -1), 0.42)), (14, -10)), symbol("r_i"))
    cable = [add(add(b, add(a, b, -1), t / 40), (0, 0, -1.1 * t / 40 * (1 - t / 40))) for t in range(41)]
    curve([project(point) for point in cable], "cable")
    pull = add(cable[-5], a, -1)
    size = math.sqrt(sum(x * x for x in pull))
    force = add(a, pull, 1.05 / size)
    line(project(a), project(force), "force", 2.4)
    label(add(project(force), (-12, 26)), symbol("F_i"), "force-text")
    line(project(g), project(add(g, (0, 0, -0.75))), "force", 2.4)
    label(add(project(add(g, (0, 0, -0.75))), (20, 4)), symbol("m g"), "force-text")
    for point, name, shift in [
        (p, "P", (3, 19)),
        (g, "G", (14, 12)),
        (a, "A_i", (8, -12)),
        (b, "B_i", (-2, -12)),
    ]:
        dot(project(point))
        label(add(project(point), shift), symbol(name))
    label((70, 26), "The platform and cable i in space", "note", "start")
    label((300, 396), symbol("s_i") + " = ", "", "start")
    label((334, 396), symbol("R") + " " + symbol("a_i") + " ,", "", "start")
    label((384, 396), symbol("r_i") + " = ", "", "start")
    label((416, 396), " + ".join([symbol("p"), symbol("s_i")]) + " &#8722; " + symbol("b_i"), "", "start")


def plane():
    """The vertical plane of one cable, its forces at A and at B."""
    b, a = (630, 120), (810, 262)
    at = lambda t: (b[0] + t * (a[0] - b[0]), b[1] + t * (a[1] - b[1]) + 80 * t * (1 - t))
    line(b, (905, b[1]), width=1.3)
    label((918, b[1] + 5), symbol("x"))
    line(b, (b[0], 58), width=1.3)
    label((b[0] + 14, 66), symbol("z"))
    line((a[0], b[1]), a, "thin", arrow=False, dash="3 4")
    curve([at(t / 50) for t in range(51)], "cable")
    label(add(at(0.5), (-128, 20)), "length " + symbol("L"), "cable-text", "start")
    label(add(at(0.5), (-128, 40)), "weight " + symbol("w"), "cable-text", "start")
    tangent = add(at(1.0), at(0.98), -1)
    end = (a[0] + 92, a[1])
    line(a, end, "force", 2.4)
    label((end[0] - 4, end[1] - 10), symbol("f_x"), "force-text")
    down = (a[0], a[1] + 92 * tangent[1] / tangent[0])
    line(a, down, "force", 2.4)
    label((down[0] + 10, down[1] + 2), symbol("f_z") + " &lt; 0", "force-text", "start")
    first = add(at(0.03), at(0.0), -1)
    size = math.hypot(*first)
    pull = (b[0] - 58 * first[0] / size, b[1] - 58 * first[1] / size)
    line(b, pull, "force", 2.4)
    label((pull[0] - 14, pull[1] + 4), symbol("T_0"), "force-text")
    dot(a)
    dot(b)
    label((b[0] + 16, b[1] - 10), symbol("B_i"))
    label((a[0] + 18, a[1] - 12), symbol("A_i"))
    label((a[0] + 8, (a[1] + b[1]) / 2), "(" + symbol("x, z") + ")", "", "start")
    label((590, 26), "The plane of cable i: forces on the cable", "note", "start")
    label((590, 372), "The force on the platform is the opposite one:", "note", "start")
    label(
        (590, 396),
        " ".join(
            [
                symbol("F_i"),
                "= &#8722;(",
                symbol("f_x"),
                symbol("e_h"),
                "+",
                symbol("f_z"),
                symbol("e_z"),
                ")",
            ]
        ),
        "",
        "start",
    )


platform()
plane()
save("frames.svg", WIDTH, HEIGHT, TITLE)
