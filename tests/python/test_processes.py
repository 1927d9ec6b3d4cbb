"""Threads, forks, Ctrl-C, and memory."""

import multiprocessing
import os
import resource
import signal
import threading
import time
import unittest
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from fixture import CATALOGUE, SMALL

import misalign


def judged(draws):
    campaign = misalign.read(SMALL)
    return misalign.judge(campaign, campaign.shifts(draws), 100)


def judged_in_a_child(draws):
    return judged(draws).tolist()


class Processes(unittest.TestCase):
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
        done, ticks = threading.Event(), 0
        thread = threading.Thread(target=lambda: (misalign.judge(campaign, shifts_mm), done.set()))
        thread.start()
        while not done.is_set():
            ticks += 1
            time.sleep(0.002)
        thread.join()
        self.assertGreater(ticks, 10)

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
                found = pool.map_async(judged_in_a_child, [range(1000)] * 6).get(timeout=100)
                histories = pool.apply_async(catalogue.histories, ([0, 1],)).get(timeout=100)
        finally:
            stop.set()
            thread.join()
        self.assertEqual(found, [wanted] * 6)
        np.testing.assert_array_equal(histories[1], catalogue.histories([0, 1])[1])

    def interrupted(self, call):
        signal.signal(signal.SIGINT, signal.default_int_handler)  # which shells turn off in the background
        timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        try:
            with self.assertRaises(KeyboardInterrupt):
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
