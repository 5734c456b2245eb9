"""Files of values and arrays that are whole, or known to be damaged."""

import io
import json
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from branchcrush.files.replacing import replacing


class Damaged(ValueError):
    """A file is not what was written: its name."""


def write_kept(path: Path, plain: Mapping[str, Any], arrays: Mapping[str, NDArray]) -> None:
    """Write values and arrays to one file, which takes an older one's place when it is whole.

    Parameters
    ----------
    path : Path
    plain : mapping
        What JSON can hold.
    arrays : mapping
    """
    buffer = io.BytesIO()
    text = np.frombuffer(json.dumps(plain).encode(), dtype=np.uint8)
    np.savez(buffer, plain=text, **arrays)
    content = buffer.getbuffer()
    with replacing(path) as file:
        file.write(zlib.crc32(content).to_bytes(4, "big"))
        file.write(content)


def read_kept(path: Path) -> tuple[dict[str, Any], dict[str, NDArray]]:
    """Return the values and arrays that `write_kept` wrote.

    Parameters
    ----------
    path : Path

    Raises
    ------
    Damaged
        When the file is not what was written.
    """
    content = path.read_bytes() if path.exists() else b""
    if len(content) < 4 or zlib.crc32(content[4:]).to_bytes(4, "big") != content[:4]:
        raise Damaged(path.name)
    with np.load(io.BytesIO(content[4:])) as file:
        arrays = {name: file[name] for name in file.files}
    return json.loads(arrays.pop("plain").tobytes()), arrays
