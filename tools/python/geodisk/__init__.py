"""Random points on triangle meshes, no two closer than a minimum distance along the surface.

Distances are exact geodesic ones, computed on a Vulkan device, a GPU's or the CPU's.

Examples
--------
>>> import geodisk
>>> box = geodisk.sample_box([1, 1], min_distance=0.1)
>>> len(box) > 50
True
"""

from . import compat
from ._bake import SampleMap, bake
from ._box import sample_box
from ._cells import Cells, cells
from ._devices import Device, devices
from ._errors import (
    Cancelled,
    DeviceLost,
    Error,
    GeodiskWarning,
    InvalidArgument,
    MeshRejected,
    MeshWarning,
    NoDevice,
    OutOfMemory,
)
from ._farthest import FarthestOrder, farthest_order
from ._geodesics import (
    GeodesicPath,
    disk_radii,
    geodesic_distances,
    geodesic_path,
    outside_faces,
)
from ._library import version
from ._mesh import Mesh
from ._neighbours import Neighbours, neighbours
from ._picture import Picture, render
from ._reading import read
from ._samples import Sample, Samples
from ._sampling import sample, sample_many
from ._transfer import transfer
from ._update import update
from ._verification import Verification, verify

__version__ = version()
__all__ = [
    "Cancelled",
    "Cells",
    "Device",
    "DeviceLost",
    "Error",
    "FarthestOrder",
    "GeodesicPath",
    "GeodiskWarning",
    "InvalidArgument",
    "Mesh",
    "MeshRejected",
    "MeshWarning",
    "Neighbours",
    "NoDevice",
    "OutOfMemory",
    "Picture",
    "Sample",
    "SampleMap",
    "Samples",
    "Verification",
    "bake",
    "cells",
    "compat",
    "devices",
    "disk_radii",
    "farthest_order",
    "geodesic_distances",
    "geodesic_path",
    "neighbours",
    "outside_faces",
    "read",
    "render",
    "sample",
    "sample_box",
    "sample_many",
    "transfer",
    "update",
    "verify",
]
