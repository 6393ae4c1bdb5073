"""Code for newer processors can never run on an older one.

    test_levels.py BUILD_FOLDER

The passes are compiled once per level of the instruction set. Of functions with the same name in two
object files the linker keeps one, whichever it meets first: were a function outside the level's own
namespace left in a v3 or v4 object, an old processor could be given AVX code. So each function that
such an object defines for others must carry the level in its name.
"""
import pathlib
import re
import subprocess
import sys
import unittest

BUILD = None
LEVELS = ("v3", "v4")


def level_objects():
    """[(level, scalar, object file)]"""
    found = []
    for folder in sorted((BUILD / "solver/passes/compiled/CMakeFiles").glob("twinarm_passes_*.dir")):
        level, scalar = re.fullmatch(r"twinarm_passes_([^_]+)_(.+)\.dir", folder.name).groups()
        found += [(level, scalar, path) for path in folder.glob("*.o")]
    for folder in sorted((BUILD / "coupling/batch/kernel/CMakeFiles").glob("twinarm_batch_*.dir")):
        level = folder.stem.rpartition("_")[2]
        found += [(level, "runs side by side", path) for path in folder.glob("*.o")]
    return found


def defined_functions(path):
    """Mangled names of functions that other objects can see: global (T) and weak (W)."""
    lines = subprocess.run(["nm", "--defined-only", str(path)], check=True, text=True,
                           stdout=subprocess.PIPE).stdout.splitlines()
    fields = [line.split() for line in lines]
    return [name for *_, kind, name in fields if kind in "TWi"]


def carries(level, mangled):
    """The namespace twinarm::<level>, spelled out or abbreviated, is part of the name."""
    return re.search(rf"(7twinarm|S\d*_)2{level}", mangled) is not None


class Levels(unittest.TestCase):
    def setUp(self):
        self.objects = level_objects()
        self.assertTrue(any(level == "generic" for level, _, _ in self.objects), BUILD)

    def test_every_level_is_built_and_known_here(self):
        self.assertEqual({level for level, _, _ in self.objects}, {"generic", *LEVELS})

    def test_functions_of_a_level_are_in_its_own_namespace(self):
        for level, scalar, path in self.objects:
            if level == "generic":
                continue
            functions = defined_functions(path)
            self.assertTrue(any("table" in name or "run_batch" in name for name in functions), path)
            strays = [name for name in functions if not carries(level, name)]
            with self.subTest(level=level, scalar=scalar):
                self.assertEqual(strays, [])

    def test_no_level_but_generic_is_used_without_asking_the_processor(self):
        """Only dynamics.cpp and batch_run.cpp, which ask, refer to the levels."""
        using = set()
        for archive in sorted(BUILD.glob("*/**/libtwinarm_*.a")):
            if archive.parent.name in ("compiled", "kernel"):
                continue
            text = subprocess.run(["nm", "--undefined-only", str(archive)], check=True, text=True,
                                  stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout
            if any(carries(level, line) for line in text.splitlines() for level in LEVELS):
                using.add(str(archive.parent.relative_to(BUILD)))
        self.assertEqual(using, {"solver/dynamics", "coupling/batch"})


if __name__ == "__main__":
    BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
