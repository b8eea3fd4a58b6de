"""The result of a run."""

from __future__ import annotations

import ctypes
import os
from dataclasses import dataclass, field

import numpy as np

from . import _library as c


@dataclass(frozen=True)
class Samples:
    """Samples, in the order of the darts: the first n of them are the set of the first n.

    Attributes
    ----------
    points : ndarray of float64, shape (n, d) or None
        Where they are; None on a mesh of lengths.
    normals : ndarray of float64, shape (n, 3) or None
        Of their triangles, on meshes in three dimensions.
    face_index : ndarray of uint32, shape (n,) or None
        Their triangles, on meshes.
    barycentric : ndarray of float64, shape (n, 3) or None
        Weights of their triangles' corners. They sum to 1.
    radius : ndarray of float64, shape (n,)
        Half the minimum distance, or where radii vary, of each.
    order : ndarray of int64, shape (n,)
        Their places in the order of the darts.
    min_distance : float
        No two are closer along the surface; where radii vary, two with the largest ones.
    seed : int
    report : dict
        How the run went: candidates, disks, windows, rho, bytes and seconds.
    """

    points: np.ndarray | None
    normals: np.ndarray | None
    face_index: np.ndarray | None
    barycentric: np.ndarray | None
    radius: np.ndarray
    order: np.ndarray
    min_distance: float
    seed: int
    report: dict = field(repr=False)

    def __len__(self) -> int:
        return len(self.radius)

    def __repr__(self) -> str:
        return f"<geodisk.Samples: {len(self)}, {self.min_distance:.6g} apart, seed {self.seed}>"

    def save(self, path) -> None:
        """Writes the samples to a file, which is complete or not there.

        Parameters
        ----------
        path : str or path-like
            ``*.npz`` for ``numpy.load``, or ``*.csv``, which ``geodisk verify`` and the other
            commands read.

        Raises
        ------
        ValueError
            For another kind of file, or samples of a box as CSV.
        """
        path = os.fspath(path)
        kind = os.path.splitext(path)[1].lower()
        if kind not in (".npz", ".csv"):
            raise ValueError(f"{path}: samples are saved as *.npz or *.csv")
        if kind == ".csv" and self.face_index is None:
            raise ValueError(f"{path}: samples of a box are saved as *.npz")
        partial = f"{path}.{os.getpid()}.tmp"
        try:
            with open(partial, "wb") as file:
                self._write_npz(file) if kind == ".npz" else self._write_csv(file)
                file.flush()
                os.fsync(file.fileno())
            os.replace(partial, path)
        except BaseException:
            if os.path.exists(partial):
                os.unlink(partial)
            raise

    def _write_npz(self, file) -> None:
        arrays = {
            "points": self.points,
            "normals": self.normals,
            "face_index": self.face_index,
            "barycentric": self.barycentric,
            "radius": self.radius,
            "min_distance": np.float64(self.min_distance),
            "seed": np.uint64(self.seed),
        }
        np.savez(file, **{name: array for name, array in arrays.items() if array is not None})

    def _write_csv(self, file) -> None:
        varies = len(self) > 0 and np.ptp(self.radius) > 0
        columns = [("face_index", self.face_index[:, None], "%d")]
        columns.append(("bary_u,bary_v,bary_w", self.barycentric, "%.9g"))
        if self.points is not None and self.points.shape[1] == 3:
            columns.insert(0, ("nx,ny,nz", self.normals, "%.9g"))
            columns.insert(0, ("x,y,z", self.points, "%.17g"))
        if varies:
            columns.append(("radius", self.radius[:, None], "%.17g"))
        header = (
            f"# version: geodisk {c.version()}\n# min_distance: {self.min_distance!r}\n"
            f"# radius: {self.min_distance / 2!r}\n# seed: {self.seed}\n"
        )
        header += ",".join(name for name, _, _ in columns) + "\n"
        file.write(header.encode())
        formats = [text for _, array, text in columns for _ in range(array.shape[1])]
        np.savetxt(file, np.hstack([a for _, a, _ in columns]), fmt=formats, delimiter=",")


def _copied(samples, attribute: int, dtype) -> np.ndarray | None:
    width = c.samples_width(samples, attribute)
    if width == 0:
        return None
    count = c.samples_count(samples)
    array = np.empty((count, width), dtype)
    kind = c.UINT32 if dtype == np.uint32 else c.FLOAT64
    c.call("geodisk_samples_copy", samples, attribute, kind, array.ctypes.data, 0, count)
    return array


def samples_of(handle: c.Handle, seed: int) -> Samples:
    samples = handle.value
    report = c.Report()
    c.call("geodisk_samples_report", samples, ctypes.byref(report))
    told = {
        name: getattr(report, name)
        for name, _ in c.Report._fields_
        if name not in ("struct_size", "calls")
    }
    face = _copied(samples, c.FACE, np.uint32)
    return Samples(
        points=_copied(samples, c.POSITION, np.float64),
        normals=_copied(samples, c.NORMAL, np.float64),
        face_index=None if face is None else face[:, 0],
        barycentric=_copied(samples, c.BARYCENTRIC, np.float64),
        radius=_copied(samples, c.RADIUS, np.float64)[:, 0],
        order=np.arange(c.samples_count(samples)),
        min_distance=report.min_distance,
        seed=seed,
        report=told,
    )
