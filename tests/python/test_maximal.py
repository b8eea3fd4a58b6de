"""Maximal sets."""

import geodisk
import pytest

from meshes import FACES, VERTICES


def test_a_maximal_set_is_certified():
    pool = geodisk.sample(VERTICES, FACES, min_distance=0.3, seed=4)
    samples = geodisk.sample(VERTICES, FACES, min_distance=0.3, seed=4, maximal=True)
    assert pool.report["is_certified"] == 0
    assert samples.report["is_certified"] == 1
    assert samples.report["maximal_rounds"] > 0
    assert 0.3 < samples.report["largest_gap"] < 0.3001
    assert len(samples) > len(pool)
    assert (samples.points[: len(pool)] == pool.points).all()
    assert geodisk.verify(samples)
    assert len(geodisk.sample(VERTICES, FACES, min_distance=0.3, pool_ratio=100)) > len(pool)
