"""Whether a file is whole, by what its own format says. Shares nothing with the program."""
import json
import pathlib
import struct
import zlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
from recording_format import MAGIC


class Half(Exception):
    """A file under its final name that is not whole."""


def recorded_blocks(data):
    """[(kind, begin, end)] of a recording that may be cut short: those that are whole."""
    found, at = [], 12
    if data[:8] != MAGIC:
        return found
    while len(data) - at >= 9:
        size, = struct.unpack_from("<I", data, at + 1)
        end = at + 9 + size
        if end > len(data) or zlib.crc32(data[at:end - 4]) != struct.unpack_from("<I", data, end - 4)[0]:
            break
        found.append((chr(data[at]), at, end))
        at = end
    return found


def map_cells(data):
    """{(ix, iy): line} of the work file of a map (docs/use/parameter_maps.md)."""
    lines = data.decode().split("\n")
    if lines[0] != "# twinarm map 2" or lines[-1]:
        raise Half("no head, or no end")
    table = [line.split(",") for line in lines[1:-1] if not line.startswith("# ")]
    if any(len(row) != len(table[0]) for row in table):
        raise Half("a row is not whole")
    return {tuple(row[:2]): row for row in table[1:]}


def png(data):
    at, kind = 8, b""
    while at < len(data):
        size, = struct.unpack_from(">I", data, at)
        kind = data[at + 4:at + 8]
        if zlib.crc32(data[at + 4:at + 8 + size]) != struct.unpack_from(">I", data, at + 8 + size)[0]:
            raise Half("check sum")
        at += 12 + size
    if not data.startswith(b"\x89PNG\r\n\x1a\n") or kind != b"IEND" or at != len(data):
        raise Half("no end")


def mp4(data):
    at, kinds = 0, []
    while at < len(data):
        size, = struct.unpack_from(">I", data, at)
        kinds.append(data[at + 4:at + 8])
        if size < 8:
            raise Half("a box of no size")
        at += size
    if at != len(data) or not {b"ftyp", b"moov", b"mdat"} <= set(kinds):
        raise Half(f"boxes {kinds}")


def table(data):
    rows = data.decode().split("\n")
    if rows.pop() != "":
        raise Half("the last row has no end")
    rows = [row for row in rows if not row.startswith("#")]
    if len({row.count(",") for row in rows}) != 1 or len(rows) < 2:
        raise Half("rows of different lengths")


def recording(data):
    blocks = recorded_blocks(data)
    if not blocks or blocks[-1][0] != "E" or blocks[-1][2] != len(data):
        raise Half("no mark of its end")


def ends_with(words):
    def check(data):
        if not data.rstrip().endswith(words):
            raise Half(f"it does not end with {words.decode()}")
    return check


CHECKS = {".json": json.loads, ".svg": ends_with(b"</svg>"), ".html": ends_with(b"</html>"), ".png": png, ".mp4": mp4,
          ".csv": table, ".twinrec": recording, ".twinmap": map_cells, ".toml": lambda data: data.decode()}


def check_whole(path):
    """Throws Half; a kind of file that is not known here is one too: it must be looked at."""
    if path.suffix not in CHECKS:
        raise Half(f"{path.name}: nobody knows what this is")
    try:
        CHECKS[path.suffix](path.read_bytes())
    except (Half, ValueError, IndexError, struct.error) as fault:
        raise Half(f"{path.name}: {fault}") from None
