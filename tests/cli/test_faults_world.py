"""A world that is not as hoped: programs that are missing, a port that is taken, pages that vanish, a clock
that jumps, another language's commas, names with spaces and umlauts, no place for temporary files."""
import json
import os
import pathlib
import re
import shutil
import signal
import socket
import struct
import subprocess

from lab_test import Running
import program
from live_socket import Lab
from program import ROOT, SCENES, main, run, start
from waiting import TIMEOUT, processor_time, wait_for, wait_while_running
from whole_files import check_whole
from writers import PENDULUM, SMALL, WRITERS, WritersTest

HAND, LONG = SCENES / "hand_and_obstacles.toml", SCENES / "robot_beside_obstacles.toml"
BAD_INPUT = 2  # docs/reference/exit_codes_and_errors.md
NEED_GNUPLOT = ("picture of a map", "fork", "cases", "study")
DAY = 86400


class Case(WritersTest):
    def run_it(self, *words, folder=None, **environment):
        return run(*words, cwd=folder or self.folder, env=dict(os.environ, **environment))

    def succeeds(self, *words, **more):
        done = self.run_it(*words, **more)
        self.assertEqual(done.returncode, 0, f"{words}: {done.stderr}")
        return done.stdout

    def refused(self, *words, **more):
        done = self.run_it(*words, **more)
        self.assertEqual(done.returncode, BAD_INPUT, f"{words}: {done.stderr[-800:]}")
        return done.stderr


class Missing(Case):
    def test_without_gnuplot_what_draws_with_it_says_which_package_it_needs_before_the_work(self):
        self.record_pendulum()
        for name in NEED_GNUPLOT:
            with self.subTest(name):
                self.assertIn("gnuplot-nox", self.refused(*WRITERS[name][0], PATH=str(self.base)))
                self.assertEqual({p.name for p in self.base.rglob("*") if p.is_file()}, {"run.twinrec"})

    def test_without_a_place_for_temporary_files_the_message_says_how_to_give_one(self):
        self.record_pendulum()
        (self.base / "file").write_text("")
        for place in ("gone", "file"):
            for words in (WRITERS["picture of a map"][0], ["replay", "../run.twinrec"], WRITERS["fork"][0],
                          ["lab", PENDULUM, "--no-browser"]):
                with self.subTest(words):
                    reported = self.refused(*words, TMPDIR=str(self.base / place))
                    self.assertIn(str(self.base / place), reported)
                    self.assertIn("set TMPDIR", reported)


class Strange(Case):
    def test_names_with_spaces_quotes_and_umlauts_are_names_as_any_other(self):
        folder = self.base / "Größe & 'Maß' $HOME"
        folder.mkdir()
        scene = folder / "Pendel Ä.toml"
        shutil.copytree(ROOT / "assets/robots/teaching", self.base / "robots/teaching")
        text = re.sub(r'"(\.\./)?robots/', f'"{self.base}/robots/', PENDULUM.read_text())
        scene.write_text(text.replace('name = "pendulum"', 'name = "Foucault\'s"'))
        self.succeeds("simulate", scene, "--record", "Lauf ü.twinrec", "--duration", 0.2, folder=folder)
        for words, file in ((["export", "Lauf ü.twinrec", "Seite ö.html"], "Seite ö.html"),
                            (["replay", "Lauf ü.twinrec", "--from", 0, "--set", "robot.Foucault's.q.hinge=1", "--plot",
                              "Gabel 'é'.svg"], "Gabel 'é'.svg"),
                            (["render", scene, "--png", "Bild ß.png", *SMALL], "Bild ß.png"),
                            (["render", scene, "--mp4", "Film ß.mp4", "--to", 0.1, *SMALL], "Film ß.mp4"),
                            (["trace", "--out", "Spur ø.csv"], "Spur ø.csv")):
            with self.subTest(file):
                self.need_ffmpeg(words)
                self.succeeds(*words, folder=folder)
                check_whole(folder / file)
        self.succeeds("hand", HAND, "--simulated", "--duration", 0.2, "--record", "--out", "Hand ï", folder=folder)
        check_whole(folder / "Hand ï/run.twinrec")

    def test_a_language_with_decimal_commas_changes_no_byte(self):
        if not shutil.which("localedef") or not pathlib.Path("/usr/share/i18n/locales/de_DE").exists():
            self.skipTest("the package locales is not installed: scripts/setup --test")
        made = subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", self.base / "de_DE.UTF-8"],
                              capture_output=True)
        self.assertTrue((self.base / "de_DE.UTF-8/LC_NUMERIC").exists(), made.stderr)
        german = {"LC_ALL": "de_DE.UTF-8", "LOCPATH": str(self.base)}
        commas = subprocess.run(["/usr/bin/printf", "%.1f", "1,5"], capture_output=True, text=True,
                                env=dict(os.environ, **german))
        self.assertEqual(commas.stdout, "1,5")  # it is in force
        self.record_pendulum()
        for name in ("picture of a map", "fork", "page", "picture", "trace", "cases"):
            words = WRITERS[name][0]
            with self.subTest(name):
                results = []
                for environment in ({"LC_ALL": "C"}, german):
                    printed = self.succeeds(*words, **environment)
                    files = {p.name: p.read_bytes() for p in self.folder.iterdir()}
                    results.append((printed if name != "cases" else "", files))
                    for path in self.folder.iterdir():
                        path.unlink()
                if name == "cases":  # it tells how long each took
                    continue
                self.assertEqual(results[1], results[0])
        for words in (["simulate", PENDULUM, "--json"], ["simulate", PENDULUM, "--csv", "--every", 0.1]):
            self.assertEqual(self.succeeds(*words, **german), self.succeeds(*words, LC_ALL="C"))

    def test_a_link_that_lies_where_a_file_is_to_be_written_is_not_followed(self):
        self.record_pendulum()
        victim = self.base / "victim"
        for name, link in (("recording", "run.twinrec.part"), ("film", "p.mp4.part"), ("picture", "p.png.$$.tmp"),
                           ("page", "run.html.$$.tmp"), ("hand", "hand.csv")):
            words = WRITERS[name][0]
            with self.subTest(name):
                self.need_ffmpeg(words)
                victim.write_text("mine")
                made = subprocess.run(["sh", "-c", f'ln -s ../victim "{link}" && exec "$@"', "sh", program.PROGRAM,
                                       *map(str, words)], cwd=self.folder, capture_output=True, text=True)
                self.assertEqual(made.returncode, 0, made.stderr)
                self.assertEqual(victim.read_text(), "mine")
                for left in self.folder.iterdir():
                    self.assertFalse(left.is_symlink(), left)
                    left.unlink()

    def test_of_two_that_record_to_one_file_the_second_is_refused(self):
        words = ["simulate", LONG, "--record", "run.twinrec"]
        first = start(*words, cwd=self.folder)
        wait_while_running(first, (self.folder / "run.twinrec.part").exists, "a recording that has begun")
        self.assertIn("another program is writing it", self.refused(*words))
        self.assertEqual(first.wait(timeout=TIMEOUT), 0)
        check_whole(self.folder / "run.twinrec")


class Clock(Case):
    def test_only_stamps_of_messages_and_of_the_audit_log_read_the_time_of_day(self):
        wall = re.compile(r"system_clock|high_resolution_clock|CLOCK_REALTIME|gettimeofday|"
                          r"\btime\((nullptr|NULL|0|&)")
        readers = {str(path.relative_to(ROOT)) for room in ("app", "solver", "collision", "coupling")
                   for path in (ROOT / room).rglob("*")
                   if path.suffix in (".h", ".cpp", ".inl") and wall.search(path.read_text())}
        self.assertEqual(readers, {"app/device/vrpn_stream.cpp", "app/lab/app/audit_log.cpp"})

    def test_a_clock_that_jumps_by_days_is_not_noticed(self):
        faketime = next(pathlib.Path("/usr/lib").glob("*/faketime/libfaketimeMT.so.1"), None)
        if faketime is None:
            self.skipTest("the package faketime is not installed: scripts/setup --test")
        jumps = self.folder / "clock"
        jumps.write_text("+0")
        environment = {"LD_PRELOAD": str(faketime), "FAKETIME_TIMESTAMP_FILE": str(jumps), "FAKETIME_NO_CACHE": "1",
                       "DONT_FAKE_MONOTONIC": "1", "FAKETIME_DONT_FAKE_MONOTONIC": "1"}
        process = start("hand", HAND, "--duration", 2, "--record", "--json", "--out", self.folder / "out",
                        env=dict(os.environ, **environment))
        log = self.folder / "out/hand.csv"
        for rows, days in ((500, 1000), (1000, -1000), (1500, 3)):
            wait_for(lambda: process.poll() is not None or (log.exists() and log.read_bytes().count(b"\n") > rows),
                     f"{rows} rows of the log")
            jumps.write_text(f"{days * DAY:+d}")
        out, reported = process.communicate(timeout=TIMEOUT)
        self.assertEqual(process.returncode, 0, reported)
        answer = json.loads(out)
        self.assertEqual(answer["ticks"], 2000)
        self.assertTrue(answer["same_bits"])
        self.assertLess(answer["timing"]["interval"]["largest"], DAY)


class Pages(Case):
    def lab(self, *more):
        running = Running(PENDULUM, *more, cwd=self.folder)
        self.addCleanup(running.process.communicate, timeout=TIMEOUT)
        self.addCleanup(running.process.send_signal, signal.SIGINT)  # it takes its temporary folder away
        return running.process, running.url

    def test_a_port_that_is_taken_is_reported_with_the_way_out(self):
        with socket.socket() as taken:
            taken.bind(("127.0.0.1", 0))
            taken.listen()
            port = taken.getsockname()[1]
            reported = self.refused("lab", PENDULUM, "--port", port, "--no-browser")
        self.assertIn(str(port), reported)
        self.assertIn("omit --port", reported)
        _, url = self.lab("--port", str(port))  # it is free now
        self.assertIn(f":{port}/", url)

    def test_pages_that_vanish_in_the_middle_of_a_word_disturb_no_other_client(self):
        process, url = self.lab()
        lab = Lab(url)
        with lab.live() as stays:
            you = stays.wait_for("state")["you"]
            for n in range(30):
                gone = lab.live()
                if n % 3 == 0:  # half a message
                    gone.socket.sendall(bytes([0x81, 0xfe, 0x10, 0]) + b"mask" + b"{\"do\": ")
                elif n % 3 == 1:  # half an upload, on a connection of its own
                    upload = socket.create_connection((lab.host, lab.port))
                    upload.sendall(f"POST /open?name=x.toml HTTP/1.1\r\nHost: {lab.host}:{lab.port}\r\n"
                                   f"Cookie: {lab.cookie}\r\nContent-Length: 100000\r\n\r\nduration".encode())
                    upload.close()
                else:
                    gone.do("request_control")
                if n % 2:  # not a close, but a reset
                    gone.socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
                gone.close()
            stays.wait_for("state", lambda s: s["clients"] == 1 and s["controller"] == you)
            step = stays.wait_for("frame").step
            stays.wait_for("frame", lambda frame: frame.step > step)
            self.assertEqual(lab.get("/save").status, 200)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(TIMEOUT), 0)
        self.assertEqual(process.stderr.read(), "")


class Ends(Case):
    """What scripts/check/kill_test meets by chance, on purpose."""

    def struck(self, words, blow, is_ready):
        """As soon as is_ready(process)."""
        process = start(*words, cwd=self.folder, start_new_session=True)
        wait_while_running(process, lambda: is_ready(process), "it is at work")
        os.killpg(process.pid, blow)
        out, reported = process.communicate(timeout=TIMEOUT)
        return process.returncode, out, reported

    def test_a_terminal_that_is_closed_ends_it_as_ctrl_c_does(self):
        self.need_ffmpeg(["--mp4"])
        for file, is_ready in (("film.mp4", lambda _: (self.folder / "film.mp4.part").exists()),
                               ("film.gif", lambda process: processor_time(process) > 1)):  # its file comes at its end
            code, _, _ = self.struck(["render", LONG, "--" + file[-3:], file, "--fps", 1000], signal.SIGHUP, is_ready)
            self.assertEqual(code, 130)
            self.assertEqual(list(self.folder.iterdir()), [])

    def test_under_nohup_a_terminal_that_is_closed_is_none_of_its_business(self):
        self.interrupted("simulate", LONG, "--record", "run.twinrec", blow=signal.SIGHUP, code=0, cwd=self.folder,
                         is_ready=lambda _: list(self.folder.iterdir()),
                         preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        check_whole(self.folder / "run.twinrec")

    def test_ctrl_c_ends_a_run_under_a_hand_and_its_recording_is_made_all_the_same(self):
        log = self.folder / "hand.csv"
        code, out, reported = self.struck(["hand", HAND, "--record", "--json", "--out", "."], signal.SIGINT,
                                          lambda _: log.exists() and log.stat().st_size > 20000)
        self.assertEqual(code, 0, reported)
        self.assertTrue(json.loads(out)["same_bits"])
        check_whole(self.folder / "run.twinrec")

    def test_a_recording_beside_which_a_later_one_was_killed_says_so(self):
        self.succeeds("simulate", PENDULUM, "--record", "run.twinrec")
        shutil.copy(self.folder / "run.twinrec", self.folder / "run.twinrec.part")
        self.assertIn("run.twinrec.part", self.run_it("replay", "run.twinrec").stderr)
        self.succeeds("simulate", PENDULUM, "--record", "run.twinrec")
        self.assertEqual([p.name for p in self.folder.iterdir()], ["run.twinrec"])


if __name__ == "__main__":
    main()
