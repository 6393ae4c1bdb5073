"""No logic of the program depends on text that is written for people.

    test_text_comparisons.py

Looked for are comparisons of a C++ or TypeScript expression with a literal, where the literal has a
blank in it, or where the expression is a field that holds text for people. What reads the input of
users or the formats of files is allowed below, with its reason.
"""
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]

# Fields that people read, of C++ and of the pages, where a name or a source is a code of a message.
FIELDS = {".ts": "force_feedback|label|rule|remedy|text|title|words",
          ".cpp": "description|force_feedback|label|legend|name|remedy|row|rule|scheme|source|title|where|words"}
CALLS = r"\??\.(?:starts_with|ends_with|r?find|contains|compare|startsWith|endsWith|includes|indexOf)\(\s*"
COMPARED = re.compile(
    r"\b(?P<left>\w+)(?:\.trim\(\)|\[\w*\]|\(\))?\s*(?:[=!]==?\s*|" + CALLS +
    r""")(?P<literal>"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.){2,}')""")

# Folder or file: what its literals are.
ALLOWED = {
    # What users and other programs write.
    "app/data/json_value.cpp": "messages of the JSON parser, of which the place is cut off",
    "app/device/vrpn_stream.cpp": "VRPN's own sender",
    "app/command/lab.cpp": "values of the lab's messages",
    "app/lab/app/lab_routes.cpp": "names of files that pages send",
    "app/command/map.cpp": "keys of tile files",
    "app/command/": "types and names of options, by CLI11",
    "app/record/branch_view.cpp": "names of columns of recordings",
    "app/scene/": "keys, names and values of scenes",
    "app/command/trial.cpp": "values of --conditions and --mapping",
    "collision/import/": "elements and attributes of XML files",
    "solver/expressions/expression_parser.cpp": "functions of formulas",
    "solver/support/diagnostics.cpp": "options as they are typed",
    # Symbols of equations, whose sign stands in front.
    "app/inspect/equations.cpp": "the sign of a term",
    "app/inspect/inspection.cpp": "the two halves of a unit in the table of quantities",
    "app/web/src/inspector/": "the sign of a term, and which equation it is",
    "app/web/src/inspector/math.ts": "the sign of equality",
    "app/inspect/report/pass_pages.cpp": "symbols of quantities, and the sign of a term",
    "app/web/src/ui/dom.ts": "typeof",
    # Text that this program takes apart to draw it.
    "app/compare/": "the names of cases and SVG",
    "app/study/": "names of the paper's rows and of laws in the files of the study, and SVG",
}


def sources():
    for folder in ("app", "coupling", "solver", "collision"):
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix in (".cpp", ".h", ".inl", ".ts") and "node_modules" not in path.parts:
                yield path


def without_comments(text):
    return re.sub(r"//[^\n]*", "", text)


def comparisons(text, suffix):
    """Expression and literal of each comparison with text for people."""
    field = re.compile(rf"(?:\w*_)?(?:{FIELDS['.ts' if suffix == '.ts' else '.cpp']})_?")
    for match in COMPARED.finditer(text):
        if field.fullmatch(match["left"]) or " " in match["literal"]:
            yield match["left"], match["literal"]


class TextComparisons(unittest.TestCase):
    maxDiff = None

    def test_no_logic_compares_text_for_people(self):
        wrong, used = [], set()
        for path in sources():
            name = str(path.relative_to(ROOT))
            for left, literal in comparisons(without_comments(path.read_text(encoding="utf-8")), path.suffix):
                allowed = {start for start in ALLOWED if name.startswith(start)}
                used |= allowed
                if not allowed:
                    wrong.append(f"{name}: {left} with {literal}")
        self.assertEqual(wrong, [], "compare an enum, an index or a code instead")
        self.assertEqual(set(ALLOWED) - used, set(), "these need no allowance any more")

    def test_what_is_looked_for_is_found(self):
        for text, suffix in (
                ('if (row.name == "numerical")', ".cpp"), ('s.name.rfind("damper of joint", 0)', ".cpp"),
                ('where != "restart"', ".h"), ('fault.where.find("\'" + prefix)', ".cpp"),
                ('option == "as the scene says"', ".cpp"), ('row.name.ends_with("/implicit")', ".inl"),
                ('s.name == "coupling \'" + name', ".cpp"), ("force_feedback.includes('synthetic')", ".ts"),
                ("words.trim() === 'opened'", ".ts")):
            self.assertTrue(list(comparisons(text, suffix)), text)
        for text, suffix in (('file.extension() == ".toml"', ".cpp"), ("c == ' '", ".cpp"),
                             ('row.kind == EnergyBalanceKind::numerical', ".cpp"),
                             ('table.find("target")', ".cpp"), ("state === 'opened'", ".ts")):
            self.assertFalse(list(comparisons(text, suffix)), text)


if __name__ == "__main__":
    unittest.main()
