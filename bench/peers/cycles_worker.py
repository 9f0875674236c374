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

from answering import answer_seeds
from cycles_scene import build


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

    loading = min(render(1 << 20, 1)[0] for _ in range(3))

    def render_alone(seed):
        took, image = render(seed, spp)
        alone = (took - loading) * spp / (spp - 1)
        return alone, alone, image

    answer_seeds(answers, {"ready": bpy.app.version_string}, render_alone)
    os.remove(picture)
    answers.flush()
    os._exit(0)  # Blender's own end can fail after the work is done


main()
