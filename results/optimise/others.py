#!/usr/bin/env python3
"""Differential evolution (SciPy) and ISRES (NLopt) beside `misalign optimise`, from the same candidates.

usage: PYTHONPATH=build/release/python others.py CATALOGUE STARTS SECONDS

Largest critical friction of rigid panels from 36 degrees, D of at least the campaign's threshold, free shifts within its
amplitude. Both get the candidate as a start, and the threshold as a penalty or a constraint. A table of what is reached
after so many seconds of one core.
"""
import sys
import time

import nlopt
import numpy as np
from scipy.optimize import differential_evolution

import misalign


class Budget(Exception):
    """The seconds are over."""


class Task:
    """Counts seconds, and keeps the best that fits."""

    def __init__(self, sheet, vertices, threshold_deg, seconds):
        self.sheet, self.vertices, self.threshold_deg = sheet, vertices, threshold_deg
        self.end = time.process_time() + seconds
        self.best, self.folded = 0.0, 0

    def look(self, x):
        """Friction, and how far D is short of the threshold."""
        if time.process_time() > self.end:
            raise Budget
        self.folded += 1
        shifts_mm = np.zeros_like(self.sheet.shifts_mm)
        shifts_mm[self.vertices] = x.reshape(-1, 2)
        try:
            verdict = misalign.judge(self.sheet, shifts_mm[None])
            short_deg = self.threshold_deg - float(verdict.deploys_from_deg[0])
            if short_deg > 0:
                return 0.0, short_deg
            friction = self.sheet.with_shifts(shifts_mm).deploy(36)["critical_friction_n_mm_per_mm"] or 0.0
        except misalign.Error:
            return 0.0, self.threshold_deg
        self.best = max(self.best, friction)
        return friction, short_deg


def evolve(task, x0, amplitude_mm):
    def cost(x):
        friction, short_deg = task.look(x)
        return -friction + max(0.0, short_deg)
    differential_evolution(cost, [(-amplitude_mm, amplitude_mm)] * x0.size, x0=x0, popsize=2, maxiter=10**6, seed=1, tol=0,
                           polish=False)


def isres(task, x0, amplitude_mm):
    looked = {}

    def both(x):
        if looked.get("x") is None or not np.array_equal(looked["x"], x):
            looked["x"], looked["found"] = x.copy(), task.look(x)
        return looked["found"]
    search = nlopt.opt(nlopt.GN_ISRES, x0.size)
    search.set_lower_bounds(-amplitude_mm)
    search.set_upper_bounds(amplitude_mm)
    search.set_max_objective(lambda x, _: both(x)[0])
    search.add_inequality_constraint(lambda x, _: both(x)[1], 0)
    search.set_maxeval(10**9)
    nlopt.srand(1)
    search.optimize(x0)


def main():
    path, starts, seconds = sys.argv[1], int(sys.argv[2]), float(sys.argv[3])
    catalogue = misalign.Catalogue(path)
    amplitude_mm = 0.4
    print(f"| draw | start | optimise, free | its CPU s | differential evolution, {seconds:g} s | sheets | ISRES, {seconds:g} s | sheets |")
    print("|---|---|---|---|---|---|---|---|")
    for draw in catalogue.candidates(limit=starts, by="draw").draw:
        sheet = catalogue.pattern(int(draw))
        before = time.process_time()
        _, said = sheet.optimise(amplitude_mm=amplitude_mm, deploys_from_deg=170)
        spent = time.process_time() - before
        vertices = np.asarray(sheet.interior)
        x0 = sheet.shifts_mm[vertices].ravel()
        cells = []
        for method in (evolve, isres):
            task = Task(sheet, vertices, 170, seconds)
            try:
                method(task, x0, amplitude_mm)
            except Budget:
                pass
            cells += [f"{task.best:.4f}", str(task.folded)]
        print(f"| {draw} | {said['before_n_mm_per_mm']:.4f} | {said['after_n_mm_per_mm']:.4f} | {spent:.1f} | " +
              " | ".join(cells) + " |", flush=True)


main()
