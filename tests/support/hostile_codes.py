"""Codes of diagnostics: those in the sources, those that were seen, and those that no file or option can cause.
scripts/check/hostile."""
import pathlib
import re
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
CODE = re.compile(r'"([a-z]+\.[a-z]+(?:-[a-z]+)*)"')
NO_CODE = "vert frag html toml csv json svg twinrec png".split()  # names of files
LITERAL = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
MORE_TEXTS = {  # of codes whose text is elsewhere, and which are seen only as text
    "picture.read": "is neither a PNG nor a JPEG",
    "mesh.mass": "the surface is not closed", "recipe.value": r"color: lies outside \[0, 1\]",
    "recipe.robot": "material 'x' does not exist", "change.number": "--set [^ ]*: not a number",
    "lab.missing": "^command: do: is missing", "lab.type": "^command: .* is .*; give ",
    "lab.unknown-command": "^command: do: there is no '"}


def of_all(codes, reason):
    return dict.fromkeys(codes.split(), reason)


UNREACHABLE = {
    **of_all("arm.damping arm.mass arm.stiffness robot.mount", "name of a number or table, not a code"),
    **of_all("batch.duration batch.friction batch.joint batch.link batch.measured batch.mimic "
             "batch.still-joint batch.target batch.targets batch.unknown-joint",
             "map falls back to single runs and does not report it"),
    **of_all("contact.geometry contact.pair coupling.gain coupling.joints coupling.link coupling.weld "
             "device.figure hand.header loop.open loop.turned-over loop.twice mapping.body mapping.degrees-of-freedom "
             "mapping.joints mapping.number mapping.ranges model.axis-zero model.mimic-loop model.name-taken "
             "model.negative model.parent render.camera render.size robot.unknown-link shape.mass shape.numbers "
             "target.degrees-of-freedom target.unknown-joint",
             "only for callers of the library; readers of files and options refuse it first"),
    **of_all("file.stdout file.write picture.write program.module render.lettering render.library render.memory",
             "fault of the machine"),
    "change.joints": "the lab rebuilds the scene before it restarts a run",
    "device.silent": "needs a device that sends nothing",
    "hand.too-long": "needs a log of 4 million steps",
    "lab.not-allowed": "only if the lab listens on a public address",
    "lab.nothing-saved": "only before the first frame of a lab",
    "lab.unreadable": "needs a file that takes 10 s to read",
    "lab.edit": "lab: depends on the scene and the state in which the edit arrives",
    "lab.variants-differ": "only in a lab with variants",
    "loop.too-many": "needs thousands of constraints",
    "page.missing": "only in a program that is built without pages",
    "parser.failed": "needs a file whose reader runs out of time or memory",
    "run.other-memory": "the lab starts a new run instead of reporting it",
    "study.file": "reported only at the end of a study, which takes minutes",
    "trace.too-long": "needs a trace of 8 million samples"}


def sources():
    named = subprocess.run(["git", "ls-files", "*.cpp", "*.h", ":!tests", ":!benchmarks", ":!app/python"], cwd=ROOT,
                           capture_output=True, text=True, check=True).stdout
    for name in named.split():
        text = (ROOT / name).read_text(encoding="utf-8")
        yield name, re.sub(r"^\s*//.*|\s//\s.*", "", text, flags=re.M)


def pattern(literal):
    """Of a text with {} in it, or beginning or end of a text; None: too short to know it by."""
    parts = [re.escape(part.replace('\\"', '"')) for part in re.split(r"\{[^{}]*\}", literal)]
    return ".*".join(parts) if len("".join(re.split(r"\{[^{}]*\}", literal)).strip()) >= 14 else None


class Codes:
    """Codes of the sources, and how each is known where only its text is shown, as of a warning."""

    def __init__(self):
        self.all, by_text = {}, {}
        for name, text in sources():
            text = re.sub(r'"\s*\n\s*"', "", text)  # a literal in several pieces
            for found in CODE.finditer(text):
                code = found[1]
                if code.split(".")[1] in NO_CODE and code != "file.toml":
                    continue
                self.all.setdefault(code, name)
                before = re.split(r";\n|\{\n", text[max(0, found.start() - 700):found.start()])[-1]
                for literal in LITERAL.findall(before)[-6:]:
                    if pattern(literal) and not CODE.fullmatch(f'"{literal}"'):
                        by_text.setdefault(pattern(literal), set()).add(code)
        self.texts = [(re.compile(words), codes.pop()) for words, codes in by_text.items() if len(codes) == 1]
        self.texts += [(re.compile(words, re.M), code) for code, words in MORE_TEXTS.items()]
        self.seen = {}

    def see(self, code, case):
        self.seen.setdefault(code, case)

    def see_text(self, text, case):
        for words, code in self.texts:
            if code not in self.seen and words.search(text):
                self.see(code, case)

    def missing(self):
        return sorted(set(self.all) - set(self.seen) - set(UNREACHABLE))
