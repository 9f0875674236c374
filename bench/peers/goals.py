"""Every goal of the renderer's speed with what is measured here, what must and what should be reached, and whether it is: a table in
Markdown, and JSON with --out. A row that could not be measured says why and is never met. `run_peers.sh --goals` sets up what this needs."""
import argparse
import json
import os
import pathlib
import re
import resource
import statistics
import subprocess
import tempfile
import time

from peer_case import CASES, NAMES, SCENES, efficiency_ratio, run_case, run_stokes
from run_peers import add_arguments, machine

SECTIONS = ["mitsuba", "cycles", "traversal", "colour", "start", "cores", "gpu"]
BUSY = 0.1  # what others may take of the processor where wall time is measured


def goal(section, name, must, aim, value=None, note="", why="", less=False, unit="x"):
    """A row. `less`: smaller is better. Without a value, `why` says why there is none."""
    reached = lambda bound: value <= bound if less else value >= bound
    if value is None:
        verdict = f"not measured: {why}"
    else:
        verdict = "aim met" if reached(aim) else "must met" if reached(must) else "MISSED"
    return {"section": section, "goal": name, "must": must, "aim": aim, "value": value, "unit": unit, "less": less, "verdict": verdict,
            "note": note}


PEER_GOALS = {  # section: [(goal, case, what of it, must, aim)]
    "mitsuba": [("s1 Msamples/s, RR off", "s1", "ratio", 3, 7), ("s1 Msamples/s, RR 5", "s1 rr5", "ratio", 3, 7),
                ("s2 Msamples/s, RR off", "s2", "ratio", 5, 12), ("s2hi Msamples/s, RR off", "s2hi", "ratio", 5, 12),
                ("mesh in the box Msamples/s, RR 5", "mesh_box rr5", "ratio", 1.5, 3), ("s3 Msamples/s, RR 5", "s3 rr5", "ratio", 2.5, 6),
                ("s3 events/s, RR off", "s3", "ratio", 6, 15), ("eff_med s1, RR 5", "s1 rr5", "median", 3, 8),
                ("eff_med s3, RR 5", "s3 rr5", "median", 3, 8), ("eff_rgb s2hi", "s2hi", "rgb", 5, 12)],
    "cycles": [("eff_med s2", "s2", "median", 2, 5)],
}


def peer_rows(peer, options, details):
    """The goals against a renderer; one that fails leaves the others' rows."""
    results, failures = {}, {}
    with tempfile.TemporaryDirectory() as folder:
        for case in CASES[peer]:
            if case[0] not in {g[1] for g in PEER_GOALS[peer]}:
                continue
            try:
                if peer == "cycles" and not options.cycles_python:
                    raise RuntimeError("no Python with bpy")
                results[case[0]] = run_case(case, peer, options, pathlib.Path(folder))
            except (OSError, RuntimeError, subprocess.CalledProcessError) as error:
                failures[case[0]] = str(error)
    details.extend(results.values())
    rows = []
    for name, case, kind, must, aim in PEER_GOALS[peer]:
        title = f"{name}, against {NAMES[peer]}"
        r = results.get(case)
        if r is None:
            rows.append(goal(peer, title, must, aim, why=failures[case]))
        elif kind == "ratio":
            note = f"{r['stokes_msamples']:.3f} against {r['peer_msamples']:.3f}; rounds {r['ratio_low']:.2f} to {r['ratio_high']:.2f}"
            note += f"; {r['rays_per_sample']:.1f} rays, {r['shadow_rays_per_sample']:.1f} shadow rays, {r['scatterings_per_sample']:.1f} scatterings per sample"
            rows.append(goal(peer, title, must, aim, r["ratio"], note))
        else:
            ours, theirs = r[f"efficiency_{kind}"], r[f"peer_efficiency_{kind}"]
            note = f"{ours:.3g} against {theirs:.3g}, images of {r['samples_per_pixel']} samples" if ours and theirs else ""
            rows.append(goal(peer, title, must, aim, efficiency_ratio(r, kind), note, "an image without noise"))
    return rows


def traversal_rows(options, details):
    """Closest hits against Embree, and building trees, from bench_traversal's lines."""
    rows, build = [], None
    for count, name in ((100000, "100k"), (1000000, "1M")):
        text = subprocess.run([options.traversal, str(count), str(1 << 19), str(options.rounds)], check=True, capture_output=True, text=True).stdout
        details.append({"traversal": count, "output": text.splitlines()})
        for kind in ("incoherent", "coherent"):
            ours, embree, ratio, robust = map(float, re.search(
                rf"^{kind} +ours +([\d.]+) +Embree +([\d.]+) .*ratio ([\d.]+) \(robust ([\d.]+)\)", text, re.M).groups())
            rows.append(goal("traversal", f"closest hit, {name} triangles, {kind}, against Embree", 0.9, 1.2, ratio,
                             f"{ours:.2f} against {embree:.2f} Mrays/s; {robust:.2f} of its robust mode"))
        build = re.search(r"build: ours ([\d.]+) s, Embree ([\d.]+) s", text)
    ours, embree = map(float, build.groups())
    return rows + [goal("traversal", "BVH build, 1M triangles, in Embree's time (medium)", 2, 1, ours / embree,
                        f"{ours:.2f} against {embree:.2f} CPU s", less=True)]


def variance(result):
    """Relative variance of R, G, B of one sample, from the efficiency that was measured with it."""
    return result["width"] * result["height"] / (result["efficiency_rgb"] * 1e6 * result["cpu_seconds"] / result["samples_per_pixel"])


def colour_rows(options, details):
    ratios = []
    for i in range(options.rounds):
        a, b = (run_stokes(options.stokes, SCENES / "s1.json", 96, 128, 7000 + 100 * i, noise=True, more=["--mode", mode])
                for mode in ("spectral", "rgb"))
        ratios.append(variance(a) / variance(b))
    details.append({"colour noise": ratios})
    return [goal("colour", "colour noise on s1, against RGB mode", 1.135, 1.05, statistics.median(ratios),
                 f"seeds {min(ratios):.3f} to {max(ratios):.3f}; relative variance of R, G, B of a sample", less=True)]


class Others:
    """How much of the processor others took since this was made: 1 is all of it."""

    def __init__(self):
        self.begin = time.monotonic(), self.all(), self.own()

    @staticmethod
    def all():
        fields = [int(f) for f in open("/proc/stat").readline().split()[1:9]]
        return (sum(fields) - fields[3] - fields[4]) / os.sysconf("SC_CLK_TCK")

    @staticmethod
    def own():
        usages = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
        return sum(u.ru_utime + u.ru_stime for u in usages)

    def share(self):
        wall, all_, own = self.begin
        return max(0.0, self.all() - all_ - (self.own() - own)) / (max(1e-9, time.monotonic() - wall) * os.cpu_count())


def start_rows(options, details):
    """Seconds of wall time. First pixels: of a whole `stokes render` of one sample per pixel, the fastest of some."""
    others = Others()
    text = subprocess.run([options.stokes, "bench", "--json", "--repeat", "1", "--size", "16x16", "--spp", "1", "--no-noise", "--no-parity"],
                          check=True, capture_output=True, text=True).stdout
    cold = {r["name"]: r["build_cold_seconds"] for r in json.loads(text)}
    first = {}
    with tempfile.TemporaryDirectory() as folder:
        for name in ("s1", "s2", "mesh_box"):
            times = []
            for _ in range(options.rounds + 1):
                begin = time.monotonic()
                subprocess.run([options.stokes, "render", SCENES / f"{name}.json", "--size", "64x64", "--spp", "1", "-q", "-o",
                                f"{folder}/{name}.exr"], check=True)
                times.append(time.monotonic() - begin)
            first[name] = min(times[1:])
    share = others.share()
    details.append({"cold": cold, "first pixel": first, "others": share})
    if share > BUSY:
        first_note = f"; others took {100 * share:.0f} % of the processor: a bound from above"
    else:
        first_note = ""
    slowest, latest = max(cold, key=cold.get), max(first, key=first.get)
    return [goal("start", "kernel build, cold", 10, 5, cold[slowest], f"slowest of the suite: {slowest}{first_note}", less=True, unit="s"),
            goal("start", "warm start of a render to its first pixel", 1, 0.3, first[latest],
                 ", ".join(f"{k} {v:.2f} s" for k, v in first.items()) + first_note, less=True, unit="s")]


def cores_rows(options, details):
    title, must, aim = "two cores against one, s1", 1.8, 1.95
    if os.cpu_count() < 2:
        return [goal("cores", title, must, aim, why="one core here")]
    others, ratios = Others(), []
    for i in range(options.rounds):
        one, two = (json.loads(subprocess.run(
            [options.stokes, "bench", SCENES / "s1.json", "--json", "--repeat", "1", "--threads", str(n), "--size", "256x256", "--spp",
             "256", "--no-cold", "--no-parity", "--no-noise", "--seed", str(i)], check=True, capture_output=True, text=True).stdout)[0]
            for n in (1, 2))
        ratios.append(two["msamples_per_second"] / one["msamples_per_second"])
    share = others.share()
    details.append({"cores": ratios, "others": share})
    if share > BUSY:
        return [goal("cores", title, must, aim, why=f"others took {100 * share:.0f} % of the processor (ratios {min(ratios):.2f} to {max(ratios):.2f})")]
    return [goal("cores", title, must, aim, statistics.median(ratios), f"rounds {min(ratios):.2f} to {max(ratios):.2f}, wall time")]


def gpu_rows(options, details):
    title, must, aim = "a GPU against one CPU core, s3 RR off", 300, 500
    arguments = [SCENES / "s3.json", "--json", "--no-cold", "--no-parity", "--no-noise", "--set", "/integrator/russian roulette=false"]
    gpu = subprocess.run([options.stokes, "bench", *arguments, "--device", "gpu", "--size", "256x256", "--spp", "64"], capture_output=True, text=True)
    if gpu.returncode != 0:
        return [goal("gpu", title, must, aim, why=(gpu.stderr.strip().splitlines() or ["no GPU"])[0])]
    cpu = json.loads(subprocess.run([options.stokes, "bench", *arguments, "--device", "cpu", "--threads", "1", "--size", "64x64", "--spp", "16"],
                                    check=True, capture_output=True, text=True).stdout)[0]
    gpu = json.loads(gpu.stdout)[0]
    details.append({"gpu": gpu, "cpu": cpu})
    return [goal("gpu", title, must, aim, gpu["msamples_per_second"] / cpu["msamples_per_cpu_second"], f"{gpu['device']}, wall time, against {cpu['device']}")]


MEASURES = {"mitsuba": lambda o, d: peer_rows("mitsuba", o, d), "cycles": lambda o, d: peer_rows("cycles", o, d), "traversal": traversal_rows,
            "colour": colour_rows, "start": start_rows, "cores": cores_rows, "gpu": gpu_rows}


def measure(section, options, details):
    try:
        return MEASURES[section](options, details)
    except (OSError, RuntimeError, AttributeError, KeyError, ValueError, subprocess.CalledProcessError) as error:
        return [goal(section, f"{section}: all rows", None, None, why=str(error))]


def table(record):
    shown = lambda value, unit, digits=None: "-" if value is None else (f"{value:.2f}" if digits else f"{value:g}") + (" s" if unit == "s" else "x" if unit else "")
    lines = [f"# Goals, {record['date']}", "", f"{record['processor']}, {record['cores']} cores; CPU seconds and one thread but where wall time is said.", "",
             "| goal | measured | must | aim | | how | version |", "|---|---|---|---|---|---|---|"]
    for r in record["rows"]:
        bound = "<= " if r["less"] else ""
        lines.append(f"| {r['goal']} | {shown(r['value'], r['unit'], 2)} | {bound}{shown(r['must'], r['unit'])} | {bound}{shown(r['aim'], r['unit'])} "
                     f"| {r['verdict']} | {r['note']} | {r['version']} |")
    return "\n".join(lines) + "\n"


def main():
    p = argparse.ArgumentParser(description=__doc__)
    add_arguments(p)
    p.set_defaults(truth_rounds=0, rounds=5)
    p.add_argument("--traversal", default="build/bench/traversal/bench_traversal")
    p.add_argument("--sections", default=",".join(SECTIONS), help="of these, separated by commas; the rows of others are kept from OUT.json")
    options = p.parse_args()
    wanted = options.sections.split(",")
    if unknown := set(wanted) - set(SECTIONS):
        p.error(f"--sections: none is called {', '.join(sorted(unknown))}")
    version = subprocess.run([options.stokes, "--version"], check=True, capture_output=True, text=True).stdout.strip()
    record = {**machine(), "rows": [], "details": {}}
    kept = pathlib.Path(options.out + ".json") if options.out else None
    old = json.loads(kept.read_text()) if kept and kept.exists() else {"rows": [], "details": {}}
    record["rows"] = [r for r in old["rows"] if r["section"] not in wanted]
    record["details"] = {k: v for k, v in old["details"].items() if k not in wanted}
    for section in wanted:
        rows = measure(section, options, record["details"].setdefault(section, []))
        record["rows"] += [{**r, "version": version, "load_average": os.getloadavg()[0]} for r in rows]
        record["rows"].sort(key=lambda r: SECTIONS.index(r["section"]))
        if options.out:
            pathlib.Path(options.out + ".json").write_text(json.dumps(record, indent=1) + "\n")
            pathlib.Path(options.out + ".md").write_text(table(record))
    print(table(record))


if __name__ == "__main__":
    main()
