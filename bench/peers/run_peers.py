"""Stokes and other renderers on the same scenes, in turn (A B A B), one thread each, in CPU seconds: prints the ratio of rates with its
spread, of efficiencies, and how far the image means are from Mitsuba's scalar variant. run_peers.sh sets up what this needs."""
import argparse
import datetime
import json
import os
import pathlib
import subprocess
import sys
import tempfile

from peer_case import CASES, NAMES, efficiency_ratio, run_case

HEADER = ["case", "Stokes Ms/s", "peer Ms/s", "ratio", "spread", "must", "aim", "eff_med ratio", "eff_rgb ratio", "Mscat/s"]
MEANS = {"mitsuba": "our mean R, G, B against scalar"}
WRONG = 5  # percent: a mean as far off, and by three standard errors, is of a wrong image; rates of such compare nothing


def add_arguments(p):
    """What running cases takes; goals.py too."""
    p.add_argument("--stokes", default="build/stokes", help="the program [build/stokes]")
    p.add_argument("--export-mesh", default="build/bench/peers/bench_export_mesh")
    p.add_argument("--python", default=sys.executable, help="a Python with Mitsuba")
    p.add_argument("--cycles-python", default="", help="a Python with bpy")
    p.add_argument("--lux-python", default="", help="a Python with pyluxcore")
    p.add_argument("--rounds", type=int, default=8)
    p.add_argument("--truth-rounds", type=int, default=8, help="renders by scalar_spectral; 0: no comparison of means")
    p.add_argument("--truth-factor", type=float, default=4, help="their samples per pixel, in Mitsuba's of the case")
    p.add_argument("--only", default="", help="names of cases, separated by commas")
    p.add_argument("--out", default="", help="writes OUT.json and OUT.md")


def number(value, digits=2):
    return "-" if value is None else f"{value:.{digits}f}" if digits else f"{value:g}"


def header(peer):
    return [*HEADER, MEANS.get(peer, "its mean R, G, B against ours")]


def verdict(differences):
    """Of pairs of a difference and its standard error, in percent."""
    if any(abs(d) > max(WRONG, 3 * e) for d, e in differences):
        return "WRONG IMAGE: "
    return "NOT CONVERGED, compares nothing: " if any(e > WRONG for _, e in differences) else ""


def row(r):
    differences = list(zip(r.get("difference_percent", []), r.get("difference_error_percent", [])))
    means = verdict(differences) + ", ".join(f"{d:+.2f} ± {e:.2f} %" for d, e in differences)
    return [r["case"], number(r["stokes_msamples"], 3), number(r["peer_msamples"], 3), number(r["ratio"]),
            f"{r['ratio_low']:.2f}-{r['ratio_high']:.2f}", number(r["must"], 0), number(r["aim"], 0),
            number(efficiency_ratio(r, "median")), number(efficiency_ratio(r, "rgb")),
            number(r["mscatterings_per_cpu_second"]), means or "not asked"]


def processor():
    for line in open("/proc/cpuinfo"):
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return "unknown processor"


def machine():
    """Where and when something was measured; names no host."""
    return {"date": datetime.date.today().isoformat(), "processor": processor(), "cores": os.cpu_count(), "load_average": os.getloadavg()}


def write_results(out, peer, results):
    record = {**machine(), "results": results}
    pathlib.Path(out + ".json").write_text(json.dumps(record, indent=1) + "\n")
    first, name = results[0], NAMES[peer]
    kind = "llvm_ad_spectral; image means against its scalar_spectral" if peer == "mitsuba" else "on the CPU, in RGB"
    lines = [f"# Stokes and {name} side by side, {record['date']}", "",
             f"{record['processor']}, one thread each, CPU seconds, in turn. Stokes {first['stokes']} on {first['device']} ({first['driver']}); "
             f"{name} {first['peer_version']} {kind}. Load average of the machine's "
             f"{record['cores']} cores at the end: {record['load_average'][0]:.1f}.", "",
             "| " + " | ".join(header(peer)) + " |", "|" + "---|" * len(header(peer))]
    lines += ["| " + " | ".join(row(r)) + " |" for r in results]
    pathlib.Path(out + ".md").write_text("\n".join(lines) + "\n")


def main():
    p = argparse.ArgumentParser(description=__doc__)
    p.add_argument("--peer", choices=sorted(CASES), default="mitsuba")
    add_arguments(p)
    options = p.parse_args()
    wanted = [w for w in options.only.split(",") if w]
    if unknown := set(wanted) - {case[0] for case in CASES[options.peer]}:
        p.error(f"--only: no case is called {', '.join(sorted(unknown))}")
    results = []
    print(" | ".join(header(options.peer)), flush=True)
    with tempfile.TemporaryDirectory() as folder:
        for case in CASES[options.peer]:
            if wanted and case[0] not in wanted:
                continue
            try:
                results.append(run_case(case, options.peer, options, pathlib.Path(folder)))
            except (OSError, RuntimeError, subprocess.CalledProcessError) as error:
                sys.exit(f"error: {case[0]}: {error}")
            print(" | ".join(row(results[-1])), flush=True)
            if options.out:
                write_results(options.out, options.peer, results)


if __name__ == "__main__":
    main()
