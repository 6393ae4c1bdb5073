#!/usr/bin/env python3
"""The arrows between the rooms: who may include whom, and where the outside world begins.

    test_includes.py [PROJECT_FOLDER]
"""
import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]

# Room by room, whom it may include (docs/design.md). Nobody includes app/ but app/ itself.
ARROWS = {
    "solver": {"solver"},
    "collision": {"collision", "solver"},
    "coupling": {"coupling", "solver"},
    "benchmarks": {"benchmarks", "solver", "collision", "coupling"},
    "app": {"app", "benchmarks", "solver", "collision", "coupling"},
    "tests": {"tests", "benchmarks", "solver", "collision", "coupling"},
}

# Outside libraries: how their headers are spelled, and the only .cpp files, or those of a folder,
# that may see them, directly or through a header of ours.
LIBRARIES = {
    "fcl": (r"fcl/|ccd/", {"collision/broad_phase.cpp", "tests/collision/fcl_oracle.cpp"}),
    "assimp": (r"assimp/", {"collision/model_file.cpp"}),
    "qhull": (r"libqhull", {"collision/convex_hull.cpp"}),
    "tinyxml2": (r"tinyxml2", {"collision/import/urdf.cpp", "collision/import/urdf_joint.cpp",
                               "collision/import/urdf_shapes.cpp",
                               "collision/import/urdf_vocabulary.cpp",
                               "collision/import/urdf_xml.cpp"}),
    "toml++": (r"toml\+\+/", {"collision/import/recipe_file.cpp", "collision/import/recipe_toml.cpp",
                              "app/scene/toml_tree.cpp", "app/study/predictions.cpp",
                              "app/study/settings.cpp"}),
    "nlohmann": (r"nlohmann/", {"app/compare/compare_output.cpp",
                                "app/dynamics/json_tree.cpp", "app/json_writer.cpp",
                                "app/program.cpp", "app/study/calibration.cpp",
                                "app/study/identification_file.cpp",
                                "app/study/output_json.cpp"}),
    "CLI11": (r"CLI/", {"app/program.cpp", "app/options/"}),
    "Google Benchmark": (r"benchmark/", {"benchmarks/speed/timing.cpp"}),
    "MuJoCo": (r"mujoco/", {"benchmarks/peers/bench_coupling_mujoco.cpp",
                          "benchmarks/peers/peer_mujoco.cpp",
                          "benchmarks/speed/contact_mujoco.cpp",
                          "benchmarks/speed/engine_mujoco.cpp",
                          "benchmarks/speed/mujoco_model.h"}),
    "Bullet": (r"BulletDynamics/|BulletCollision/|LinearMath/|btBullet",
               {"benchmarks/peers/peer_bullet.cpp", "benchmarks/speed/contact_bullet.cpp",
                "benchmarks/speed/engine_bullet.cpp"}),
    "DART": (r"dart/", {"benchmarks/peers/peer_dart.cpp", "benchmarks/speed/engine_dart.cpp"}),
    "Simbody": (r"SimTK", {"benchmarks/peers/peer_simbody.cpp",
                           "benchmarks/speed/engine_simbody.cpp"}),
    "ODE": (r"ode/", {"benchmarks/peers/peer_ode.cpp"}),
    "Boost": (r"boost/", {"app/lab/server/connection_http.inl", "app/lab/server/connection_live.inl",
                          "app/lab/server/lab_server.cpp",
                          "benchmarks/analytic/special_functions.cpp"}),
    "NLopt": (r"nlopt", {"app/study/minimise.cpp"}),
    "OpenGL": (r"GL/", {"app/render/draw_mesh.cpp", "app/render/gl_context.cpp",
                        "app/render/gl_objects.cpp", "app/render/overlay.cpp",
                        "app/render/painter.cpp", "app/render/scene_floor.cpp",
                        "app/render/scene_pass.cpp", "app/render/shaders.cpp"}),
    "FreeType": (r"ft2build|freetype/", {"app/render/lettering.cpp"}),
    "zlib": (r"zlib\.h", {"app/lab/server/http_text.cpp", "app/record/recording.cpp",
                          "app/web/page_bytes.cpp", "tests/lab/test_lab_requests.cpp"}),
    "turbojpeg": (r"turbojpeg\.h", {"app/render/image_decode.cpp",
                                    "tests/render/test_visual_model.cpp"}),
    "pybind11": (r"pybind11/", {"app/python/"}),
    "PNG": (r"png\.h", {"app/render/image.cpp", "app/render/image_decode.cpp"}),
}
# Parts of the program that are libraries of their own, so that tests can look at them.
TESTS_OF_LIBRARY = {"tests/scene/": "app/scene/", "tests/hand/": "app/hand/",
                    "tests/lab/": "app/", "tests/live/": "app/live/", "tests/inspect/": "app/inspect/",
                    "tests/live/": ("app/live/", "app/hand/", "app/scene/"), "tests/inspect/": "app/inspect/",
                    "tests/render/": "app/render/", "tests/show/": ("app/show/", "app/render/"),
                    "tests/fuzz/": "app/"}

# The rooms of the lab (app/lab/README.md), and what of the program each may include besides itself.
LAB = {
    "app/lab/run/": {"coupling", "hand", "interrupt.h", "live", "nearest_name.h", "output_file.h", "record",
                     "scene", "show", "simulate"},
    "app/lab/knobs/": {"coupling", "find_assets.h", "json_writer.h", "lab/run", "nearest_name.h", "record",
                       "scene", "simulate"},
    "app/lab/stream/": {"dynamics", "json_writer.h", "lab/run", "record", "render", "scene", "show",
                        "simulate", "web"},
    "app/lab/glass/": {"dynamics", "inspect", "json_writer.h", "lab/run", "record", "scene", "simulate"},
    "app/lab/server/": set(),
}

# Headers that show an outside library. Each is of use inside its own folder only.
INNER_HEADERS = {"app/python/arrays.h", "app/python/bind.h", "app/python/fast_arguments.h",
                 "app/python/scene_change.h",
                 "app/lab/server/connection.h", "collision/import/recipe_toml.h", "app/render/gl_table.h",
                 "app/study/whole_number.h",
                 "app/render/gl_objects.h", "app/render/scene_pass.h"}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)


def sources(root):
    """Of every room: {path: [(bracket, included)]}."""
    found = {}
    for room in ARROWS:
        for path in sorted((root / room).rglob("*")):
            if path.suffix in (".h", ".cpp", ".inl"):
                text = path.read_text(encoding="utf-8")
                found[str(path.relative_to(root))] = INCLUDE.findall(text)
    return found


class Includes(unittest.TestCase):
    def setUp(self):
        self.files = sources(ROOT)
        self.assertGreater(len(self.files), 100)

    def test_every_room_includes_only_whom_its_arrows_allow(self):
        wrong = []
        for path, includes in self.files.items():
            room = path.split("/")[0]
            for bracket, name in includes:
                other = name.split("/")[0]
                if any(path.startswith(tests) and name.startswith(library)
                       for tests, library in TESTS_OF_LIBRARY.items()):
                    continue
                if bracket == '"' and other not in ARROWS[room]:
                    wrong.append(f'{path} includes "{name}"')
        self.assertEqual(wrong, [])

    def test_a_room_of_the_lab_includes_only_what_it_knows(self):
        wrong = []
        for path, includes in self.files.items():
            for room, known in LAB.items():
                for bracket, name in includes if path.startswith(room) else []:
                    if bracket == "<" or not name.startswith("app/") or name.startswith(room):
                        continue
                    if not any(name == "app/" + other or name.startswith("app/" + other + "/")
                               for other in known):
                        wrong.append(f'{path} includes "{name}"')
        self.assertEqual(wrong, [])

    def test_every_quoted_include_is_a_file_named_from_the_root(self):
        wrong = [f'{path} includes "{name}"' for path, includes in self.files.items()
                 for bracket, name in includes if bracket == '"' and name not in self.files]
        self.assertEqual(wrong, [])

    def test_an_inner_header_is_included_from_its_own_folder_only(self):
        wrong = [f'{path} includes "{name}"' for path, includes in self.files.items()
                 for _, name in includes
                 if name in INNER_HEADERS and path.rpartition("/")[0] != name.rpartition("/")[0]]
        self.assertEqual(wrong, [])

    def seen(self, path, memo):
        """All outside headers that a file sees, directly or through headers of ours."""
        if path not in memo:
            memo[path] = set()
            for bracket, name in self.files.get(path, []):
                memo[path] |= {name} if bracket == "<" else self.seen(name, memo)
        return memo[path]

    def test_each_outside_library_is_seen_by_the_cpp_files_that_are_named_here_and_no_header(self):
        memo, wrong = {}, []
        for path in self.files:
            for library, (spelling, allowed) in LIBRARIES.items():
                sees = any(re.match(spelling, name) for name in self.seen(path, memo))
                may = path in INNER_HEADERS or any(
                    path == name or name.endswith("/") and path.startswith(name)
                    and path.endswith(".cpp") for name in allowed)
                if sees and not may:
                    wrong.append(f"{path} sees {library}")
        self.assertEqual(wrong, [])

    def test_no_file_of_the_lists_above_is_gone(self):
        named = INNER_HEADERS.union(*(files for _, files in LIBRARIES.values()))
        folders = {path.rpartition("/")[0] + "/" for path in self.files}
        self.assertEqual(sorted(named - set(self.files) - folders), [])

    def test_the_solver_knows_nothing_but_eigen_and_the_standard_library(self):
        outside = {name for path, includes in self.files.items() if path.startswith("solver/")
                   for bracket, name in includes if bracket == "<"}
        self.assertEqual(sorted(n for n in outside if "/" in n and not n.startswith("Eigen/")), [])

    def test_every_room_with_source_has_a_readme(self):
        rooms = {path.split("/")[0] for path in self.files} - {"tests"}
        missing = [room for room in sorted(rooms) if not (ROOT / room / "README.md").is_file()]
        self.assertEqual(missing, [])


if __name__ == "__main__":
    if len(sys.argv) > 1 and not sys.argv[1].startswith("-"):
        ROOT = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
