"""No argument ends the interpreter: every public function, method and property of the module is called with what it is
not meant for, the same each time. A call returns, or raises a Python exception that has a text; and Ctrl-C ends it.

The calls are made in a process of their own, which writes each before it makes it.
"""
import inspect
import os
import random
import resource
import signal
import subprocess
import sys
import tempfile
import unittest
import webbrowser

import numpy as np

from notebook import PRELOADED, PUMA, ROOT, SCENES, command, main, twinarm
from program import DATA
from test_stub import reported

SECONDS = 0.25  # of a call, before it is interrupted
PAIRS = 25  # further calls of each function, with several hostile arguments
HINGE_SCENE = str(DATA / "hinge.toml")
ARM_SCENE = str(SCENES / "robot_beside_obstacles.toml")
MODEL = twinarm.load(PUMA)
ZERO = np.zeros(6)
twinarm.aba(MODEL, ZERO, ZERO, ZERO)  # fills the workspace


class Raises:
    """Its conversions raise, or return what they may not."""

    def __array__(self, *_, **__):
        raise KeyError("no array")

    def __len__(self):
        return 1 << 62

    def __float__(self):
        raise ZeroDivisionError("no number")

    def __index__(self):
        raise OverflowError("no index")

    def __fspath__(self):
        return 7

    def __bool__(self):
        raise ValueError("no truth")

    def __repr__(self):
        return "Raises()"


def frozen(array):
    array.flags.writeable = False
    return array


def hostile():
    """(description, value); made for each function, as a call may change them."""
    endless = []
    endless.append(endless)
    nested = {}
    nested["a"] = nested
    wild = ["None", "True", "-1", "0", "7", "1 << 31", "1 << 63", "-(1 << 63)", "1 << 64", "10 ** 400", "0.5", "-0.0",
            "1e-320", "1e308", "float('nan')", "float('inf')", "-float('inf')", "1j", "''", "'x'", "'link3'", "'\\0'",
            "'gr\\xfcn'", "'\\udcff'", "'x' * 100000", "'/dev/null/x'", "'..'", "b'gr\\xfcn'", "bytearray(48)",
            "memoryview(bytes(48))", "()", "[]", "[1, 2]", "[0] * 6", "[[0] * 6] * 2", "[[1], [2, 3]]", "['a'] * 6",
            "[None] * 6", "[10 ** 400] * 6", "{}", "{'joint1': 'x'}", "{'x': 1}", "{1: 2}", "{'a.b': float('nan')}",
            "{'coupling.damping': [[]]}", "{'joint1': np.zeros(3)}", "object()", "object", "len", "lambda *a: 1 / 0",
            "lambda *a: 'x'", "Ellipsis", "slice(None, None, 0)", "slice('a')", "range(6)", "iter([0] * 6)",
            "np.zeros(())", "np.zeros(0)", "np.zeros((0, 6))", "np.zeros(5)", "np.zeros((2, 6))", "np.zeros((6, 1))",
            "np.zeros((1, 1, 6))", "np.zeros((3, 0))", "np.zeros((1,) * 30)", "np.full(6, np.nan)",
            "np.full((2, 6), np.inf)", "np.full(6, 1e308)", "np.zeros(6, np.float32)", "np.zeros(6, np.float16)",
            "np.zeros(6, np.longdouble)", "np.zeros(6, np.int8)", "np.zeros(6, '>f8')", "np.zeros(6, complex)",
            "np.zeros(6, bool)", "np.zeros(6, object)", "np.array([None] * 6)", "np.array(['a'] * 6)",
            "np.array([b'gr\\xfcn'] * 6)", "np.zeros(6, 'M8[s]')", "np.zeros(6, [('a', 'f8'), ('b', 'i1')])",
            "np.zeros(12)[::2]", "np.zeros(6)[::-1]", "np.zeros((6, 2))[:, 0]", "np.zeros((6, 6), order='F')",
            "np.zeros((6, 6))[::2, ::3]", "frozen(np.zeros(6))", "np.broadcast_to(0.0, (2, 6))",
            "np.broadcast_to(0.0, (1 << 40, 6))", "np.ma.masked_all(6)", "np.matrix('0 0 0 0 0 0')",
            "np.frombuffer(bytes(49), 'f8', 6, 1)", "np.float32(1)", "np.int64(-1)", "np.bool_(True)", "np.str_('x')",
            "Raises()", "Raises", "MODEL", "MODEL.workspace()", "twinarm.InputError('x')", "twinarm"]
    found = [(text, eval(text)) for text in wild] + [("endless list", endless), ("endless dict", nested)]
    for kind in ("Model", "Workspace", "Simulation", "SceneSimulation", "SavedState", "Samples", "Run", "Recording"):
        made = getattr(twinarm, kind)
        try:
            found.append((f"{kind}.__new__({kind})", made.__new__(made)))
        except TypeError as error:
            assert str(error)
    return found


def good(folder):
    """A valid value of each parameter, by its name."""
    body = {"model": MODEL, "robot": MODEL, "q": ZERO, "qd": ZERO, "tau": ZERO, "qdd": ZERO, "body": "link3",
            "file": HINGE_SCENE, "scene": HINGE_SCENE, "recording": str(folder / "run.twinrec"),
            "M": [[1.0]], "K": [[1.0]], "B": [[0.1]], "scheme": "explicit Euler", "zeta": 0.1, "duration": 0.002,
            "count": 1, "name": "IA", "source": "coupling/x", "key": 0, "kind": None, "value": None, "trace": None,
            "data": {}}
    return body


def members(folder):
    """(name, callable, its parameters) of all that is public."""
    scene = twinarm.SceneSimulation(ARM_SCENE)
    run = scene.run(0.003)
    instances = {"Model": MODEL, "Workspace": MODEL.workspace(), "Simulation": twinarm.Simulation(MODEL),
                 "Samples": run, "Run": run, "Recording": twinarm.open_recording(folder / "run.twinrec"),
                 "SavedState": scene.save(), "Inspection": scene.inspect(), "SceneSimulation": scene}
    for name in (n for n in dir(twinarm) if not n.startswith("_")):
        there = getattr(twinarm, name)
        if inspect.isclass(there):
            if not issubclass(there, Exception):
                yield from members_of(name, there, instances[name])
        elif callable(there):
            yield name, there, reported(there)


def members_of(kind, there, instance):
    if kind.endswith("Simulation"):
        yield f"{kind}()", there, reported(there.__init__)[1:]
    else:
        yield f"{kind}()", there, [("data", "either", "none")]
    for name in dir(there):
        is_special = name in ("__getitem__", "__contains__", "__len__", "__iter__", "__enter__", "__exit__", "__repr__",
                              "__eq__", "__reduce_ex__", "__deepcopy__")
        if name.startswith("_") and not is_special or hasattr(dict, name) and kind == "Inspection" and not is_special:
            continue
        member = inspect.getattr_static(there, name)
        if isinstance(member, property) and member.fset is not None:
            yield f"{kind}.{name}", lambda value, n=name: setattr(instance, n, value), [("value", "either", "none")]
        elif not isinstance(member, property):
            try:
                parameters = reported(member)[1:]
            except Exception:  # without a signature
                parameters = [("key", "either", "none")] if name not in ("__len__", "__iter__", "__repr__") else []
            yield f"{kind}.{name}", getattr(instance, name), parameters


def calls(folder, name, parameters):
    """(description, positional, by name): each parameter replaced by each value, then several at once."""
    values, valid = hostile(), good(folder)
    for parameter, _, default in parameters:
        assert parameter in valid or not isinstance(default, str) or default != "none", f"good(): {name}({parameter})"
    draw = random.Random(name)
    for places in [[p] for p, _, _ in parameters] + [None] * PAIRS:
        for text, value in values if places else [(None, None)]:
            chosen = {places[0]: (text, value)} if places else {
                p: draw.choice(values) for p, _, _ in parameters if draw.random() < 0.6}
            given = {p: chosen.get(p, ("a valid one", valid.get(p))) for p, _, default in parameters
                     if p in chosen or default == "none" or p == "duration"}
            words = ", ".join(f"{p} = {text}" for p, (text, _) in given.items() if text != "a valid one")
            first = [p for p, kind, _ in parameters if kind == "either"]
            first = first[:next((i for i, p in enumerate(first) if p not in given), len(first))]
            if draw.random() < 0.5:
                first = []
            yield (f"{name}({words})", [given[p][1] for p in first],
                   {p: value for p, (_, value) in given.items() if p not in first})
    for count in (0, 1, 7, 300):
        yield f"{name}() with {count} arguments", [ZERO] * count, {}
    for word in ("nothing", "gr\xfcn", "", "\udcff"):
        yield f"{name}({ascii(word)} = 1)", [], {word: 1}


class Interrupted(Exception):
    """Of the clock, as Ctrl-C is of the keyboard."""


def interrupt(*_):
    raise Interrupted("by the clock")


def outcome(function, positional, named):
    """What is wrong; empty if the call returned, or raised an exception with a text."""
    try:
        signal.setitimer(signal.ITIMER_REAL, SECONDS, SECONDS)
        try:
            function(*positional, **named)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
    except SystemError as error:
        return f"SystemError: {error}"
    except Exception as error:
        return "" if text_of(error).strip() else f"{type(error).__name__} without a text"
    return ""


def text_of(error):
    """A KeyError of dict has the text of its key, which may have none."""
    try:
        return str(error)
    except Exception as other:
        return str(other)


def child(folder):
    """Makes all calls; each is written first."""
    if not os.environ.get("ASAN_OPTIONS"):  # sanitizers reserve terabytes of addresses
        resource.setrlimit(resource.RLIMIT_DATA, (3 << 30, 3 << 30))
    resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 26, 1 << 26))
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    signal.signal(signal.SIGALRM, interrupt)
    webbrowser.open = lambda *_: True
    twinarm._viewer.subprocess.run = no_program
    os.chdir(folder)
    count, faults = 0, []
    for name, function, parameters in list(members(folder)):
        for words, positional, named in calls(folder, name, parameters):
            print(ascii(words)[:300], flush=True)
            count += 1
            if wrong := outcome(function, positional, named):
                faults.append(f"{ascii(words)[:300]}: {wrong}")
    q = twinarm.aba(MODEL, ZERO, ZERO, ZERO)
    assert abs(twinarm.rnea(MODEL, ZERO, ZERO, q)).max() < 1e-12
    print(f"made {count} calls", *faults, sep="\n")


def no_program(words, **_):
    return subprocess.CompletedProcess(words, 2, "", "not run by this test")


class HostileArguments(unittest.TestCase):
    def test_no_argument_ends_the_interpreter(self):
        with tempfile.TemporaryDirectory() as place:
            command.twinarm("simulate", ROOT / "assets/scenes/bouncing_ball.toml", "--duration", 0.01, "--record",
                            f"{place}/run.twinrec")
            module = os.path.dirname(os.path.dirname(twinarm.__file__))
            shared = {"PYTHONPATH": os.pathsep.join(sys.path), **PRELOADED}
            with open(f"{place}/calls", "w+") as said:
                done = subprocess.run([sys.executable, "-B", "-X", "faulthandler", __file__, module, command.PROGRAM,
                                       place], stdout=said, stderr=subprocess.PIPE, text=True, timeout=1800,
                                      env={**os.environ, **shared})
                said.seek(0)
                lines = said.read().splitlines()
        self.assertEqual(done.returncode, 0, f"{lines[-1:]}: {done.stderr[-3000:]}")
        made = next(n for n, line in enumerate(lines) if line.startswith("made "))
        self.assertEqual(lines[made + 1:], [])
        self.assertGreater(made, 5000)


if __name__ == "__main__":
    if len(sys.argv) > 1 and os.path.isdir(sys.argv[1]):
        import pathlib
        child(pathlib.Path(sys.argv[1]))
    else:
        main()
