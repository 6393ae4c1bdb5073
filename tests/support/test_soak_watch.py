"""What the soaks in real time conclude from what they see, on series whose growth is known."""
import contextlib
import io
import os
import pathlib
import random
import signal
import time
import unittest
import unittest.mock

ROOT = pathlib.Path(__file__).resolve().parents[2]
from soak_watch import MOST_BEHIND, TICK, Checks, Growth, IdleLoop


class SoakWatch(unittest.TestCase):
    def growth(self, per_second, noise):
        series, rng = Growth(), random.Random(1)
        for n in range(600):
            series.add(10 + 6 * n, 300 + per_second * 6 * n + rng.uniform(-noise, noise))
        return series.fitted()

    def test_a_leak_is_seen_through_noise_and_noise_is_no_leak(self):
        self.assertAlmostEqual(self.growth(0, 0), 0, places=9)
        self.assertLess(abs(self.growth(0, 3)), 1)
        self.assertAlmostEqual(self.growth(0.002, 0), 0.002 * 6 * 599, places=6)
        self.assertGreater(self.growth(0.002, 3), 6)  # 2 kB a second, 7 MB in the hour
        self.assertEqual(Growth().fitted(), 0)

    def test_the_last_line_counts_and_a_failure_is_an_exit_code(self):
        for failures in (0, 2):
            checks, reported = Checks(), io.StringIO()
            checks.add("good", True, "as it is to be")
            for _ in range(failures):
                checks.add("bad", False, "as it is not")
            with contextlib.redirect_stdout(reported):
                self.assertEqual(checks.finish(), 1 if failures else 0)
            lines = reported.getvalue().splitlines()
            self.assertEqual(lines[-1], f"1 passed, {failures} failed")
            self.assertEqual(sum(line.startswith("FAILED") for line in lines), failures)

    def test_a_loop_that_needs_more_than_there_is_does_not_keep_up(self):
        idle = IdleLoop(0.002)  # in each millisecond: half of real time, whatever the machine
        while idle.done.value < 200:
            pass
        self.assertLess(idle.pace(), 0.6)
        idle.end()
        self.assertFalse(idle.process.is_alive())

    def test_a_pace_is_that_since_the_mark(self):
        idle = IdleLoop(0)
        while idle.done.value < 20:
            pass
        idle.end()
        with unittest.mock.patch("soak_watch.time.monotonic") as clock:
            clock.return_value = 500
            idle.mark()
            idle.done.value += 2000
            clock.return_value = 504
            self.assertAlmostEqual(idle.pace(), 0.5)

    def test_a_loop_that_was_held_up_does_not_make_up_for_all_of_it(self):
        idle = IdleLoop(0)
        while idle.done.value < 20:
            pass
        os.kill(idle.process.pid, signal.SIGSTOP)
        time.sleep(1)
        idle.mark()
        os.kill(idle.process.pid, signal.SIGCONT)
        while idle.done.value - idle.ticks < 1500:
            pass
        gone = time.monotonic() - idle.start
        self.assertLess((idle.done.value - idle.ticks) * TICK, gone + MOST_BEHIND + 2 * TICK)
        idle.end()


if __name__ == "__main__":
    unittest.main()
