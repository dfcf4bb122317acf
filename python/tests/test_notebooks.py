"""Notebooks, and the Python of the pages, run as they stand."""

from __future__ import annotations

import re
import textwrap
from pathlib import Path

import nbformat
import pytest
from conftest import ROOT
from nbclient import NotebookClient

pytestmark = pytest.mark.unsanitized
NOTEBOOKS = sorted((ROOT / "examples/notebooks").glob("*.ipynb"))


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs(path: Path) -> None:
    notebook = nbformat.read(path, as_version=4)  # type: ignore[no-untyped-call]
    NotebookClient(notebook, timeout=600, resources={"metadata": {"path": str(ROOT)}}).execute()
    assert all(
        cell.get("outputs") is not None for cell in notebook.cells if cell.cell_type == "code"
    )


def test_committed_outputs_are_small() -> None:
    assert len(NOTEBOOKS) >= 1
    for path in NOTEBOOKS:
        assert path.stat().st_size < 60_000, path


def python_of(page: str) -> list[str]:
    """Blocks of Python in a page: fenced ones, and the indented one that imports lacuna."""
    text = (ROOT / page).read_text()
    fenced = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    indented = re.findall(r"((?:^    .*\n)*^    import lacuna\n(?:^    .*\n)*)", text, re.MULTILINE)
    return [*fenced, *map(textwrap.dedent, indented)]


@pytest.mark.filterwarnings("ignore::lacuna.LacunaWarning")
@pytest.mark.parametrize("page", ["README.md", "python/README.md", "docs/from-pysindy.md"])
def test_the_python_of_a_page_runs(
    page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "data").symlink_to(ROOT / "data")
    monkeypatch.chdir(tmp_path)
    blocks = python_of(page)
    assert blocks
    for block in blocks:
        exec(compile(block, page, "exec"), {})
