"""
Yields of miscut copies
=======================

The most tolerant of some eight hundred candidates, the one with the largest D, and one in the middle, each with a hundred
miscut copies. Choosing candidates by their tolerance pays.
"""

import subprocess
import tempfile

import matplotlib.pyplot as plt
import misalign

plt.style.use(misalign.style)
errors_mm = (0.02, 0.05, 0.1, 0.15, 0.2, 0.3)
figure, axes = plt.subplots()
with tempfile.TemporaryDirectory() as folder:
    file = f"{folder}/small.db"
    subprocess.run(["misalign", "search", "search/campaigns/miura-4x4.json", "--draws", "2000", "--catalogue", file,
                    "--progress", "none", "--log-level", "error"], check=True, stdout=subprocess.DEVNULL)
    with misalign.Catalogue(file) as catalogue:
        tolerant = catalogue.candidates(by="miscut_margin_mm")
        chosen = {"most tolerant": tolerant.draw[0], "best by angle": catalogue.candidates(limit=1).draw[0],
                  "in the middle": tolerant.draw[len(tolerant) // 2]}
        for name, draw in chosen.items():
            counts = [catalogue.tolerance(int(draw), error_mm, trials=100) for error_mm in errors_mm]
            axes.plot(errors_mm, [100 * count["from_threshold"]["share"] for count in counts], "o-",
                      label=f"draw {draw}, {name}")
axes.set(xlabel="largest cutting error of a vertex (mm)", ylabel="copies that deploy from 150° (%)", ylim=(0, 104))
axes.legend()
plt.show()
