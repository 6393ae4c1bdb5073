"""A program that is struck at a random moment, and what it may leave. scripts/check/kill_test; victims.py."""
import os
import pathlib
import re
import shutil
import signal
import subprocess
import time

from whole_files import Half, check_whole

from waiting import TIMEOUT

ROOT = pathlib.Path(__file__).resolve().parents[2]
SOFT = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
LEFT_OVER = re.compile(r"\.part$|\.\d+\.tmp$")  # docs/reference/exit_codes_and_errors.md: these are named there


class Fault(Exception):
    """A promise that was not kept."""


def demand(is_kept, words):
    if not is_kept:
        raise Fault(words)


class Victim:
    """One command, struck again and again in the same folder.

    A kind says its `command`, and may look at what it left (`look`), after it was struck and at the end."""
    name = ""
    done_code = 0        # where it comes to its end
    stopped_codes = (130,)  # where SIGINT, SIGTERM, SIGHUP stop it

    def __init__(self, program, folder, random):
        self.program, self.random = pathlib.Path(program), random
        self.out, self.tmp = folder / self.name / "out", folder / self.name / "tmp"
        for made in (self.out, self.tmp):
            made.mkdir(parents=True)
        self.environment = dict(os.environ, TMPDIR=str(self.tmp))

    # What a kind of victim says.

    def command(self):
        raise NotImplementedError

    def wait_in(self, process, seconds):
        """Lives for so long, or to its end."""
        try:
            process.wait(seconds)
        except subprocess.TimeoutExpired:
            pass

    def look(self, is_done):
        """After a blow: is_done, if it came to its end before it."""

    def keep_reference(self):
        """After a run that nobody has struck."""

    def finish(self):
        """The same command succeeds after all that."""
        done = subprocess.run(self.command(), capture_output=True, text=True, cwd=ROOT, env=self.environment,
                              timeout=TIMEOUT)
        demand(done.returncode == self.done_code, f"the same command ended with {done.returncode}: {done.stderr}")
        self.look(True)
        left = [p.name for p in self.files() if p.name.endswith(".part")]
        demand(not left, f"the same command, come to its end, has left {left}")

    # What is done to all of them.

    def prepare(self):
        start = time.monotonic()
        done = subprocess.run(self.command(), capture_output=True, text=True, cwd=ROOT, env=self.environment,
                              timeout=TIMEOUT)
        demand(done.returncode == self.done_code, f"ended with {done.returncode}, unstruck: {done.stderr}")
        self.length = time.monotonic() - start
        self.printed = done.stdout
        self.keep_reference()

    def files(self):
        return sorted(p for p in self.out.rglob("*") if p.is_file())

    def sizes(self, since):
        """Of what this life has written so far, and goes on writing."""
        found = {}
        for path in self.files():
            if path.name.endswith((".part", ".csv")):
                reported = path.stat()
                if reported.st_mtime_ns > since:
                    found[path] = reported.st_size
        return found

    def start(self):
        return subprocess.Popen(self.command(), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=ROOT,
                                env=self.environment, start_new_session=True)

    def strike(self, blow):
        """One life; returns how it ended."""
        # A killed life before it may have left some, and this one not come so far as to replace them.
        left_before = {p: p.stat().st_mtime_ns for p in self.files() if LEFT_OVER.search(p.name)}
        began, process = time.time_ns(), self.start()
        try:
            self.wait_in(process, self.random.uniform(0, 1.05 * (self.length or 1)))
            before = self.sizes(began)
            # Ctrl-C and a closed terminal reach the children too.
            if process.poll() is None:
                if blow in (signal.SIGINT, signal.SIGHUP):
                    os.killpg(process.pid, blow)
                else:
                    process.send_signal(blow)
            _, self.reported = process.communicate(timeout=TIMEOUT)
        finally:
            if process.poll() is None:
                process.kill()
                process.communicate()
        self.judge(process, blow, before, left_before)
        return process.returncode

    def judge(self, process, blow, before, left_before):
        code, is_done = process.returncode, process.returncode == self.done_code
        # Before it listens to them, a soft blow ends it at once, with nothing made yet.
        stopped = (-blow,) if blow == signal.SIGKILL else (*self.stopped_codes, -blow)
        demand(is_done or code in stopped, f"ended with {code}: {self.reported[-500:]}")
        self.no_child_lives()
        whole, left = [], []
        for path in self.files():
            (left if LEFT_OVER.search(path.name) else whole).append(path)
        left = [path for path in left if left_before.get(path) != path.stat().st_mtime_ns]
        for path in whole:
            if not self.may_be_cut(path):
                check_whole(path)
        if code != -signal.SIGKILL and code != -blow:
            mine = [p.name for p in left if p.name.endswith((".part", f".{process.pid}.tmp"))]
            demand(not mine, f"{signal.Signals(blow).name} has left {mine}")
            demand(not list(self.tmp.iterdir()), f"{signal.Signals(blow).name} has left temporary files")
        for path, size in before.items():
            if path.exists():  # else it has got its own name
                demand(path.stat().st_size >= size, f"{path.name} has lost what had been written")
        strange = [p.name for p in self.tmp.iterdir() if not p.name.startswith("twinarm-")]
        demand(not strange, f"temporary files without our name: {strange}")
        for folder in self.tmp.iterdir():
            shutil.rmtree(folder)
        self.look(is_done)

    def may_be_cut(self, path):
        """A log that grows under its own name."""
        return False

    def no_child_lives(self):
        """Of its children none goes on for long."""
        for _ in range(1200):
            alive = [p for p in processes() if str(self.out.parent) in p[1]]
            if not alive:
                return
            time.sleep(0.05)
        raise Fault(f"a minute later there still is {alive}")


def processes():
    """[(number, command line and folder)] of all that live."""
    found = []
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            if folder.joinpath("stat").read_text().rpartition(")")[2].split()[0] != "Z":
                words = folder.joinpath("cmdline").read_bytes().decode(errors="replace")
                found.append((folder.name, words + os.readlink(folder / "cwd")))
        except OSError:  # it has ended
            pass
    return found


__all__ = ["Fault", "Half", "ROOT", "SOFT", "Victim", "demand"]
