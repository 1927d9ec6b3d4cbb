#!/usr/bin/env python3
"""measure.py BUILD [verdicts] [speed] [histories] [memory] [ctrl-c]: the numbers of README.md, all of them by default.

Wants BUILD/misalign, BUILD/python (-DMISALIGN_PYTHON=ON) and BUILD/tests/draw_speed, and runs from the top folder.
"""

import os
import resource
import signal
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

build = Path(sys.argv[1]).resolve()
sys.path.insert(0, str(build / "python"))

import numpy as np

import misalign

DEFAULT = "search/campaigns/miura-6x6.json"


def program(*arguments):
    return subprocess.run([build / "misalign", *map(str, arguments)], check=True, capture_output=True, text=True).stdout


def searched(directory, campaign, threshold_deg, draws):
    """The candidates of a campaign like this one with another threshold."""
    import json
    path, catalogue = Path(directory) / "campaign.json", Path(directory) / f"{threshold_deg}.db"
    configuration = campaign.configuration
    configuration["accept"]["deploys_from_deg"] = threshold_deg
    path.write_text(json.dumps(configuration))
    program("search", path, "--draws", draws, "--catalogue", catalogue, "--progress", "none")
    return misalign.Catalogue(catalogue).candidates()


def verdicts():
    """Of 100,000 draws, beside searches whose thresholds are 1 degree (which keeps D of every draw) and others."""
    draws = 100_000
    campaign = misalign.read(DEFAULT)
    shifts_mm = campaign.shifts(range(draws))
    with tempfile.TemporaryDirectory() as directory:
        found = searched(directory, campaign, 1, draws)
        deploys_from_deg = np.zeros(draws)
        deploys_from_deg[found.draw] = found.deploys_from_deg
        judged = misalign.judge(campaign, shifts_mm)
        print(f"without a threshold: {(judged.deploys_from_deg != deploys_from_deg).sum()} of {draws} D differ, "
              f"{(judged.fault == misalign.faults.index('undecided')).sum()} undecided")
        for threshold_deg in (100, 150, 170):
            kept = np.zeros(draws, dtype=bool)
            kept[searched(directory, campaign, threshold_deg, draws).draw] = True
            accepted = misalign.judge(campaign, shifts_mm, threshold_deg)
            by_pattern = misalign.judge(campaign.pattern, shifts_mm, threshold_deg)
            print(f"threshold {threshold_deg}: {(accepted != kept).sum()} of {draws} differ from the search, "
                  f"{(by_pattern != accepted).sum()} where the pattern is given, {kept.sum()} accepted")


def cpu_s(work):
    start = time.process_time()
    work()
    return time.process_time() - start


def speed():
    """CPU seconds of the same draws, in turns: Python's call, and what `bench` times."""
    campaign = misalign.read(DEFAULT)
    for what, draws, threshold_deg in (("search", 400_000, campaign.threshold_deg), ("paths", 8_000, None)):
        shifts_mm = campaign.shifts(range(draws))
        misalign.judge(campaign, shifts_mm[:2000], threshold_deg)
        alone, drawn, of_pattern = [], [], []
        misalign.judge(campaign.pattern, shifts_mm[:2000], threshold_deg)
        for _ in range(11):
            theirs = float(subprocess.run([build / "tests/draw_speed", DEFAULT, what, str(draws)], check=True,
                                          capture_output=True, text=True).stdout)
            ours = cpu_s(lambda: misalign.judge(campaign, shifts_mm, threshold_deg))
            alone.append(theirs / ours)
            drawn.append(theirs / (ours + cpu_s(lambda: campaign.shifts(range(draws)))))
            of_pattern.append(theirs / cpu_s(lambda: misalign.judge(campaign.pattern, shifts_mm, threshold_deg)))
        for name, ratios in (("judge", alone), ("drawing and judge", drawn), ("judge, given the pattern", of_pattern)):
            print(f"{what}: {name}: {statistics.median(ratios):.3f} of the program's draws/s "
                  f"({min(ratios):.3f} to {max(ratios):.3f} of {len(ratios)})")
        print(f"{what}: {draws / theirs:.0f} draws per CPU second of the program, {draws / ours:.0f} of Python")


def histories():
    """Of 1,000 draws of 6 x 6, on one core."""
    with tempfile.TemporaryDirectory() as directory:
        path = Path(directory) / "campaign.db"
        program("search", DEFAULT, "--draws", 2_000_000, "--catalogue", path, "--progress", "none")
        catalogue = misalign.Catalogue(path)
        for name, draws in (("candidates", catalogue.candidates(limit=1000).draw), ("draws from 0 on", range(1000))):
            times = []
            for _ in range(5):
                start = time.monotonic()
                cpu = cpu_s(lambda: catalogue.histories(draws))
                times.append((cpu, time.monotonic() - start))
            print(f"1,000 histories of {len(draws)} {name}: {statistics.median(t[0] for t in times) / len(draws) * 1000:.2f} "
                  f"CPU s ({min(times)[0]:.2f} to {max(times)[0]:.2f}), {min(t[1] for t in times):.2f} s at least by the clock")


def resident_mb():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * resource.getpagesize() / 2**20


def memory():
    """Over ten million draws, and 20,000 on their full paths."""
    campaign = misalign.read(DEFAULT)
    piece = 100_000
    seen, accepted = [], 0
    for first in range(0, 10_000_000, piece):
        accepted += int(misalign.judge(campaign, campaign.shifts(range(first, first + piece)), 170).sum())
        misalign.judge(campaign, campaign.shifts(range(200)))
        seen.append(resident_mb())
    print(f"10,000,000 draws, {accepted} accepted; resident after each 100,000: {seen[0]:.1f} MB first, "
          f"{seen[9]:.1f} MB after 1,000,000, {seen[-1]:.1f} MB at the end, {max(seen):.1f} MB at most")


def ctrl_c():
    """From the signal to KeyboardInterrupt, s."""
    signal.signal(signal.SIGINT, signal.default_int_handler)  # which shells turn off in the background
    campaign = misalign.read(DEFAULT)
    one = campaign.shifts(range(100_000))
    for name, threshold_deg in (("with a threshold", 170), ("without", None)):
        misalign.judge(campaign, one[:1000], threshold_deg)
        waits = []
        for k in range(20):
            sent = []
            timer = threading.Timer(0.2 + 0.01 * k, lambda: (sent.append(time.monotonic()),
                                                             os.kill(os.getpid(), signal.SIGINT)))
            timer.start()
            try:
                while True:
                    misalign.judge(campaign, one, threshold_deg)
            except KeyboardInterrupt:
                waits.append(time.monotonic() - sent[0])
            timer.join()
        print(f"Ctrl-C {name}: {statistics.median(waits):.3f} s, {max(waits):.3f} s at most of {len(waits)}")


parts = {"verdicts": verdicts, "speed": speed, "histories": histories, "memory": memory, "ctrl-c": ctrl_c}
for part in sys.argv[2:] or parts:
    parts[part]()
