"""Skin from fair to dark: reflectance spectra and colours for a sweep of the melanosome fraction.

A notebook in plain Python: editors run its `# %%` cells one by one; `python melanin_sweep.py [FILE.png]` runs them all. Without matplotlib
the numbers are printed alone.
"""

# %% The scene: a large patch of skin under a white sky, seen from above.
import sys

import numpy as np

import stokes


def patch(melanosomes):
    """Skin under a sky of radiance 1 at every wavelength: the radiance that comes back is the reflectance."""
    return {
        "scene unit": "mm",
        "camera": {"type": "orthographic", "transform": {"from": [0, 0, 50]}, "height": 4, "resolution": [16, 16]},
        "integrator": {"max bounces": 1024, "russian roulette": False},
        "background": {"type": "constant", "value": 1.0},
        "materials": [{"type": "skin", "name": "skin", "melanosome fraction": melanosomes, "blood fraction": 0.01}],
        "surfaces": [{"type": "quad", "size": 40, "material": "skin"}],
    }


# %% Render. Spectra are arrays of (height, width, bins): the mean over the pixels is the patch's reflectance.
fractions = [0.02, 0.05, 0.10, 0.20, 0.35]
reflectances, colours = [], []
for fraction in fractions:
    result = stokes.render(patch(fraction), spp=200, spectral=(380, 780, 20))
    reflectances.append(result.spectra.mean(axis=(0, 1)))
    colours.append(result.image.mean(axis=(0, 1)))
wavelengths = result.wavelengths

# %% The numbers.
for fraction, reflectance, colour in zip(fractions, reflectances, colours):
    at = {nm: float(np.interp(nm, wavelengths, reflectance)) for nm in (450, 550, 650)}
    print(f"melanosomes {fraction:4.2f}: " + ", ".join(f"{value:.3f} at {nm} nm" for nm, value in at.items()), "| linear sRGB", np.round(colour, 3))

# %% The last picture shows itself in a notebook.
result

# %% Plot.
try:
    import matplotlib.pyplot as plt
except ImportError:
    print("matplotlib is not installed: no plot")
else:
    figure, axes = plt.subplots(figsize=(7, 4))
    for fraction, reflectance, colour in zip(fractions, reflectances, colours):
        encoded = np.clip(colour, 0, 1) ** (1 / 2.2)
        axes.plot(wavelengths, reflectance, color=encoded, linewidth=3, label=f"melanosomes {fraction:.2f}")
    axes.set(xlabel="wavelength (nm)", ylabel="reflectance under a white sky", xlim=(380, 780), ylim=(0, None))
    axes.legend()
    figure.tight_layout()
    if len(sys.argv) > 1 and sys.argv[1].endswith(".png"):
        figure.savefig(sys.argv[1], dpi=120)
    else:
        plt.show()
