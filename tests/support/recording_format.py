"""The file format of recordings, from docs/reference/recording_file.md: read into plain values and written again.
Shares nothing with the program."""
import json
import struct
import zlib

MAGIC, VERSION = b"TWINREC\n", 3
TEXT, NUMBER, COUNT, WHOLE, SMALL, FLAG = "text", "d", "Q", "q", "I", "?"
VECTOR = ("d", "d", "d")
GIVEN = ("?", "d")  # an option: whether it was given, and what


def listed(item):
    return ["list", item]


HEADER_2 = (                                               # of version 2
    TEXT, listed(TEXT), listed((TEXT, TEXT)),              # program, command, files
    TEXT, TEXT, TEXT, FLAG, FLAG, FLAG, FLAG,              # model, state, gravity, how it is read
    GIVEN, GIVEN, GIVEN, GIVEN, TEXT, TEXT,                # duration .. energy bound, as given
    TEXT, NUMBER, NUMBER, WHOLE,                           # integrator, step, duration, seed
    listed((TEXT, TEXT)), listed(TEXT), listed(TEXT))      # columns, couplings, geometries
CONTACT = ("i", "i", NUMBER, VECTOR, VECTOR, VECTOR, VECTOR)
FRAME = (WHOLE, NUMBER, COUNT, listed(NUMBER), listed(VECTOR), listed(CONTACT), listed(SMALL), listed(NUMBER),
         listed(SMALL), listed(VECTOR), TEXT)


class Reader:
    def __init__(self, data):
        self.data, self.at = data, 0

    def read(self, kind):
        if isinstance(kind, tuple):
            return [self.read(k) for k in kind]
        if isinstance(kind, list):
            return [self.read(kind[1]) for _ in range(self.read(COUNT))]
        if kind == TEXT:
            size = self.read(COUNT)
            self.at += size
            return self.data[self.at - size:self.at]
        value, = struct.unpack_from("<" + kind, self.data, self.at)
        self.at += struct.calcsize("<" + kind)
        return value


def written(kind, value):
    if isinstance(kind, tuple):
        return b"".join(written(k, v) for k, v in zip(kind, value, strict=True))
    if isinstance(kind, list):
        return written(COUNT, len(value)) + b"".join(written(kind[1], v) for v in value)
    if kind == TEXT:
        return written(COUNT, len(value)) + value
    return struct.pack("<" + kind, value)


def decoded(kind, payload):
    reader = Reader(payload)
    value = reader.read(kind)
    assert reader.at == len(payload), "bytes are left over"
    return value


def block(kind, payload):
    data = kind.encode() + struct.pack("<I", len(payload)) + payload
    return data + struct.pack("<I", zlib.crc32(data))


def blocks(data):
    """[(kind, payload)] of a whole file; every checksum is looked at."""
    assert data[:8] == MAGIC and struct.unpack_from("<I", data, 8)[0] == VERSION
    found, at = [], 12
    while at < len(data):
        size, = struct.unpack_from("<I", data, at + 1)
        payload = data[at + 5:at + 5 + size]
        kind = chr(data[at])
        assert data[at:at + 9 + size] == block(kind, payload)
        found.append((kind, payload))
        at += 9 + size
    return found


def file_of(found, version=VERSION):
    return MAGIC + struct.pack("<I", version) + b"".join(block(*b) for b in found)


def header(found):
    return json.loads(found[0][1])


def with_header(found, made):
    return [("H", json.dumps(made).encode()), *found[1:]]


def as_version_2(data):
    """The same recording as programs before version 3 wrote it."""
    found = blocks(data)
    made, run = header(found), header(found)["run"]

    def text(words):
        return words.encode()

    def given(name):
        value = run[name]
        return [value is not None, 0.0 if value is None else float(value)]
    files = [payload for kind, payload in found if kind == "D"]
    values = [text(made["program"]), [text(word) for word in made["command"]],
              [[text(path), data] for path, data in zip(made["files"], files, strict=True)],
              *(text(run[name]) for name in ("model", "state", "gravity")),
              *(run[name] for name in ("floating", "friction", "armature", "strict")),
              *(given(name) for name in ("duration", "step", "tolerance", "energy_bound")),
              text(run["integrator"]), text(run["contact"]),
              text(made["integrator"]), made["step"], made["duration"], made["seed"],
              [[text(column["name"]), text(column["unit"])] for column in made["columns"]],
              [text(name) for name in made["couplings"]], [text(name) for name in made["geometries"]]]
    return file_of([("H", written(HEADER_2, values)), *(b for b in found[1:] if b[0] != "D")], 2)
