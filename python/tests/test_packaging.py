"""The distribution is called lacuna-ode, what is imported lacuna."""

from __future__ import annotations

import re
import sys

import pytest
from conftest import ROOT

import lacuna
from lacuna.errors import optional


def test_the_distribution_has_its_own_name() -> None:
    project = (ROOT / "pyproject.toml").read_text()
    assert re.search(r'^name = "lacuna-ode"', project, re.M)
    pages = [ROOT / "README.md", *(ROOT / "docs").rglob("*.md"), *(ROOT / "python").rglob("*.md")]
    sources = [*(ROOT / "python" / "lacuna").glob("*.py"), *(ROOT / "scripts").glob("*.sh")]
    assert len(pages) > 50
    named = 0
    for path in [*pages, *sources]:
        for name in re.findall(r"pip install [\"'`]*(lacuna[\w-]*)", path.read_text()):
            assert name == "lacuna-ode", path
            named += 1
    assert named >= 2


def test_what_is_not_installed_names_its_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    extras = dict(
        re.findall(r"^(\w+) = \[\"([\w-]+)>=", (ROOT / "pyproject.toml").read_text(), re.M)
    )
    assert extras["frames"] == "pandas"
    monkeypatch.setitem(sys.modules, "pandas", None)
    run = lacuna.simulate("lorenz", [1, 1, 20], t_end=1, dt=0.1)
    with pytest.raises(ImportError, match=r"pip install 'lacuna-ode\[frames\]'"):
        run.to_frame()
    with pytest.raises(ImportError, match="nonsense is not installed"):
        optional("nonsense.of_mine", "plot")
