"""The explorer: its file, and its widget in notebooks."""

import pytest

import cdpr


def test_the_page_of_a_robot_is_one_file_that_writes_over_no_other(tmp_path, cogiro):
    path = tmp_path / "cogiro.html"
    cogiro.write_explorer(path)
    page = path.read_text()
    assert page.startswith("<!DOCTYPE html>") and "connect-src" not in page.split("<body>")[0]
    assert '"name":"CoGiRo"' in page.replace('": "', '":"')
    cogiro.write_explorer(path)
    path.write_text("of the user")
    with pytest.raises(cdpr.FileError):
        cogiro.write_explorer(path)
    assert path.read_text() == "of the user"


def test_the_widget_holds_robot_module_and_state(cogiro):
    pytest.importorskip("anywidget", reason="anywidget is not installed")
    widget = cogiro.explore(state={"format": "cdpr-explorer/1", "payload": 20})
    assert widget.robot == cogiro.to_dict()
    assert widget.state["payload"] == 20
    assert widget._module[:4] == b"\0asm"
    assert "export default" in widget._esm and "cdprExplorer.mount" in widget._esm
    assert cogiro.explore().state is None
