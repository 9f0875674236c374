"""Prints what PyPI `flip-evaluator` 1.7 (the FLIP authors' own, BSD-3-Clause) says of the image pairs in compare_test.cpp.

    python3 -m venv v && v/bin/pip install flip-evaluator==1.7 numpy && v/bin/python tests/unit/make_flip_values.py
"""
import flip_evaluator
import numpy as np

y, x = np.mgrid[0:48, 0:64]
a = np.stack([x / 63, y / 47, (x + y) / 110], axis=-1).astype(np.float32)
patterned = np.stack([((5 * x + 3 * y) % 32) / 31, ((x * x + y) % 29) / 28, ((x ^ y) % 17) / 16], axis=-1).astype(np.float32)
dim, block, stripe = (0.9 * a + 0.02).astype(np.float32), a.copy(), a.copy()
block[10:20, 30:45] = 1 - a[10:20, 30:45]
stripe[:, 31] = 0
for name, b in {"dim": dim, "block": block, "stripe": stripe, "patterned": patterned}.items():
    for ppd in (67.0, 30.0):
        _, mean, _ = flip_evaluator.evaluate(a, b, "LDR", inputsRGB=False, applyMagma=False, computeMeanError=True, parameters={"ppd": ppd})
        print(f"{name} at {ppd}: {mean:.7f}")
