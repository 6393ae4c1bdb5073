"""What can be taken in at once: files below 300 lines, functions below 60, folders of about 25 sources."""
import collections
import pathlib
import re
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PRODUCT = ["solver", "collision", "coupling", "app", "benchmarks"]
LONGER = {"aba": 80,  # three passes over the same bodies, reported in one piece
          "coupling_keys": 70}  # a table
# As clang-format has it: the head of a function ends its line with "{", its body with "}" below the first letter.
HEAD = re.compile(r"^( *)(?!(?:namespace|struct|class|enum|union|extern|using|return|if|for|while|switch|else|do|try)"
                  r"\b)[\w~<].*\)[^={};]*\{$")
NAME = re.compile(r"([\w~]+|operator\S+)\(")


def sources(*suffixes):
    listed = subprocess.run(["git", "ls-files", *PRODUCT], cwd=ROOT, check=True, capture_output=True, text=True)
    return [ROOT / name for name in listed.stdout.split() if name.endswith(suffixes) and (ROOT / name).is_file()]


def functions(text):
    """(name, lines) of what is defined; a head of several lines is counted from its last one."""
    lines = text.splitlines()
    for first, line in enumerate(lines):
        head = HEAD.match(line)
        if not head:
            continue
        depth = len(head.group(1))  # at most: the list of a constructor's members stands deeper than its body's end
        end = next((n for n in range(first, len(lines)) if re.match(rf" {{0,{depth}}}\}}", lines[n])), first)
        name = NAME.search(line)
        yield (name.group(1) if name else line.strip()), end - first + 1


class Sizes(unittest.TestCase):
    def test_a_file_has_at_most_300_lines(self):
        for path in sources(".h", ".cpp", ".inl", ".ts", ".css"):
            with self.subTest(str(path.relative_to(ROOT))):
                self.assertLessEqual(len(path.read_text(encoding="utf-8").splitlines()), 300)

    def test_a_function_has_at_most_60_lines(self):
        for path in sources(".h", ".cpp", ".inl"):
            for name, lines in functions(path.read_text(encoding="utf-8")):
                with self.subTest(str(path.relative_to(ROOT)), function=name):
                    self.assertLessEqual(lines, LONGER.get(name, 60))

    def test_a_folder_has_about_25_sources(self):
        count = collections.Counter(path.parent for path in sources(".h", ".cpp", ".ts"))
        for folder, number in count.items():
            with self.subTest(str(folder.relative_to(ROOT))):
                self.assertLessEqual(number, 25)


if __name__ == "__main__":
    unittest.main()
