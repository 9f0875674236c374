"""A process that renders one scene with Cycles, on request, as mitsuba_worker.py does with Mitsuba:
`cycles_worker.py cycles SCENE.json SIZE SPP`. Each line of its input is a seed; it answers with a line of JSON: CPU seconds of the
render, mean linear sRGB; and keeps the images, so that "noise" answers with their efficiency. Blender synchronises the scene in every
render: what a render of one sample takes is measured first and subtracted, with that sample."""
import json
import os
import sys
import tempfile
import time

import bpy
import numpy as np

from cycles_scene import build
from efficiency import efficiencies


def main():
    path, size, spp = sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
    answers = os.fdopen(os.dup(1), "w")
    quiet = os.open(os.devnull, os.O_WRONLY)  # Blender's messages
    os.dup2(quiet, 1)
    scene = build(json.load(open(path)), size, 1)
    handle, picture = tempfile.mkstemp(suffix=".exr")
    os.close(handle)
    scene.render.filepath = picture

    def render(seed, samples):
        scene.cycles.samples, scene.cycles.seed = samples, seed
        begin = time.process_time()
        bpy.ops.render.render(write_still=True)
        took = time.process_time() - begin
        image = bpy.data.images.load(picture)
        pixels = np.array(image.pixels[:], dtype=np.float64).reshape(size, size, -1)[::-1, :, :3]
        bpy.data.images.remove(image)
        return took, pixels

    def answer(value):
        print(json.dumps(value), file=answers, flush=True)

    loading = min(render(1 << 20, 1)[0] for _ in range(3))
    answer({"ready": bpy.app.version_string})
    images, seconds = [], []
    for line in sys.stdin:
        if line.strip() == "noise":
            median, rgb = efficiencies(np.array(images), float(np.median(seconds)))
            answer({"efficiency_median": median, "efficiency_rgb": rgb})
            continue
        took, image = render(int(line), spp)
        images.append(image)
        seconds.append((took - loading) * spp / (spp - 1))
        answer({"cpu_seconds": seconds[-1], "mean": image.mean((0, 1)).tolist()})
    os.remove(picture)
    answers.flush()
    os._exit(0)  # Blender's own end can fail after the work is done


main()
