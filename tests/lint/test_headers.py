"""Every header of the three rooms says at its head what it is for; the filter of the header pages keeps the code."""
import importlib.util
import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
HEADERS = sorted(file for room in ("solver", "collision", "coupling") for file in (ROOT / room).rglob("*.h"))
sys.dont_write_bytecode = True
spec = importlib.util.spec_from_file_location("doxygen_filter", ROOT / "docs/site/doxygen_filter.py")
doxygen_filter = importlib.util.module_from_spec(spec)
spec.loader.exec_module(doxygen_filter)


def code_of(text):
    """Without comments and white space; texts in quotes stay."""
    token = re.compile(r'"(?:\\.|[^"\\])*"|//[^\n]*|/\*.*?\*/|\s+', re.S)
    return token.sub(lambda found: found[0] if found[0].startswith('"') else "", text)


class Headers(unittest.TestCase):
    def test_each_begins_with_what_it_is_for(self):
        self.assertGreater(len(HEADERS), 100)
        for header in HEADERS:
            head = re.match(r"(?:// ?.*\n)+", header.read_text())
            words = re.findall(r"\w+", head[0]) if head else []
            self.assertGreater(len(words), 3, f"{header.relative_to(ROOT)}: no comment at its head")


class Filter(unittest.TestCase):
    def filtered(self, text):
        return doxygen_filter.filtered(text)

    def test_the_code_of_each_header_stays(self):
        for header in HEADERS:
            text = header.read_text()
            self.assertEqual(code_of(self.filtered(text)), code_of(text), header)

    def test_the_head_is_of_the_file(self):
        self.assertEqual(self.filtered("// What it is.\n#pragma once\n"),
                         "/// \\file\n/// What it is.\n#pragma once\n")

    def test_a_comment_belongs_to_what_it_stands_above_or_behind(self):
        text = "// Head.\n\n  // Above.\n  int a;  // behind,\n          // and on\n  int b;\n"
        self.assertEqual(self.filtered(text).split("\n\n")[1],
                         "  /// Above.\n  int a;  ///< behind,\n          ///< and on\n  int b;\n")

    def test_a_comment_that_stands_alone_or_behind_an_end_is_nobodys(self):
        text = "// Head.\n\n// Alone.\n\nint a;\n}  // namespace twinarm\n"
        self.assertEqual(self.filtered(text).split("\n", 2)[2], text.split("\n", 1)[1])

    def test_signs_stand_for_themselves(self):
        self.assertIn("///< 0 &lt; a &amp; \\@b", self.filtered("int a;  // 0 < a & @b"))

    def test_slashes_in_a_text_are_no_comment(self):
        self.assertEqual(self.filtered('f("a//b");'), 'f("a//b");')


if __name__ == "__main__":
    unittest.main()
