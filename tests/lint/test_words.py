"""The field's language: words of docs/reference/glossary.md ("Words that are not used") do not come back.

What users read is held against the list: sentences in string literals of C++ and TypeScript, the documentation,
scenes, the gallery. A literal without a space is a key or a name and is not judged here.
"""
import pathlib
import re
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
WORDS = re.compile(
    r"\b(?:told|felt|rubs?|rubbing|blows?|struck|whoever|nobody|anew|mend(?:s|ed)?|witness|knobs?|glass|twins?"
    r"|ghosts?|ledgers?|forks?|second ways?|hangs? on|lets? go|in vain|astray|gives? way|by right"
    r"|upon each other|follows nobody)\b", re.IGNORECASE)
LITERAL = re.compile(r'R"(\w*)\((.*?)\)\1"|"((?:\\.|[^"\\\n])*)"|//[^\n]*|/\*.*?\*/', re.DOTALL)
SCRIPT_LITERAL = re.compile(
    r"'((?:\\.|[^'\\\n])*)'|\"((?:\\.|[^\"\\\n])*)\"|`((?:\\.|[^`\\])*)`|//[^\n]*|/\*.*?\*/", re.DOTALL)
# Where a word stands for what it says: the list itself, and a body of glass.
EXCEPT = {"docs/reference/glossary.md"}


def files(*patterns):
    listed = subprocess.run(["git", "ls-files", *patterns], cwd=ROOT, check=True, capture_output=True, text=True)
    return [name for name in listed.stdout.split() if name not in EXCEPT and (ROOT / name).is_file()]


def sentences(text, literal):
    for match in literal.finditer(text):
        part = next((group for group in match.groups()[-3:] if group is not None), "")
        if " " in part:
            yield text.count("\n", 0, match.start()) + 1, part


class Words(unittest.TestCase):
    def check(self, name, found):
        for line, text in found:
            for match in WORDS.finditer(text):
                with self.subTest(f"{name}:{line}", word=match.group(0)):
                    self.fail(text.strip()[:100])

    def test_sentences_of_the_program(self):
        for name in files("solver/*", "collision/*", "coupling/*", "benchmarks/*", "app/*"):
            if name.endswith((".h", ".cpp", ".inl")):
                self.check(name, sentences((ROOT / name).read_text(encoding="utf-8"), LITERAL))

    def test_sentences_of_the_pages(self):
        for name in files("app/web/src/*.ts"):
            self.check(name, sentences((ROOT / name).read_text(encoding="utf-8"), SCRIPT_LITERAL))

    def test_documentation_and_scenes(self):
        for name in files("README.md", "CONTRIBUTING.md", "docs/*.md", "assets/scenes/*.toml", "assets/scenes/*.md"):
            text = (ROOT / name).read_text(encoding="utf-8")
            # Code blocks hold commands and keys.
            text = re.sub(r"^<!--.*?^-->|^(```|~~~).*?^\1", lambda block: "\n" * block.group(0).count("\n"), text,
                          flags=re.DOTALL | re.MULTILINE)
            lines = text.splitlines()
            self.check(name, ((n + 1, re.sub(r"`[^`]*`|\]\([^)]*\)", "", line)) for n, line in enumerate(lines)))


if __name__ == "__main__":
    unittest.main()
