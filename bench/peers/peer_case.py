"""One scene rendered by Stokes and by another renderer in turn (A B A B), one thread each, in CPU seconds. Knows the cases and the
workers' protocol, not how results are printed."""
import json
import pathlib
import statistics
import subprocess

HERE = pathlib.Path(__file__).resolve().parent
SCENES = HERE.parent / "scenes"

# name, scene, Russian roulette from that bounce (False: off), edge of the image, samples per pixel of the peer, factor of ours,
# the ratio of rates that must and that should be reached.
MITSUBA_CASES = [
    ("s1", "s1", False, 128, 16, 8, 3, 7),
    ("s1 rr5", "s1", 5, 128, 32, 8, 3, 7),
    ("s2", "s2", False, 128, 8, 16, 5, 12),
    ("s2hi", "s2hi", False, 128, 8, 16, 5, 12),
    ("mesh_box", "mesh_box", False, 128, 32, 4, 1.5, 3),
    ("mesh_box rr5", "mesh_box", 5, 128, 32, 4, 1.5, 3),
    ("s3 rr5", "s3", 5, 128, 16, 4, 2.5, 6),
    ("s3", "s3", False, 64, 4, 8, 6, 15),
]
# Others have no such goals for rates. Cycles' samples are stratified best in powers of two.
CYCLES_CASES = [
    ("s1", "s1", False, 96, 16, 8, None, None),
    ("s1 rr5", "s1", 5, 96, 16, 8, None, None),
    ("s2", "s2", False, 96, 16, 8, None, None),
    ("s2hi", "s2hi", False, 96, 16, 8, None, None),
    ("mesh_box rr5", "mesh_box", 5, 96, 16, 8, None, None),
    ("s3 rr5", "s3", 5, 64, 8, 8, None, None),
]
LUX_CASES = [
    ("s1", "s1", False, 96, 32, 8, None, None),
    ("s1 rr5", "s1", 5, 96, 32, 8, None, None),
    ("s2", "s2", False, 96, 16, 16, None, None),
    ("s2hi", "s2hi", False, 96, 16, 16, None, None),
    ("mesh_box", "mesh_box", False, 96, 32, 4, None, None),
    ("mesh_box rr5", "mesh_box", 5, 96, 32, 4, None, None),
    ("s3 rr5", "s3", 5, 64, 16, 4, None, None),
]
CASES = {"mitsuba": MITSUBA_CASES, "cycles": CYCLES_CASES, "lux": LUX_CASES}
NAMES = {"mitsuba": "Mitsuba", "cycles": "Cycles", "lux": "LuxCore"}
VARIANT = {"mitsuba": "llvm_ad_spectral", "cycles": "cycles", "lux": "lux"}


def prepare_scene(name, roulette, folder, export_mesh):
    """The suite's scene with its generated meshes exported, so that both programs see the same triangles."""
    scene = json.loads((SCENES / f"{name}.json").read_text())
    scene["integrator"]["russian roulette"] = roulette
    for surface in scene["surfaces"]:
        if "generator" in surface:
            mesh, resolution = surface.pop("generator"), str(surface.pop("resolution"))
            parameters = [f"{key}={value}" for key, value in surface.pop("parameters", {}).items()]
            path = folder / ("_".join([mesh, resolution, *parameters]) + ".obj")
            if not path.exists():
                subprocess.run([export_mesh, mesh, resolution, path, *parameters], check=True)
            surface["filename"] = str(path)
    path = folder / f"{name}_{roulette}.json"
    path.write_text(json.dumps(scene))
    return path


class Worker:
    """Another renderer's process: its ..._worker.py. A request is a seed or "noise", an answer a line of JSON."""

    def __init__(self, python, peer, variant, scene, size, spp):
        self.peer = peer
        self.process = subprocess.Popen([python, HERE / f"{peer}_worker.py", variant, scene, str(size), str(spp)],
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.version = self.answer()["ready"]

    def answer(self):
        line = self.process.stdout.readline()
        if not line:
            raise RuntimeError(f"{self.peer}: its worker ended early")
        return json.loads(line)

    def ask(self, request):
        self.process.stdin.write(f"{request}\n")
        self.process.stdin.flush()
        return self.answer()

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def run_stokes(program, scene, size, spp, seed, noise=False, more=()):
    """What `stokes bench --json` says of one render with one thread."""
    command = [program, "bench", scene, "--json", "--repeat", "1", "--threads", "1", "--size", f"{size}x{size}", "--spp", str(spp),
               "--seed", str(seed), "--no-cold", "--no-parity", *more]
    return json.loads(subprocess.run(command + ([] if noise else ["--no-noise"]), check=True, capture_output=True, text=True).stdout)[0]


def python_of(peer, options):
    return {"mitsuba": options.python, "cycles": options.cycles_python, "lux": options.lux_python}[peer]


def mean_and_error(values):
    spread = statistics.stdev(values) / len(values) ** 0.5 if len(values) > 1 else float("nan")
    return statistics.fmean(values), spread


def means(answers):
    return [mean_and_error([a["mean"][c] for a in answers]) for c in range(3)]


def note_difference(result, of, reference):
    pairs = list(zip(of, reference))
    result["difference_percent"] = [100 * (a[0] / b[0] - 1) for a, b in pairs]
    result["difference_error_percent"] = [100 * (a[1] ** 2 + b[1] ** 2) ** 0.5 / b[0] for a, b in pairs]


def compare_with_scalar(result, case, scene, options):
    """How far our image means are from Mitsuba's scalar variant, which is the truth of the two."""
    spp = max(1, int(case[4] * options.truth_factor))
    truth = Worker(options.python, "mitsuba", "scalar_spectral", scene, case[3], spp)
    result["scalar_mean"] = means([truth.ask(50000 + i) for i in range(options.truth_rounds)])
    truth.close()
    note_difference(result, result["mean"], result["scalar_mean"])


def run_case(case, peer, options, folder):
    """`options` needs stokes, export_mesh, python, cycles_python and lux_python (of the peers), rounds, truth_rounds and truth_factor.
    Efficiencies are of eight images of the same number of samples on both sides: where a few paths carry most of the light, the
    median pixel's variance depends on that number."""
    name, scene_name, roulette, size, spp, factor, must, aim = case
    scene = prepare_scene(scene_name, roulette, folder, options.export_mesh)
    worker = Worker(python_of(peer, options), peer, VARIANT[peer], scene, size, spp)
    run_stokes(options.stokes, scene, size, 1, 0)  # fills the kernel cache
    ours, theirs = [], []
    for i in range(options.rounds):
        ours.append(run_stokes(options.stokes, scene, size, spp * factor, 1000 * i))
        theirs.append(worker.ask(i))
    for i in range(len(theirs), 8):
        theirs.append(worker.ask(i))
    noise = worker.ask("noise")
    worker.close()
    last = run_stokes(options.stokes, scene, size, spp * 8, 1000 * options.rounds, noise=True)
    our_rates = [o["samples"] / o["cpu_seconds"] * 1e-6 for o in ours]
    their_rates = [size * size * spp / t["cpu_seconds"] * 1e-6 for t in theirs]
    ratios = sorted(a / b for a, b in zip(our_rates, their_rates))
    finite = lambda value: value if value not in (0, float("inf")) else None
    # The last render's own seconds are those of a render that was not in turn: our efficiencies take the rounds' rate.
    speed = statistics.median(our_rates) / (last["samples"] / last["cpu_seconds"] * 1e-6)
    result = {
        "case": name, "peer": peer, "must": must, "aim": aim, "size": size, "device": last["device"], "driver": last["driver"],
        "stokes": last["version"], "peer_version": worker.version, "samples_per_pixel": spp,
        "stokes_msamples": statistics.median(our_rates), "peer_msamples": statistics.median(their_rates),
        "ratio": statistics.median(ratios), "ratio_low": ratios[0], "ratio_high": ratios[-1],
        "rays_per_sample": last["rays"] / last["samples"], "shadow_rays_per_sample": last["shadow_rays"] / last["samples"],
        "scatterings_per_sample": last["scatterings"] / last["samples"],
        "mscatterings_per_cpu_second": statistics.median(o["mscatterings_per_cpu_second"] for o in ours),
        "efficiency_median": finite(last["efficiency_median"] * speed), "peer_efficiency_median": finite(noise["efficiency_median"]),
        "efficiency_rgb": finite(last["efficiency_rgb"] * speed), "peer_efficiency_rgb": finite(noise["efficiency_rgb"]),
        "mean": means(ours), "peer_mean": means(theirs)}
    if peer != "mitsuba":
        note_difference(result, result["peer_mean"], result["mean"])
    elif options.truth_rounds > 0:
        compare_with_scalar(result, case, scene, options)
    return result


def efficiency_ratio(result, kind):
    """Ours over theirs, `kind` "median" or "rgb"; None where either has no noise to speak of."""
    a, b = result[f"efficiency_{kind}"], result[f"peer_efficiency_{kind}"]
    return a / b if a and b else None
