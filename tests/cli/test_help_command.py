"""Help, glossary, manual, completion and version of the program, and its assets in any folder."""
import os
import re
import shutil
import subprocess
import tempfile
import unittest

import program
from program import main
from waiting import TIMEOUT


def run(*arguments, cwd="/"):
    return program.run(*arguments, cwd=cwd)


def options_of(page):
    """All --options that a help page lists."""
    return set(re.findall(r"^  (?:-\w,)?(--[\w-]+)", page, re.M))


class HelpCommand(unittest.TestCase):
    def commands(self):
        """All commands and subcommands that --help lists."""
        def below(path):
            page = run(*path, "--help").stdout
            names = re.findall(r"^  ([a-z][\w-]*) ", page.partition("Subcommands:")[2], re.M)
            return [found for name in names for found in [[*path, name], *below([*path, name])]]
        paths = below([])
        self.assertIn(["study"], paths)
        self.assertIn(["coupling", "predict"], paths)
        return paths

    def test_manual_has_a_section_for_every_command_with_all_its_options(self):
        manual = run("help", "--man").stdout.replace("\\-", "-")
        sections = dict(re.findall(r"^\.SS (.*?)\n(.*?)(?=^\.S)", manual, re.M | re.S))
        paths = self.commands()
        self.assertEqual(sorted(sections), sorted(" ".join(path) for path in paths))
        for path in paths:
            expected = options_of(run(*path, "--help").stdout) - {"--help"}
            found = set(re.findall(r"\\fB(--[\w-]+)\\fR", sections[" ".join(path)]))
            self.assertEqual(found, expected, path)

    def test_help_of_a_command_prints_the_same_as_its_option_and_has_examples(self):
        self.assertIn("Examples:\n  twinarm", run("--help").stdout)
        for path in self.commands():
            page, own = run("help", *path), run(*path, "--help")
            self.assertEqual((page.returncode, own.returncode, own.stderr), (0, 0, ""))
            self.assertIn("Examples:\n  twinarm " + path[0], own.stdout)
            self.assertEqual(page.stdout.split("Usage:")[0], own.stdout.split("Usage:")[0])
            self.assertEqual(options_of(page.stdout), options_of(own.stdout))

    def test_values_of_options_are_described_in_words(self):
        types = re.compile(r"\b(?:FLOAT|U?INT|BOOLEAN|POSITIVE|NONNEGATIVE)\b| in \[")
        pages = [run(*path, "--help").stdout for path in self.commands()] + [run("help", "--man").stdout]
        for page in pages:
            self.assertNotRegex(page, types)
        lab, manual = run("lab", "--help").stdout, pages[-1].replace("\\-", "-")
        for page in (lab, manual):
            self.assertRegex(page, r"--port(?:\\fR \\fI| )N(?:\\fR)?\s+port of the server; default: any free port "
                                   r"\(0 to 65535\)")
        self.assertRegex(lab, r"--history N +memory .* \(1 to 65536; default 256\)")
        self.assertRegex(lab, r"\nServer:\n  --port N")

    def test_help_of_a_term_prints_its_glossary_entry(self):
        for words, parts in ((["bias force"], ["bias force, symbol p [N m, N]", "p = v x* I v - f_ext", "RBDA 7.1"]),
                             (["bias", "force"], ["bias force, symbol p"]), (["IA"], ["articulated-body inertia"]),
                             (["KVR"], ["target robot"]), (["ghost"], ["not used; use target robot"])):
            page = run("help", *words)
            self.assertEqual((page.returncode, page.stderr), (0, ""), words)
            for part in parts:
                self.assertIn(part, page.stdout)
        unknown = run("help", "bias forc")
        self.assertEqual(unknown.returncode, 2)
        self.assertIn("did you mean 'bias force'?", unknown.stderr)

    def completed(self, *words):
        script = '. "$0"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _twinarm; printf "%s\\n" "${COMPREPLY[@]}"'
        with tempfile.TemporaryDirectory() as folder:
            os.mkdir(os.path.join(folder, "my runs"))
            file = os.path.join(folder, "completion")
            with open(file, "w", encoding="utf-8") as out:
                out.write(run("help", "--completion").stdout)
            done = subprocess.run(["bash", "-c", script, file, *words], capture_output=True, text=True,
                                  timeout=TIMEOUT, cwd=folder)
        return sorted(line for line in done.stdout.split("\n") if line)

    def test_completion_of_commands_options_and_files_and_none_for_numbers(self):
        for words, expected in ((["twinarm", "stu"], ["study"]),
                                (["twinarm", "coupling", "p"], ["predict"]),
                                (["twinarm", "study", "--seed", "3", "--pa"], ["--paper-view"]),
                                (["twinarm", "study", "--out", "my"], ["my runs"]),
                                (["twinarm", "study", "--out", "=", "my"], ["my runs"]),
                                (["twinarm", "simulate", "my"], ["my runs"]),
                                (["twinarm", "study", "--device", "trace", "--se"], ["--seed"]),
                                (["twinarm", "study", "--seed", "my"], [])):
            self.assertEqual(self.completed(*words), expected, words)

    def test_all_commands_and_options_are_completed(self):
        for path in self.commands():
            options = options_of(run(*path, "--help").stdout)
            self.assertEqual(set(self.completed("twinarm", *path, "--")), options, path)

    CANDIDATES = (("twinarm stu", "study"), ("twinarm coupling p", "predict"), ("twinarm study --pa", "--paper-view"),
                  ("twinarm simulate my", "my runs/"), ("twinarm study --seed my", ""))
    # What zsh's completion calls, replaced by functions that print.
    ZSH = """compadd() { shift; print -l -- ${(M)@:#$words[CURRENT]*} }
    _files() { print -l -- $words[CURRENT]*(/N:s/%/\\//) }
    words=("${@:2}"); CURRENT=$#words; source $1"""

    def printed_by(self, shell, *words):
        """What the shell prints with the completion script as its first argument; skips without the shell."""
        if not shutil.which(shell):
            self.skipTest(f"{shell} is not installed")
        with tempfile.TemporaryDirectory() as folder:
            os.mkdir(os.path.join(folder, "my runs"))
            file = os.path.join(folder, "completion")
            with open(file, "w", encoding="utf-8") as out:
                out.write(run("help", "--completion", shell).stdout)
            done = subprocess.run([shell, *(file if word == "{file}" else word for word in words)], cwd=folder,
                                  capture_output=True, text=True, timeout=TIMEOUT, env=dict(os.environ, HOME=folder))
        self.assertEqual(done.stderr, "")
        return done.stdout

    def test_zsh_completes_the_same(self):
        for line, expected in self.CANDIDATES:
            printed = self.printed_by("zsh", "-f", "-c", self.ZSH, "zsh", "{file}", *line.split())
            self.assertEqual(printed.strip().split("\n")[0].strip("/"), expected.strip("/"), line)

    def test_fish_completes_the_same(self):
        for line, expected in self.CANDIDATES:
            printed = self.printed_by("fish", "--no-config", "-c", f"source $argv[1]; complete -C '{line}'", "{file}")
            self.assertEqual(printed.split("\t")[0].strip(), expected, line)

    def test_a_shell_without_completion_is_refused(self):
        self.assertIn("not in {bash,zsh,fish}", run("help", "--completion", "tcsh").stderr)

    def test_version_is_that_of_the_manual(self):
        result = run("--version")
        self.assertEqual(result.returncode, 0)
        self.assertRegex(result.stdout, r"^twinarm \d+\.\d+\.\d+\n$")
        self.assertIn(f'"{result.stdout.strip()}"', run("help", "--man").stdout)

    def test_assets_are_found_from_any_folder_unless_a_file_of_that_name_exists(self):
        words = ("dynamics", "assets/robots/teaching/pendulum.urdf", "--json")
        found = run(*words)
        self.assertEqual(found.returncode, 0, found.stderr)
        with tempfile.TemporaryDirectory() as folder:
            os.makedirs(os.path.join(folder, "assets/robots/teaching"))
            with open(os.path.join(folder, words[1]), "w", encoding="utf-8") as file:
                file.write("no robot")
            self.assertEqual(run(*words, cwd=folder).returncode, 2)
        missing = run("dynamics", "assets/robots/nowhere.urdf")
        self.assertEqual(missing.returncode, 2)
        self.assertIn("assets/robots/nowhere.urdf", missing.stderr)


if __name__ == "__main__":
    main()
