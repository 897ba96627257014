"""What the drawings of the book share: colours for light and dark pages, arrows, labels, the file."""

from pathlib import Path

STYLE = """
.page { fill: #ffffff } .ink { stroke: #24292f; fill: none }
.thin { stroke: #8c959f; fill: none }
.solid { fill: #d0d7de; fill-opacity: .45; stroke: #57606a } .cable { stroke: #0969da; fill: none }
.force { stroke: #bc4c00; fill: none } .dot { fill: #24292f }
text { fill: #24292f; font: 15px Georgia, 'Times New Roman', serif }
.note { font: 12.5px Helvetica, Arial, sans-serif }
.force-text { fill: #bc4c00 } .cable-text { fill: #0969da }
#ink path { fill: #24292f } #force path { fill: #bc4c00 } #thin path { fill: #8c959f }
@media (prefers-color-scheme: dark) {
  .page { fill: #0d1117 } .ink { stroke: #e6edf3 } .thin { stroke: #7d8590 }
  .solid { fill: #30363d; stroke: #8d96a0 } .cable { stroke: #58a6ff }
  .force { stroke: #f0883e } .dot { fill: #e6edf3 }
  text { fill: #e6edf3 } .force-text { fill: #f0883e } .cable-text { fill: #58a6ff }
  #ink path { fill: #e6edf3 } #force path { fill: #f0883e } #thin path { fill: #7d8590 }
}
"""
parts = []


def symbol(text):
    """`b_i` as italics with a subscript."""
    base, _, index = text.partition("_")
    italic = f'<tspan font-style="italic">{base}</tspan>'
    return italic + (
        f'<tspan font-size="11" dy="4">{index}</tspan><tspan dy="-4">&#8203;</tspan>' if index else ""
    )


def label(at, text, kind="", anchor="middle"):
    parts.append(f'<text x="{at[0]:.1f}" y="{at[1]:.1f}" text-anchor="{anchor}" class="{kind}">{text}</text>')


def line(a, b, kind="ink", width=1.6, arrow=True, dash=""):
    end = f' marker-end="url(#{kind})"' if arrow else ""
    dash = f' stroke-dasharray="{dash}"' if dash else ""
    x = f'x1="{a[0]:.1f}" y1="{a[1]:.1f}" x2="{b[0]:.1f}" y2="{b[1]:.1f}"'
    parts.append(f'<line {x} class="{kind}" stroke-width="{width}"{end}{dash}/>')


def curve(points, kind, width=2.2):
    d = "M" + " L".join(f"{x:.1f},{y:.1f}" for x, y in points)
    parts.append(f'<path d="{d}" class="{kind}" stroke-width="{width}"/>')


def dot(at):
    parts.append(f'<circle cx="{at[0]:.1f}" cy="{at[1]:.1f}" r="3.2" class="dot"/>')


def add(a, b, factor=1.0):
    return tuple(x + factor * y for x, y in zip(a, b))


def save(name, width, height, title):
    """Writes what has been drawn since the last file."""
    markers = "".join(
        f'<marker id="{kind}" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="9" markerHeight="9" '
        f'markerUnits="userSpaceOnUse" orient="auto"><path d="M0 0L10 5L0 10z"/></marker>'
        for kind in ("ink", "force", "thin")
    )
    svg = f"""<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" role="img">
<title>{title}</title>
<style>{STYLE}</style>
<defs>{markers}</defs>
<rect class="page" width="{width}" height="{height}" rx="8"/>
{chr(10).join(parts)}
</svg>
"""
    Path(__file__).with_name(name).write_text(svg)
    parts.clear()
