"""How long tests wait, and what for.

TIMEOUT [s] bounds every wait for a program or a condition. It only ends tests that hang: nothing that passes comes
near it. TWINARM_TEST_TIMEOUT is a factor for slow machines and sanitizers.
"""
import os
import pathlib
import resource
import time

TIMEOUT = 900 * float(os.environ.get("TWINARM_TEST_TIMEOUT", "1"))


def wait_for(condition, what):
    """The first true value of condition(); TimeoutError with `what` if there is none."""
    deadline = time.monotonic() + TIMEOUT
    while not (value := condition()):
        if time.monotonic() > deadline:
            raise TimeoutError(f"not within {TIMEOUT:g} s: {what}")
        time.sleep(0.01)
    return value


def wait_while_running(process, condition, what):
    """As wait_for(), of a process that must not end before."""
    def is_so():
        if process.poll() is not None:
            raise AssertionError(f"it ended with {process.returncode} before: {what}")
        return condition()
    return wait_for(is_so, what)


def processor_time(process):
    """Of all threads of a running process, so far [s]. Unlike the clock it does not depend on the machine's load."""
    fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def processor_time_of_ended():
    """Of all child processes that have ended, and their children [s]."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime
