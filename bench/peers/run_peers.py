"""Stokes and Mitsuba on the same scenes, in turn (A B A B), one thread each, in CPU seconds: prints the ratio of rates with its
spread, and how far the image means are from Mitsuba's scalar variant. run_peers.sh sets up what this needs."""
import argparse
import datetime
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
SCENES = HERE.parent / "scenes"

# name, scene, Russian roulette from that bounce (False: off), edge of the image, samples per pixel of Mitsuba, factor of ours,
# what is compared, the ratio that must and that should be reached.
CASES = [
    ("s1", "s1", False, 128, 16, 8, "msamples", 3, 7),
    ("s1 rr5", "s1", 5, 128, 32, 8, "msamples", 3, 7),
    ("s2", "s2", False, 128, 8, 16, "msamples", 5, 12),
    ("s2hi", "s2hi", False, 128, 8, 16, "msamples", 5, 12),
    ("mesh_box", "mesh_box", False, 128, 32, 4, "msamples", 1.5, 3),
    ("mesh_box rr5", "mesh_box", 5, 128, 32, 4, "msamples", 1.5, 3),
    ("s3 rr5", "s3", 5, 128, 16, 4, "msamples", 2.5, 6),
    ("s3", "s3", False, 64, 4, 8, "msamples", 6, 15),
]


def arguments():
    p = argparse.ArgumentParser(description=__doc__)
    p.add_argument("--stokes", default="build/stokes", help="the program [build/stokes]")
    p.add_argument("--export-mesh", default="build/bench/peers/bench_export_mesh")
    p.add_argument("--python", default=sys.executable, help="a Python with Mitsuba")
    p.add_argument("--rounds", type=int, default=8)
    p.add_argument("--truth-rounds", type=int, default=8, help="renders by scalar_spectral; 0: no comparison of means")
    p.add_argument("--truth-factor", type=float, default=4, help="their samples per pixel, in Mitsuba's of the case")
    p.add_argument("--only", default="", help="names of cases, separated by commas")
    p.add_argument("--out", default="", help="writes OUT.json and OUT.md")
    return p.parse_args()


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


class Mitsuba:
    """A worker process; see mitsuba_worker.py."""

    def __init__(self, python, variant, scene, size, spp):
        self.process = subprocess.Popen([python, HERE / "mitsuba_worker.py", variant, scene, str(size), str(spp)],
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.version = self.answer()["ready"]

    def answer(self):
        line = self.process.stdout.readline()
        if not line:
            sys.exit("Mitsuba's worker ended early")
        return json.loads(line)

    def ask(self, request):
        self.process.stdin.write(f"{request}\n")
        self.process.stdin.flush()
        return self.answer()

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def run_stokes(program, scene, size, spp, seed, noise):
    command = [program, "bench", scene, "--json", "--repeat", "1", "--threads", "1", "--size", f"{size}x{size}", "--spp", str(spp),
               "--seed", str(seed), "--no-cold", "--no-parity"]
    return json.loads(subprocess.run(command + ([] if noise else ["--no-noise"]), check=True, capture_output=True, text=True).stdout)[0]


def mean_and_error(values):
    spread = statistics.stdev(values) / len(values) ** 0.5 if len(values) > 1 else float("nan")
    return statistics.fmean(values), spread


def run_case(case, options, folder):
    name, scene_name, roulette, size, spp, factor, _, must, aim = case
    scene = prepare_scene(scene_name, roulette, folder, options.export_mesh)
    peer = Mitsuba(options.python, "llvm_ad_spectral", scene, size, spp)
    run_stokes(options.stokes, scene, size, 1, 0, False)  # fills the kernel cache
    ours, theirs = [], []
    for i in range(options.rounds):
        ours.append(run_stokes(options.stokes, scene, size, spp * factor, 1000 * i, i == options.rounds - 1))
        theirs.append(peer.ask(i))
    noise = peer.ask("noise")
    peer.close()
    our_rates = [o["samples"] / o["cpu_seconds"] * 1e-6 for o in ours]
    their_rates = [size * size * spp / t["cpu_seconds"] * 1e-6 for t in theirs]
    ratios = sorted(a / b for a, b in zip(our_rates, their_rates))
    last = ours[-1]
    result = {
        "case": name, "must": must, "aim": aim, "size": size, "device": last["device"], "driver": last["driver"],
        "stokes": last["version"], "mitsuba": peer.version,
        "stokes_msamples": statistics.median(our_rates), "mitsuba_msamples": statistics.median(their_rates),
        "ratio": statistics.median(ratios), "ratio_low": ratios[0], "ratio_high": ratios[-1],
        "rays_per_sample": last["rays"] / last["samples"], "shadow_rays_per_sample": last["shadow_rays"] / last["samples"],
        "scatterings_per_sample": last["scatterings"] / last["samples"],
        "mscatterings_per_cpu_second": statistics.median(o["mscatterings_per_cpu_second"] for o in ours),
        "efficiency_median": last["efficiency_median"], "mitsuba_efficiency_median": noise["efficiency_median"],
        "efficiency_rgb": last["efficiency_rgb"], "mitsuba_efficiency_rgb": noise["efficiency_rgb"],
        "mean": [mean_and_error([o["mean"][c] for o in ours]) for c in range(3)],
        "llvm_mean": [mean_and_error([t["mean"][c] for t in theirs]) for c in range(3)]}
    if options.truth_rounds > 0:
        truth = Mitsuba(options.python, "scalar_spectral", scene, size, max(1, int(spp * options.truth_factor)))
        runs = [truth.ask(50000 + i) for i in range(options.truth_rounds)]
        truth.close()
        result["scalar_mean"] = [mean_and_error([t["mean"][c] for t in runs]) for c in range(3)]
        result["difference_percent"] = [100 * (a[0] / b[0] - 1) for a, b in zip(result["mean"], result["scalar_mean"])]
        result["difference_error_percent"] = [100 * (a[1] ** 2 + b[1] ** 2) ** 0.5 / b[0] for a, b in zip(result["mean"], result["scalar_mean"])]
    return result


HEADER = ["case", "Stokes Ms/s", "Mitsuba Ms/s", "ratio", "spread", "must", "aim", "eff_med ratio", "eff_rgb ratio", "Mscat/s",
          "mean R, G, B against scalar"]


def row(r):
    means = ", ".join(f"{d:+.2f} ± {e:.2f} %" for d, e in zip(r.get("difference_percent", []), r.get("difference_error_percent", [])))
    return [r["case"], f"{r['stokes_msamples']:.3f}", f"{r['mitsuba_msamples']:.3f}", f"{r['ratio']:.2f}",
            f"{r['ratio_low']:.2f}-{r['ratio_high']:.2f}", f"{r['must']:g}", f"{r['aim']:g}",
            f"{r['efficiency_median'] / r['mitsuba_efficiency_median']:.2f}", f"{r['efficiency_rgb'] / r['mitsuba_efficiency_rgb']:.2f}",
            f"{r['mscatterings_per_cpu_second']:.2f}", means or "not asked"]


def processor():
    for line in open("/proc/cpuinfo"):
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return "unknown processor"


def write_results(out, results):
    record = {"date": datetime.date.today().isoformat(), "processor": processor(), "cores": os.cpu_count(),
              "load_average": os.getloadavg(), "results": results}
    pathlib.Path(out + ".json").write_text(json.dumps(record, indent=1) + "\n")
    first = results[0]
    lines = [f"# Stokes and Mitsuba side by side, {record['date']}", "",
             f"{record['processor']}, one thread each, CPU seconds, in turn. Stokes {first['stokes']} on {first['device']} ({first['driver']}); "
             f"Mitsuba {first['mitsuba']} llvm_ad_spectral; image means against its scalar_spectral. Load average of the machine's "
             f"{record['cores']} cores at the end: {record['load_average'][0]:.1f}.", "",
             "| " + " | ".join(HEADER) + " |", "|" + "---|" * len(HEADER)]
    lines += ["| " + " | ".join(row(r)) + " |" for r in results]
    pathlib.Path(out + ".md").write_text("\n".join(lines) + "\n")


def main():
    options = arguments()
    wanted = [w for w in options.only.split(",") if w]
    results = []
    print(" | ".join(HEADER), flush=True)
    with tempfile.TemporaryDirectory() as folder:
        for case in CASES:
            if wanted and case[0] not in wanted:
                continue
            results.append(run_case(case, options, pathlib.Path(folder)))
            print(" | ".join(row(results[-1])), flush=True)
            if options.out:
                write_results(options.out, results)


main()
