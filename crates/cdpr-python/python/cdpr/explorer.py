"""The explorer in a notebook: a robot that computes where it is shown, as a widget.

>>> import cdpr
>>> robot = cdpr.Robot.from_file("cogiro")
>>> widget = robot.explore()  # doctest: +SKIP

The widget needs the package anywidget (`pip install anywidget`), and no connection. `widget.state` is what the
page shows, and follows it; a state that is set is shown.
"""

from __future__ import annotations

import json
import lzma
from typing import Any

try:
    import anywidget
    import traitlets
except ImportError as missing:  # pragma: no cover
    raise ImportError("the explorer in a notebook is a widget: pip install anywidget") from missing

from ._core import Robot, explorer_parts

_PARTS = explorer_parts()

# Notebooks draw below a style of their own; 640 px are as high as most windows leave room for.
_STYLE = ".cdpr-explorer { height: 640px; overflow: auto; }\n" + _PARTS["style"]

_RENDER = """
export default {
  render({ model, el }) {
    const box = document.createElement("div");
    box.className = "cdpr-explorer";
    el.append(box);
    const { buffer, byteOffset, byteLength } = model.get("_module");
    const explorer = cdprExplorer.mount(box, {
      robot: model.get("robot"),
      study: null,
      state: model.get("state"),
      name: model.get("_name"),
      module: buffer.slice(byteOffset, byteOffset + byteLength),
      worker: model.get("_worker"),
      embedded: true,
    });
    let shown = null;
    box.addEventListener("cdpr-state", ({ detail }) => {
      shown = JSON.stringify(detail);
      model.set("state", detail);
      model.save_changes();
    });
    const follow = () => {
      const state = model.get("state");
      if (state && JSON.stringify(state) !== shown) explorer.setState(state);
    };
    model.on("change:state", follow);
    return () => {
      model.off("change:state", follow);
      explorer.dispose();
    };
  },
};
"""


class Explorer(anywidget.AnyWidget):
    """A robot that computes in the notebook.

    robot: the robot file as a dictionary.
    state: what is shown, a dictionary of the format `cdpr-explorer/1`; None until something is shown.
    """

    _esm = lzma.decompress(_PARTS["script"]).decode() + _RENDER
    _css = _STYLE
    robot = traitlets.Dict().tag(sync=True)
    state = traitlets.Dict(default_value=None, allow_none=True).tag(sync=True)
    _module = traitlets.Bytes().tag(sync=True)
    _worker = traitlets.Unicode().tag(sync=True)
    _name = traitlets.Unicode().tag(sync=True)

    def __init__(self, robot: Robot, state: dict[str, Any] | None = None, **traits: Any) -> None:
        super().__init__(
            robot=json.loads(robot.to_json()),
            state=state,
            _module=lzma.decompress(_PARTS["module"]),
            _worker=_PARTS["worker"],
            _name=f"{robot.name}.json",
            **traits,
        )
