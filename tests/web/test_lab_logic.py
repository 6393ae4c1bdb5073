"""Logic of the lab's page without a browser, in Node.

    test_lab_logic.py FOLDER_OF_MODULES
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

from waiting import TIMEOUT

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parents[1] / "app" / "web" / "src"
MODULES = pathlib.Path(sys.argv.pop(1)).resolve()
NODE = shutil.which("node") or shutil.which("nodejs")
# Test files and the modules that they test.
PARTS = {
    "lab_logic": ("ui/scale", "source/store", "source/run_record", "plot/export", "plot/specs",
                  "panels/input_bar", "panels/gallery", "ui/dom", "plot/chart_parts",
                  "plot/chart_data", "source/run_source", "pages/address"),
    "lab_view": ("protocol/frame", "source/meshes", "input/handles", "input/drag_goal", "view/pace",
                 "input/gamepad", "view/labels", "view/live_stage", "view/painter", "panels/hints"),
}
BUNDLE = """
import { createRequire } from 'node:module';
const [modules, entry, out] = process.argv.slice(2);
const esbuild = createRequire(modules + '/any.js')('esbuild');
await esbuild.build({ entryPoints: [entry], outfile: out, bundle: true, format: 'esm',
  platform: 'node', nodePaths: [modules], logLevel: 'error' });
"""


class LabLogic(unittest.TestCase):
    @unittest.skipUnless(NODE and (MODULES / "esbuild").is_dir(),
                         "the program was built without its pages: scripts/setup --web, then build")
    def test_node_tests(self):
        for file, parts in PARTS.items():
            with self.subTest(file):
                self.run_in_node(file, parts)

    def run_in_node(self, file, parts):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "bundle.mjs").write_text(BUNDLE, encoding="utf-8")
            entry = "".join(f"export * from '{SOURCE / part}.ts';\n" for part in parts)
            entry += "export * as THREE from 'three';\n"
            (folder / "entry.ts").write_text(entry, encoding="utf-8")
            out = folder / "lab.mjs"
            subprocess.run([NODE, folder / "bundle.mjs", MODULES, folder / "entry.ts", out],
                           check=True, timeout=TIMEOUT)
            done = subprocess.run([NODE, "--test", HERE / f"{file}.mjs"], check=False,
                                  env={**os.environ, "MODULES": str(out)}, timeout=TIMEOUT,
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
