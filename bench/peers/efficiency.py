"""How much quality a second of CPU time buys: the definition that `stokes bench` uses, for images of other renderers."""
import numpy as np

LUMINANCE = np.array([0.2126729, 0.7151522, 0.0721750])


def efficiencies(images, seconds):
    """Of independent images [n, height, width, linear sRGB] that took `seconds` of CPU time each: pixels / (relative variance x
    seconds) / 1e6, of the luminance's median pixel and of the trimmed mean of R, G and B."""
    luminance = images @ LUMINANCE
    relative = luminance.var(0, ddof=1) / (luminance.mean(0) ** 2 + 0.01)
    colours = (images.var(0, ddof=1) / (images.mean(0) ** 2 + 0.01)).mean(-1)
    kept = relative <= np.quantile(relative, 0.999)
    count = relative.size
    return float(count / (np.median(relative) * seconds) / 1e6), float(count / (colours[kept].mean() * seconds) / 1e6)
