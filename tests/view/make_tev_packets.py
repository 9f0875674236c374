"""Writes tev_packets.h: the bytes that tev's own client library sends for a few calls (PyPI `tevclient` 1.0.4, BSD-3-Clause, and numpy).

    python3 -m venv v && v/bin/pip install tevclient==1.0.4 numpy && v/bin/python tests/view/make_tev_packets.py > tests/view/tev_packets.h
"""
import numpy as np
from tevclient import packet

pixels = (np.arange(2 * 3 * 4, dtype=np.float32).reshape(2, 3, 4) - 5) / 4
packets = {
    "kCreate": packet.create_image("box \u00e9.json", 300, 200, ["R", "G", "B", "A"], True),
    "kUpdate": packet.update_image("box \u00e9.json", pixels, ["R", "G", "B", "A"], 128, 7, False),
    "kClose": packet.close_image("box \u00e9.json"),
}
print("// Written by make_tev_packets.py with tevclient 1.0.4: what tev's own client sends.\n#pragma once\n#include <string>\n")
print("namespace stokes::test {\n")
for name, data in packets.items():
    print(f"inline const std::string {name}(")
    for i in range(0, len(data), 24):
        print('    "' + "".join(f"\\x{b:02x}" for b in data[i : i + 24]) + '"')
    print(f"    , {len(data)});\n")
print("}  // namespace stokes::test")
