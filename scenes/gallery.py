"""Renders every scene of this folder small and writes the gallery into README.md: picture, command and time.

    python3 scenes/gallery.py [--stokes build/stokes] [--seconds 15] [NAME ...]

Needs oiiotool (Debian: openimageio-tools). The samples are what fits into about --seconds of processor time, as a power of two and at least
32. Times are processor seconds of the whole command, of all cores together, with the kernel built before: other programs beside it hardly
change them. With names, only these are rendered again; the others keep their rows.
"""
import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
PAGE, PICTURES = HERE / "README.md", HERE / "pictures"
BEGIN, END = "<!-- gallery: written by gallery.py -->\n", "<!-- end of the gallery -->\n"
LONG_SIDE = 240
# The report's last picture: larger, at many samples, and only when named.
LARGE = {"glow", "glow_skin"}
LARGE_SIZE, LARGE_SAMPLES, LARGE_OPTIONS = "480x600", 512, ["--exposure", "0.3"]


def render(stokes, scene, size, samples, output, options=()):
    """Renders; returns the processor seconds that it took."""
    command = [stokes, "render", str(scene), "--size", size, "--spp", str(samples), *options, "--png", "-o", str(output), "--restart", "--quiet"]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if status:
        sys.exit(f"gallery: {' '.join(command)} failed")
    return usage.ru_utime + usage.ru_stime


def samples_for(stokes, scene, size, seconds, output):
    few = min(render(stokes, scene, size, 1, output) for _ in range(2))
    per_sample = max(render(stokes, scene, size, 17, output) - few, 1e-2) / 16
    samples = 32
    while samples < 4096 and 2 * samples * per_sample <= seconds:
        samples *= 2
    return samples


def picture(stokes, name, seconds):
    """Renders a scene for about `seconds`; returns its row of the table."""
    scene = HERE / f"{name}.json"
    width, height = json.loads(scene.read_text())["camera"].get("resolution", [512, 512])
    scale = LONG_SIDE / max(width, height)
    size = f"{round(width * scale)}x{round(height * scale)}"
    options = []
    if name in LARGE:
        size, options = LARGE_SIZE, LARGE_OPTIONS
    with tempfile.TemporaryDirectory() as folder:
        output = pathlib.Path(folder) / f"{name}.exr"
        render(stokes, scene, size, 1, output)  # builds the kernel
        samples = LARGE_SAMPLES if name in LARGE else samples_for(stokes, scene, size, seconds, output)
        took = render(stokes, scene, size, samples, output, options)
        subprocess.run(["oiiotool", output.with_suffix(".png"), "--ch", "R,G,B", "--compression", "jpeg:88", "-o", PICTURES / f"{name}.jpg"], check=True)
    print(f"{name}: {size}, {samples} samples, {took:.1f} s", flush=True)
    command = " ".join(["stokes render", f"scenes/{name}.json --size {size} --spp {samples}", *options, f"-o {name}.exr --png"])
    return f"| ![{name}](pictures/{name}.jpg) | `{command}` | {took:.0f} s |"


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("names", nargs="*")
    p.add_argument("--stokes", default=str(HERE.parent / "build" / "stokes"))
    p.add_argument("--seconds", type=float, default=15)
    options = p.parse_args()
    page = PAGE.read_text()
    before, rest = page.split(BEGIN)
    table, after = rest.split(END)
    rows = {name: row for row, name in re.findall(r"^(\| !\[(\w+)\].*)$", table, re.M)}
    scenes = sorted(f.stem for f in HERE.glob("*.json"))
    PICTURES.mkdir(exist_ok=True)
    for name in options.names or [n for n in scenes if n not in LARGE]:
        rows[name] = picture(options.stokes, name, options.seconds)
        lines = [rows[n] for n in scenes if n in rows]
        PAGE.write_text(before + BEGIN + "| picture | command | processor time |\n|---|---|---|\n" + "\n".join(lines) + "\n" + END + after)


if __name__ == "__main__":
    main()
