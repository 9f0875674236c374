#!/usr/bin/env python3
"""Renders Mitsuba scenes by Mitsuba and, imported, by Stokes, and compares the pictures' means. Not part of the tests: needs Mitsuba 3.

Usage: against_mitsuba.py STOKES [SPP] [FILE.xml ...]; Mitsuba's variant is llvm_ad_spectral. Exit code 1 when a channel's means differ by
more than five standard errors and by more than 0.3 %.

Rough surfaces are rendered by kernels with Mitsuba's masking, the product of two Smith terms; ours is the height-correlated form.
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile

import mitsuba
import numpy as np

HERE = pathlib.Path(__file__).parent


def mean_and_error(pictures):
    means = np.array([p.reshape(-1, 3).mean(axis=0) for p in pictures])
    return means.mean(axis=0), means.std(axis=0, ddof=1) / np.sqrt(len(means))


def by_mitsuba(file, spp, seeds):
    scene = mitsuba.load_file(str(file))
    return [np.array(mitsuba.render(scene, spp=spp, seed=s))[:, :, :3] for s in range(seeds)]


def kernels_masking_separately(folder):
    kernels = pathlib.Path(folder) / "kernels"
    shutil.copytree(HERE.parents[2] / "kernels", kernels)
    for name in ("conductor.cl", "dielectric.cl"):
        text = (kernels / name).read_text()
        ours, theirs = "(real(1.0f) + lambda_o + lambda_i)", "((real(1.0f) + lambda_o) * (real(1.0f) + lambda_i))"
        assert ours in text
        (kernels / name).write_text(text.replace(ours, theirs))
    return kernels


def by_stokes(stokes, file, spp, seeds, folder, kernels):
    scene = pathlib.Path(folder) / f"{file.stem}.json"
    subprocess.run([stokes, "import", file, "-o", scene], check=True, stdout=subprocess.DEVNULL)
    pictures = []
    for s in range(seeds):
        out = scene.with_suffix(".exr")
        subprocess.run([stokes, "render", scene, "-q", "--spp", str(spp), "--seed", str(s), "-o", out, "--kernel-dir", kernels], check=True, stdout=subprocess.DEVNULL)
        pictures.append(np.array(mitsuba.Bitmap(str(out)).convert(mitsuba.Bitmap.PixelFormat.RGB, mitsuba.Struct.Type.Float32, False)))
    return pictures


def main():
    stokes = sys.argv[1]
    spp = int(sys.argv[2]) if len(sys.argv) > 2 else 512
    files = [pathlib.Path(f) for f in sys.argv[3:]] or [HERE / f"{name}.xml" for name in ("box", "fog", "rough")]
    mitsuba.set_variant("llvm_ad_spectral")
    failed = False
    with tempfile.TemporaryDirectory() as folder:
        kernels = kernels_masking_separately(folder)
        for file in files:
            a, error_a = mean_and_error(by_mitsuba(file, spp, 4))
            b, error_b = mean_and_error(by_stokes(stokes, file, spp, 4, folder, kernels))
            z = (b - a) / np.hypot(error_a, error_b)
            relative = b / a - 1
            print(f"{file.name}: Mitsuba {np.round(a, 5)}, Stokes {np.round(b, 5)}, difference {np.round(100 * relative, 2)} %, z {np.round(z, 1)}")
            failed |= bool(np.any((np.abs(z) > 5) & (np.abs(relative) > 0.003)))
    return failed


if __name__ == "__main__":
    sys.exit(main())
