from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

class Picture:
    device: str
    invalid: int
    samples: int
    load_seconds: float
    build_seconds: float
    render_seconds: float
    warnings: list[str]
    def channels(self) -> dict[str, NDArray[np.float32]]: ...
    def metadata(self) -> dict[str, str]: ...
    def write_exr(self, path: str) -> None: ...
    def write_png(self, path: str, exposure: float) -> None: ...

def render(
    text: str | None, path: str, directory: str, options: dict[str, Any], progress: Callable[[float], object] | None
) -> Picture: ...
def parity(
    text: str | None,
    path: str,
    directory: str,
    options: dict[str, Any],
    alpha: float,
    block: int,
    progress: Callable[[float], object] | None,
) -> dict[str, Any]: ...
def devices() -> list[dict[str, Any]]: ...
def version() -> str: ...
