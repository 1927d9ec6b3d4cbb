"""
Energies of a released sheet
============================

Table 1 released at 36°: without friction all of the springs' energy becomes kinetic. With twice the critical friction
the sheet stalls half-way.
"""

import json
import subprocess

import matplotlib.pyplot as plt
import misalign
import numpy as np

plt.style.use(misalign.style)


def let_go(friction):
    """The JSON of `misalign deploy` with this friction, in N mm/mm."""
    return json.loads(subprocess.run(["misalign", "deploy", "search/patterns/table1.json", "--friction", str(friction),
                                      "--json"], capture_output=True, check=True).stdout)


critical = let_go(0)["critical_friction_n_mm_per_mm"]
figure, grid = plt.subplots(1, 2, figsize=(6.3, 3.2), sharey=True)
for axes, friction in zip(grid, (0, 2 * critical)):
    motion = let_go(friction)
    springs, kinetic = np.array(motion["energy_n_mm"]), np.array(motion["kinetic_n_mm"])
    axes.stackplot(motion["time_s"], springs, kinetic, springs[0] - springs - kinetic,
                   labels=("springs", "kinetic", "lost to friction"), colors=("C0", "C4", "#cccccc"))
    axes.set(xlabel="time (s)", title=f"friction {friction:.4f} N mm/mm: {motion['outcome']} "
                                     f"at {abs(motion['end']['pilot_deg']):.1f}°")
grid[0].set_ylabel("energy (N mm)")
grid[1].legend(loc="lower left", frameon=True)
plt.show()
