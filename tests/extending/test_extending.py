"""Adding a thing takes the files and lines that docs/develop/extending.md promises.

    test_extending.py              every patch applies, and touches no more than promised
    test_extending.py --build      also applies all patches to a copy of the tree, builds it and runs their checks

A patch begins with lines `build: TARGET ..` and `check: COMMAND`, before its first `diff`. Commands run in the root of
the copy, with its programs first on the path.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PATCHES = sorted((ROOT / "tests/extending").glob("*.patch"))
# Files (the one that is new, or has most of it), and lines in others; neither tests nor documentation count. The number
# of a scene's key is kept in a member, and used (a key of a member that is there: a row).
PROMISED = {
    "analytic_case": (1, 0), "command": (1, 0), "coupling": (1, 0), "device": (1, 0), "engine": (1, 0),
    "importer": (1, 0), "joint": (1, 0), "lab_parameter": (1, 0), "loop": (1, 1), "overlay": (1, 0),
    "run_column": (1, 0), "scene_key": (1, 2), "shape": (1, 1)}
BUILD = False


def heads(patch, key):
    head = patch.read_text(encoding="utf-8").partition("diff --git")[0]
    return re.findall(rf"^{key}: (.+)$", head, re.MULTILINE)


def touched(patch):
    """(files, lines in others) of the product."""
    added = []
    for part in patch.read_text(encoding="utf-8").split("diff --git ")[1:]:
        path = part.split(" b/")[0].removeprefix("a/")
        if not path.startswith(("tests/", "docs/")):
            lines = len(re.findall(r"^\+(?!\+\+ )", part, re.MULTILINE))
            added.append(("\nnew file mode" in part, lines))
    added.sort()
    return 1, sum(lines for _, lines in added[:-1])


def apply(patch, folder):
    subprocess.run(["git", "apply", "--recount", "-C1", str(patch)], cwd=folder, check=True)


def copy_tree(folder):
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True)
    for name in listed.stdout.split("\0"):
        if name and (ROOT / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, folder / name)


class Extending(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory(prefix="twinarm-extending-")
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)
        copy_tree(self.folder)

    def test_there_is_a_patch_for_each_kind_that_touches_no_more_than_promised(self):
        self.assertEqual([patch.stem for patch in PATCHES], sorted(PROMISED))
        for patch in PATCHES:
            with self.subTest(patch.stem):
                self.assertLessEqual(touched(patch), PROMISED[patch.stem])

    def test_all_patches_apply_together_and_do_what_they_say(self):
        for patch in PATCHES:
            with self.subTest(patch.stem):
                apply(patch, self.folder)
                self.assertTrue(heads(patch, "check"), "it says no check")
        if not BUILD:
            return
        build = self.folder / "build/extending"
        targets = sorted({target for patch in PATCHES for line in heads(patch, "build") for target in line.split()})
        environment = dict(os.environ, CCACHE_BASEDIR=str(self.folder), CCACHE_NOHASHDIR="1",
                           PATH=f"{build}:{os.environ['PATH']}")
        for command in (["cmake", "-S", ".", "-B", "build/extending", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Debug",
                         "-DCMAKE_CXX_FLAGS_DEBUG=-O0", "-DTWINARM_WERROR=ON"],
                        ["cmake", "--build", "build/extending", "--target", *targets]):
            done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, env=environment)
            self.assertEqual(done.returncode, 0, done.stdout[-3000:] + done.stderr[-3000:])
        for patch in PATCHES:
            for command in heads(patch, "check"):
                with self.subTest(patch.stem, command=command):
                    done = subprocess.run(["bash", "-c", command], cwd=self.folder, capture_output=True, text=True,
                                          env=environment)
                    self.assertEqual(done.returncode, 0, done.stdout[-3000:] + done.stderr[-3000:])


if __name__ == "__main__":
    if "--build" in sys.argv:
        sys.argv.remove("--build")
        BUILD = True
    unittest.main()
