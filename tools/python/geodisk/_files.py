"""Files that are written whole or not at all."""

from __future__ import annotations

import contextlib
import os
import secrets
import stat
import tempfile
from typing import BinaryIO, Callable, Iterator

from . import _errors as e

_BINARY = getattr(os, "O_BINARY", 0)


@contextlib.contextmanager
def complete(path: str) -> Iterator[BinaryIO]:
    """Gives a file to write, which takes the place of `path` once all of it is on the disk.

    Follows links, and keeps the permissions and the owner of a file that is replaced. What
    is there stays as it was when writing fails. Raises OSError for what cannot be replaced as a whole.
    """
    target = os.path.realpath(path)
    replaced = _replaced(path, target)
    try:
        partial, descriptor = _open_new(os.path.dirname(target))
    except OSError as error:  # It names the temporary file.
        raise type(error)(error.errno, error.strerror, path) from None
    try:
        with open(descriptor, "wb") as file:
            if replaced is not None:
                _take_rights(partial, replaced, path)
            yield file
            file.flush()
            os.fsync(file.fileno())
        os.replace(partial, target)
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(partial)
        raise


def bytes_of(suffix: str, write: Callable[[str], object]) -> bytes:
    """Returns the file that `write(path)` writes."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "samples" + suffix)
        try:
            write(path)
        except e.InvalidArgument as error:
            raise e.invalid(str(error).replace(path + ": ", "")) from None
        with open(path, "rb") as file:
            return file.read()


def _replaced(path: str, target: str) -> os.stat_result | None:
    """Returns what is known of the file at `target`, or None if there is none."""
    try:
        found = os.stat(target)
    except FileNotFoundError:
        return None
    if stat.S_ISDIR(found.st_mode):
        raise IsADirectoryError(f"{path}: is a folder")
    if not stat.S_ISREG(found.st_mode):
        raise OSError(f"{path}: is not a regular file")
    if not os.access(target, os.W_OK):
        raise PermissionError(f"{path}: is write-protected")
    if found.st_nlink > 1:
        raise OSError(
            f"{path}: has another name (a hard link), which would keep the old content; "
            "remove it first"
        )
    return found


def _open_new(folder: str) -> tuple[str, int]:
    """Makes a file under a name that nobody else has. Its permissions are those of new files."""
    while True:
        partial = os.path.join(folder, f".geodisk-{secrets.token_hex(8)}.tmp")
        with contextlib.suppress(FileExistsError):
            return partial, os.open(partial, os.O_CREAT | os.O_EXCL | os.O_WRONLY | _BINARY, 0o666)


def _take_rights(partial: str, replaced: os.stat_result, path: str) -> None:
    """Gives the new file the owner and permissions of the one that it replaces."""
    own = os.stat(partial)
    if hasattr(os, "chown") and (own.st_uid, own.st_gid) != (replaced.st_uid, replaced.st_gid):
        try:
            os.chown(partial, replaced.st_uid, replaced.st_gid)
        except PermissionError:
            raise PermissionError(f"{path}: belongs to another user; replacing it would change its owner") from None
    os.chmod(partial, stat.S_IMODE(replaced.st_mode))
