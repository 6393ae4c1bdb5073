"""A page as the program wrote it, read without a browser."""
import array
import base64
import json
import re
import subprocess
import unittest
import zlib

from waiting import TIMEOUT

ARRAYS = {"u8": "B", "i8": "b", "u16": "H", "i16": "h", "u32": "I", "f32": "f", "f64": "d"}


def run(program, *words, code=0):
    """The finished process; it has ended with that code."""
    done = subprocess.run([program, *map(str, words)], capture_output=True, text=True, check=False,
                          timeout=TIMEOUT)
    if done.returncode != code:
        raise AssertionError(f"{words}: {done.returncode}\n{done.stderr}")
    return done


def skip_without_pages(done):
    """Of a finished command that writes a page."""
    if done.returncode == 2 and "there is no page to fill in" in done.stderr:
        raise unittest.SkipTest("the program was built without its pages: scripts/setup --web, then build")


def with_arrays(value, block):
    """The page's JSON with its arrays in the place of what points to them."""
    if isinstance(value, list):
        return [with_arrays(item, block) for item in value]
    if not isinstance(value, dict):
        return value
    if set(value) == {"at", "count", "type"}:
        found = array.array(ARRAYS[value["type"]])
        found.frombytes(block[value["at"]:value["at"] + value["count"] * found.itemsize])
        return found.tolist()
    return {key: with_arrays(item, block) for key, item in value.items()}


def png(rows):
    """The bytes of a picture; rows of (red, green, blue)."""
    def chunk(kind, data):
        body = kind + data
        return len(data).to_bytes(4, "big") + body + zlib.crc32(body).to_bytes(4, "big")
    size = len(rows[0]).to_bytes(4, "big") + len(rows).to_bytes(4, "big")
    lines = b"".join(b"\0" + b"".join(map(bytes, row)) for row in rows)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", size + b"\x08\x02\0\0\0")
            + chunk(b"IDAT", zlib.compress(lines)) + chunk(b"IEND", b""))


def data_of(html):
    """What the page carries."""
    text = re.search(r'<script type="application/json" id="run">(.*?)</script>', html, re.S)
    block = re.search(r'id="run-bytes">(.*?)</script>', html, re.S)
    return with_arrays(json.loads(text[1]), zlib.decompress(base64.b64decode(block[1])))
