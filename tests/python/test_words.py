"""Examples run, types are right, and everything public has its words."""

import doctest
import importlib
import inspect
import os
import pkgutil
import re
import subprocess
import sys
import unittest

from fixture import PACKAGE, PROGRAM, SOURCE, program

import misalign

MODULES = [importlib.import_module(f"misalign.{module.name}") for module in pkgutil.iter_modules(misalign.__path__)
           if module.name != "_misalign"] + [misalign]


class Words(unittest.TestCase):
    def test_every_example_runs(self):
        results = {module.__name__: doctest.testmod(module, extraglobs={"misalign": misalign}) for module in MODULES}
        self.assertEqual([name for name, result in results.items() if result.failed], [])
        self.assertGreater(sum(result.attempted for result in results.values()), 50)

    def test_everything_public_has_an_example(self):
        for name in misalign.__all__:
            thing = getattr(misalign, name)
            if not inspect.isclass(thing) and not inspect.isfunction(thing):
                continue
            public = [thing] + [value for key, value in vars(thing).items()
                                if inspect.isfunction(value) and not key.startswith("_")]
            for each in public:
                self.assertTrue(each.__doc__, each)
                if each.__name__ not in ("close", "UndecidedError"):  # nothing to show
                    self.assertIn(">>> ", each.__doc__, each)

    def test_types(self):
        cache = os.environ.get("MISALIGN_MYPY_CACHE", ".mypy_cache")
        done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", cache, "-p", "misalign"],
                              cwd=PACKAGE, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_stubs_are_of_the_module(self):
        from misalign import _misalign
        with open(PACKAGE / "misalign/_misalign.pyi", encoding="utf-8") as file:
            stub = file.read()
        whole = stub
        for thing in (_misalign, _misalign.Sheet, _misalign.Catalogue):
            # A class has its own part; a function of the module may have the name of a method.
            stub = whole.partition(f"class {thing.__name__}:")[2].partition("\n\n")[0] if inspect.isclass(thing) else (
                "\n".join(line for line in whole.splitlines() if not line.startswith(" ")))
            for name, value in vars(thing).items():
                if (name.startswith("_") and name not in ("__version__", "_use_error")):
                    continue
                self.assertRegex(stub, rf"\b{name}\b")
                said = re.search(rf"def {name}\((?:self, )?([^)]*)\)", stub)
                if callable(value) and said and not inspect.isclass(value):
                    names = re.findall(r"(\w+): ", said[1])
                    signature = (value.__doc__ or "").split("->")[0]
                    for argument in names:
                        self.assertIn(argument + ":", signature)

    def test_the_version(self):
        self.assertIn(misalign.__version__, program("--version"))

    def test_what_it_needs_is_installed(self):
        """By scripts/run.sh, which builds it."""
        done = subprocess.run(["bash", "-c", ". scripts/packages.sh; echo $build_packages"], cwd=SOURCE, check=True,
                              capture_output=True, text=True)
        self.assertIn("python3-numpy", done.stdout.split())


if __name__ == "__main__":
    unittest.main()
