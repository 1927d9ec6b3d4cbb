"""
The springs' moment along the path
==================================

Springs on all diagonals of Table 1 push strongly where the sheet is folded, and hardly at all near flat: there the
moment about the pilot crease is proportional to the cube of the angle.
"""

import matplotlib.pyplot as plt
import misalign

plt.style.use(misalign.style)
history = misalign.read("search/patterns/table1.json").actuators()["history"]
pilot_deg, moment_n_mm = history["pilot_deg"], history["moment_n_mm"]

figure, axes = plt.subplots()
way = pilot_deg > 0
axes.plot(pilot_deg[way], moment_n_mm[way], label="springs of 50 N/mm")
axes.plot(pilot_deg[way], moment_n_mm[pilot_deg == 10] * (pilot_deg[way] / 10) ** 3, color="#999999", linestyle="--",
          label="ρ³ through 10°")
axes.set(xscale="log", yscale="log", xlabel="pilot angle ρ (°)", ylabel="moment about the pilot crease (N mm)")
axes.grid()
axes.legend()
plt.show()
