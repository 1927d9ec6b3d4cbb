"""
Stress of the deploying sheet
=============================

The paper's figure 14: von Mises stress of Table 1's panels, 1 mm of aluminium, while springs of 50 N/mm deploy it from
36°, 20 % of the way. Upper row: in equilibrium at three angles, as in a slow deployment (`misalign deploy --panels bend`).
Lower row: the first 10 ms after a sudden release, in CalculiX, which shakes the panels (`misalign stress`). Stress beside
corners is left out, since it has no limit there. The paper's model had 34 MPa, in panels of the perimeter: neither has.
"""

import json
import shutil
import subprocess
import tempfile

import matplotlib.pyplot as plt
import misalign
import numpy as np

FILE, FROM_DEG = "search/patterns/table1.json", 36
TIME_LIMIT_S = 0.01  # 1: the whole deployment, which takes CalculiX some minutes

plt.style.use(misalign.style)
table1 = misalign.read(FILE)
slow = table1.deploy(from_deg=FROM_DEG, bend=True)["bent"]
has_ccx = shutil.which("ccx") is not None
figure = plt.figure(figsize=(6.3, 4.4 if has_ccx else 2.2))
rows = figure.subfigures(2 if has_ccx else 1, squeeze=False)[:, 0]

colours = plt.cm.ScalarMappable(plt.Normalize(0, slow["largest_stress_mpa"]))
upper = rows[0].subplots(1, 3, subplot_kw={"projection": "3d"})
for axes, near_deg in zip(upper, (36, 20, 10)):
    angle = min(slow["angles"], key=lambda each: abs(each["pilot_deg"] - near_deg))
    table1.plot(angle["pilot_deg"], axes, colours=colours.to_rgba(angle["panel_stress_mpa"]))
    axes.set_title(f"{angle['pilot_deg']:.0f}°: at most {angle['largest_stress_mpa']:.1f} MPa")
rows[0].colorbar(colours, ax=upper, shrink=0.8, label="slow: stress (MPa)")

if has_ccx:
    with tempfile.TemporaryDirectory() as folder:
        sudden = json.loads(subprocess.run(["misalign", "stress", FILE, "--from", str(FROM_DEG), "--time-limit",
                                            str(TIME_LIMIT_S), "--output", folder, "--json"], capture_output=True,
                                           check=True).stdout)
    panels_mpa = np.array([panel["outside_discs_mpa"] for panel in sudden["panels"]])
    colours = plt.cm.ScalarMappable(plt.Normalize(0, panels_mpa.max()))
    left, right = rows[1].subfigures(1, 2)
    axes = left.subplots(subplot_kw={"projection": "3d"})
    table1.plot(FROM_DEG, axes, colours=colours.to_rgba(panels_mpa))
    axes.set_title(f"largest in the first {1000 * TIME_LIMIT_S:g} ms")
    left.colorbar(colours, ax=axes, shrink=0.8, label="sudden: stress (MPa)")
    axes = right.subplots()
    axes.plot(1000 * np.array(sudden["stress"]["time_s"]), sudden["stress"]["outside_discs_mpa"], color="C1",
              label="sudden release, CalculiX")
    axes.axhline(slow["largest_stress_mpa"], color="C0", linestyle="--", label=f"slow, at {FROM_DEG}°")
    axes.set(xlabel="time (ms)", ylabel="largest stress (MPa)", ylim=(0, None))
    axes.legend()
else:
    print("CalculiX (ccx) is not in PATH: the sudden release is left out; install Debian's calculix-ccx.")
plt.show()
