"""One hostile case: its folder, its run within limits, and what is demanded of it. scripts/check/hostile."""
import dataclasses
import hashlib
import json
import os
import pathlib
import re
import shutil
import signal
import stat
import subprocess
import tempfile
import time

SECONDS, MEGABYTES = 10, 1024
# docs/reference/exit_codes_and_errors.md; 1: a check failed, 3: diverged
ENDS = {"compare": {1}, "inspect": {1}, "replay": {1}, "simulate": {3}, "hand": {3}}
LIMITED = f'ulimit -c 0; ulimit -d {MEGABYTES << 10}; ulimit -t {SECONDS + 1}; exec /usr/bin/nice "$@"'


HELP = re.compile(r"(^| )(-h|--help|--version|--man|--completion|--scene-keys|--json=)")  # not JSON, or not wanted


@dataclasses.dataclass
class Case:
    """Files of a folder, and words of the command that is run in it."""
    reader: str
    name: str
    words: list
    files: dict = dataclasses.field(default_factory=dict)  # name: bytes
    links: dict = dataclasses.field(default_factory=dict)  # name: where it leads
    may_write: set = dataclasses.field(default_factory=set)  # inputs that the command is meant to write
    stop_after: float = 0  # s, by SIGINT: of a command that would go on
    before: list = dataclasses.field(default_factory=list)  # commands that make its files
    path: str = ""  # in place of PATH; what stands in bin/ can be run
    has_own_assets: bool = False  # a copy of the program stands beside the assets of its folder


def strict_json(text):
    def refuse(word):
        raise ValueError(f"{word} is not JSON")
    value = json.loads(text, parse_constant=refuse)
    if not isinstance(value, dict):
        raise ValueError("not an object")
    return value


def listing(folder):
    """What stands in a folder: each name with its content's hash, or what else it is."""
    found = {}
    for path in sorted(folder.rglob("*")):
        mode = path.lstat().st_mode
        name = str(path.relative_to(folder))
        if stat.S_ISREG(mode):
            found[name] = hashlib.blake2b(path.read_bytes()).hexdigest()
        elif stat.S_ISLNK(mode):
            found[name] = "-> " + os.readlink(path)
        else:
            found[name] = stat.S_IFMT(mode)
    return found


def processor_seconds(pid):
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class Runner:
    """Runs cases under `folder`; `processes` are those that run now."""

    def __init__(self, program, folder):
        self.program, self.folder, self.processes = str(program), folder, set()

    def run(self, case, number):
        """(faults, codes, text): what was wrong; the codes of the errors; all that was printed."""
        holder = self.folder / str(number)
        place = holder / "a/b"  # what climbs out of it with ../ is seen
        for made in (place, holder / "tmp"):
            made.mkdir(parents=True)
        try:
            self.write(case, place)
            for name, target in case.links.items():
                (place / name).parent.mkdir(parents=True, exist_ok=True)
                (place / name).symlink_to(target)
            before = listing(holder)
            code, out, err, usage = self.execute(case, place, holder)
            faults = self.demands(case, code, out, err, usage)
            faults += self.left(case, before, listing(holder), place.relative_to(holder))
            return self.judged(case, code, out, err, faults)
        finally:
            shutil.rmtree(holder, ignore_errors=True)

    def write(self, case, place):
        for name, data in case.files.items():
            (place / name).parent.mkdir(parents=True, exist_ok=True)
            if data is None:  # exists, and cannot be opened
                os.mknod(place / name, 0o600 | stat.S_IFSOCK)
                continue
            (place / name).write_bytes(data)
            if name.startswith("bin/"):
                (place / name).chmod(0o755)
        if case.has_own_assets:
            shutil.copy(self.program, place / "bin/sub/twinarm")
        for words in case.before:
            subprocess.run([self.program, *words.split()], cwd=place, capture_output=True, timeout=60)

    def execute(self, case, place, holder):
        words = [str(word).replace("{here}", str(place)) for word in case.words]
        environment = dict(os.environ, TMPDIR=str(holder / "tmp"), HOME=str(holder / "tmp"), COLUMNS="100")
        environment.pop("DISPLAY", None)
        program = str(place / "bin/sub/twinarm") if case.has_own_assets else self.program
        if case.path:
            environment["PATH"] = case.path.replace("{here}", str(place))
        with tempfile.TemporaryFile(dir=self.folder) as out, tempfile.TemporaryFile(dir=self.folder) as err:
            process = subprocess.Popen(["/bin/sh", "-c", LIMITED, "sh", program,
                                        *(os.fsencode(word) for word in words)], stdin=subprocess.DEVNULL, stdout=out,
                                       stderr=err, cwd=place, env=environment, start_new_session=True)
            self.processes.add(process.pid)
            try:
                status, usage = self.wait(process.pid, case.stop_after)
            finally:
                self.processes.discard(process.pid)
                process.returncode = 0  # it has been waited for
            texts = []
            for file in (out, err):
                file.seek(0)
                texts.append(file.read(4 << 20))
        return os.waitstatus_to_exitcode(status), *texts, usage

    @staticmethod
    def wait(pid, stop_after):
        """Until it ends; SIGKILL where it neither ends nor computes."""
        start = looked = time.monotonic()
        used, pause, is_stopped = 0.0, 0.002, False
        while True:
            done, status, usage = os.wait4(pid, os.WNOHANG)
            if done:
                return status, usage
            time.sleep(pause)
            pause = min(0.05, 1.5 * pause)
            now = time.monotonic()
            if stop_after and not is_stopped and now > start + stop_after:
                os.killpg(pid, signal.SIGINT)
                is_stopped = True
            if now > looked + SECONDS:
                computed = processor_seconds(pid)
                if computed < used + 0.1 or now > start + 20 * SECONDS:
                    os.killpg(pid, signal.SIGKILL)
                looked, used = now, computed

    @staticmethod
    def demands(case, code, out, err, usage):
        faults = []
        if usage.ru_utime + usage.ru_stime > SECONDS:
            faults.append(f"took {usage.ru_utime + usage.ru_stime:.1f} s of processor time")
        if usage.ru_maxrss > MEGABYTES << 10:
            faults.append(f"took {usage.ru_maxrss >> 10} MiB")
        ends = {0, 2} | ({130} if case.stop_after else set()) | ENDS.get(case.words[0] if case.words else "", set())
        if code not in ends:
            faults.append(f"ended by signal {-code}" if code < 0 else f"ended with exit code {code}")
        if code == 2 and not re.search(rb"^twinarm: .*(; |must (not )?be|did you mean)", err, re.M | re.S):
            faults.append("has no error with a remedy on stderr")
        if len(err) > 1 << 20:
            faults.append(f"wrote {len(err)} bytes on stderr")
        return faults

    @staticmethod
    def left(case, before, after, place):
        faults = []
        if any(str(word).split("=")[-1] == ".." for word in case.words):
            return faults  # is asked to write there
        for name, what in before.items():
            own = os.path.relpath(name, place)  # a link may be replaced; where it leads, nothing
            if after.get(name) != what and own not in case.may_write and own not in case.links:
                faults.append(f"{name} was {'changed' if name in after else 'removed'}")
        for name in after.keys() - before.keys():
            if not pathlib.Path(name).is_relative_to(place):
                faults.append(f"{name} was written, outside of the folder")
            elif name.endswith((".part", ".tmp")):
                faults.append(f"{name} was left")
        return faults

    @staticmethod
    def judged(case, code, out, err, faults):
        codes, text = [], err.decode("utf-8", "replace")
        if code != 130 and "--json" in case.words and not HELP.search(" ".join(map(str, case.words))):
            try:
                reported = strict_json(out.decode("utf-8"))
                text += json.dumps(reported.get("warnings", []), ensure_ascii=False)
                codes = [one["code"] for one in reported.get("errors", [])]
                if code == 2 and not codes:
                    faults.append("has no errors in JSON")
                for one in reported.get("errors", []):
                    faults += [f"an error has no {key}: {one}" for key in ("code", "problem", "fix")
                               if not one[key] and not (key == "fix" and re.search("must (not )?be", one["problem"]))]
            except ValueError as fault:
                faults.append(f"its JSON: {fault}: {out[:300]!r}")
        return faults, codes, text

    def kill(self):
        for pid in list(self.processes):
            try:
                os.killpg(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
