"""What samples had of their mesh, for those that update() and transfer() make of them."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Callable, Sequence

from . import _errors as e
from ._mesh import Mesh
from ._oddities import warn
from ._record import Record
from ._samples import Samples
from ._values import names

#: Makes the mesh to move to, read for a record and attributes.
MakeMesh = Callable[[Record, Sequence[str]], Mesh]


@dataclass(frozen=True)
class Wanted:
    """Arguments of a caller; None where the samples say it."""

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

    def mesh(self, samples: Samples, own: Sequence[str], make: MakeMesh) -> tuple[Mesh, Record]:
        """Returns a mesh and its record: all that is wanted, or what the mesh has of it.

        `own` names the attributes to read if the caller does not say it.
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
