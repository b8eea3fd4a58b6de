"""Functions of other packages by exact geodesic distances, with their arguments and results.

Each module has the name of a package, which it does not import before it needs it.
"""

from . import open3d, pyg, trimesh

__all__ = ["open3d", "pyg", "trimesh"]
