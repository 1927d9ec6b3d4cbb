"""Threads, forks, Ctrl-C, and memory."""

import copy
import multiprocessing
import os
import pickle
import resource
import signal
import threading
import time
import unittest
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from fixture import CATALOGUE, PATIENCE_S, SMALL, SOURCE, TABLE1, program

import misalign


def judged(draws):
    campaign = misalign.read(SMALL)
    return misalign.judge(campaign, campaign.shifts(draws), 100)


def judged_in_a_child(draws):
    return judged(draws).tolist()


def reached_deg(source, shifts_mm):
    return misalign.judge(source, shifts_mm).deploys_from_deg


class Processes(unittest.TestCase):
    def same(self, one, other):
        """Of patterns and campaigns: all that they say, and what they judge."""
        self.assertIs(type(one), type(other))
        for name in [name for name in vars(one) if name not in ("_sheet", "pattern")]:
            np.testing.assert_array_equal(getattr(one, name), getattr(other, name), name)
        if isinstance(one, misalign.Campaign):
            np.testing.assert_array_equal(one.shifts([0, 5]), other.shifts([0, 5]))
            return self.same(one.pattern, other.pattern)
        with self.assertRaises(ValueError):
            other.vertices_mm[0, 0] = 1
        folding, again = one.fold([10, 60]), other.fold([10, 60])
        np.testing.assert_array_equal(folding.length_mm, again.length_mm)
        self.assertEqual((folding.deploys_from_deg, folding.first_fault, folding.fold_limit_deg),
                         (again.deploys_from_deg, again.first_fault, again.fold_limit_deg))

    def test_pickles_and_copies(self):
        patterns = SOURCE / "search/patterns"
        catalogue = misalign.Catalogue(CATALOGUE)
        best = int(catalogue.candidates(limit=1).draw[0])
        program("export", CATALOGUE, "--draw", best, "--output", "pickled")
        program("export", CATALOGUE, "--draw", best, "--format", "fold", "--output", "pickled")
        sources = [misalign.read(path) for path in (
            TABLE1, SMALL, patterns / "turned-quads-6x6.fold", patterns / "turned-quads-6x6.json",
            patterns / "miura-graded-6x6.json", "search/campaigns/angle-array-6x6.json",
            "search/campaigns/miura-8x8-rare.json", f"pickled/miura-4x4-{best}.json",
            f"pickled/miura-4x4-{best}.fold")]
        self.assertIsNotNone(sources[-1].exported)
        for source in sources + [sources[1].pattern, catalogue.campaign]:
            with self.subTest(repr(source)):
                if getattr(source, "is_splitting", False):
                    self.same(source.pattern, pickle.loads(pickle.dumps(source)).pattern)
                    continue
                for copied in (pickle.loads(pickle.dumps(source)), copy.deepcopy(source), copy.copy(source)):
                    self.same(source, copied)
        self.assertEqual(catalogue.campaign.identity, pickle.loads(pickle.dumps(catalogue.campaign)).identity)

    def test_campaigns_go_to_processes_that_share_nothing(self):
        campaign = misalign.read(SMALL)
        shifts_mm = campaign.shifts(range(100))
        with multiprocessing.get_context("spawn").Pool(2) as pool:
            found = pool.starmap(reached_deg, [(campaign, shifts_mm), (campaign.pattern, shifts_mm)])
        for reached in found:
            np.testing.assert_array_equal(reached, reached_deg(campaign, shifts_mm))

    def test_threads(self):
        campaign = misalign.read(SMALL)
        catalogue = misalign.Catalogue(CATALOGUE)
        pieces = [range(k, k + 500) for k in range(0, 4000, 500)]
        wanted = [judged(piece) for piece in pieces]

        def work(k):
            piece = pieces[k % len(pieces)]
            found = misalign.judge(campaign, campaign.shifts(piece), 100)  # all the same model
            verdicts = misalign.judge(campaign.pattern, campaign.shifts(piece[:20]))
            np.testing.assert_array_equal(verdicts.deploys_from_deg >= 100, found[:20])
            self.assertEqual(len(catalogue.candidates(limit=2)), 2)
            return found

        with ThreadPoolExecutor(6) as pool:
            for k, found in enumerate(pool.map(work, range(16))):
                np.testing.assert_array_equal(found, wanted[k % len(pieces)])

    def test_python_goes_on_meanwhile(self):
        campaign = misalign.read(SMALL)
        shifts_mm = campaign.shifts(range(6000))
        stop, begun_or_done = threading.Event(), [0]  # odd while it judges

        def keep_judging():
            while not stop.is_set():
                begun_or_done[0] += 1
                misalign.judge(campaign, shifts_mm)
                begun_or_done[0] += 1

        thread = threading.Thread(target=keep_judging)
        thread.start()
        # Ten times within one call; who kept others waiting would let them run between two of them.
        ticks, call, end = 0, 0, time.monotonic() + PATIENCE_S
        while ticks < 10 and time.monotonic() < end:
            time.sleep(0.002)
            now = begun_or_done[0]
            ticks, call = (ticks + 1 if now == call and now % 2 else 0), now
        stop.set()
        thread.join()
        self.assertEqual(ticks, 10)

    def test_forks(self):
        wanted = judged(range(1000)).tolist()  # in the parent first: the child finds its models made
        catalogue = misalign.Catalogue(CATALOGUE)
        stop = threading.Event()

        def keep_judging():
            while not stop.is_set():
                judged(range(300))

        thread = threading.Thread(target=keep_judging)
        thread.start()
        try:
            with multiprocessing.get_context("fork").Pool(2) as pool:
                found = pool.map_async(judged_in_a_child, [range(1000)] * 6).get(timeout=PATIENCE_S)
                histories = pool.apply_async(catalogue.histories, ([0, 1],)).get(timeout=PATIENCE_S)
        finally:
            stop.set()
            thread.join()
        self.assertEqual(found, [wanted] * 6)
        np.testing.assert_array_equal(histories[1], catalogue.histories([0, 1])[1])

    def interrupted(self, call):
        signal.signal(signal.SIGINT, signal.default_int_handler)  # which shells turn off in the background
        timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
        try:
            with self.assertRaises(KeyboardInterrupt):
                timer.start()
                call()
        finally:
            timer.join()

    def test_ctrl_c(self):
        """No time is asserted: each call would take minutes."""
        campaign = misalign.read(SMALL)
        one = campaign.shifts(range(1000))
        many = np.broadcast_to(one, (2000, *one.shape)).reshape(-1, *one.shape[1:])
        misalign.judge(campaign, one, 100)
        catalogue = misalign.Catalogue(CATALOGUE)
        draw = int(catalogue.candidates(limit=1).draw[0])
        self.interrupted(lambda: misalign.judge(campaign, many))
        self.interrupted(lambda: [misalign.judge(campaign, many, 100) for _ in range(1000)])
        self.interrupted(lambda: catalogue.histories(range(100000)))
        for jobs in (1, 2):
            self.interrupted(lambda: catalogue.tolerance(draw, 0.05, 1000000, jobs))
        large = misalign.read({"family": "miura", "rows": 10, "columns": 10, "displacements_mm": {"A14": [1, 1]}})
        self.interrupted(lambda: large.gradient(np.linspace(1, 60, 100000)))
        sheet = catalogue.pattern(draw)
        self.interrupted(lambda: sheet.optimise("yield", trials=1000000))
        self.interrupted(lambda: [sheet.optimise(amplitude_mm=2) for _ in range(1000)])
        numbers = "WITH RECURSIVE n(k) AS (SELECT 1 UNION ALL SELECT k + 1 FROM n) SELECT k FROM n "
        self.interrupted(lambda: catalogue.query(numbers + "WHERE k < 0"))
        self.interrupted(lambda: catalogue.query(numbers + "WHERE k % 100000 = 0"))
        np.testing.assert_array_equal(misalign.judge(campaign, one, 100), judged(range(1000)))  # still usable

    def test_memory_is_flat(self):
        campaign = misalign.read(SMALL)
        catalogue = misalign.Catalogue(CATALOGUE)
        shifts_mm = campaign.shifts(range(500))

        def work():
            misalign.judge(campaign, shifts_mm, 150)
            misalign.judge(campaign, shifts_mm.astype(np.float32)[:20])
            campaign.pattern.fold([90])
            catalogue.histories([1])
            catalogue.query("best")
            for bad in (np.zeros((1, 2, 3)), np.full((1, 25, 2), np.nan)):
                try:
                    misalign.judge(campaign, bad)
                except misalign.Error:
                    pass

        for _ in range(5):
            work()
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        for _ in range(25):
            work()
        self.assertLess(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before, 4096)  # kB


if __name__ == "__main__":
    unittest.main()
