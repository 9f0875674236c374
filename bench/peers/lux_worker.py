"""A process that renders one scene with LuxCore, on request, as mitsuba_worker.py does with Mitsuba: `lux_worker.py lux SCENE.json SIZE SPP`.
Each line of its input is a seed; it answers with a line of JSON: CPU seconds of the render, mean linear sRGB; and keeps the images, so
that "noise" answers with their efficiency. LuxCore looks at its number of samples from time to time only and takes some more than
asked: seconds are those that the samples asked for would have taken."""
import json
import os
import sys
import time

import numpy as np

from answering import answer_seeds

POLL = 0.01


def render(pyluxcore, scene, configuration, size):
    """CPU seconds and samples after the start, which compiles the scene, and the picture."""
    session = pyluxcore.RenderSession(pyluxcore.RenderConfig(configuration, scene))

    def state():
        session.UpdateStats()
        return time.process_time(), session.GetStats().Get("stats.renderengine.total.samplecount").GetFloat()

    session.Start()
    begin, first = state()
    while not session.HasDone():
        time.sleep(POLL)
        session.UpdateStats()
    end, last = state()
    pixels = np.zeros(size * size * 3, dtype=np.float32)
    session.GetFilm().GetOutputFloat(pyluxcore.FilmOutputType.RGB, pixels, 0, False)
    session.Stop()
    return end - begin, last - first, pixels.reshape(size, size, 3)[::-1].astype(np.float64)


def main():
    path, size, spp = sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # LuxCore's messages
    os.environ["OCL_ICD_VENDORS"] = "/nonexistent"  # it asks every OpenCL platform what it is, which some do not survive
    import pyluxcore
    from lux_scene import build, settings

    pyluxcore.Init(lambda message: None)
    description = json.load(open(path))
    scene = build(description, size)

    def render_seed(seed):
        took, samples, image = render(pyluxcore, scene, settings(description["integrator"], size, seed, spp), size)
        return took * size * size * spp / samples, took, image

    answer_seeds(answers, {"ready": pyluxcore.Version()}, render_seed)
    os._exit(0)  # its end can fail after the work is done


main()
