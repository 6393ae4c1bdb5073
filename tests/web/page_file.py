"""Data of a page, read without a browser."""
import array
import base64
import json
import re
import tempfile
import unittest
import zlib

import program
from browser import Browser, folder_for_pictures

ARRAYS = {"u8": "B", "i8": "b", "u16": "H", "i16": "h", "u32": "I", "f32": "f", "f64": "d"}


def main():
    """TEST.py PATH/TO/twinarm [FOLDER_FOR_PICTURES] [options of unittest]"""
    PageTest.pictures = folder_for_pictures()
    program.main()


def setUpModule():
    """Skips the file if the program was built without pages."""
    with tempfile.TemporaryDirectory() as folder:
        done = program.run("inspect", "assets/robots/s103/s103.urdf", "--html", f"{folder}/page.html")
        if done.returncode == 2 and "there is no page to fill in" in done.stderr:
            raise unittest.SkipTest("the program was built without its pages: scripts/setup --web, then build")


def page_browser():
    """A small window is faster in software rendering."""
    return Browser(*((1280, 720) if PageTest.pictures else (840, 480)))


class PageTest(unittest.TestCase):
    pictures = None  # a folder

    def picture(self, browser, name):
        if self.pictures:
            browser.picture(self.pictures / f"{name}.png")


def with_arrays(value, block):
    """Replaces references to arrays in the page's JSON by the arrays."""
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
    """PNG of rows of (red, green, blue)."""
    def chunk(kind, data):
        body = kind + data
        return len(data).to_bytes(4, "big") + body + zlib.crc32(body).to_bytes(4, "big")
    size = len(rows[0]).to_bytes(4, "big") + len(rows).to_bytes(4, "big")
    lines = b"".join(b"\0" + b"".join(map(bytes, row)) for row in rows)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", size + b"\x08\x02\0\0\0")
            + chunk(b"IDAT", zlib.compress(lines)) + chunk(b"IEND", b""))


def data_of(html):
    """Embedded data of the page."""
    text = re.search(r'<script type="application/json" id="run">(.*?)</script>', html, re.S)
    block = re.search(r'id="run-bytes">(.*?)</script>', html, re.S)
    return with_arrays(json.loads(text[1]), zlib.decompress(base64.b64decode(block[1])))
