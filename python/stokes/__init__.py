"""Stokes, a spectral volumetric path tracer: scenes to numpy arrays.

>>> import stokes
>>> result = stokes.render("scenes/jensen_box.json", spp=16)
>>> result.image.shape
(512, 512, 3)

A scene is a file or a dict of the same format (scenes/README.md).
"""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Callable, Iterable, Mapping
from typing import Any, Union

from . import _core
from ._errors import DeviceError, InvalidSamplesWarning, SceneError, SceneWarning
from ._result import Device, Parity, Render

__version__ = _core.version().split()[0]
__all__ = ["Device", "DeviceError", "InvalidSamplesWarning", "Parity", "Render", "SceneError", "SceneWarning", "devices", "parity", "render"]

Scene = Union[str, "os.PathLike[str]", Mapping[str, Any]]
Progress = Callable[[float], object]


def _plain(value: Any) -> Any:
    """numpy's numbers and arrays as JSON's."""
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"{type(value).__name__} is no value of a scene")


def _source(scene: Scene, directory: str | os.PathLike[str] | None) -> tuple[str | None, str, str]:
    """The scene's text (None: it is a file), its name for messages, and the folder of its files."""
    if isinstance(scene, Mapping):
        return json.dumps(scene, indent=1, default=_plain, ensure_ascii=False), "scene", os.fspath(directory or ".")
    if directory is not None:
        raise TypeError("directory is for scenes given as dicts; a file's own folder is taken")
    return None, os.fspath(scene), ""


def _options(
    *,
    size: tuple[int, int] | None,
    aov: str | Iterable[str] | None = None,
    spectral: tuple[float, float, int] | None = None,
    overrides: Mapping[str, Any] | None,
    **rest: Any,
) -> dict[str, Any]:
    for name, low in (("spp", 1), ("seed", 0), ("threads", 0)):
        high = 2**32 - 1 if name == "seed" else 2**31 - 1
        if rest.get(name) is not None and not low <= rest[name] <= high:
            raise ValueError(f"{name}: {rest[name]} is not in the range {low} to {high}")
    if rest.get("mode") not in (None, "spectral", "rgb"):
        raise ValueError(f"mode: {rest['mode']!r} is neither 'spectral' nor 'rgb'")
    if rest.get("wavelengths_per_path") not in (None, 1, 4, 8):
        raise ValueError(f"wavelengths_per_path: {rest['wavelengths_per_path']} is none of 1, 4 and 8")
    return {
        **rest,
        "allow_outside": os.environ.get("STOKES_ALLOW_OUTSIDE", "") not in ("", "0", "false"),
        "device": rest.get("device") or os.environ.get("STOKES_DEVICE") or "auto",
        "size": None if size is None else "x".join(str(int(n)) for n in size),
        "aov": aov if aov is None or isinstance(aov, str) else ",".join(aov) or None,
        "spectral": None if spectral is None else ":".join(f"{x:g}" for x in spectral),
        "overrides": [f"{pointer}={json.dumps(value, default=_plain)}" for pointer, value in (overrides or {}).items()],
    }


def render(
    scene: Scene,
    *,
    spp: int | None = None,
    device: str | None = None,
    aov: str | Iterable[str] | None = None,
    spectral: tuple[float, float, int] | None = None,
    seed: int | None = None,
    size: tuple[int, int] | None = None,
    integrator: str | None = None,
    mode: str | None = None,
    wavelengths_per_path: int | None = None,
    threads: int = 0,
    overrides: Mapping[str, Any] | None = None,
    directory: str | os.PathLike[str] | None = None,
    progress: Progress | None = None,
) -> Render:
    """Renders a scene. The GIL is released meanwhile; Ctrl-C ends the render and raises KeyboardInterrupt.

    What is None is as the scene says.

    Args:
        scene: a scene file, or the same as a dict; numpy values may stand in it. The files that a dict names may lie anywhere, those of a
            scene file in or below its folder, that one's parent or the current one, unless $STOKES_ALLOW_OUTSIDE is 1.
        spp: samples per pixel.
        device: "auto", "reference" (the CPU integrator), "gpu", "cpu", "P:D" or part of a name; None: $STOKES_DEVICE, else "auto".
        aov: "albedo", "normal", "depth", "variance", "fluorescence", several of them, or "all"; see Render.aovs.
        spectral: (from, to, n): n equal bins between two wavelengths in nm, within 280 to 780; see Render.spectra.
        seed: of the random numbers. Scene, seed and spp determine the picture to the bit, on one device.
        size: (width, height) in pixels.
        integrator: "mis", "nee", "mats", "normals", "ao".
        mode: "spectral" or "rgb".
        wavelengths_per_path: 1, 4 or 8.
        threads: CPU threads; 0 is all.
        overrides: values by JSON pointer that replace the scene's, as {"/camera/vfov": 40}.
        directory: where files that a dict names are looked for; None: the current one.
        progress: called with the fraction done, some 50 times a second.

    Raises:
        SceneError: the scene is wrong.
        DeviceError: there is no such device, or it failed.
        ValueError: an argument is wrong.
        MemoryError: the film or scene is too large.
    """
    options = _options(spp=spp, device=device, aov=aov, spectral=spectral, seed=seed, size=size, integrator=integrator, mode=mode,
                       wavelengths_per_path=wavelengths_per_path, threads=threads, overrides=overrides)  # fmt: skip
    picture = _core.render(*_source(scene, directory), options, progress)
    for warning in picture.warnings:
        warnings.warn(warning, SceneWarning, stacklevel=2)
    if picture.invalid:
        warnings.warn(f"{picture.invalid} invalid samples (NaN, infinite or too large) were left out", InvalidSamplesWarning, stacklevel=2)
    return Render._of(picture)


def parity(
    scene: Scene,
    *,
    device: str | None = None,
    spp: int | None = None,
    alpha: float = 0.01,
    block: int = 0,
    seed: int | None = None,
    size: tuple[int, int] | None = None,
    integrator: str | None = None,
    mode: str | None = None,
    wavelengths_per_path: int | None = None,
    threads: int = 0,
    overrides: Mapping[str, Any] | None = None,
    directory: str | os.PathLike[str] | None = None,
    progress: Progress | None = None,
) -> Parity:
    """Renders a scene on a device and by the CPU reference, and tests whether they agree within their noise.

    Args:
        alpha: probability that equal renders are called different.
        block: edge in pixels of the blocks that are compared; 0: by the samples.

    The other arguments and the exceptions are those of `render`; spp must be 2 or more.
    """
    if not 0 < alpha <= 0.5:
        raise ValueError(f"alpha: {alpha} is outside (0, 0.5]")
    options = _options(spp=spp, device=device, seed=seed, size=size, integrator=integrator, mode=mode,
                       wavelengths_per_path=wavelengths_per_path, threads=threads, overrides=overrides)  # fmt: skip
    return Parity(**_core.parity(*_source(scene, directory), options, alpha, block, progress))


def devices() -> list[Device]:
    """Every OpenCL device, numbered as by `clinfo -l`. The CPU reference (device="reference") is always there beside them."""
    return [Device(**d) for d in _core.devices()]
