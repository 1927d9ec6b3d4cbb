"""
Acceptance against amplitude
============================

The same draws with ever larger shifts: fewer sheets deploy from 150°, but their springs have more stroke. The best
amplitude depends on the springs and on the cutter.
"""

import matplotlib.pyplot as plt
import misalign
import numpy as np

plt.style.use(misalign.style)
DRAWS = 1500
campaign = misalign.read("search/campaigns/miura-6x6.json")
pattern = campaign.pattern
directions = campaign.shifts(range(DRAWS)) / campaign.amplitude_mm
amplitudes_mm = np.geomspace(0.1, 6.4, 7)
shares, strokes = [], []
for amplitude_mm in amplitudes_mm:
    shifts_mm = amplitude_mm * directions
    accepted = np.flatnonzero(misalign.judge(pattern, shifts_mm).deploys_from_deg >= 150)
    shares.append(len(accepted) / DRAWS)
    histories = [pattern.fold([0, 150], shifts_mm[draw]) for draw in accepted[:20]]
    strokes.append(np.mean([np.abs(each.length_mm[1] / each.flat_mm - 1).max() for each in histories]))

figure, axes = plt.subplots()
axes.plot(amplitudes_mm, 100 * np.array(shares), "o-", color="C0", label="share of draws that deploy from 150°")
axes.plot(amplitudes_mm, 100 * np.array(strokes), "s-", color="C1", label="mean largest stroke at 150°")
axes.axhline(8, color="#999999", linestyle=":", label="8 %: recovered by Ti–Ni wires")
axes.set(xscale="log", yscale="log", xlabel="amplitude of the shifts (mm; panels of 80 mm)", ylabel="share or stroke (%)")
axes.legend()
plt.show()
