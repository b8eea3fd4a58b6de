"""tools/bench/scaling counts what processes exchange, and its model finds the figures that it is fitted to."""

import importlib.machinery
import importlib.util
import math
import pathlib

import pytest

from launching import ENVIRONMENT, PROGRAM
from surfaces import torus, write_ply

TOOL = pathlib.Path(__file__).resolve().parents[2] / "tools" / "bench" / "scaling"


@pytest.fixture
def scaling():
    loader = importlib.machinery.SourceFileLoader("scaling", str(TOOL))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("scaling", loader))
    loader.exec_module(module)
    module.PROGRAM = pathlib.Path(PROGRAM)
    module.ENVIRONMENT = ENVIRONMENT
    return module


def figures(scaling, processes, parts, samples):
    """What a model with a = 4, n = 5, b = 100, r = 2, s = 0.5 and i = 3 gives."""
    width = math.sqrt(samples / parts)
    halo = (1 + 4 / width) ** 2
    return scaling.Figures(processes, parts, samples, halo, 5 * halo, 100 * width,
                           2 + 0.5 * math.log2(parts), 1 + 3 / math.sqrt(samples / processes))


def test_model_finds_what_made_the_figures(scaling):
    runs = [figures(scaling, processes, parts, samples)
            for processes, parts in [(8, 8), (8, 32), (8, 64)] for samples in (1e3, 1e5)]
    # Those of few parts do not count.
    model = scaling.Model([scaling.Figures(2, 2, 1e3, 9, 9, 9, 9, 9)] + runs)
    for parts, samples in [(64, 1e6), (4096, 1e8)]:
        expected, found = figures(scaling, parts, parts, samples), model.at(parts, parts, samples)
        for name in ["held", "neighbours", "bytes", "rounds", "messages", "imbalance"]:
            assert getattr(found, name) == pytest.approx(getattr(expected, name)), name
    assert figures(scaling, 1, 1, model.width_at(2) ** 2).held == pytest.approx(2)


def test_model_needs_several_numbers_of_parts(scaling):
    with pytest.raises(SystemExit, match="two runs with different numbers of parts"):
        scaling.Model([figures(scaling, 8, 8, 1e3), figures(scaling, 4, 4, 1e3)])


def test_figures_are_those_of_a_run(scaling, tmp_path):
    mesh = tmp_path / "torus.ply"
    write_ply(mesh, *torus(60, 24))
    found = scaling.run("mpirun -q", str(mesh), 100, 2, 4)
    assert (found.processes, found.parts) == (2, 8)
    assert 80 < found.samples < 120 and 1 < found.held < 8 and found.neighbours <= 7
    assert found.rounds > 1 and found.bytes > 0 and 1 <= found.imbalance < 2
    with pytest.raises(SystemExit, match="not read in ranges"):
        scaling.run("mpirun -q", "builtin:torus-knot", 100, 2, 2)
