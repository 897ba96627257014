"""Draws the figures of docs/theory.md: `python3 docs/images/drawings.py`."""

import math

from sketch import add, curve, dot, label, line, parts, save, symbol


def cable():
    """One cable in its plane, with a part of it cut free."""
    b, a = (90, 70), (470, 220)
    at = lambda t: (b[0] + t * (a[0] - b[0]), b[1] + t * (a[1] - b[1]) + 330 * t * (1 - t))
    line(b, (560, b[1]), width=1.3)
    label((572, b[1] + 5), symbol("x"))
    line((b[0], 300), (b[0], 30), width=1.3)
    label((b[0] - 14, 38), symbol("z"))
    line(b, a, "thin", arrow=False, dash="5 4")
    label((372, 160), "chord", "note")
    curve([at(k / 60) for k in range(61)], "cable")
    middle = at(0.5)
    line(add(middle, (0, -82)), add(middle, (0, -4)), "thin")
    label(add(middle, (22, -24)), "sag", "note")
    cut = at(0.72)
    tangent = add(at(0.74), at(0.7), -1)
    size = math.hypot(*tangent)
    for sign, name, shift in ((1, "T(s)", (14, 24)), (-1, "", (0, 0))):
        end = add(cut, tangent, sign * 62 / size)
        line(cut, end, "force", 2.2)
        label(add(end, shift), symbol(name) if name else "", "force-text")
    line(add(at(0.25), (0, 4)), add(at(0.25), (0, 58)), "force", 2.2)
    label(add(at(0.25), (22, 58)), symbol("w ds"), "force-text", "start")
    line(a, (a[0] + 84, a[1]), "force", 2.4)
    label((a[0] + 96, a[1] + 5), symbol("f_x"), "force-text", "start")
    end = (a[0], a[1] - 40)
    line(a, end, "force", 2.4)
    label((end[0] + 12, end[1] + 8), symbol("f_z"), "force-text", "start")
    dot(a)
    dot(b)
    label((b[0] + 12, b[1] - 12), symbol("B") + ", " + symbol("s") + " = 0", "", "start")
    label((a[0] + 6, a[1] + 24), symbol("A") + ", " + symbol("s") + " = " + symbol("L"), "", "start")
    label((600, 110), "At the unstrained length " + symbol("s") + ":", "note", "start")
    for row, text in enumerate([
        symbol("V") + "(" + symbol("s") + ") = " + symbol("f_z") + " &#8722; " + symbol("w") + " ("
        + symbol("L") + " &#8722; " + symbol("s") + ")",
        symbol("T") + "(" + symbol("s") + ") = &#8730;(" + symbol("f_x") + "&#178; + " + symbol("V")
        + "&#178;)",
        "stretch of an element: " + symbol("T") + " / " + symbol("EA"),
    ]):
        label((600, 142 + 30 * row), text, "", "start")
    save("cable.svg", 860, 320, "One cable in its vertical plane: chord, sag, weight, forces and tension")


def pulley():
    """A swivelling pulley with a vertical axis, in the plane of its wheel."""
    r, d = 74, (200, 250)
    centre = (d[0] + r, d[1])
    psi = math.radians(52)
    # The cable enters at D along k, goes over the wheel, and leaves at B along tau.
    leave = (centre[0] + r * math.cos(psi), centre[1] - r * math.sin(psi))
    parts.append(f'<circle cx="{centre[0]}" cy="{centre[1]}" r="{r}" class="solid"/>')
    line((d[0], 390), (d[0], 60), "thin", arrow=False, dash="8 4 2 4")
    label((d[0] - 12, 74), "swivel axis", "note", "end")
    curve([(d[0], 380), d], "cable")
    arc = [math.pi - (math.pi - psi) * t / 40 for t in range(41)]
    curve([(centre[0] + r * math.cos(t), centre[1] - r * math.sin(t)) for t in arc], "cable")
    tau = (math.sin(psi), math.cos(psi))
    far = [
        (leave[0] + 330 * t * tau[0], leave[1] + 330 * t * tau[1] - 26 * t * t)
        for t in (k / 40 for k in range(41))
    ]
    curve(far, "cable")
    line(d, add(d, (0, -92)), width=1.8)
    label((d[0] - 14, d[1] - 84), symbol("k"))
    line(d, add(d, (centre[0] - d[0], 0)), width=1.8)
    label((d[0] + 40, d[1] + 20), symbol("r u"))
    line(centre, leave, width=1.8)
    label((centre[0] + 12, centre[1] - 38), symbol("r m"), "", "end")
    line(leave, add(leave, tau, 76), width=1.8)
    label(add(add(leave, tau, 76), (4, -12)), symbol("&#964;"), "", "start")
    curve([(centre[0] + 28 * math.cos(psi * k / 20), centre[1] - 28 * math.sin(psi * k / 20)) for k in range(21)],
          "ink", 1.2)
    line(centre, add(centre, (r + 26, 0)), "thin", arrow=False, dash="3 4")
    label((centre[0] + 42, centre[1] - 12), symbol("&#968;"))
    for point in (d, leave, far[-1], centre):
        dot(point)
    label((d[0] - 14, d[1] + 6), symbol("D"), "", "end")
    label((leave[0] + 8, leave[1] - 12), symbol("B"), "", "start")
    label((far[-1][0] + 12, far[-1][1] + 4), symbol("A"), "", "start")
    label((d[0] - 12, 372), "lead " + symbol("d") + ", from the winch", "cable-text", "end")
    label((430, 76), "The wheel turns about " + symbol("k") + " until its plane contains " + symbol("&#964;") + ".",
          "note", "start")
    label((430, 104), symbol("B") + " = " + symbol("r") + " (" + symbol("u") + " + " + symbol("m")
          + "), seen from " + symbol("D"), "", "start")
    label((430, 132), symbol("m") + " = cos " + symbol("&#968;") + " " + symbol("u") + " + sin "
          + symbol("&#968;") + " " + symbol("k"), "", "start")
    label((430, 160), "arc: " + symbol("r") + " (&#960; &#8722; " + symbol("&#968;") + ")", "cable-text",
          "start")
    save("pulley.svg", 860, 410, "A pulley: entry D, wheel, leave point B, the vectors k, u, m and tau")


def box(centre, angle, half=(92, 34)):
    """Corners of a platform, turned by an angle."""
    c, s = math.cos(angle), math.sin(angle)
    return [
        (centre[0] + c * x - s * y, centre[1] + s * x + c * y)
        for x, y in ((-half[0], -half[1]), (half[0], -half[1]), (half[0], half[1]), (-half[0], half[1]))
    ]


def solid(corners, kind="solid", dash=""):
    points = " ".join(f"{x:.1f},{y:.1f}" for x, y in corners)
    parts.append(f'<polygon points="{points}" class="{kind}"{dash}/>')


def forces():
    """The balance of the platform: forces of the cables, weight, load."""
    p = (330, 210)
    corners = box(p, math.radians(-5))
    solid(corners)
    for corner, end, index in ((corners[0], (70, 46), 1), (corners[1], (610, 40), 2), (corners[3], (60, 330), 3)):
        line(end, corner, "cable", 2.2, arrow=False)
        way = add(end, corner, -1)
        size = math.hypot(*way)
        head = add(corner, way, 74 / size)
        line(corner, head, "force", 2.6)
        label(add(head, (14 if index == 1 else -16, -12)), symbol(f"F_{index}"), "force-text")
        line(p, corner, "thin", width=1.3)
        dot(corner)
    label(add(p, (-44, -30)), symbol("s_1"))
    g = add(p, (26, 10))
    line(g, add(g, (0, 84)), "force", 2.6)
    label(add(g, (26, 84)), symbol("m g"), "force-text")
    load = add(corners[2], (-30, -12))
    line(p, add(p, (112, 66)), "force", 2.6)
    label(add(p, (138, 80)), "load", "force-text")
    dot(p)
    dot(g)
    label(add(p, (-14, 18)), symbol("P"))
    label(add(g, (12, -6)), symbol("G"))
    label((650, 130), "&#931; " + symbol("F_i") + " + " + symbol("f_ex") + " = 0", "", "start")
    label((650, 162), "&#931; " + symbol("s_i") + " &#215; " + symbol("F_i") + " + " + symbol("m_ex") + " = 0", "",
          "start")
    label((650, 194), symbol("f_ex") + " = " + symbol("m g") + " + load", "", "start")
    save("forces.svg", 860, 360, "Forces on the platform: cables, weight, load, and the lever arms s")


def offset():
    """What an offset of a tension set-point does: wanted tension, length, and where the platform rests."""
    p = (250, 200)
    moved = (p[0] - 34, p[1] - 22)
    wanted, rests = box(p, 0.0, (70, 28)), box(moved, math.radians(6), (70, 28))
    solid(wanted, "thin", ' stroke-dasharray="5 4"')
    solid(rests)
    for index, end in ((0, (50, 40)), (1, (470, 40))):
        line(end, wanted[index], "thin", arrow=False, dash="5 4")
        line(end, rests[index], "cable", 2.2, arrow=False)
        dot(end)
    line(p, moved, "force", 2.4)
    label(add(moved, (-16, 2)), symbol("dp"), "force-text", "end")
    dot(p)
    label((96, 46), symbol("t_1") + " + " + symbol("dt_1"), "force-text", "start")
    label((448, 86), symbol("t_2"), "", "end")
    label((p[0] + 82, p[1] + 34), "wanted pose", "note", "start")
    label((moved[0] - 84, moved[1] + 40), "rest", "note", "end")
    rows = [
        "1. The inverse model chooses the tensions " + symbol("t_i") + ".",
        "2. The set-point of cable 1 is too high by " + symbol("dt_1") + ":",
        "    its length is set for " + symbol("t_1") + " + " + symbol("dt_1") + ", so it is too short.",
        "3. With these lengths the platform rests elsewhere,",
        "    and all tensions differ from both.",
    ]
    for row, text in enumerate(rows):
        label((520, 96 + 30 * row), text, "note", "start")
    save("offset.svg", 860, 270, "An offset of a tension set-point: a shorter cable, and another rest")


cable()
pulley()
forces()
offset()
