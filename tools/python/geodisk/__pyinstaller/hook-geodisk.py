"""PyInstaller's hook for geodisk: its libraries and, if installed, geodisk_cpu."""

import pathlib
from importlib.util import find_spec

binaries = []
datas = []
hiddenimports = []
# What samples.to() and meshes of other packages need; programs that use these import them.
excludedimports = ["nibabel", "open3d", "pyvista", "torch", "trimesh", "vtkmodules"]
for package in ("geodisk", "geodisk_cpu"):
    found = find_spec(package)
    if found is None:
        continue
    hiddenimports.append(package)
    for folder in map(pathlib.Path, found.submodule_search_locations or []):

        def collect(*patterns: str) -> list[tuple[str, str]]:
            paths = [path for pattern in patterns for path in folder.glob(pattern)]
            return [(str(path), str(path.parent.relative_to(folder.parent))) for path in paths]

        binaries += collect("*.so*", "*.dylib", "*.dll")
        datas += collect("*.json")
