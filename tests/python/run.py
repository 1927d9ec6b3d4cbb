"""run.py PROGRAM SOURCE PACKAGE REFERENCE: every test of the Python package, in a directory of its own."""

import os
import subprocess
import sys
import tempfile
import unittest

if __name__ == "__main__":  # processes that tests start import this file
    names = ("MISALIGN_PROGRAM", "MISALIGN_SOURCE", "MISALIGN_PACKAGE", "MISALIGN_REFERENCE")
    os.environ.update(zip(names, map(os.path.abspath, sys.argv[1:5])))
    here = os.path.dirname(os.path.abspath(__file__))
    with tempfile.TemporaryDirectory() as directory:
        os.chdir(directory)
        os.symlink(os.path.join(os.environ["MISALIGN_SOURCE"], "search"), "search")  # as examples name files
        subprocess.run([os.environ["MISALIGN_PROGRAM"], "search", "search/campaigns/miura-4x4.json", "--draws", "20000",
                        "--catalogue", "miura-4x4.db", "--progress", "none"], check=True, stdout=subprocess.DEVNULL)
        tests = unittest.defaultTestLoader.discover(here, pattern=sys.argv[5] if len(sys.argv) > 5 else "test_*.py")
        good = unittest.TextTestRunner(verbosity=2).run(tests).wasSuccessful()
        os.chdir("/")
    sys.exit(not good)
