"""The package's promises: shapes, units, bits, errors, interruption. Renders by the CPU reference unless a test is about OpenCL."""

import copy
import json
import math
import os
import pathlib
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import stokes

BOX = {
    "camera": {"transform": {"from": [0, 0, 3]}, "vfov": 40, "resolution": [12, 8]},
    "sampler": {"samples": 8, "seed": 3},
    "background": 0.5,
    "materials": [
        {"type": "lambertian", "name": "grey", "albedo": 0.5},
        {
            "type": "diffuse_fluorescent",
            "name": "dye",
            "absorption": {"type": "box", "range": [380, 450], "value": 0.8},
            "emission": {"type": "box", "range": [550, 600]},
        },
    ],
    "surfaces": [{"type": "sphere", "material": "grey"}, {"type": "sphere", "radius": 0.3, "transform": {"translate": [1.2, 0, 0]}, "material": "dye"}],
}


@pytest.fixture(autouse=True)
def reference(monkeypatch):
    monkeypatch.setenv("STOKES_DEVICE", "reference")


def endless():
    """A scene that would take hours."""
    scene = copy.deepcopy(BOX)
    scene["camera"]["resolution"] = [400, 400]
    scene["sampler"]["samples"] = 1_000_000
    return scene


def test_image_has_shape_type_and_radiance():
    result = stokes.render({"camera": {"resolution": [6, 4]}, "background": 0.25}, spp=4000)
    assert result.image.shape == (4, 6, 3)
    assert result.image.dtype == np.float32
    assert result.image.flags.c_contiguous
    assert result.samples == 4000
    assert result.aovs == {}
    assert result.spectra is None
    # A grey background of 0.25 is a pixel of 0.25 in every channel.
    assert np.allclose(result.image.mean(axis=(0, 1)), 0.25, rtol=0.02)
    assert result.alpha.max() == 0


def test_row_zero_is_the_top_and_size_is_width_by_height():
    lamp = {"type": "quad", "size": [40, 9], "transform": {"translate": [0, 5, -3]}, "material": {"type": "diffuse_light"}}
    result = stokes.render({"camera": {"transform": {"from": [0, 0, 1]}}, "surfaces": [lamp]}, spp=16, size=(6, 10))
    assert result.image.shape == (10, 6, 3)
    assert result.image[:4].mean() > 0.5
    assert result.image[6:].max() == 0


def test_every_aov_by_name():
    result = stokes.render(BOX, aov="all", spp=1000)
    shapes = {name: array.shape for name, array in result.aovs.items()}
    three, one = (8, 12, 3), (8, 12)
    assert shapes == {"albedo": three, "normal": three, "variance": three, "fluorescence": three, "depth": one, "fluorescence_energy": one}
    assert np.allclose(result.aovs["albedo"][3:5, 4:7].mean(axis=(0, 1)), 0.5, rtol=0.05)
    assert result.aovs["normal"][4, 6, 2] > 0.9
    assert result.aovs["depth"][4, 6] == pytest.approx(2, abs=0.1)
    assert set(stokes.render(BOX, aov=["depth", "normal"]).aovs) == {"depth", "normal"}


def test_spectra_are_radiance_per_nm():
    lamp = {"type": "constant", "value": 2.0}
    scene = {"camera": {"resolution": [4, 4]}, "background": {"type": "product", "of": [lamp, {"type": "box", "range": [500, 600]}]}}
    result = stokes.render(scene, spp=2000, spectral=(400, 700, 6))
    assert result.wavelengths.tolist() == [425, 475, 525, 575, 625, 675]
    assert result.spectra.shape == (4, 4, 6)
    assert np.allclose(result.spectra.mean(axis=(0, 1)), [0, 0, 2, 2, 0, 0], rtol=0.05)


def test_the_same_bits_as_the_command_line(tmp_path):
    """The picture is a function of scene, seed and samples; a file and a dict are the same scene."""
    file = tmp_path / "box.json"
    file.write_text(json.dumps(BOX))
    result = stokes.render(BOX)
    assert np.array_equal(result.image, stokes.render(file).image)
    assert np.array_equal(result.image, stokes.render(str(file), threads=1).image)
    assert not np.array_equal(result.image, stokes.render(BOX, seed=4).image)
    program = os.environ.get("STOKES")
    if not program:
        pytest.skip("STOKES, the executable's name, is not set")
    subprocess.run([program, "render", file, "-q", "-o", tmp_path / "program.exr"], check=True)
    result.save(tmp_path / "package.exr")
    compared = subprocess.run([program, "compare", "--exact", tmp_path / "program.exr", tmp_path / "package.exr"], check=False)
    assert compared.returncode == 0


def test_numpy_values_and_overrides():
    scene = {**BOX, "background": np.float64(0.5)}
    scene["materials"] = [{**BOX["materials"][0], "albedo": np.array([0.5, 0.5, 0.5]) * 1.0}, BOX["materials"][1]]
    assert stokes.render(scene).image.shape == (8, 12, 3)
    brighter = stokes.render(BOX, overrides={"/background": 1.0}).image
    assert brighter.mean() > 1.5 * stokes.render(BOX).image.mean()
    assert stokes.render(BOX, overrides={"/integrator/max bounces": 2}).samples == 8


def test_scene_errors_are_the_command_lines():
    scene = copy.deepcopy(BOX)
    scene["materials"][0]["albdo"] = 0.5
    with pytest.raises(stokes.SceneError) as caught:
        stokes.render(scene)
    error = caught.value
    assert str(error).startswith("scene:")
    assert str(error).endswith('error: /materials/0/albdo: unknown key in a material of type "lambertian"; did you mean "albedo"?')
    assert error.pointer == "/materials/0/albdo"
    assert error.message.startswith("unknown key")
    assert error.line > 10
    assert error.column > 0
    with pytest.raises(stokes.SceneError, match="NaN is not a number in JSON"):
        stokes.render({**BOX, "background": math.nan})
    with pytest.raises(stokes.SceneError, match="cannot be read"):
        stokes.render("no/such/scene.json")
    with pytest.raises(TypeError, match="no value of a scene"):
        stokes.render({**BOX, "background": object()})


def test_files_of_a_dict_are_in_its_directory(tmp_path):
    (tmp_path / "curve.csv").write_text("400,0.5\n700,0.5\n")
    scene = {**BOX, "background": {"type": "file", "filename": "curve.csv"}}
    assert stokes.render(scene, directory=tmp_path).image.mean() > 0
    with pytest.raises(stokes.SceneError, match=r"there is no file \./curve\.csv"):
        stokes.render(scene)


@pytest.mark.parametrize(
    "arguments",
    [{"spp": 0}, {"seed": -1}, {"mode": "RGB"}, {"wavelengths_per_path": 2}, {"spectral": (200, 700, 3)}, {"aov": "depht"}, {"size": (0, 4)},
     {"integrator": "bdpt"}, {"overrides": {"background": 1}}, {"threads": -1}],
    ids=lambda a: next(iter(a)),
)  # fmt: skip
def test_wrong_arguments_are_value_errors(arguments):
    with pytest.raises(ValueError, match=f"{'set' if 'overrides' in arguments else next(iter(arguments))}:") as caught:
        stokes.render(BOX, **arguments)
    assert not isinstance(caught.value, stokes.SceneError)


def test_an_unknown_device_and_too_much_memory():
    with pytest.raises(stokes.DeviceError, match="no such device"):
        stokes.render(BOX, device="no such device")
    with pytest.raises(MemoryError, match="GiB"):
        stokes.render(BOX, size=(65536, 65536))


def test_warnings_are_pythons():
    media = [{"type": "homogeneous", "name": "fog", "sigma_t": 1, "albedo": 0.5, "unit": "cm"}]
    with pytest.warns(stokes.SceneWarning, match='without a "scene unit"'):
        stokes.render({**BOX, "media": media})


def test_pictures_in_notebooks_and_files(tmp_path):
    result = stokes.render(BOX)
    png = result._repr_png_()
    assert png.startswith(b"\x89PNG\r\n\x1a\n")
    assert png != result.png(exposure=2)
    result.save(tmp_path / "picture.png")
    assert (tmp_path / "picture.png").read_bytes() == png
    with pytest.raises(ValueError, match="neither"):
        result.save(tmp_path / "picture.jpg")
    with pytest.raises(OSError, match="no/such"):
        result.save("no/such/picture.exr")
    assert "12x8, 8 samples" in repr(result)


def test_the_gil_is_released():
    seen = []
    thread = threading.Thread(target=lambda: [seen.append(time.monotonic()) or time.sleep(0.01) for _ in range(10)])

    def stop(_):
        if not thread.is_alive():
            if thread.ident is None:
                thread.start()
            else:
                raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        stokes.render(endless(), progress=stop)
    assert len(seen) == 10


def test_progress_rises_and_its_exceptions_end_the_render():
    fractions = []

    def watch(fraction):
        fractions.append(fraction)
        if fraction > 1e-5 and len(fractions) > 5:
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        stokes.render(endless(), progress=watch)
    assert fractions == sorted(fractions)
    assert 0 <= fractions[0] <= fractions[-1] < 1


@pytest.mark.parametrize("device", ["reference", "auto"])
def test_ctrl_c_ends_a_render_promptly(device):
    if device == "auto" and not any(d.auto for d in stokes.devices()):
        pytest.skip("there is no OpenCL device")
    code = (
        "import sys, stokes, json, time\n"
        "def watch(fraction):\n"
        "  if fraction > 0 and not started: started.append(print('started', flush=True))\n"
        "started = []\n"
        f"try: stokes.render(json.loads(sys.argv[1]), device={device!r}, progress=watch)\n"
        "except KeyboardInterrupt: print('interrupted', flush=True)\n"
    )
    process = subprocess.Popen([sys.executable, "-c", code, json.dumps(endless())], stdout=subprocess.PIPE, text=True)
    try:
        assert process.stdout.readline() == "started\n"
        process.send_signal(signal.SIGINT)
        assert process.communicate(timeout=60)[0] == "interrupted\n"
        assert process.returncode == 0
    finally:
        process.kill()


def test_devices_and_parity():
    devices = stokes.devices()
    assert sum(d.auto for d in devices) <= 1
    if not any(d.auto for d in devices):
        pytest.skip("there is no OpenCL device")
    assert all(d.id.count(":") == 1 and d.compute_units > 0 for d in devices if d.usable)
    result = stokes.parity(BOX, device="auto", spp=64)
    assert result, result.report
    assert result.device != "reference"
    assert {m["channel"] for m in result.means} >= {"R", "G", "B"}
    assert result.largest_z <= result.threshold_z
    with pytest.raises(ValueError, match="spp: parity needs at least 2"):
        stokes.parity(BOX, device="auto", spp=1)


def test_types_and_docstrings_are_there():
    package = pathlib.Path(stokes.__file__).parent
    assert (package / "py.typed").exists()
    for name in stokes.__all__:
        assert getattr(stokes, name).__doc__, name
    assert stokes.render.__annotations__["return"] == "Render"
