"""docs/reference/scene_file.md names each key that a scene may have, and no other; exit_codes_and_errors.md each exit
code; assets/study/settings.toml, which docs/reference/study_files.md shows, has each of the study's settings.

The program is asked: a scene whose tables have every word that may be a key is reported which of them are none.
"""
import pathlib
import re
import tempfile
import tomllib
import unittest

from program import ROOT, ProgramTest, main, run

PAGE = (ROOT / "docs/reference/scene_file.md").read_text()
WORD = re.compile(r"[a-z][a-z_0-9]*")
CELLS = re.compile(r"(?<!\\)\|")
ROBOT = '[[robot]]\nname = "arm"\nmodel = "robots/s103/s103.urdf"\n'
ARM = '[[coupling]]\nlink = "arm1"\nstiffness = 1\n'
SHAPES = ("halfspace", "box", "sphere", "capsule", "cylinder",
          "ellipsoid", "spherical_cavity", "cylindrical_cavity", "mesh")


def spans(text):
    return re.findall(r"`([^`]+)`", text)


def section(heading):
    return re.search(rf"^## {re.escape(heading)}\n(.*?)(?=^## |\Z)", PAGE, re.M | re.S)[1]


def rows(heading):
    """Of each table of a section: its header's cells and a row's."""
    found, header = [], None
    for line in section(heading).splitlines():
        cells = [cell.strip() for cell in CELLS.split(line)[1:-1]] if line.startswith("|") else None
        if not cells:
            header = None
        elif header is None:
            header = cells
        elif not cells[0].startswith("---"):
            found.append((header, cells))
    return found


def named(heading):
    """The keys of a table, as its section lists them in columns that are headed so."""
    return {word for header, cells in rows(heading) for title, cell in zip(header, cells)
            if title in ("key", "keys", "keys of its own") and header[0] != "shape"
            for word in spans(cell) if WORD.fullmatch(word)}


def named_within(heading, key):
    """The keys of an inline table, as the examples in its row give them."""
    text = " ".join(" ".join(cells) for header, cells in rows(heading) if key in spans(cells[0]))
    return {word for span in spans(text) if "{" in span for word in re.findall(r"(\w+) = ", span)} - {key}


def words_of_sources():
    """What may be a key: each such word in quotes in the sources of the reader and of shapes, and in the page."""
    text = " ".join(file.read_text() for folder in ("app/scene", "collision/shapes")
                    for file in sorted((ROOT / folder).rglob("*.[ch]*")))
    quoted = set(re.findall(r'"([a-z][a-z_0-9]*)"', text))
    in_page = {word for span in spans(PAGE) for word in WORD.findall(span)}
    return sorted(quoted | in_page)


def known(before, skip=(), inside=None):
    """Those of all words that the program takes as keys of the table that ends `before`."""
    taken = set()
    words = [word for word in words_of_sources() if word not in skip]
    # So few at once that all faults are reported: the program stops at 200.
    for first in range(0, len(words), 80):
        some = words[first:first + 80]
        body = inside % ", ".join(f"{word} = []" for word in some) if inside else "\n".join(f"{w} = []" for w in some)
        with tempfile.TemporaryDirectory() as place:
            file = pathlib.Path(place) / "scene.toml"
            file.write_text(f"{before}\n{body}\n")
            ran = run("simulate", file, "--duration", 0.001)
        if ran.returncode != 2:
            raise AssertionError(f"the scene was not refused: {ran.stderr[:500]}")
        refused = set(re.findall(r", (\w+): (?:unknown key|there is no such)", ran.stderr))
        taken |= set(some) - refused
    return taken | set(skip)


class Keys(unittest.TestCase):
    maxDiff = None

    def check(self, heading, found, said=None):
        said = named(heading) if said is None else said
        self.assertEqual(sorted(found - said), [], f"docs/reference/scene_file.md, {heading}: not said, though there")
        self.assertEqual(sorted(said - found), [],
                         f"docs/reference/scene_file.md, {heading}: said, though there is none")

    def test_the_top(self):
        lists = {"robot", "body", "pair", "coupling", "constraint", "spring"}
        self.check("The top", known("") - lists)
        for name in lists:
            self.assertIn(f"## `[[{name}]]`", PAGE)

    def test_each_list_of_tables(self):
        for name, before, skip in (("robot", ROBOT, ("name", "model")), ("body", "[[body]]", ()),
                                   ("pair", "[[pair]]", ()), ("coupling", ROBOT + "[[coupling]]", ()),
                                   ("constraint", "[[constraint]]", ()), ("spring", "[[spring]]", ())):
            with self.subTest(name):
                self.check(f"`[[{name}]]`", known(before, skip=skip))

    def test_the_tables_of_numbers_are_those_that_the_program_prints(self):
        printed = run("help", "--scene-keys").stdout
        for table in printed.strip().split("\n\n"):
            self.assertIn(f"\n{table}\n\n", PAGE,
                          "docs/reference/scene_file.md: take the table from twinarm help --scene-keys")

    def test_tables_within_tables(self):
        for heading, key, before, inside, extra in (
                ("`[[robot]]`", "payload", ROBOT, "payload = [{ %s }]", ()),
                ("`[[body]]`", "motion", "[[body]]", "motion = { %s }", ()),
                ("`[[coupling]]`", "gripper", ROBOT + ARM + 'target = "paper"', "gripper = { %s }", ())):
            with self.subTest(key):
                self.check(heading, known(before, inside=inside), named_within(heading, key))

    def test_each_shape(self):
        reported = {shape: set(spans(cells[1])) for header, cells in rows("`[[body]]`") if header[0] == "shape"
                    for shape in spans(cells[0])}
        self.assertEqual(sorted(reported), sorted(SHAPES))
        for shape, keys in reported.items():
            with self.subTest(shape):
                self.check(f"shape {shape}", known("[[body]]", inside=f"shape = {{ {shape} = {{ %s }} }}"), keys)


class Settings(ProgramTest):
    """The study needs all of its settings: of a file that has none it misses each."""

    def missed(self):
        assets = self.folder / "assets"
        (assets / "study").mkdir(parents=True)
        (assets / "robots").symlink_to(ROOT / "assets/robots")
        (assets / "study/settings.toml").write_text("[[robot.mount]]\n" * 2)
        places = {fault["where"] for fault in self.faults("study", "--assets", assets, "--out", self.folder / "out")
                  if fault["file"].endswith("settings.toml")}
        return {place.replace("mount, ", "mount[], ").replace(", ", ".") for place in places
                if not place.startswith("settings, ")}  # the tables themselves

    def test_each_setting_is_in_the_file_that_the_page_shows_and_no_other(self):
        self.assertIn("{literalinclude} ../../assets/study/settings.toml",
                      (ROOT / "docs/reference/study_files.md").read_text())
        shipped = set()
        for table, entries in tomllib.loads((ROOT / "assets/study/settings.toml").read_text()).items():
            for key, value in entries.items():
                tables = isinstance(value, list) and isinstance(value[0], dict)
                shipped |= {f"{table}.{key}[].{inner}" for inner in value[0]} if tables else {f"{table}.{key}"}
        self.assertEqual(shipped, self.missed())


class ExitCodes(unittest.TestCase):
    def test_each_code_of_the_sources_is_in_the_table_and_no_other(self):
        table = re.search(r"^## Exit codes\n(.*?)(?=^## )",
                          (ROOT / "docs/reference/exit_codes_and_errors.md").read_text(), re.M | re.S)[1]
        said = {int(code) for code in re.findall(r"^\| (\d+) \|", table, re.M)}
        there = {0, 1}  # of commands whose result can fall short: no name of their own
        for file in (ROOT / "app").rglob("*.cpp"):
            text = file.read_text()
            for codes in re.findall(r"enum ExitCode \{([^}]*)\}", text):
                there |= {int(code) for code in re.findall(r"= (\d+)", codes)}
            there |= {int(code) for code in re.findall(r"constexpr int kStopped = (\d+);", text)}
        self.assertEqual(said, there)


if __name__ == "__main__":
    main()
