#!/usr/bin/env python3
"""Generates the textures of the scenes: boards.png and crate.png, beside this file.

Procedural wood: boards with one tone each and a grain that is stretched along them. 256 x 256 pixels
of 16 colours. Uses the standard library only; the output is the same bytes each time.
"""
import math
import pathlib
import struct
import zlib

SIDE = 256
TONES = 16
DARK, LIGHT = (118, 84, 52), (214, 178, 128)  # sRGB


def noise(x, y, seed):
    """A number in [0, 1) for each point of a grid: a hash."""
    n = (x * 374761393 + y * 668265263 + seed * 974711) & 0xFFFFFFFF
    n = ((n ^ (n >> 13)) * 1274126177) & 0xFFFFFFFF
    return ((n ^ (n >> 16)) & 0xFFFF) / 65536


def smooth_noise(x, y, period, seed):
    """The same between the points, once around in `period` of them."""
    x0, y0 = math.floor(x), math.floor(y)
    s, t = (u * u * (3 - 2 * u) for u in (x - x0, y - y0))

    def at(i, j):
        return noise((x0 + i) % period, y0 + j, seed)

    low = at(0, 0) + s * (at(1, 0) - at(0, 0))
    high = at(0, 1) + s * (at(1, 1) - at(0, 1))
    return low + t * (high - low)


def wood(along, across, board):
    """0 dark to 1 light; both in pixels. The grain is forty times as long as it is wide."""
    bend = 6 * smooth_noise(along / 64, across / 48, 4, board)
    grain = sum(w * smooth_noise(along / length, (across + bend) / width, SIDE // length, board + k)
                for k, (length, width, w) in enumerate(((128, 9, 0.5), (64, 3, 0.3), (32, 1.3, 0.2))))
    return 0.42 + 0.28 * (noise(board, 7, 1) - 0.5) + 0.55 * (grain - 0.5)


def gap(distance):
    """The joint between two boards, in pixels from its middle."""
    return 0.45 * max(0.0, 1 - abs(distance) / 2.5)


def boards(x, y):
    height = SIDE // 5 + 1
    board = y // height
    return wood(x + 61 * board, y, board) - gap(min(y % height, height - y % height))


def crate(x, y):
    frame = 34
    edge = min(x, y, SIDE - 1 - x, SIDE - 1 - y)
    if edge < frame:  # mitred: along whichever side is nearer
        upright = min(x, SIDE - 1 - x) < min(y, SIDE - 1 - y)
        tone = wood(y, x, 11) if upright else wood(x, y, 12)
        return tone + 0.1 - gap(frame - edge) - 0.5 * gap(abs(x - y)) - 0.5 * gap(abs(x + y - SIDE))
    return boards(y, x) - 0.12


def png(of):
    palette = b"".join(bytes(round(a + (b - a) * i / (TONES - 1)) for a, b in zip(DARK, LIGHT))
                       for i in range(TONES))
    rows = bytearray()
    for y in range(SIDE):
        tones = [min(TONES - 1, max(0, round(of(x, y) * (TONES - 1)))) for x in range(SIDE)]
        rows += b"\0" + bytes(tones[i] << 4 | tones[i + 1] for i in range(0, SIDE, 2))

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", SIDE, SIDE, 4, 3, 0, 0, 0))
            + chunk(b"PLTE", palette) + chunk(b"IDAT", zlib.compress(bytes(rows), 9))
            + chunk(b"IEND", b""))


for made in (boards, crate):
    path = pathlib.Path(__file__).resolve().parent / f"{made.__name__}.png"
    path.write_bytes(png(made))
    print(path, path.stat().st_size, "bytes")
