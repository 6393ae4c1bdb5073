"""The file format of recordings, from docs/reference/recording_file.md: read into plain values and written again.
Shares nothing with the program."""
import ctypes
import json
import struct
import zlib

MAGIC, VERSION = b"TWINREC\n", 4
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
NUMBERS, VECTORS, CONTACTS, SMALLS = listed(NUMBER), listed(VECTOR), listed(CONTACT), listed(SMALL)
# Step, time, q, qd, values, coupling forces, contacts, works, momenta, rows, momentum rows.
FRAME = (WHOLE, NUMBER, NUMBERS, NUMBERS, NUMBERS, VECTORS, CONTACTS, NUMBERS, VECTORS, SMALLS, SMALLS)
# Of versions 2 and 3: step, time, hash, values .. contacts, rows, works, momentum rows, momenta, memory.
FRAME_3 = (WHOLE, NUMBER, COUNT, NUMBERS, VECTORS, CONTACTS, SMALLS, NUMBERS, SMALLS, VECTORS, TEXT)
ZSTD = ctypes.CDLL("libzstd.so.1")
ZSTD_LEVEL = 1
PERIOD, REPEATED = 14, 9  # words of a contact; a length


def compressed(data):
    made = ctypes.create_string_buffer(len(data) + (len(data) >> 8) + 64)
    size = ZSTD.ZSTD_compress(made, ctypes.c_size_t(len(made)), data, ctypes.c_size_t(len(data)), ZSTD_LEVEL)
    assert 0 < size <= len(made)
    return made.raw[:size]


def decompressed(data):
    size = ZSTD.ZSTD_getFrameContentSize(data, ctypes.c_size_t(len(data)))
    made = ctypes.create_string_buffer(size + 1)
    assert ZSTD.ZSTD_decompress(made, ctypes.c_size_t(size), data, ctypes.c_size_t(len(data))) == size
    return made.raw[:size]


class Coder:
    """Frames as differences of their words of 8 bytes; the differences begin at each keyframe."""

    def __init__(self):
        self.before, self.earlier = [], []

    def predictions(self, count):
        self.is_new_size = len(self.before) != count
        self.before, self.earlier = ((words + [0] * count)[:count] for words in (self.before, self.earlier))
        return [(2 * b - e) % 2**64 for b, e in zip(self.before, self.earlier)]

    def keep(self, words):
        self.before, self.earlier = words, words if self.is_new_size else self.before

    def encoded(self, data):
        """The size with the lengths, and the bytes that are kept."""
        words = [word for word, in struct.iter_unpack("<Q", data + bytes(-len(data) % 8))]
        differences, lengths, kept = [], [], b""
        for i, (word, guess) in enumerate(zip(words, self.predictions(len(words)))):
            difference = (word - guess + 2**63) % 2**64 - 2**63
            differences.append(2 * difference if difference >= 0 else -2 * difference - 1)
            lengths.append((differences[i].bit_length() + 7) // 8)
            if lengths[i] > 1 and i >= PERIOD and differences[i] == differences[i - PERIOD]:
                lengths[i] = REPEATED
            else:
                kept += differences[i].to_bytes(lengths[i], "little")
        self.keep(words)
        lengths += [0] * (len(lengths) % 2)
        return struct.pack("<Q", len(data)) + bytes(a + 16 * b for a, b in zip(lengths[::2], lengths[1::2])), kept

    def decoded(self, lengths, kept):
        size, = struct.unpack_from("<Q", lengths)
        at, words, differences = 0, [], []
        for i, guess in enumerate(self.predictions((size + 7) // 8)):
            length = lengths[8 + i // 2] >> 4 * (i % 2) & 15
            if length == REPEATED:
                differences.append(differences[i - PERIOD])
            else:
                differences.append(int.from_bytes(kept[at:at + length], "little"))
                at += length
            half, odd = divmod(differences[i], 2)
            words.append((guess + (-half - 1 if odd else half)) % 2**64)
        assert at == len(kept), "bytes are left over"
        self.keep(words)
        return b"".join(struct.pack("<Q", word) for word in words)[:size]


def frame_payload(start, lengths, kept):
    return start + compressed(lengths) + kept


def parts_of_frame(payload):
    """The arguments of frame_payload()."""
    at = 16 + ZSTD.ZSTD_findFrameCompressedSize(payload[16:], ctypes.c_size_t(len(payload) - 16))
    return payload[:16], decompressed(payload[16:at]), payload[at:]


def frames(found):
    """[(frame, memory)]; memory: None where the frame is not a keyframe."""
    all_frames, memory = [], None
    for kind, payload in found:
        if kind == "S":
            memory, coder = decompressed(payload), Coder()
        elif kind == "F":
            start, *coded = parts_of_frame(payload)
            values = start + coder.decoded(*coded)
            all_frames.append((decoded(FRAME, values), memory))
            memory = None
    return all_frames


def frame_blocks(all_frames):
    """The blocks of such frames."""
    made = []
    for frame, memory in all_frames:
        if memory is not None:
            made.append(("S", compressed(memory)))
            coder = Coder()
        values = written(FRAME, frame)
        made.append(("F", frame_payload(values[:16], *coder.encoded(values[16:]))))
    return made


def fnv(data):
    """FNV-1a, 64 bits."""
    value = 0xcbf29ce484222325
    for byte in data:
        value = (value ^ byte) * 0x100000001b3 % 2**64
    return value


def state_hash(frame):
    return fnv(b"".join(written(kind, value) for kind, value in zip(FRAME[1:4], frame[1:4])))


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


def blocks(data, version=VERSION):
    """[(kind, payload)] of a whole file; every checksum is looked at."""
    assert data[:8] == MAGIC and struct.unpack_from("<I", data, 8)[0] == version
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


LAYOUT_3 = ["step int64", "t float64 s", "hash uint64", "values float64[]", "pulls float64[][3]", None, "rows uint32[]",
            "works float64[] J", "momentum_rows uint32[]", "momenta float64[][3]", "memory uint8[]"]


def as_version_3(data):
    """The blocks of the same recording as programs before version 4 wrote it; all its frames have memory."""
    found = blocks(data)
    made = header(found)
    contacts, = (field for field in made["frame"] if field.startswith("contacts"))
    made["frame"] = [field or contacts for field in LAYOUT_3]
    changed = iter(written(FRAME_3, [step, t, fnv(memory), values, forces, points, rows, works, momentum_rows, momenta,
                                     memory])
                   for (step, t, _, _, values, forces, points, works, momenta, rows, momentum_rows), memory
                   in frames(found))
    return with_header([(kind, next(changed) if kind == "F" else payload) for kind, payload in found if kind != "S"],
                       made)


def as_version_2(data):
    """The same recording as programs before version 3 wrote it."""
    found = as_version_3(data)
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
