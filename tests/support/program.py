"""The program under test: how tests run it, stop it, and read what it prints."""
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import unittest

from waiting import TIMEOUT, processor_time, wait_while_running

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENES = ROOT / "assets/scenes"
DATA = ROOT / "tests/data"
PROGRAM = ""  # its path


def main():
    """TEST.py PATH/TO/PROGRAM [options of unittest]"""
    global PROGRAM
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()


def run(*words, **more):
    """The finished process."""
    return subprocess.run([PROGRAM, *map(str, words)],
                          **{"capture_output": True, "text": True, "timeout": TIMEOUT, "cwd": ROOT, **more})


def twinarm(*words, code=0, **more):
    """The finished process, which has ended with that code."""
    done = run(*words, **more)
    if done.returncode != code:
        raise AssertionError(f"{words}: {done.returncode}, not {code}: {done.stderr[-2000:]}{done.stdout[:2000]}")
    return done


def start(*words, **more):
    """The running process."""
    return subprocess.Popen([PROGRAM, *map(str, words)],
                            **{"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True, "cwd": ROOT, **more})


def data(name, **values):
    """The text of a file in tests/data, with other values where these keys first stand."""
    text = (DATA / name).read_text()
    for key, value in values.items():
        text, count = re.subn(rf"^{key} = .*$", f"{key} = {json.dumps(value)}", text, count=1, flags=re.M)
        assert count == 1, f"{name} has no key {key}"
    return text


def line_of(fault):
    """As stderr has it."""
    return "{file}:{line}: {where}: {problem}; {fix}".format(**fault)


class ProgramTest(unittest.TestCase):
    """Each test has a folder of its own."""
    cwd = ROOT  # of the program

    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="twinarm-test-", ignore_cleanup_errors=True)
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return self.folder / name

    def twinarm(self, *words, code=0, **more):
        """The finished process, which has ended with that code."""
        return twinarm(*words, code=code, **{"cwd": self.cwd, **more})

    def json_of(self, *words, code=0, **more):
        return json.loads(self.twinarm(*words, "--json", code=code, **more).stdout)

    def faults(self, *words, **more):
        return self.json_of(*words, code=2, **more)["errors"]

    def fault(self, code, *words, **more):
        """The only fault, which has that code."""
        (fault,) = self.faults(*words, **more)
        self.assertEqual(fault["code"], code, fault)
        return fault

    def interrupted(self, *words, is_ready=lambda process: processor_time(process) > 0.3, blow=signal.SIGINT,
                    code=130, **more):
        """What it has printed, interrupted as soon as is_ready(process)."""
        process = start(*words, **{"cwd": self.cwd, **more})
        wait_while_running(process, lambda: is_ready(process), "it is at work")
        process.send_signal(blow)
        out, err = process.communicate(timeout=TIMEOUT)
        self.assertEqual(process.returncode, code, f"{out}{err}")
        return out, err
