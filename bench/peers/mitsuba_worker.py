"""A process that renders one scene with one variant of Mitsuba, on request: `mitsuba_worker.py VARIANT SCENE.json SIZE SPP`.
Each line of its input is a seed; it answers with a line of JSON: CPU seconds of the render, mean linear sRGB of the image; and keeps
the images, so that "noise" answers with their efficiency."""
import json
import os
import sys
import time

import mitsuba as mi
import numpy as np

from answering import answer_seeds
from mitsuba_scene import mitsuba_scene

XYZ_TO_SRGB = np.array([[3.2404542, -1.5371385, -0.4985314], [-0.9692660, 1.8760108, 0.0415560], [0.0556434, -0.2040259, 1.0572252]])


def main():
    variant, path, size, spp = sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
    mi.set_variant(variant)
    llvm = variant.startswith("llvm")
    if llvm:
        import drjit as dr
        dr.set_thread_count(1)
    scene = mi.load_dict(mitsuba_scene(mi, json.load(open(path)), size, spp), parallel=False)

    def render(seed):
        begin = time.process_time()
        image = mi.render(scene, spp=spp, seed=seed)
        if llvm:
            dr.eval(image)
            dr.sync_thread()
        image = np.array(image, dtype=np.float64)
        took = time.process_time() - begin
        return took, took, image @ XYZ_TO_SRGB.T

    if llvm:
        render(1 << 20)  # traces and compiles
    answer_seeds(sys.stdout, {"ready": mi.__version__, "threads": os.cpu_count()}, render)


main()
