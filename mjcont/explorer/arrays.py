"""Arrays as JSON carries them: `{"dtype", "shape", "data"}`, base64 of little-endian numbers, read without a copy."""

from __future__ import annotations

import base64
import math
from collections.abc import Mapping
from typing import Any

import numpy as np

TYPES = {"f4": np.float32, "f8": np.float64, "i1": np.int8, "i4": np.int32, "u2": np.uint16, "u4": np.uint32}


def packed(values: Any, dtype: str = "f8") -> dict[str, Any]:
    """Return an array as plain data; NaN and infinity are numbers like others."""
    array = np.ascontiguousarray(values, dtype=np.dtype(TYPES[dtype]).newbyteorder("<"))
    return {"dtype": dtype, "shape": list(array.shape), "data": base64.b64encode(array.tobytes()).decode("ascii")}


def unpacked(found: Mapping[str, Any]) -> np.ndarray:
    """Return the array that `packed` made plain."""
    flat = np.frombuffer(base64.b64decode(found["data"]), np.dtype(TYPES[found["dtype"]]).newbyteorder("<"))
    return flat.reshape(found["shape"])


def indices(values: np.ndarray) -> dict[str, Any]:
    """Return numbers of vertices, in two bytes each where these can hold them."""
    return packed(values, "u2" if values.size == 0 or values.max() < 2**16 else "u4")


def plain(value: Any) -> Any:
    """Return numbers, texts, lists and mappings as strict JSON takes them: what is no number is None."""
    if isinstance(value, Mapping):
        return {str(k): plain(v) for k, v in value.items()}
    if isinstance(value, list | tuple | np.ndarray):
        return [plain(v) for v in value]
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    return value if value is None or isinstance(value, bool | int | str) else str(value)
