#!/usr/bin/env python3
"""NLopt's MMA (Svanberg 2002) with exact gradients beside `misalign optimise`, from the same candidates, free shifts.

usage: PYTHONPATH=build/release/python mma.py CATALOGUE STARTS SECONDS

What it gets is what `optimise` has: `Pattern.gradient` gives lengths and fold angles at the angles that the linear programs
look at; the largest t with which every energy step down from 36 degrees is t times what creases turn, every diagonal goes on
between neighbouring angles, no crease is folded flat. What it says is folded before it counts.
"""
import sys
import time

import nlopt
import numpy as np

import misalign

kTo_deg, kFrom_deg, kAmplitude_mm, kStiffness = 170.0, 36.0, 0.4, 50.0
kAngles = np.concatenate([[0], np.arange(4, 146, 4), np.arange(146, kTo_deg, 1), [kTo_deg - 0.02, kTo_deg]])
kGoal = np.array([kFrom_deg * k / 6 for k in range(1, 7)])
kAll = np.unique(np.concatenate([kAngles, kGoal]))


class Search:
    def __init__(self, sheet, seconds):
        self.sheet, self.interior = sheet, np.asarray(sheet.interior)
        self.end = time.process_time() + seconds
        self.best, self.folded, self.known = 0.0, 0, {}
        creases = np.asarray(sheet.creases)
        points = np.asarray(sheet.vertices_mm)
        self.crease_mm = np.linalg.norm(points[creases[:, 0]] - points[creases[:, 1]], axis=1)

    def at(self, x):
        """Slacks (>= 0 is good) and their gradients by shifts; none where its path is lost before."""
        if time.process_time() > self.end:
            raise nlopt.ForcedStop
        key = x.tobytes()
        if key not in self.known:
            self.known = {key: self.look(x)}
        return self.known[key]

    def look(self, x):
        self.folded += 1
        shifts = np.zeros_like(self.sheet.shifts_mm)
        shifts[self.interior] = x.reshape(-1, 2)
        sheet = self.sheet.with_shifts(shifts)
        try:
            found = sheet.gradient(kAll)
        except misalign.Error:
            return None
        length, by = found["length_mm"], found["length_by_mm"][:, :, self.interior, :].reshape(len(kAll), -1, x.size)
        if not np.isfinite(length).all():
            return None
        at = np.searchsorted(kAll, kAngles)
        side = np.sign(length[at[-1]] - length[0])
        steps = side * np.diff(length[at], axis=0)
        steps_by = side[None, :, None] * np.diff(by[at], axis=0)
        least = 1e-3 * np.sin(np.radians((kAngles[1:] + kAngles[:-1]) / 2)) * np.diff(kAngles)
        fold = np.abs(found["fold_deg"][-1])
        fold_by = np.sign(found["fold_deg"][-1])[:, None] * found["fold_by_mm"][-1][:, self.interior, :].reshape(-1, x.size)
        slack = np.concatenate([(steps - least[:, None]).ravel(), (179.999 - fold) / 100])
        slack_by = np.vstack([steps_by.reshape(-1, x.size), -fold_by / 100])
        goal = np.searchsorted(kAll, kGoal)
        longer = length[goal] - length[0]
        energy = kStiffness / 2 * (longer**2).sum(axis=1)
        energy_by = kStiffness * np.einsum("gd,gdx->gx", longer, by[goal] - by[0])
        turned = (self.crease_mm * np.radians(np.abs(found["fold_deg"][goal]))).sum(axis=1)
        below, over = np.append(0, energy[:-1]), turned[-1] - np.append(0, turned[:-1])
        friction = (energy[-1] - below) / over
        friction_by = (energy_by[-1] - np.vstack([0 * x, energy_by[:-1]])) / over[:, None]
        if slack.min() > -1e-6:
            if float(misalign.judge(self.sheet, shifts[None]).deploys_from_deg[0]) >= kTo_deg:
                self.best = max(self.best, sheet.deploy(kFrom_deg)["critical_friction_n_mm_per_mm"] or 0.0)
        return slack, slack_by, friction, friction_by

    def constraints(self, result, x, gradient):
        found = self.at(x[:-1])
        if found is None:  # far out: the step is taken back
            result[:] = 1e3
            if gradient.size:
                gradient[:] = 0
            return
        slack, slack_by, friction, friction_by = found
        scale = 100.0  # frictions are hundredths
        result[:] = np.concatenate([-slack, x[-1] - scale * friction])
        if gradient.size:
            gradient[: len(slack), :-1], gradient[: len(slack), -1] = -slack_by, 0
            gradient[len(slack):, :-1], gradient[len(slack):, -1] = -scale * friction_by, 1

    def run(self, method, x0):
        self.at(x0)
        search = nlopt.opt(method, x0.size + 1)
        search.set_lower_bounds(np.append(np.full(x0.size, -kAmplitude_mm), 0))
        search.set_upper_bounds(np.append(np.full(x0.size, kAmplitude_mm), 1e3))

        def largest(x, gradient):
            if gradient.size:
                gradient[:], gradient[-1] = 0, 1
            return x[-1]
        search.set_max_objective(largest)
        count = len(self.at(x0)[0]) + len(kGoal)
        search.add_inequality_mconstraint(self.constraints, np.full(count, 1e-8))
        search.set_xtol_rel(1e-6)
        try:
            search.optimize(np.append(x0, 100 * self.at(x0)[2].min()))
            return "ended"
        except nlopt.ForcedStop:
            return "time"
        except (RuntimeError, ValueError) as error:
            return type(error).__name__


path, starts, seconds = sys.argv[1], int(sys.argv[2]), float(sys.argv[3])
catalogue = misalign.Catalogue(path)
print(f"| draw | start | optimise | its CPU s | MMA, at most {seconds:g} s | sheets | CPU s | CCSAQ | sheets | CPU s |")
print("|---|---|---|---|---|---|---|---|---|---|")
for draw in catalogue.candidates(limit=starts, by="draw").draw:
    sheet = catalogue.pattern(int(draw))
    before = time.process_time()
    _, said = sheet.optimise(amplitude_mm=kAmplitude_mm, deploys_from_deg=kTo_deg)
    cells = [f"{said['before_n_mm_per_mm']:.4f}", f"{said['after_n_mm_per_mm']:.4f}", f"{time.process_time() - before:.1f}"]
    for method in (nlopt.LD_MMA, nlopt.LD_CCSAQ):
        search = Search(sheet, seconds)
        x0 = sheet.shifts_mm[np.asarray(sheet.interior)].ravel()
        before = time.process_time()
        how = search.run(method, x0)
        cells += [f"{search.best:.4f} ({how})", str(search.folded), f"{time.process_time() - before:.1f}"]
    print(f"| {draw} | " + " | ".join(cells) + " |", flush=True)
