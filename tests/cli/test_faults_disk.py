"""A disk that is full, a folder that is read-only, a stdout that takes nothing: what each command that
writes says then, with which code it ends, and that nothing half is left."""
import json
import os
import resource
import shutil
import signal
import subprocess
import unittest

import program
from program import SCENES, main, start
from waiting import TIMEOUT, wait_while_running
from whole_files import check_whole, recorded_blocks
from writers import PENDULUM, ROBOT, WRITERS, WritersTest

NOBODY = 65534
BAD_INPUT = 2  # docs/reference/exit_codes_and_errors.md
# Mounts a disk, fills it, runs the rest there, and copies out what is left.
ON_FULL_DISK = """
mount -t tmpfs -o size=8k,mode=777 none "$0" || exit 99
cd "$0"; left=$1; shift
cat /dev/zero > full 2> /dev/null
"$@"; code=$?
rm full; cp -r . "$left"
exit $code
"""


def can_mount():
    return subprocess.run(["unshare", "-rm", "true"], capture_output=True).returncode == 0 \
        if shutil.which("unshare") else False


class Case(WritersTest):
    def setUp(self):
        super().setUp()
        self.base.chmod(0o755)
        self.environment = dict(os.environ, TMPDIR=str(self.base))
        self.record_pendulum()  # some of the commands read it

    def run_it(self, words, **more):
        return subprocess.run([str(w) for w in words], capture_output=True, text=True, timeout=TIMEOUT, cwd=self.folder,
                              env=self.environment, **more)

    def told_well(self, name, done):
        self.assertEqual(done.returncode, BAD_INPUT, f"{name}: {done.returncode}: {done.stderr[-800:]}")
        faults = [line for line in done.stderr.splitlines() if line.startswith("twinarm: ")]
        self.assertTrue(any("; " in line for line in faults), f"{name}: no remedy: {done.stderr}")
        self.assertNotIn("internal", done.stderr)

    def nothing_half(self, name, folder, may_be_left):
        for path in folder.rglob("*"):
            if path.is_file() and path.name not in may_be_left:
                check_whole(path)


class FullDisk(Case):
    @unittest.skipUnless(can_mount(), "unshare -rm is not allowed here: no disk can be mounted that is full")
    def test_where_the_disk_is_full_each_command_says_so_and_leaves_nothing_half(self):
        for name, (words, may_be_left) in WRITERS.items():
            with self.subTest(name):
                self.need_ffmpeg(words)
                left = self.base / f"left of {name}"
                left.mkdir()
                done = self.run_it(["unshare", "-rm", "sh", "-c", ON_FULL_DISK, self.folder, left, program.PROGRAM,
                                    *words])
                self.told_well(name, done)
                self.nothing_half(name, left, may_be_left)

    def test_a_file_that_may_not_grow_is_reported_as_a_full_disk_is(self):
        """`ulimit -f`: of all who can mount nothing."""
        for name in ("recording", "map", "picture", "trace", "hand"):
            words, may_be_left = WRITERS[name]
            with self.subTest(name):
                done = self.run_it([program.PROGRAM, *words], preexec_fn=lambda: resource.setrlimit(
                    resource.RLIMIT_FSIZE, (400, 400)))
                self.told_well(name, done)
                self.nothing_half(name, self.folder, may_be_left)
                for left in self.folder.iterdir():
                    left.unlink()

    def test_a_recording_for_which_there_is_no_more_room_keeps_its_frames(self):
        limit = 100_000
        words = ["simulate", SCENES / "box_stack.toml", "--duration", 0.5, "--record", "run"]
        done = self.run_it([program.PROGRAM, *words],
                           preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
        self.told_well("recording", done)
        self.assertIn("free space", done.stderr)
        self.assertFalse((self.folder / "run").exists())
        kinds = [kind for kind, _, _ in recorded_blocks((self.folder / "run.part").read_bytes())]
        self.assertGreater(kinds.count("F"), 2)
        read = self.run_it([program.PROGRAM, "export", "run", "--json"])
        self.assertEqual(len(json.loads(read.stdout)["frames"]), kinds.count("F"))
        self.assertIn("run.part", read.stderr)

    def test_a_recording_whose_name_was_taken_meanwhile_is_reported_and_kept(self):
        """By a folder, while the run waits for somebody to read its table."""
        process = start("simulate", SCENES / "box_stack.toml", "--duration", 0.5, "--csv", "--every", 0.001, "--record",
                        "run.twinrec", cwd=self.folder)
        process.stdout.readline()
        wait_while_running(process, (self.folder / "run.twinrec.part").exists, "a recording that has begun")
        (self.folder / "run.twinrec").mkdir()
        _, reported = process.communicate(timeout=TIMEOUT)
        self.told_well("recording", subprocess.CompletedProcess([], process.returncode, "", reported))
        self.assertIn("run.twinrec", reported)
        data = (self.folder / "run.twinrec.part").read_bytes()
        self.assertEqual(recorded_blocks(data)[-1][2], len(data))


class ReadOnly(Case):
    def as_nobody(self):
        """Root may write anywhere; so another user tries."""
        if os.getuid() != 0:
            return {}
        probe = self.run_it([program.PROGRAM, "--help"], user=NOBODY, group=NOBODY, extra_groups=[])
        if probe.returncode != 0:
            self.skipTest(f"root may write anywhere, and user {NOBODY} cannot run {program.PROGRAM}")
        return {"user": NOBODY, "group": NOBODY, "extra_groups": []}

    def test_where_the_folder_is_read_only_each_command_says_so_before_its_work_and_leaves_nothing(self):
        who = self.start_as_nobody()
        self.folder.chmod(0o555)
        self.addCleanup(self.folder.chmod, 0o755)
        for name, (words, _) in WRITERS.items():
            with self.subTest(name):
                self.need_ffmpeg(words)
                self.told_well(name, self.run_it([program.PROGRAM, *words], **who))
                self.assertEqual(list(self.folder.iterdir()), [])
                self.assertEqual(list(self.base.glob("work.*")), [])  # a map would begin with it

    def test_a_read_only_folder_is_reported_at_once_for_all_files(self):
        who = self.start_as_nobody()
        self.folder.chmod(0o555)
        self.addCleanup(self.folder.chmod, 0o755)
        for words in (["render", PENDULUM, "--png", "p.png", "--mp4", "p.mp4"],
                      ["simulate", PENDULUM, "--record", "p.twinrec", "--post-mortem", "q.twinrec"],
                      ["zwidth", "--svg", "p.svg", "--png", "p.png"]):
            done = self.run_it([program.PROGRAM, *words], **who)
            self.told_well(words[0], done)
            for option, file in zip(words[-4::2], words[-3::2]):
                self.assertRegex(done.stderr, f"{file}: cannot be written: no permission in .*{option}")

    def start_as_nobody(self):
        try:
            who = self.as_nobody()
        except PermissionError:
            self.skipTest("root may write anywhere, and another user cannot come here")
        temporary = self.base / "tmp"
        temporary.mkdir(mode=0o777)
        temporary.chmod(0o777)
        self.environment["TMPDIR"] = str(temporary)
        # The work file of maps lies beside the folder.
        self.base.chmod(0o777)
        return who


class Streams(Case):
    PRINTING = (["simulate", PENDULUM], ["simulate", PENDULUM, "--json"],
                ["simulate", PENDULUM, "--csv", "--every", "0.02"], ["export", "../run.twinrec", "--csv"],
                ["dynamics", ROBOT], ["compare", "A1", "--json"], ["--help"], ["--version"], ["simulate", "--help"],
                ["help", "simulate"])

    def run_in_shell(self, words, redirections):
        command = " ".join(f"'{word}'" for word in [program.PROGRAM, *words])
        return self.run_it(["sh", "-c", f"{command} {redirections}"])

    def test_what_cannot_be_printed_is_reported(self):
        for words in self.PRINTING:
            with self.subTest(words):
                for stdout in ("/dev/full", None):
                    done = self.run_in_shell(words, f"> {stdout}" if stdout else ">&-")
                    self.told_well(words, done)
                    self.assertIn("stdout", done.stderr)

    def test_what_is_printed_never_goes_into_a_file_that_is_open(self):
        """With stdout closed the next file has its number."""
        for closed in (">&-", "<&- >&-", "<&- >&- 2>&-"):
            self.run_in_shell(["simulate", PENDULUM, "--csv", "--every", 0.02, "--record", "run.twinrec"], closed)
            (file,) = self.folder.iterdir()  # run.twinrec.part, where printing has ended the run
            data = file.read_bytes()
            self.assertEqual(recorded_blocks(data)[-1][2], len(data), closed)
            file.unlink()

    def test_what_is_said_never_goes_into_a_file_that_is_open(self):
        """An alarm, said while the run is recorded, that has nowhere to go."""
        words = ["simulate", SCENES / "tracking_map.toml", "--step", 0.01, "--record", "run.twinrec"]
        self.assertIn("alarm", self.run_in_shell(words, "").stderr)
        heard = (self.folder / "run.twinrec").read_bytes()
        for closed in ("2>&-", "<&- 2>&-"):
            self.run_in_shell(words, closed)
            self.assertTrue((self.folder / "run.twinrec").read_bytes() == heard, closed)

    def test_stderr_may_be_closed(self):
        for stderr in ("2>&-", "2>/dev/full"):
            done = self.run_in_shell(["render", PENDULUM, "--frames", "film", "--to", 0.1, "--size", "64x48"], stderr)
            self.assertEqual(done.returncode, 0)
            self.assertEqual(self.run_in_shell(["simulate", "nowhere.toml"], stderr).returncode, BAD_INPUT)

    def test_stdin_may_be_closed(self):
        done = self.run_in_shell(["simulate", PENDULUM, "--json", "--record", "run.twinrec"], "<&-")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        check_whole(self.folder / "run.twinrec")

    def test_a_reader_that_goes_away_ends_it_and_the_recording_can_be_read(self):
        process = start("simulate", SCENES / "box_stack.toml", "--csv", "--every", 0.001, "--record", "run.twinrec",
                        cwd=self.folder)
        for _ in range(500):
            process.stdout.readline()
        process.stdout.close()
        self.assertEqual(process.stderr.read(), "")
        process.stderr.close()
        self.assertEqual(process.wait(TIMEOUT), -signal.SIGPIPE)
        self.assertFalse((self.folder / "run.twinrec").exists())
        read = self.run_it([program.PROGRAM, "replay", "run.twinrec", "--json"])
        self.assertTrue(json.loads(read.stdout)["bit_exact"])


if __name__ == "__main__":
    main()
