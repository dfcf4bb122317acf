"""Registered parts are classes with checked options; pipelines hold them."""

from __future__ import annotations

import copy
import pickle
import re

import numpy as np
import pytest

import lacuna

Samples = tuple[np.ndarray, np.ndarray]
KINDS = ("basis", "formulation", "differentiator", "filter", "regressor", "pruner", "refiner")


def every_class() -> list[type[lacuna.Stage]]:
    names = [name for name in dir(lacuna) if name not in lacuna.__all__]
    return [getattr(lacuna, name) for name in names]


def test_every_registered_part_of_a_pipeline_is_a_class() -> None:
    lines = [line for kind in KINDS for line in lacuna.list_parts(kind).splitlines()]
    listed = [line.split()[0] for line in lines if re.match(r"  \S", line)]  # others go on
    made = [part.name for part in every_class() if part.kind in KINDS]
    assert sorted(made) == sorted(listed)
    assert len(made) > 25


@pytest.mark.parametrize("part", every_class(), ids=lambda part: part.__name__)
def test_options_are_described_and_come_back(part: type[lacuna.Stage]) -> None:
    if "Unavailable" in lacuna.describe(part.name):
        with pytest.raises(lacuna.ConfigError, match="not in this build"):
            part()
        return
    stage = part()
    assert stage.to_dict()["type"] == part.name
    for option in stage.to_dict():
        assert option == "type" or f"{option} :" in str(part.__doc__)
    assert pickle.loads(pickle.dumps(stage)) == stage == copy.deepcopy(stage)
    assert repr(stage).startswith(part.__name__)


def test_a_value_out_of_range_names_option_and_range() -> None:
    with pytest.raises(ValueError, match=r"threshold.*at least 0") as raised:
        lacuna.Stlsq(threshold=-1)
    assert isinstance(raised.value, lacuna.ConfigError)
    with pytest.raises(lacuna.ConfigError, match="threshold"):
        lacuna.Stlsq(treshold=1)
    with pytest.raises(lacuna.ConfigError):
        lacuna.Stlsq(threshold="much")


def test_options_are_attributes() -> None:
    stage = lacuna.Stlsq(threshold=0.2)
    assert stage.threshold == 0.2
    with pytest.raises(AttributeError, match="no option"):
        stage.nonsense
    assert stage != lacuna.Stlsq() and stage == lacuna.Stlsq(threshold=0.2)
    assert hash(stage) == hash(lacuna.Stlsq(threshold=0.2))
    inner = lacuna.Strong(differentiator=lacuna.SavitzkyGolay())
    assert inner.differentiator["type"] == "savitzky-golay"


def test_a_name_that_is_none_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="Nonsense"):
        lacuna.Nonsense


@pytest.mark.filterwarnings("ignore::lacuna.LacunaWarning")
def test_a_pipeline_is_used(samples: Samples) -> None:
    t, x = samples
    pipeline = lacuna.Pipeline(
        preset="sindy",
        basis=lacuna.Monomials(max_degree=2),
        regressor=lacuna.Stlsq(threshold=0.05),
        differentiator="savitzky-golay",
    )
    found = lacuna.identify(x, t, pipeline=pipeline)
    used = found.pipeline.used
    assert used.basis.max_degree == 2
    assert used.regressor.threshold == 0.05
    assert used.formulation.differentiator.type == "savitzky-golay"
    same = lacuna.identify(
        x, t, preset="sindy", degree=2,
        options={"regressor.threshold": 0.05, "differentiator": lacuna.SavitzkyGolay()},
    )  # fmt: skip
    assert same.model == found.model


def test_a_preset_is_all_of_its_stages(samples: Samples) -> None:
    t, x = samples
    whole = lacuna.Pipeline.preset("sindy")
    assert isinstance(whole.stages()["regressor"], lacuna.Stlsq)
    found = lacuna.identify(x, t, pipeline=whole)
    assert found.model == lacuna.identify(x, t, preset="sindy").model
    assert lacuna.Pipeline.preset("algorithm1", paper=True).stages()["pruner"].tolerances == "paper"
    with pytest.raises(lacuna.ConfigError, match="sindy"):
        lacuna.Pipeline.preset("sindi")


def test_a_stage_in_a_wrong_place_is_said() -> None:
    with pytest.raises(lacuna.ConfigError, match="is a regressor"):
        lacuna.Pipeline(basis=lacuna.Ols())
