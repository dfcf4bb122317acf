"""Answers are values: attributes, frames, pictures, pages, copies for other processes."""

from __future__ import annotations

import json
import pickle
from html.parser import HTMLParser
from multiprocessing import get_context
from pathlib import Path

import matplotlib
import numpy as np
import pytest

import lacuna

matplotlib.use("Agg")
pytestmark = pytest.mark.filterwarnings("ignore::lacuna.LacunaWarning")


@pytest.fixture(scope="module")
def found(folder: Path) -> lacuna.Identification:
    return lacuna.identify(folder / "run.csv", inputs="u", preset="sindy", degree=1)


@pytest.fixture(scope="module")
def lacks(folder: Path) -> lacuna.Diagnosis:
    return lacuna.diagnose(folder / "nominal.ode", folder / "run.csv", effects="linear-term")


def test_attributes_are_those_of_the_json(found: lacuna.Identification) -> None:
    document = json.loads(found.to_json())
    assert set(document) <= set(dir(found))
    assert found.verdict == document["verdict"]
    assert found.validation.windows.states[0].state == "x"
    assert found.to_dict() == document
    assert found.ok and not found.failure
    with pytest.raises(AttributeError, match="nonsense"):
        found.nonsense
    with pytest.raises(AttributeError, match="nonsense"):
        found.validation.nonsense


def test_trail_and_rivals_are_frames(found: lacuna.Identification, lacks: lacuna.Diagnosis) -> None:
    trail = found.trail.to_frame()
    assert {"equation", "term", "kept", "value"} <= set(trail.columns)
    assert len(trail) == len(found.trail)
    assert len(lacks.rivals.to_frame()) == len(lacks.rivals) > 0


def test_a_diagnosis_names_what_is_missing(lacks: lacuna.Diagnosis) -> None:
    assert lacks.verdict == "explained"
    assert lacks.effects[0].name in {"linear-term", "leakage"}
    assert lacks.model is not None
    assert "v" in lacks.model.terms["v"]


def test_every_picture_is_drawn_on_axes(
    found: lacuna.Identification, lacks: lacuna.Diagnosis
) -> None:
    import matplotlib.pyplot as plt

    for result in (found, lacks):
        figures = result.figures()
        assert list(figures) == list(result.pictures())
        assert len(figures) > 2
        for name, figure in figures.items():
            axes = result.plot(name)
            assert axes.get_title() == figure["title"]
            if figure["kind"] == "lines":
                assert len(axes.lines) == len(figure["series"])
        axes = plt.figure().add_subplot()
        assert (
            result.plot(next(n for n, f in figures.items() if f["kind"] == "lines"), axes) is axes
        )
        plt.close("all")
    with pytest.raises(KeyError, match="nonsense"):
        found.plot("nonsense")


class Ids(HTMLParser):
    """Ids of the elements of a page."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.ids: list[str] = []
        self.frames: list[str] = []
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        values = dict(attrs)
        if values.get("id"):
            self.ids.append(str(values["id"]))
        if tag == "iframe":
            self.frames.append(str(values["srcdoc"]))


def test_two_answers_on_one_page_have_no_id_in_common(
    found: lacuna.Identification, lacks: lacuna.Diagnosis
) -> None:
    shown = Ids(found._repr_html_() + lacks._repr_html_())
    assert shown.ids == []
    assert shown.frames == [found.report(), lacks.report()]
    assert "prefers-color-scheme" in shown.frames[0]


def test_a_report_is_written(found: lacuna.Identification, tmp_path: Path) -> None:
    page = found.report(tmp_path / "out.html")
    assert (tmp_path / "out.html").read_text() == page
    assert page.startswith("<!DOCTYPE html>")


def test_answers_without_a_page_say_so(folder: Path) -> None:
    summary = lacuna.check(folder / "run.csv")
    with pytest.raises(TypeError, match="no report"):
        summary.report()
    assert summary.pictures() == {} == summary.figures()
    assert "<pre>" in summary._repr_html_()


def _shown(result: lacuna.Result) -> tuple[str, str, str]:
    return result.to_json(), result.summary(), result.report()


def test_answers_go_to_other_processes(
    found: lacuna.Identification, lacks: lacuna.Diagnosis
) -> None:
    again = pickle.loads(pickle.dumps(lacks))
    assert again.explain() == lacks.explain()
    assert again.model == lacks.model
    assert list(again.figures()) == list(lacks.figures())
    with get_context("spawn").Pool(1) as pool:
        text, summary, _ = pool.apply(_shown, (found,))
    assert (text, summary) == (found.to_json(), found.summary())


def test_a_simulation_is_columns_with_names(folder: Path) -> None:
    run = lacuna.simulate(folder / "true.ode", [1, 0], np.linspace(0, 2, 9),
                          inputs=folder / "input.csv")  # fmt: skip
    t, x = run
    assert x.shape == (9, 2) and len(run) == 9
    np.testing.assert_array_equal(run["v"], x[:, 1])
    frame = run.to_frame()
    assert list(frame.columns) == ["x", "v"]
    np.testing.assert_array_equal(frame.index, t)
    assert run.units == {"x": "m", "v": "m/s"}
    assert "9 samples" in repr(run)


def test_what_has_no_answer_is_said() -> None:
    with pytest.raises(lacuna.NoAnswerError, match="simulate"):
        lacuna.simulate(lacuna.Model.from_text("dx/dt = x^2"), [1.0], t_end=5, dt=0.1)


def test_warnings_have_a_class_of_their_own(samples: tuple[np.ndarray, np.ndarray]) -> None:
    t, x = samples
    gappy = x.copy()
    gappy[100] = np.nan
    with pytest.warns(lacuna.LacunaWarning, match="split"):
        lacuna.identify(gappy, t, preset="sindy", degree=1)


def test_a_build_says_what_it_holds() -> None:
    info = lacuna.build_info()
    assert info["version"] == lacuna.__version__
    assert set(info) == {"version", "compiler", "libraries", "gpl"}
    libraries = info["libraries"]
    assert isinstance(libraries, dict)
    assert set(info["gpl"]) == {"Ceres", "CHOLMOD"} & set(libraries)  # type: ignore[call-overload]
