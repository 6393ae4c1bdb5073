"""A folder is a library is a layer: what may include and call what, derived from the targets.

    test_layers.py BUILD_FOLDER

BUILD_FOLDER/layers.txt is written by CMake (scripts/cmake/library.cmake), one line for each folder,
bottom up: `folder: targets that it uses`.
"""
import collections
import pathlib
import re
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = None
PRODUCT = ("solver", "collision", "coupling", "benchmarks", "app")
MAX_FILES = 25
# Programs: folders without a library, and what they may include besides their own files.
PROGRAMS = {"app/command/main": "app/command", "benchmarks": "solver/stepping",
            "benchmarks/peers": "benchmarks/drivers"}

# Outside libraries: how their headers are spelled, and the target that a folder links to see them.
OUTSIDE = {
    r"fcl/|ccd/": "fcl", r"assimp/": "assimp::assimp", r"libqhull": "Qhull::qhull_r",
    r"tinyxml2": "tinyxml2::tinyxml2", r"toml\+\+/": "tomlplusplus::tomlplusplus",
    r"nlohmann/": "nlohmann_json::nlohmann_json", r"CLI/": "CLI11::CLI11", r"fmt/": "fmt::fmt",
    r"boost/": "Boost::headers", r"nlopt": "NLopt::nlopt_cxx", r"png\.h": "PNG::PNG",
    r"ft2build|freetype/": "Freetype::Freetype", r"zlib\.h": "ZLIB::ZLIB",
    r"zstd\.h": "zstd::libzstd_shared",
}
# Headers that show an outside library. Each is of use inside its own folder only.
INNER_HEADERS = {"app/lab/server/connection.h", "app/render/gl/gl_objects.h", "benchmarks/drivers/command_line.h"}
SHOWN_HEADERS = {"app/command/parser/shared_options.h"}  # commands, which all link CLI11, add options with it

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)


def name_of(folder):
    return "twinarm_" + folder.replace("/", "_")


class Layers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.order, cls.uses = [], {}
        for line in (BUILD / "layers.txt").read_text(encoding="utf-8").splitlines():
            folder, _, used = line.partition(":")
            cls.order.append(folder)
            cls.uses[folder] = used.replace(";", " ").split()
        cls.folder_of = {name_of(folder): folder for folder in cls.order}
        cls.below = {}
        for folder in cls.order:
            cls.below[folder] = {folder}
            for target in cls.uses[folder]:
                cls.below[folder] |= cls.below.get(cls.folder_of.get(target), set())
        cls.files = {}
        for part in PRODUCT:
            for path in sorted((ROOT / part).rglob("*")):
                if path.suffix in (".h", ".cpp", ".inl") and "node_modules" not in path.parts:
                    text = path.read_text(encoding="utf-8")
                    cls.files[str(path.relative_to(ROOT))] = INCLUDE.findall(text)

    def folder(self, path):
        return path.rpartition("/")[0]

    def test_every_folder_with_source_is_a_library(self):
        folders = {path.rpartition("/")[0] for path in self.files}
        self.assertEqual(sorted(folders - set(self.order) - set(PROGRAMS)), [])

    def test_layers_use_only_layers_below_them(self):
        for at, folder in enumerate(self.order):
            above = [self.folder_of[target] for target in self.uses[folder]
                     if target in self.folder_of
                     and self.order.index(self.folder_of[target]) >= at]
            self.assertEqual(above, [], f"{folder} uses layers that are listed after it")

    def test_includes_follow_the_layers(self):
        wrong = []
        for path, includes in self.files.items():
            for bracket, name in includes:
                folder = path.rpartition("/")[0]
                below = self.below[PROGRAMS.get(folder, folder)] | {folder}
                if bracket == '"' and self.folder(name) not in below:
                    wrong.append(f'{path} includes "{name}"')
        self.assertEqual(wrong, [])

    def test_tests_include_nothing_above_the_folder_that_they_mirror(self):
        wrong = []
        for path in sorted((ROOT / "tests").rglob("*.*")):
            folder = path.parent.relative_to(ROOT / "tests").as_posix()
            if path.suffix not in (".h", ".cpp") or folder not in self.order:
                continue
            for bracket, name in INCLUDE.findall(path.read_text(encoding="utf-8")):
                used = self.folder(name).removeprefix("tests/")
                if bracket == '"' and used in self.order and self.order.index(used) > self.order.index(folder):
                    wrong.append(f'{path.relative_to(ROOT)} includes "{name}"')
        self.assertEqual(wrong, [])

    def test_every_folder_of_tests_mirrors_one_of_the_product(self):
        own = ("tests", "fuzz", "package", "soak", "support")  # of no single library
        folders = {path.parent.relative_to(ROOT / "tests").as_posix() for path in (ROOT / "tests").rglob("*.cpp")}
        self.assertEqual(sorted(f for f in folders if f not in self.order and f.split("/")[0] not in own + (".",)), [])

    def test_every_quoted_include_is_a_file_named_from_the_root(self):
        wrong = [f'{path} includes "{name}"' for path, includes in self.files.items()
                 for bracket, name in includes if bracket == '"' and name not in self.files]
        self.assertEqual(wrong, [])

    def test_a_folder_links_the_outside_libraries_that_it_includes(self):
        wrong = []
        for path, includes in self.files.items():
            for bracket, name in includes:
                for spelling, target in OUTSIDE.items():
                    if bracket != "<" or not re.match(spelling, name):
                        continue
                    if target not in self.uses.get(self.folder(path), [target]):
                        wrong.append(f"{path} includes <{name}> without {target}")
                    if path.endswith(".h") and path not in INNER_HEADERS | SHOWN_HEADERS and target != "fmt::fmt":
                        wrong.append(f"{path} shows <{name}> to others")
        self.assertEqual(wrong, [])

    def test_an_inner_header_is_included_from_its_own_folder_only(self):
        self.assertEqual(sorted(INNER_HEADERS - set(self.files)), [])
        wrong = [f'{path} includes "{name}"' for path, includes in self.files.items()
                 for _, name in includes
                 if name in INNER_HEADERS and self.folder(path) != self.folder(name)]
        self.assertEqual(wrong, [])

    def test_the_solver_uses_only_eigen_and_the_standard_library(self):
        outside = {name for path, includes in self.files.items() if path.startswith("solver/")
                   for bracket, name in includes if bracket == "<"}
        self.assertEqual(sorted(n for n in outside if "/" in n and not n.startswith("Eigen/")), [])

    def test_no_library_calls_a_layer_that_it_does_not_use(self):
        """What no include shows: functions that are declared in one layer and defined above it."""
        needs, defined = collections.defaultdict(set), {}
        for folder in self.order:
            archive = BUILD / folder / f"lib{name_of(folder)}.a"
            if not archive.is_file():
                continue
            lines = subprocess.run(["nm", str(archive)], check=True, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout
            for line in lines.splitlines():
                fields = line.split()
                if len(fields) < 2 or "twinarm" not in fields[-1]:
                    continue
                if fields[-2] == "U":
                    needs[folder].add(fields[-1])
                elif fields[-2] in "TDBR":
                    defined[fields[-1]] = folder
        self.assertGreater(len(defined), 1000)
        wrong = {f"{folder} calls {defined[symbol]}: {symbol}"
                 for folder, symbols in needs.items() for symbol in symbols
                 if symbol in defined and defined[symbol] not in self.below[folder]}
        self.assertEqual(sorted(wrong), [])

    def test_every_folder_has_a_readme_that_names_files_of_it(self):
        missing = []
        for folder in self.order:
            readme = ROOT / folder / "README.md"
            if not readme.is_file():
                missing.append(f"{folder} has no README.md")
                continue
            for name in re.findall(r"`([a-z0-9_/]+\.(?:h|cpp|inl))`", readme.read_text(encoding="utf-8")):
                if not (ROOT / name).is_file() and not list((ROOT / folder).rglob(name)):
                    missing.append(f"{folder}/README.md names {name}")
        self.assertEqual(missing, [])

    def test_folders_are_small(self):
        count = collections.Counter(path.rpartition("/")[0] for path in self.files)
        self.assertEqual({f: n for f, n in count.items() if n > MAX_FILES}, {})


if __name__ == "__main__":
    BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
