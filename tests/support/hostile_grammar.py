"""Changes of a file that somebody could make by mistake or on purpose: by key and value, by line, by byte.
scripts/check/hostile."""
import re
import struct

import recording_format

# key = value of TOML, "key": value of JSON, key="value" of XML; a value is a text, a list, a table or a word.
PAIR = re.compile(
    r"""(?<![\w.:-])("?[\w.:-]{1,60}"?)(\s*[=:]\s*)"""
    r"""("(?:[^"\\\n]|\\.)*"|'[^'\n]*'|\[[^\[\]]*\]|\{[^{}]*\}|[^\s,}\]#>]+)""")
NUMBER = re.compile(r"(?<![\w.])-?\d+\.?\d*(?:e-?\d+)?(?![\w.])", re.I)
NAME = re.compile(r'"([A-Za-z]\w*)"')
LINE = re.compile(r".*\n?")
VALUES = ["0", "-1", "1", "2.5", "1e9", "-1e9", "1e308", "1e-308", "1e400", "nan", "inf", "-inf", "NaN", "true",
          "false", "null", '""', '"x"', '"nothing"', "[]", "{}", "[1]", "[1, 2]", "[1, 2, 3]", "[0, 0, 0]",
          "[1, 2, 3, 4]",
          "[nan, 0, 0]", "[1e300, 1e300, 1e300]", '["a", "b"]', "[[[]]]", "9999999999999999999999", "0x10", "1_000",
          "1.2.3", "2020-01-01", '"../../../../etc/passwd"', '"/dev/zero"', '"."', '"gr\udcfcn"', '"\x01"',
          '"' + "a" * 3000 + '"', "[" + "1, " * 3000 + "1]", "[" * 300 + "]" * 300, "{ a = " * 50 + "1" + " }" * 50]
ENCODINGS = ["utf-16", "utf-8-sig", "latin-1", "utf-32"]


def quoted(old, new):
    """XML has its values in quotes, whatever they are."""
    return '"' + new.strip('"').replace('"', "'") + '"' if old.startswith('"') and not new.startswith('"') else new


def change_pair(text, dice, is_xml):
    pairs = list(PAIR.finditer(text))
    if not pairs:
        return text
    pair = dice.choice(pairs)
    key, sign, value = pair.groups()
    other = dice.choice(pairs)
    name = dice.choice(NAME.findall(text) or ["a"])
    found = NUMBER.search(value)
    number = found[0] if found else "1"
    scaled = value.replace(number, f"{dice.choice((-1, 0, 1, 1e3, 1e-3, 1e12, 1e-12, 1e200)) * float(number):g}", 1)
    shorter = re.sub(r"[\s,]*-?[\d.]+(?=\]|\"?$)", "", value, count=1)
    with_key = lambda words, made: words + sign + made
    new = dice.choice([
        lambda: "", lambda: pair[0] + (" " if is_xml else "\n") + pair[0], lambda: with_key(key, scaled),
        lambda: with_key(key, scaled), lambda: with_key(key, shorter), lambda: with_key(key, other[3]),
        lambda: with_key(other[1], value), lambda: with_key(key, f'"{name}"'), lambda: with_key(key, f'"{name}_"'),
        lambda: with_key(key[:1] + "x" + key[1:], value), lambda: with_key(key + ".a", value),
        lambda: with_key(key, "[" + value + "]"), lambda: with_key(key, "{ a = " + value + " }"),
        lambda: with_key(key, quoted(value if is_xml else "", dice.choice(VALUES))),
        lambda: with_key(key, quoted(value if is_xml else "", dice.choice(VALUES)))])()
    return text[:pair.start()] + new + text[pair.end():]


def change_lines(text, dice, is_xml):
    parts = re.split(r"(?=<\w)", text) if is_xml else LINE.findall(text)
    at, to = dice.randrange(len(parts)), dice.randrange(len(parts))
    first, last = min(at, to), max(at, to) + 1
    return "".join(dice.choice([
        lambda: parts[:at] + parts[at + 1:], lambda: parts[:first] + parts[last:],
        lambda: parts + parts[first:last], lambda: parts[:at] + [parts[at]] * 2 + parts[at + 1:],
        lambda: parts[:at] + [parts[at]] * 300 + parts[at + 1:], lambda: parts[:at] + [parts[to]] + parts[at + 1:],
        lambda: parts[:at] + [dice.choice(PIECES)] + parts[at:], lambda: parts[:at]])())


PIECES = ["\n", "x", "[[body]]\n", "[[robot]]\n", "[[coupling]]\n", "[[constraint]]\n", "[[pair]]\n", "[a]\n",
          "a = 1\n", "<a/>", "<link/>", "<joint/>", '<link name="a"/>', "<!-- ", "]]>", "&a;", "{", "}", "[", "]", ",",
          "\0", "# " + "a" * 70000 + "\n", "<a>" * 300, "[[" + "a." * 150 + "a]]\n", "1e999\n", "t[s]\n", "0,0,0\n",
          "nan,nan,nan,nan,nan,nan,nan\n", '<!DOCTYPE a [<!ENTITY a "a"><!ENTITY b "&a;&a;">]>',
          '<xi:include href="/etc/passwd"/>', '<xacro:arm/>', '"a": 1,']


def change_cells(text, dice, _):
    rows = [line.split(",") for line in text.splitlines()]
    if not rows:
        return text
    row = dice.choice(rows[:6])
    row[dice.randrange(len(row))] = dice.choice(
        ["", "x", "nan", "inf", "1e400", "-1", "1e9", '"', "theta1[deg]", "t[s]"])
    return "\n".join(",".join(row) for row in rows)


def change_bytes(data, dice):
    data = bytearray(data)
    kind = dice.randrange(6)
    if kind == 0 or not data:
        return bytes(data[:dice.randrange(len(data) + 1)])
    if kind == 1:
        return bytes(data) + dice.randbytes(dice.randrange(1, 50))
    at = dice.randrange(len(data))
    if kind == 2:
        data[at:at + 4] = struct.pack("<I", dice.choice((0, 1, 0x7fffffff, 0xffffffff, 1 << 20)))
    elif kind == 3:
        data[at:at + 8] = struct.pack("<d", dice.choice((float("nan"), float("inf"), 1e308, -1.0, 0.0)))
    elif kind == 4:
        del data[at:at + dice.randrange(1, 20)]
    else:
        for _ in range(dice.choice((1, 1, 2, 8))):
            data[dice.randrange(len(data))] ^= 1 << dice.randrange(8)
    return bytes(data)


def change_recording(data, dice):
    """Its checksums are right, half of the time."""
    try:
        found = recording_format.blocks(data)
    except (AssertionError, struct.error, IndexError):
        return change_bytes(data, dice)
    at = dice.randrange(len(found)) if dice.random() < 0.5 else 0
    kind, payload = found[at]
    how = dice.randrange(5)
    if how == 0:
        return change_bytes(data, dice)
    if how == 1:
        del found[at]
    elif how == 2:
        found.insert(dice.randrange(len(found)), found[at])
    elif kind == "H" or (kind == "D" and how == 3):
        found[at] = kind, changed("header.json" if kind == "H" else "a.toml", payload, dice)
    else:
        found[at] = kind, change_bytes(payload, dice)
    return recording_format.file_of(found, dice.choice((4, 4, 4, 4, 4, 3, 2, 9)))


def changed(name, data, dice):
    """One or two changes, of a kind that this file may have."""
    if name.endswith(".twinrec"):
        return change_recording(data, dice)
    is_text = b"\0" not in data[:2000] and not name.endswith((".png", ".jpg", ".stl", ".glb"))
    for _ in range(dice.choice((1, 1, 1, 2, 3))):
        if not is_text or dice.random() < 0.08:
            data = change_bytes(data, dice)
        elif dice.random() < 0.04:
            data = data.decode("utf-8", "surrogateescape").encode(dice.choice(ENCODINGS), "replace")
            break
        else:
            text, is_xml = data.decode("utf-8", "surrogateescape"), name.endswith((".urdf", ".dae"))
            how = dice.choice([change_pair] * 3 + [change_lines])
            if name.endswith(".csv") and dice.random() < 0.7:
                how = change_cells
            data = how(text, dice, is_xml).encode("utf-8", "surrogateescape")
    return data
