"""The file format of recordings, from docs/recording.md: read into plain values and written again.
Shares nothing with the program."""
import struct
import zlib

MAGIC, VERSION = b"TWINREC\n", 2
TEXT, NUMBER, COUNT, WHOLE, SMALL, FLAG = "text", "d", "Q", "q", "I", "?"
VECTOR = ("d", "d", "d")
GIVEN = ("?", "d")  # an option: whether it was given, and what


def listed(item):
    return ["list", item]


HEADER = (
    TEXT, listed(TEXT), listed((TEXT, TEXT)),              # program, command, files
    TEXT, TEXT, TEXT, FLAG, FLAG, FLAG, FLAG,              # model, state, gravity, how it is read
    GIVEN, GIVEN, GIVEN, GIVEN, TEXT, TEXT,                # duration .. energy bound, as given
    TEXT, NUMBER, NUMBER, WHOLE,                           # integrator, step, duration, seed
    listed((TEXT, TEXT)), listed(TEXT), listed(TEXT))      # columns, couplings, geometries
CONTACT = ("i", "i", NUMBER, VECTOR, VECTOR, VECTOR, VECTOR)
FRAME = (
    WHOLE, NUMBER, COUNT, listed(NUMBER), listed(VECTOR), listed(CONTACT),
    listed(SMALL), listed(NUMBER), listed(SMALL), listed(VECTOR), TEXT)


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


def file_of(found):
    return MAGIC + struct.pack("<I", VERSION) + b"".join(block(*b) for b in found)
