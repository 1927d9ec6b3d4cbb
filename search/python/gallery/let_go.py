"""
Energies of a released sheet
============================

Table 1 released at 36°: without friction all of the springs' energy becomes kinetic. With twice the critical friction
the sheet stalls half-way.
"""

import matplotlib.pyplot as plt
import misalign

plt.style.use(misalign.style)
table1 = misalign.read("search/patterns/table1.json")
critical = table1.deploy(friction_n_mm_per_mm=0)["critical_friction_n_mm_per_mm"]

figure, grid = plt.subplots(1, 2, figsize=(6.3, 3.2), sharey=True)
for axes, friction in zip(grid, (0, 2 * critical)):
    motion = table1.deploy(friction_n_mm_per_mm=friction)
    springs, kinetic = motion["energy_n_mm"], motion["kinetic_n_mm"]
    axes.stackplot(motion["time_s"], springs, kinetic, springs[0] - springs - kinetic,
                   labels=("springs", "kinetic", "lost to friction"), colors=("C0", "C4", "#cccccc"))
    axes.set(xlabel="time (s)", title=f"friction {friction:.4f} N mm/mm: {motion['outcome']} "
                                     f"at {abs(motion['end']['pilot_deg']):.1f}°")
grid[0].set_ylabel("energy (N mm)")
grid[1].legend(loc="lower left", frameon=True)
plt.show()
