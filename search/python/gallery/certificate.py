"""
The intervals of a certificate
==============================

A certificate is a chain of intervals of the pilot angle. In each a box round the path is proven to hold exactly one
folded state at every angle. Intervals are long where the path is smooth, and ever shorter towards the fold limit.
Table 1's certificate ends at 156.155°, where a diagonal reverses, a fifth of a degree before that limit.
"""

import base64
import struct

import matplotlib.pyplot as plt
import misalign

plt.style.use(misalign.style)
said = misalign.read("search/patterns/table1.json").certify(from_deg=180)
proof = base64.b64decode(said["proof"])
_, creases, balls, intervals = struct.unpack_from("<4I", proof)
HEAD, SIZE = 32, 16 + 4 * creases + 12 * balls      # each: where it ends, its box, and the state in its middle
ends = [struct.unpack_from("<df", proof, HEAD + SIZE * k) for k in range(intervals)]

figure, axes = plt.subplots()
from_deg = 0.0
for number, (to_deg, box) in enumerate(ends):
    axes.bar(from_deg, to_deg - from_deg, width=to_deg - from_deg, align="edge", edgecolor="white", linewidth=0.5,
             color=f"C{number % 2}")
    from_deg = to_deg
axes.axvline(said["certified_deg"], color="black", linestyle=":",
             label=f"{said['certified_deg']:.4f}°: {said['end']} of {said['where']}")
axes.set(yscale="log", ylim=(0.05, 60), xlabel="pilot angle (°)", ylabel="length of the interval (°)",
         title=f"Table 1: {intervals} intervals, from flat on")
axes.legend(loc="upper left")
plt.show()
