"""What a render and a comparison return."""

from __future__ import annotations

import os
import tempfile
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from . import _core

_VECTORS = {
    "albedo": ("Albedo.R", "Albedo.G", "Albedo.B"),
    "normal": ("N.X", "N.Y", "N.Z"),
    "variance": ("Variance.R", "Variance.G", "Variance.B"),
    "fluorescence": ("Fluorescence.R", "Fluorescence.G", "Fluorescence.B"),
}
_SCALARS = {"depth": "Z", "fluorescence_energy": "Fluorescence.Energy"}


def _spectra(channels: dict[str, NDArray[np.float32]]) -> tuple[NDArray[np.float64], NDArray[np.float32]] | None:
    names = [name for name in channels if name.startswith("S0.")]
    if not names:
        return None
    centres = [float(name[3:-2].replace(",", ".")) for name in names]
    order = np.argsort(centres)
    return np.array(centres)[order], np.stack([channels[names[i]] for i in order], axis=-1)


@dataclass(repr=False)
class Render:
    """A rendered picture. In a notebook it shows itself.

    Arrays have the shape (height, width, ...); row 0 is the top. Radiances are in the scene's units of emission; where lamps are in watts,
    W m^-2 sr^-1.

    Attributes:
        image: (h, w, 3) float32, linear sRGB (Rec. 709 primaries, D65 white).
        alpha: (h, w) float32, the fraction of samples that hit something.
        aovs: by name, what ``aov`` asked for: ``albedo`` (h, w, 3), ``normal`` (h, w, 3; world space), ``depth`` (h, w; scene units),
            ``variance`` (h, w, 3; of each pixel's mean), ``fluorescence`` (h, w, 3; the part of ``image`` that came through a dye) and
            ``fluorescence_energy`` (h, w; its radiance integrated over wavelength).
        wavelengths: (n,) centres of the spectral bins in nm, or None.
        spectra: (h, w, n) float32, mean spectral radiance per nm of each bin, or None.
        samples: samples per pixel.
        device: the device's name.
        load_seconds, build_seconds, render_seconds: reading the scene, building kernels, rendering.
        invalid_samples: samples that were not finite and were left out.
        metadata: what the EXR says of itself (version, scene hash, seed, ...).
    """

    image: NDArray[np.float32]
    alpha: NDArray[np.float32]
    aovs: dict[str, NDArray[np.float32]]
    wavelengths: NDArray[np.float64] | None
    spectra: NDArray[np.float32] | None
    samples: int
    device: str
    load_seconds: float
    build_seconds: float
    render_seconds: float
    invalid_samples: int
    metadata: dict[str, str]
    _picture: _core.Picture = field(repr=False)

    @classmethod
    def _of(cls, picture: _core.Picture) -> Render:
        channels = picture.channels()
        aovs = {name: np.stack([channels[c] for c in parts], axis=-1) for name, parts in _VECTORS.items() if parts[0] in channels}
        aovs.update({name: channels[c] for name, c in _SCALARS.items() if c in channels})
        wavelengths, spectra = _spectra(channels) or (None, None)
        return cls(
            image=np.stack([channels[c] for c in "RGB"], axis=-1),
            alpha=channels["A"],
            aovs=aovs,
            wavelengths=wavelengths,
            spectra=spectra,
            samples=picture.samples,
            device=picture.device,
            load_seconds=picture.load_seconds,
            build_seconds=picture.build_seconds,
            render_seconds=picture.render_seconds,
            invalid_samples=picture.invalid,
            metadata=picture.metadata(),
            _picture=picture,
        )

    def save(self, path: str | os.PathLike[str], exposure: float = 0) -> None:
        """Writes an ``.exr`` (float32, every channel, metadata) or an 8-bit sRGB ``.png``, there ``exposure`` stops brighter."""
        name = os.fspath(path)
        if name.lower().endswith(".exr"):
            self._picture.write_exr(name)
        elif name.lower().endswith(".png"):
            self._picture.write_png(name, exposure)
        else:
            raise ValueError(f"{name!r} ends in neither .exr nor .png")

    def png(self, exposure: float = 0) -> bytes:
        """The picture as an 8-bit sRGB PNG, ``exposure`` stops brighter."""
        with tempfile.TemporaryDirectory() as folder:
            name = os.path.join(folder, "picture.png")
            self._picture.write_png(name, exposure)
            with open(name, "rb") as file:
                return file.read()

    def _repr_png_(self) -> bytes:
        return self.png()

    def __repr__(self) -> str:
        height, width, _ = self.image.shape
        more = "".join(f", {name}" for name in self.aovs)
        bins = "" if self.wavelengths is None else f", {len(self.wavelengths)} bins"
        return f"<stokes.Render {width}x{height}, {self.samples} samples{more}{bins}, {self.render_seconds:.2f} s on {self.device}>"


@dataclass
class Parity:
    """Whether a device and the CPU reference render the same picture.

    Attributes:
        agree: the verdict.
        device: the device's name.
        largest_z, threshold_z: the largest |z| of all tests, and that above which one rejects (Sidak-corrected).
        p: probability of so large a |z| if both render the same.
        tests, block: how many tests, and the edge of the pixel blocks.
        means, rejected: dicts with channel, x, y, width, height (0: the whole image), device, reference, z, p.
        report: a few lines for people.
    """

    agree: bool
    device: str
    largest_z: float
    threshold_z: float
    p: float
    tests: int
    block: int
    means: list[dict[str, Any]]
    rejected: list[dict[str, Any]]
    report: str

    def __bool__(self) -> bool:
        return self.agree


@dataclass(frozen=True)
class Device:
    """An OpenCL device. ``id`` is what ``device=`` takes; ``auto`` says that ``device="auto"`` takes it; ``why_not`` why it is not usable."""

    id: str
    name: str
    platform: str
    type: str
    vendor: str
    version: str
    driver: str
    compute_units: int
    memory_bytes: int
    usable: bool
    why_not: str
    auto: bool
