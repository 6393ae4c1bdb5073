"""Tracing costs nothing when it is off: aba() without a trace is, instruction by instruction, what
the compiler makes of the same text without the hook.

    test_no_trace.py BUILD_FOLDER
"""
import json
import pathlib
import re
import shutil
import shlex
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = ""
HOOK = "trace.transmitted(i, Ia, pa);"
ABA = """#include "solver/passes/aba.h"
namespace twinarm::generic {
void pass(const Model<double>& model, const State<double>& x, const Forces<double>& forces, Workspace<double>& w) {
  aba(model, x, forces, w, NoTrace{});
}
}
"""


def command():
    """As the passes in double precision are compiled for plain x86-64."""
    for entry in json.loads((pathlib.Path(BUILD) / "compile_commands.json").read_text()):
        words = shlex.split(entry["command"])
        if (entry["file"].endswith("solver/passes/compiled/passes.cpp") and "-DTWINARM_ISA=generic" in words
                and "-DTWINARM_SCALAR=double" in words):
            words = [w for w in words if not w.endswith("ccache")]
            return words[:words.index("-o")]
    raise AssertionError("the passes are not in compile_commands.json")


def instructions(words, root):
    words = [f"-I{root}" if w == f"-I{ROOT}" else w for w in words]
    made = subprocess.run([*words, "-S", "-o", "-", "-x", "c++", "-"], input=ABA, cwd=root,
                          capture_output=True, text=True, check=True).stdout
    # Debuggers' labels are numbered through; files and versions are no instructions.
    made = re.sub(r"\.L(F[BE]|func_begin|func_end)\d+", ".L", made)
    return [line for line in made.splitlines() if not re.match(r"\s*\.(file|ident)", line)]


class NoTrace(unittest.TestCase):
    def test_the_hook_leaves_no_instruction(self):
        with tempfile.TemporaryDirectory() as folder:
            bare = pathlib.Path(folder)
            shutil.copytree(ROOT / "solver", bare / "solver")
            text = (ROOT / "solver/passes/aba.h").read_text(encoding="utf-8")
            self.assertEqual(text.count(HOOK), 1)
            (bare / "solver/passes/aba.h").write_text(text.replace(HOOK, "(void)trace;"), encoding="utf-8")
            with_hook, without = (instructions(command(), root) for root in (ROOT, bare))
        self.assertGreater(len(with_hook), 1000)
        self.assertTrue(with_hook == without, "aba() without a trace is not the bare pass")


if __name__ == "__main__":
    BUILD = sys.argv.pop(1)
    unittest.main()
