"""What the tests of the Python package share: the program beside it, and a small catalogue."""

import json
import os
import subprocess
import sys
from pathlib import Path

PROGRAM = os.environ["MISALIGN_PROGRAM"]
SOURCE = Path(os.environ["MISALIGN_SOURCE"])
PACKAGE = Path(os.environ["MISALIGN_PACKAGE"])  # what PYTHONPATH names
REFERENCE = os.environ["MISALIGN_REFERENCE"]  # the program reference_verdicts

sys.path.insert(0, str(PACKAGE))

CAMPAIGNS = SOURCE / "search/campaigns"
TABLE1 = str(SOURCE / "search/patterns/table1.json")
PATIENCE_S = 600  # no test fails for want of time: only what is stuck is given up

SMALL = str(CAMPAIGNS / "miura-4x4.json")
CATALOGUE = "miura-4x4.db"  # in the directory of the tests, which run.py fills


def program(*arguments, codes=(0,)):
    """What the program prints, where it ends with one of these codes."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    if done.returncode not in codes:
        raise RuntimeError(f"misalign {' '.join(map(str, arguments))}: {done.stderr}")
    return done.stdout


def program_json(*arguments, codes=(0,)):
    return json.loads(program(*arguments, "--json", codes=codes))
