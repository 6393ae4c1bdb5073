"""Reads PNG, and says how far two pictures differ to the eye. Python's own library alone."""
import pathlib
import struct
import zlib

JUST_SEEN = 2.3  # of CIE 1976: a difference that an observer just sees


def read_png(path):
    """(width, height, rows): rows of bytes red, green, blue. With a palette too."""
    data = pathlib.Path(path).read_bytes()
    if data[:8] != b"\x89PNG\r\n\x1a\n":
        raise ValueError(f"{path} is no PNG")
    at, packed, palette = 8, b"", None
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, depth, color, _, _, laced = struct.unpack(">IIBBBBB", body)
            if depth != 8 or color not in (2, 3) or laced:
                raise ValueError(f"{path} is not 8 bits of red, green and blue or of a palette, row by row")
            wide = 3 if color == 2 else 1
        elif kind == b"PLTE":
            palette = [body[k:k + 3] for k in range(0, size, 3)]
        elif kind == b"IDAT":
            packed += body
        at += 12 + size
    raw = zlib.decompress(packed)
    stride = wide * width
    rows, above = [], bytearray(stride)
    for y in range(height):
        line = bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        unfilter(raw[y * (stride + 1)], line, above, wide)
        rows.append(line if wide == 3 else bytearray(b"".join(palette[index] for index in line)))
        above = line
    return width, height, rows


def unfilter(kind, line, above, wide):
    """The five filters of PNG (W3C Recommendation, section 9), undone in place."""
    if kind == 0:
        return
    for i in range(len(line)):
        left = line[i - wide] if i >= wide else 0
        up = above[i]
        if kind == 1:
            guess = left
        elif kind == 2:
            guess = up
        elif kind == 3:
            guess = (left + up) // 2
        else:
            corner = above[i - wide] if i >= wide else 0
            sum_ = left + up - corner
            far = (abs(sum_ - left), abs(sum_ - up), abs(sum_ - corner))
            guess = left if far[0] <= far[1] and far[0] <= far[2] else up if far[1] <= far[2] else corner
        line[i] = (line[i] + guess) & 255


LINEAR = [(s / 255 / 12.92 if s <= 10 else ((s / 255 + 0.055) / 1.055) ** 2.4) for s in range(256)]


def lab(rgb):
    """CIE 1976 L*a*b* under D65 of linear sRGB."""
    r, g, b = rgb
    xyz = ((0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505,
           0.2126 * r + 0.7152 * g + 0.0722 * b,
           (0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089)
    x, y, z = (t ** (1 / 3) if t > 216 / 24389 else (24389 / 27 * t + 16) / 116 for t in xyz)
    return 116 * y - 16, 500 * (x - y), 200 * (y - z)


def blocks(picture, side=6):
    """The mean light of squares of pixels, as the eye has it from a little away."""
    width, height, rows = picture
    found = []
    for y0 in range(0, height - side + 1, side):
        for x0 in range(0, width - side + 1, side):
            sums = [0.0, 0.0, 0.0]
            for row in rows[y0:y0 + side]:
                for k in range(3):
                    sums[k] += sum(LINEAR[v] for v in row[3 * x0 + k:3 * (x0 + side):3])
            found.append(lab([s / side ** 2 for s in sums]))
    return found


def share_seen(a, b):
    """The share of two pictures' squares that are seen to differ. 1 where their sizes do."""
    if a[:2] != b[:2]:
        return 1.0
    pairs = list(zip(blocks(a), blocks(b)))
    seen = sum(1 for p, q in pairs if sum((u - v) ** 2 for u, v in zip(p, q)) > JUST_SEEN ** 2)
    return seen / len(pairs)
