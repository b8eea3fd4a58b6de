"""What samples get of their mesh besides attributes: normals, colours of a texture, frames.

Samples that update() and transfer() make inherit it.
"""

from __future__ import annotations

import copy
import dataclasses
import json
import numbers
import os
import reprlib
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from . import _errors as e
from . import _library as c
from ._oddities import warn
from ._polygons import from_rows
from ._source import split
from ._surface import Surface
from ._values import choice, names, number, path_of, text

if TYPE_CHECKING:
    from ._mesh import Mesh
    from ._samples import Samples


_AUTO = "auto"


class Record:
    """What to add."""

    texture: str | None  #: Path of an image, or "auto" for the materials of the mesh.
    normals: str
    frames: str | None  #: Style of frames, as files spell it.
    up: str | None  #: Axis that frames keep to, where they do; None for that of the mesh.

    def __init__(
        self,
        texture: str | os.PathLike[str] | None,
        normals: str,
        frames: bool | float | str,
        up: str | None = None,
    ) -> None:
        self.texture = None if texture is None else path_of(texture, "texture")
        if self.texture == _AUTO and not isinstance(texture, str):
            self.texture = os.path.join(os.curdir, _AUTO)  # A path means a file of that name.
        self.normals = choice(normals, "normals", ("face", "file", "smooth"))
        self.frames, has_up = _style_of(frames)
        self.up = None if up is None else choice(up, "up", "xyz")
        if up is not None and not has_up:
            raise e.invalid("up is for frames that are 'upright', or a part of the way to the normal")
        self._has_up = has_up

    def on(self, surface: Surface) -> Record:
        """Returns the same with the axis that frames on a mesh keep to."""
        if not self._has_up or self.up is not None:
            return self
        found = copy.copy(self)
        found.up = "y" if surface.is_y_up else "z"
        return found

    def with_texture(self, texture: str) -> Record:
        """Returns the same with another texture."""
        found = copy.copy(self)
        found.texture = texture
        return found

    def check_no_file(self) -> None:
        """Raises TypeError for what only the reader of a file finds."""
        if self.texture is not None or self.normals == "file":
            raise TypeError("a texture, and normals of a file, need the path of the mesh")

    def check(self, surface: Surface) -> None:
        """Raises if a mesh cannot have it."""
        if self.is_nothing():
            return
        if surface.dimension() != 3:
            raise e.invalid("texture, normals and frames need a mesh with 3 coordinates per vertex")
        if self.texture is not None and "color" in surface.attributes:
            raise e.invalid("the texture and the attribute color are both attributes['color']")

    def has_materials(self) -> bool:
        """Returns True for the colours of the materials of the mesh."""
        return self.texture == _AUTO

    def is_nothing(self) -> bool:
        return self.texture is None and self.normals == "face" and self.frames is None


def _style_of(frames: bool | float | str) -> tuple[str | None, bool]:
    """Returns the style of frames, and whether they keep to an axis of the mesh."""
    if isinstance(frames, (bool, np.bool_)):
        return ("yes" if frames else None), False
    if isinstance(frames, numbers.Real):
        frames = repr(number(frames, "frames"))
    if not isinstance(frames, str):
        raise TypeError(f"frames is {reprlib.repr(frames)}, neither True, False, a number nor a text")
    if not frames:
        raise e.invalid("frames is '', which names no style")
    (style,) = c.run("frame_style", text=text(frames, "frames"))
    read = json.loads(style)
    return read["text"], read["has_up"]


NOTHING = Record(None, "face", False)


def recorded(samples: Samples, mesh: Mesh, record: Record) -> Samples:
    """Returns samples with what they get of their mesh, as the program writes it."""
    if record.is_nothing():
        return dataclasses.replace(samples, _record=record)
    assert samples.face_index is not None and samples.barycentric is not None
    record = record.on(mesh._surface)
    normals = np.asarray(samples.normals, np.float64)
    normals, added = _record(
        mesh, record, samples.face_index, samples.barycentric, normals, samples.seed or 0
    )
    return dataclasses.replace(
        samples, normals=normals, attributes={**samples.attributes, **added}, _record=record
    )


def coloured(samples: Samples, mesh: Mesh, texture: str | None) -> Samples:
    """Returns samples with the colours of a texture, by the texture coordinates of a mesh."""
    if texture is None or mesh._source is None or "color" in samples.attributes:
        return samples
    assert samples.face_index is not None and samples.barycentric is not None
    normals = np.zeros((len(samples), 3))
    colours = Record(texture, "face", False)
    try:
        _, added = _record(mesh, colours, samples.face_index, samples.barycentric, normals, 0)
    except e.InvalidArgument:  # The image is gone.
        return samples
    had = samples._record or NOTHING
    return dataclasses.replace(
        samples,
        attributes={**samples.attributes, **added},
        _record=had.with_texture(texture),
    )


def check_record(mesh: Mesh, record: Record) -> None:
    """Raises for images and normals that cannot be read, before samples are made for them."""
    if record.texture is not None or record.normals == "file":
        none = np.empty((0, 3))
        _record(mesh, record, np.empty(0, np.uint32), none, none, 0)


def _record(
    mesh: Mesh,
    record: Record,
    face_index: NDArray[np.uint32],
    barycentric: NDArray[np.float64],
    normals: NDArray[np.float64],
    seed: int,
) -> tuple[NDArray[np.float64], dict[str, NDArray[np.float64]]]:
    """Returns normals and attributes."""
    arrays: dict[str, Any] = {
        "source": mesh._source or _source_of(mesh._surface),
        "faces": np.ascontiguousarray(face_index),
        "samples": np.hstack([barycentric, normals]),
        "path": None if record.texture is None else os.fsencode(record.texture),
    }
    made = c.run(
        "record", arrays, count=len(face_index), normals=record.normals,
        frames=record.frames or "", up=record.up or "", seed=seed,
    )
    if record.normals != "face":
        normals = np.frombuffer(made.pop(0), np.float32).reshape(-1, 3).astype(np.float64)
    added = {}
    for name, value, width in (("color", record.texture, 3), ("frames", record.frames, 4)):
        if value is not None:
            added[name] = np.frombuffer(made.pop(0), np.float64).reshape(-1, width).copy()
    return normals, added


def _source_of(surface: Surface) -> c.Handle | None:
    """Returns a source of a mesh that was not read from a file."""
    faces = from_rows(surface.indices())
    return split(surface.coordinates(), faces, surface.weld, surface.keep_seams).handle


@dataclass(frozen=True)
class Inherited:
    """Arguments of update() or transfer(); None where the samples say it."""

    texture: str | os.PathLike[str] | None
    normals: str | None
    frames: bool | float | str | None
    up: str | None
    attributes: str | Sequence[str] | None = None
    has_colours: bool = False  #: Whether what is made keeps the colours of a texture already.

    def given(self) -> Record:
        """Returns what the caller asks for."""
        frames = False if self.frames is None else self.frames
        normals = "face" if self.normals is None else self.normals
        return Record(self.texture, normals, frames, None if self.frames is None else self.up)

    def inherited(self, samples: Samples) -> Record:
        """Returns what the caller asks for, and else what the samples had."""
        given, had = self.given(), record_of(samples)
        texture = had.texture if self.texture is None and not self.has_colours else given.texture
        normals = had.normals if self.normals is None else given.normals
        frames = had if self.frames is None else given
        up = frames.up if self.up is None else self.up
        return Record(texture, normals, frames.frames or False, up)

    def mesh(
        self, samples: Samples, own: Sequence[str], make: Callable[[Record, Sequence[str]], Mesh]
    ) -> tuple[Mesh, Record]:
        """Returns a mesh and its record: all that is wanted, or what the mesh has of it.

        `make` returns the mesh to move to, read for a record and attributes. `own` names the
        attributes to read if the caller does not say it.
        """
        given, wanted = self.given(), self.inherited(samples)
        listed = () if self.attributes is None else names(self.attributes, "attributes")
        inherited = own if self.attributes is None else listed
        less = _without_file(wanted, given)
        for record, read in ((wanted, inherited), (less, inherited), (less, listed)):
            try:
                return make(record, read), record
            except (TypeError, e.InvalidArgument, e.MeshRejected):
                pass  # What the caller asks for raises below.
        return make(given, listed), given

    def warn_of_lost(self, before: Samples, after: Samples) -> None:
        """Shows what the samples had, and have no longer."""
        columns = before.columns.keys() - after.columns.keys() - {"existing"}
        lost = [f"columns[{name!r}]" for name in columns]
        if self.attributes is None:
            own = before.attributes.keys() - after.attributes.keys() - {"cover", "row"}
            own -= {"frames"} if self.frames is not None else set()
            lost += [f"attributes[{name!r}]" for name in own]
        had = record_of(before).normals
        if self.normals is None and had != record_of(after).normals:
            lost.append(f"normals={had!r}")
        if lost:
            message = (
                f"the samples of this mesh lack {', '.join(sorted(lost))} of those before; give the "
                "path of its file, or values to interpolate()"
            )
            warn([e.GeodiskWarning(message, "not_kept", len(lost))])


def record_of(samples: Samples) -> Record:
    """Returns what samples have of their mesh, as far as they know it."""
    return samples._record or Record(None, "face", "frames" in samples.attributes)


def _without_file(wanted: Record, given: Record) -> Record:
    """Returns what a mesh of arrays can have, and what the caller asks for."""
    normals = given.normals if wanted.normals == "file" else wanted.normals
    return Record(given.texture, normals, wanted.frames or False, wanted.up)
