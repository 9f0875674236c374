"""Renders every scene of this folder small and writes the gallery into README.md: picture, command and time.

    python3 scenes/gallery.py [--stokes build/stokes] [--seconds 8] [NAME ...]

Needs oiiotool (Debian: openimageio-tools). The samples are what fits into about --seconds of rendering, as a power of two, so that the
pictures' noise can be compared too. With names, only these are rendered again; the others keep their rows.
"""
import argparse
import json
import pathlib
import re
import subprocess
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
PAGE, PICTURES = HERE / "README.md", HERE / "pictures"
BEGIN, END = "<!-- gallery: written by gallery.py -->\n", "<!-- end of the gallery -->\n"
LONG_SIDE = 240


def render(stokes, scene, size, samples, output):
    command = [stokes, "render", str(scene), "--size", size, "--spp", str(samples), "--png", "-o", str(output), "--json", "--quiet"]
    return json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout)


def picture(stokes, name, seconds):
    """Renders a scene for about `seconds`; returns its row of the table."""
    scene = HERE / f"{name}.json"
    width, height = json.loads(scene.read_text())["camera"].get("resolution", [512, 512])
    scale = LONG_SIDE / max(width, height)
    size = f"{round(width * scale)}x{round(height * scale)}"
    with tempfile.TemporaryDirectory() as folder:
        output = pathlib.Path(folder) / f"{name}.exr"
        pilot = render(stokes, scene, size, 2, output)["render_seconds"] / 2
        samples = 4
        while samples < 4096 and 2 * samples * pilot <= seconds:
            samples *= 2
        summary = render(stokes, scene, size, samples, output)
        subprocess.run(["oiiotool", output.with_suffix(".png"), "--ch", "R,G,B", "--compression", "jpeg:88", "-o", PICTURES / f"{name}.jpg"], check=True)
    print(f"{name}: {size}, {samples} samples, {summary['render_seconds']:.1f} s", flush=True)
    return (f"| ![{name}](pictures/{name}.jpg) | `stokes render scenes/{name}.json --size {size} --spp {samples} -o {name}.exr --png` | "
            f"{summary['render_seconds']:.1f} s |")


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("names", nargs="*")
    p.add_argument("--stokes", default=str(HERE.parent / "build" / "stokes"))
    p.add_argument("--seconds", type=float, default=8)
    options = p.parse_args()
    page = PAGE.read_text()
    before, rest = page.split(BEGIN)
    table, after = rest.split(END)
    rows = {name: row for row, name in re.findall(r"^(\| !\[(\w+)\].*)$", table, re.M)}
    scenes = sorted(f.stem for f in HERE.glob("*.json"))
    PICTURES.mkdir(exist_ok=True)
    for name in options.names or scenes:
        rows[name] = picture(options.stokes, name, options.seconds)
        lines = [rows[n] for n in scenes if n in rows]
        PAGE.write_text(before + BEGIN + "| picture | command | time |\n|---|---|---|\n" + "\n".join(lines) + "\n" + END + after)


if __name__ == "__main__":
    main()
