"""Notebooks, and the Python of the pages, run as they stand."""

from __future__ import annotations

import re
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


def python_of(page: Path) -> list[str]:
    """Blocks of Python in a page."""
    return re.findall(r"^```python\n(.*?)^```", page.read_text(), re.DOTALL | re.MULTILINE)


FOLDERS = ["docs", "site", "examples", "effects", "bases", "solvers", "data", "python"]
PAGES = [ROOT / "README.md", *(page for name in FOLDERS for page in (ROOT / name).rglob("*.md"))]
WITH_PYTHON = sorted(page.relative_to(ROOT).as_posix() for page in PAGES if python_of(page))


def test_pages_have_python() -> None:
    assert len(WITH_PYTHON) >= 4


@pytest.mark.filterwarnings("ignore::lacuna.LacunaWarning")
@pytest.mark.parametrize("page", WITH_PYTHON)
def test_the_python_of_a_page_runs(
    page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "data").symlink_to(ROOT / "data")
    monkeypatch.chdir(tmp_path)
    for block in python_of(ROOT / page):
        exec(compile(block, page, "exec"), {})
