"""The hash of a scene's whole memory (docs/use/record_and_resume.md) after some steps, and the table of what it was.

The same input gives the same bits, whatever the width of the registers and the C library
(scripts/cmake/libm.cmake). Only whether multiply-adds are fused matters: hashes are those of the generic
level, which every x86-64 has and which fuses none.
"""
import os
import pathlib
import subprocess
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
import recording_format
from waiting import TIMEOUT

SCENES = sorted((ROOT / "assets/scenes").glob("*.toml"))
TABLE = ROOT / "tests/cli/golden_hashes.toml"
STEPS = 500  # of a scene that is new in the table, or all that it has
GENERIC = dict(os.environ, TWINARM_ISA="generic")
HEAD = """# Of each scene in assets/scenes: after so many steps, FNV-1a (64 bits) of all that the next step reads
# (docs/use/record_and_resume.md). A change that is meant to change no motion changes no line here. Where one is meant
# to: scripts/check/same_bits --renew writes the table anew; say in the message of the commit why.
# At the generic level (golden_hashes.py), so the same on every x86-64. Whether g++ and clang agree:
# scripts/check/same_bits.
"""


def read_table():
    return tomllib.loads(TABLE.read_text())


def write_table(rows):
    width = max(map(len, rows))
    TABLE.write_text(HEAD + "".join(f'{name:{width}} = {{ steps = {row["steps"]}, hash = "{row["hash"]}" }}\n'
                                    for name, row in sorted(rows.items())))


def run(program, scene, steps, file, every_step=False, environment=GENERIC):
    """Records so many steps of a scene into `file`."""
    step = tomllib.loads(scene.read_text())["step"]
    duration = steps * step
    words = [program, "simulate", scene, "--duration", repr(duration), "--record", file, "--json"]
    if not every_step:
        words += ["--record-every", repr(duration)]
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=TIMEOUT, cwd=ROOT,
                          env=environment)
    if done.returncode != 0:
        raise RuntimeError(f"{scene.name}: exit code {done.returncode}\n{done.stderr}")


def steps_of(scene):
    reported = tomllib.loads(scene.read_text())
    return min(STEPS, round(reported["duration"] / reported["step"]))


def frames(file):
    """[(frame, memory)] of a recording (recording_format.py)."""
    return recording_format.frames(recording_format.blocks(file.read_bytes()))


def columns(file):
    header = recording_format.header(recording_format.blocks(file.read_bytes()))
    return [column["name"] for column in header["columns"]]


def golden(program, scene, steps, folder, environment=GENERIC):
    """The hash after so many steps."""
    file = pathlib.Path(folder) / f"{scene.stem}.twinrec"
    run(program, scene, steps, file, environment=environment)
    frame, memory = frames(file)[-1]
    if frame[0] != steps:
        raise RuntimeError(f"{scene.name}: {frame[0]} steps, not {steps}")
    return f"{recording_format.fnv(memory):016x}"
