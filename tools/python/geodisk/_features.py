"""Samples on the corners and curves of a mesh, before those on its faces."""

from __future__ import annotations

import dataclasses
import math
from ctypes import byref, c_size_t

import numpy as np

from . import _errors as e
from . import _library as c
from . import _structs as s
from ._devices import DeviceLike
from ._existing import existing_of
from ._mesh import Mesh
from ._results import places_of
from ._running import Runs
from ._samples import Samples
from ._values import number


def degrees_of(features: float) -> float:
    """Returns the angle from which on edges are features, checked."""
    degrees = math.nan if isinstance(features, bool) else number(features, "features")
    if not 1 <= degrees <= 180:
        raise e.invalid(f"features is {features!r}, not an angle from 1 to 180 degrees")
    return degrees


class Features:
    """The features of one mesh of many: they are sampled before all meshes together."""

    def __init__(self, features: float, mesh: Mesh, device: DeviceLike | None) -> None:
        self._degrees = degrees_of(features)
        self._mesh, self._device = mesh, device
        self._corners = c_size_t()

    def settle(self, params: s.SurfaceParams, kept: int) -> object:
        """Samples the features at the distance of `params`, and adds them to its existing samples.

        The first `kept` of these are those of the caller. Returns what has to be kept until the
        domain is made.
        """
        params.existing_count = kept
        own = s.SurfaceParams.from_buffer_copy(params)
        own.darts = own.stop_count = 0
        domain = c.Handle(
            "domain",
            "geodisk_domain_features",
            self._mesh._handle.value,
            byref(own),
            self._degrees,
            byref(self._corners),
        )
        if not domain.value:
            return None
        with Runs(self._device, False) as runs:
            settled = existing_of(self._mesh._surface, places_of(runs.run(domain)))
        params.existing, params.existing_count = settled.ctypes.data, len(settled)
        return settled

    def marked(self, samples: Samples, kept: int, settled: int) -> Samples:
        """Returns the samples of the run with the column `feature`.

        The first `kept` are the caller's own, and the first `settled` these and those on features.
        """
        assert samples.barycentric is not None
        kinds = np.count_nonzero(samples.barycentric == 0, axis=1).astype(np.uint32)
        place = np.arange(len(samples))
        kinds[(place < kept) | (place >= settled)] = 0
        columns = {name: x for name, x in samples.columns.items() if name != "existing"}
        if kept > 0:
            columns["existing"] = (place < kept).astype(np.uint32)
        columns["feature"] = kinds
        corners = int(np.count_nonzero(kinds == 2))
        report = {
            **samples.report,
            "existing": kept,
            "corners": corners,
            "corners_left_out": self._corners.value - corners,
        }
        return dataclasses.replace(samples, columns=columns, report=report)
