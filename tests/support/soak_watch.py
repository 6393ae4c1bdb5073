"""What the soaks in real time share: whether a series is flat, what an idle loop keeps up with, progress, checks.

    watch = Growth()                        # of memory, say
    watch.add(seconds, value); watch.fitted()
    idle = IdleLoop(cost); .. idle.pace()   # of a loop of milliseconds beside the program
    checks = Checks(); checks.add("memory", growth < 4, f"{growth:.1f} MB"); sys.exit(checks.finish())
"""
import multiprocessing
import statistics
import sys
import time

TICK = 0.001         # of the idle loop [s]
MOST_BEHIND = 0.05   # what is further behind is not made up for, as in the lab [s]


def say(text, end="\n"):
    print(text, file=sys.stderr, end=end, flush=True)


def clock(seconds):
    return f"{int(seconds) // 3600}:{int(seconds) // 60 % 60:02d}:{int(seconds) % 60:02d}"


class Growth:
    """A series over time, and the straight line through it."""

    def __init__(self):
        self.times, self.values = [], []

    def add(self, at, value):
        self.times.append(at)
        self.values.append(value)

    def __len__(self):
        return len(self.times)

    def fitted(self):
        """How much the line rises from the first to the last; 0 of fewer than two."""
        if len(self.times) < 2:
            return 0.0
        return statistics.linear_regression(self.times, self.values).slope * (self.times[-1] - self.times[0])


def _tick(cost, done):
    """A loop of milliseconds; behind, it hurries, but for what is too far behind."""
    start, ticks, given_up = time.monotonic(), 0, 0
    while True:
        due = int((time.monotonic() - start) / TICK) - given_up
        given_up += max(0, due - ticks - int(MOST_BEHIND / TICK))
        if ticks < due:
            end = time.thread_time() + cost
            while time.thread_time() < end:
                pass
            ticks += 1
            done.value = ticks
        else:
            time.sleep(max(0.0, start + (ticks + 1 + given_up) * TICK - time.monotonic()))


class IdleLoop:
    """What this machine can do at all: a process that does nothing each millisecond, but as long as is said."""

    def __init__(self, cost):
        context = multiprocessing.get_context("fork")
        self.done = context.Value("q", 0, lock=False)
        self.process = context.Process(target=_tick, args=(cost, self.done), daemon=True)
        self.process.start()
        self.mark()

    def mark(self):
        """From now on."""
        self.ticks, self.start = self.done.value, time.monotonic()

    def pace(self):
        """Of its milliseconds over those of the clock, since the mark; 1: it kept up."""
        return (self.done.value - self.ticks) * TICK / (time.monotonic() - self.start)

    def end(self):
        self.process.terminate()
        self.process.join()


class Progress:
    """With the time that is left; a line each minute where stderr is no terminal."""

    def __init__(self, name, seconds):
        self.name, self.seconds, self.reported, self.start = name, seconds, -60.0, time.monotonic()
        self.terminal = sys.stderr.isatty()

    def tell(self, words=""):
        gone = time.monotonic() - self.start
        text = f"{self.name}: {clock(gone)} of {clock(self.seconds)}, {clock(max(0, self.seconds - gone))} left{words}"
        if self.terminal:
            say(f"\r{text}   ", end="")
        elif gone - self.reported >= 60:
            self.reported = gone
            say(text)

    def finish(self):
        if self.terminal:
            say("")


class Checks:
    """What was watched, line by line; the last line is 'N passed, N failed'."""

    def __init__(self):
        self.rows = []

    def add(self, name, passed, words):
        self.rows.append({"name": name, "passed": bool(passed), "words": words})

    def lines(self):
        width = max(len(row["name"]) for row in self.rows)
        return [f"{'ok    ' if row['passed'] else 'FAILED'}  {row['name'].ljust(width)}  {row['words']}"
                for row in self.rows]

    def finish(self):
        """Prints them, and gives the exit code."""
        failed = sum(not row["passed"] for row in self.rows)
        print("\n".join(self.lines()))
        print(f"{len(self.rows) - failed} passed, {failed} failed", flush=True)
        return 1 if failed else 0
