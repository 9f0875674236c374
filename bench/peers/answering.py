"""What the workers of all peers have in common: seeds come in, a line each, and lines of JSON go out."""
import json
import sys

import numpy as np

from efficiency import efficiencies


def answer_seeds(answers, ready, render):
    """Says `ready` (a dict) to the file `answers`, then answers each line of standard input: a seed by the CPU seconds of its render and the mean
    linear sRGB, "noise" by the efficiency of all images so far. `render(seed)` returns the seconds to tell, the seconds that this very image took,
    and the image [height, width, linear sRGB]."""

    def answer(value):
        print(json.dumps(value), file=answers, flush=True)

    answer(ready)
    images, seconds = [], []
    for line in sys.stdin:
        if line.strip() == "noise":
            median, rgb = efficiencies(np.array(images), float(np.median(seconds)))
            answer({"efficiency_median": median, "efficiency_rgb": rgb})
            continue
        told, took, image = render(int(line))
        images.append(image)
        seconds.append(took)
        answer({"cpu_seconds": told, "mean": image.mean((0, 1)).tolist()})
