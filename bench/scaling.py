"""How the cost of a sample grows: against triangles, lights, bounces, optical thickness, wavelengths per path and threads. Prints a table
with fitted exponents, and with --out FOLDER writes it there with a plot of each series (python3-matplotlib; without it no plots).
Costs are CPU seconds per camera path with one thread, loading and building kernels apart, medians of rounds that go through all points."""
import argparse
import json
import math
import pathlib
import statistics
import subprocess
import tempfile

SCENES = pathlib.Path(__file__).resolve().parent / "scenes"


def scene(name, **integrator):
    loaded = json.loads((SCENES / f"{name}.json").read_text())
    loaded["integrator"].update(integrator)
    return loaded


def write_ball(path, count):
    """A closed bumpy ball of about `count` triangles as OBJ."""
    rows = max(3, round(math.sqrt(count / 4)))
    columns = 2 * rows
    with open(path, "w") as out:
        for i in range(rows + 1):
            theta = math.pi * i / rows
            for j in range(columns):
                phi = 2 * math.pi * j / columns
                r = 0.6 * (1 + 0.05 * math.sin(13 * theta) * math.sin(11 * phi))
                out.write(f"v {r * math.sin(theta) * math.cos(phi):.6f} {r * math.cos(theta):.6f} {r * math.sin(theta) * math.sin(phi):.6f}\n")
        at = lambda i, j: i * columns + j % columns + 1
        for i in range(rows):
            for j in range(columns):
                if i > 0:
                    out.write(f"f {at(i, j)} {at(i, j + 1)} {at(i + 1, j)}\n")
                if i + 1 < rows:
                    out.write(f"f {at(i + 1, j)} {at(i, j + 1)} {at(i + 1, j + 1)}\n")


def triangles(folder, count):
    ball = folder / f"ball_{count}.obj"
    write_ball(ball, count)
    box = scene("mesh_box", **{"russian roulette": 5})
    box["surfaces"][-1] = {"type": "mesh", "name": "ball", "filename": str(ball), "material": "white"}
    return box, []


def lamp_places(count):
    """Points and edge of `count` equal lamps on a grid in the ceiling's square, whose areas add up to the box's one lamp."""
    side = math.ceil(math.sqrt(count))
    pitch = 1.6 / side
    edge = min(0.9 * pitch, 0.5 / math.sqrt(count))
    return [(-0.8 + pitch * (k % side + 0.5), -0.8 + pitch * (k // side + 0.5)) for k in range(count)], edge


def quad_lights(folder, count):
    box = scene("s1", **{"russian roulette": 5})
    box["surfaces"] = [s for s in box["surfaces"] if s["name"] != "light"]
    places, edge = lamp_places(count)
    for k, (x, z) in enumerate(places):
        box["surfaces"].append({"type": "quad", "name": f"lamp {k}", "size": edge, "material": "light",
                                "transform": [{"rotate": [90, 1, 0, 0]}, {"translate": [x, 0.998, z]}]})
    return box, []


def triangle_lights(folder, count):
    """Each lamp is a triangle of one mesh."""
    path = folder / f"lamps_{count}.obj"
    places, edge = lamp_places(count)
    with open(path, "w") as out:
        for x, z in places:
            out.write(f"v {x - edge / 2:.6f} 0.998 {z - edge / 2:.6f}\nv {x + edge / 2:.6f} 0.998 {z - edge / 2:.6f}\nv {x:.6f} 0.998 {z + edge / 2:.6f}\n")
        for k in range(len(places)):
            out.write(f"f {3 * k + 1} {3 * k + 2} {3 * k + 3}\n")
    box = scene("s1", **{"russian roulette": 5})
    box["surfaces"] = [s for s in box["surfaces"] if s["name"] != "light"]
    box["surfaces"].append({"type": "mesh", "name": "lamps", "filename": str(path), "material": "light"})
    return box, []


def bounces(folder, count):
    return scene("s1", **{"max bounces": count}), []


def thickness(folder, depth):
    """A ball of radius 1 of a medium that absorbs next to nothing, whose diameter is `depth` mean free paths, in even light."""
    return {"camera": {"transform": {"from": [0, 0, 4], "at": [0, 0, 0], "up": [0, 1, 0]}, "vfov": 22, "resolution": [64, 64]},
            "sampler": {"type": "independent", "samples": 16}, "background": {"type": "constant", "value": 1},
            "integrator": {"type": "path tracer volumetric mis", "max bounces": 100000, "russian roulette": False},
            "media": [{"type": "homogeneous", "name": "milk", "sigma_t": depth / 2, "albedo": 0.9999, "g": 0}],
            "materials": [{"type": "interface", "name": "boundary"}],
            "surfaces": [{"type": "sphere", "name": "ball", "radius": 1, "material": "boundary", "inside": "milk", "outside": "vacuum"}]}, []


def wavelengths(folder, count):
    return scene("s1", **{"russian roulette": 5}), ["--wavelengths-per-path", str(count)]


def threads(folder, count):
    return scene("s1", **{"russian roulette": 5}), ["--threads", str(count)]


# name: axis, points, what makes a point's scene, image's edge, samples per pixel, what theory says of the cost per path.
SERIES = {
    "triangles": ("triangles", [10_000, 30_000, 100_000, 300_000, 1_000_000], triangles, 128, 32,
                  "a tree's depth grows as log n: an exponent of about 0.1 over this range, more once the tree outgrows the caches"),
    "triangle lights": ("emissive triangles", [1, 10, 100, 1_000, 10_000], triangle_lights, 128, 32,
                        "lights are drawn from a table: constant, but for the tree that grows as log n"),
    "quad lights": ("emissive quads", [1, 10, 100, 1_000, 10_000], quad_lights, 96, 8,
                    "lights are drawn from a table: constant; every ray looks for quads, linearly where they are in no tree"),
    "bounces": ("bounces", [1, 2, 4, 8, 16, 32, 64], bounces, 128, 32, "at most linear: paths also end, by leaving the box"),
    "optical thickness": ("mean free paths across", [1, 3, 10, 30, 100, 300], thickness, 64, 16,
                          "scatterings per path are at most the mean chord in mean free paths: an exponent of 1"),
    "wavelengths per path": ("wavelengths", [1, 4, 8], wavelengths, 128, 64, "at most linear, with what paths share costing once"),
    "threads": ("threads", [1, 2], threads, 256, 64, "CPU seconds per path stay the same: an exponent of 0"),
}
LARGE = {"triangles": [5_000_000]}


def measure(options, path, size, spp, more, seed):
    command = [options.stokes, "bench", path, "--json", "--repeat", "1", "--size", f"{size}x{size}", "--spp", str(spp), "--seed", str(seed),
               "--no-cold", "--no-parity", "--no-noise", *([] if "--threads" in more else ["--threads", "1"]), *more]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{path.name}: {done.stderr.strip()}")
    return json.loads(done.stdout)[0]


def exponent(points, costs):
    """The slope of the least-squares line through the logarithms."""
    x, y = [math.log(p) for p in points], [math.log(c) for c in costs]
    mx, my = statistics.fmean(x), statistics.fmean(y)
    return sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx) ** 2 for a in x)


def run_series(name, options, folder):
    axis, points, make, size, spp, theory = SERIES[name]
    points = points + (LARGE.get(name, []) if options.large else [])
    cases = []
    for point in points:
        description, more = make(folder, point)
        path = folder / f"{name.replace(' ', '_')}_{point}.json"
        path.write_text(json.dumps(description))
        cases.append((path, more))
    runs = [[] for _ in points]
    for round_ in range(options.rounds):
        for (path, more), results in zip(cases, runs):
            results.append(measure(options, path, size, spp, more, round_))
    rows = []
    for point, results in zip(points, runs):
        last = results[-1]
        each = lambda key: last[key] / last["samples"]
        rows.append({"point": point, "cpu_nanoseconds_per_path": 1e9 * statistics.median(r["cpu_seconds"] / r["samples"] for r in results),
                     "wall_nanoseconds_per_path": 1e9 * statistics.median(r["render_seconds"] / r["samples"] for r in results),
                     "rays_per_path": each("rays"), "shadow_rays_per_path": each("shadow_rays"), "scatterings_per_path": each("scatterings"),
                     "bvh_seconds": last["bvh_seconds"], "peak_memory_mib": last["peak_memory_bytes"] / 2**20})
    costs = [r["cpu_nanoseconds_per_path"] for r in rows]
    middle = len(points) // 2
    return {"series": name, "axis": axis, "theory": theory, "device": runs[0][0]["device"], "version": runs[0][0]["version"],
            "rounds": options.rounds, "exponent": exponent(points, costs),
            "exponent_of_upper_half": exponent(points[middle - 1:], costs[middle - 1:]) if len(points) > 3 else None, "rows": rows}


def markdown(results):
    lines = []
    for s in results:
        upper = "" if s["exponent_of_upper_half"] is None else f", of the upper half {s['exponent_of_upper_half']:.2f}"
        lines += [f"## Against {s['series']}", "", f"Theory: {s['theory']}. **Exponent {s['exponent']:.2f}**{upper}.", "",
                  f"| {s['axis']} | CPU ns per path | rays | shadow rays | scatterings per path | BVH s | MiB |", "|---|---|---|---|---|---|---|"]
        lines += [f"| {r['point']:,} | {r['cpu_nanoseconds_per_path']:.0f} | {r['rays_per_path']:.2f} | {r['shadow_rays_per_path']:.2f} | "
                  f"{r['scatterings_per_path']:.2f} | {r['bvh_seconds']:.2f} | {r['peak_memory_mib']:.0f} |" for r in s["rows"]]
        lines.append("")
    return "\n".join(lines)


def plot(series, path):
    import matplotlib
    matplotlib.use("Agg")
    matplotlib.rcParams["svg.hashsalt"] = "stokes"  # the same file from the same numbers
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(figsize=(5, 3.5))
    x = [r["point"] for r in series["rows"]]
    y = [r["cpu_nanoseconds_per_path"] for r in series["rows"]]
    axes.loglog(x, y, "o-")
    middle = math.exp(statistics.fmean(map(math.log, y))), math.exp(statistics.fmean(map(math.log, x)))
    axes.loglog(x, [middle[0] * (p / middle[1]) ** series["exponent"] for p in x], "--", label=f"exponent {series['exponent']:.2f}")
    axes.set(xlabel=series["axis"], ylabel="CPU ns per path")
    axes.set_ylim(min(y) / 2, max(y) * 2)
    axes.grid(True, which="both", alpha=0.3)
    axes.legend()
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})
    pyplot.close(figure)


def main():
    p = argparse.ArgumentParser(description=__doc__)
    p.add_argument("--stokes", default="build/stokes", help="the program [build/stokes]")
    p.add_argument("--series", default=",".join(SERIES), help="of these, separated by commas")
    p.add_argument("--rounds", type=int, default=3)
    p.add_argument("--large", action="store_true", help="also 5M triangles (some GiB)")
    p.add_argument("--out", default="", help="a folder for scaling.json, scaling.md and the plots; series not run now are kept there")
    options = p.parse_args()
    wanted = options.series.split(",")
    if unknown := set(wanted) - set(SERIES):
        p.error(f"--series: none is called {', '.join(sorted(unknown))}")
    out = pathlib.Path(options.out) if options.out else None
    kept = json.loads((out / "scaling.json").read_text()) if out and (out / "scaling.json").exists() else []
    results = [s for s in kept if s["series"] not in wanted]
    with tempfile.TemporaryDirectory() as folder:
        for name in wanted:
            result = run_series(name, options, pathlib.Path(folder))
            print(markdown([result]), flush=True)
            results = sorted(results + [result], key=lambda s: list(SERIES).index(s["series"]))
            if out:
                out.mkdir(parents=True, exist_ok=True)
                (out / "scaling.json").write_text(json.dumps(results, indent=1) + "\n")
                (out / "scaling.md").write_text("# Scaling\n\n" + markdown(results))
                try:
                    plot(result, out / f"{name.replace(' ', '_')}.svg")
                except ImportError:
                    print("no plot: Python has no matplotlib")


if __name__ == "__main__":
    main()
