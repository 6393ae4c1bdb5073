"""Colours of the pages' themes, and their perception: contrast (WCAG 2.1), differences
(CIEDE2000), colour vision deficiencies (Machado, Oliveira and Fernandes 2009).
"""
import math
import pathlib
import re

SOURCE = pathlib.Path(__file__).resolve().parents[2] / "app/web/src"
STYLES = ("ui/style.css",)

# Severity 1, of linear RGB: table 1 of Machado, Oliveira and Fernandes, IEEE TVCG 15 (2009) 1291.
EYES = {
    "all cones": ((1, 0, 0), (0, 1, 0), (0, 0, 1)),
    "protanopia": ((0.152286, 1.052583, -0.204868), (0.114503, 0.786281, 0.099216), (-0.003882, -0.048116, 1.051998)),
    "deuteranopia": ((0.367322, 0.860646, -0.227968), (0.280085, 0.672501, 0.047413), (-0.011820, 0.042940, 0.968881)),
    "tritanopia": ((1.255528, -0.076749, -0.178779), (-0.078411, 0.930809, 0.147602), (0.004733, 0.691367, 0.303900)),
}


def themes():
    """{'light': {'--ink': (r, g, b, a), ..}, 'dark': ..}, bytes and a share; later files win."""
    found = {"light": {}, "dark": {}}
    for style in STYLES:
        text = re.sub(r"/\*.*?\*/", "", (SOURCE / style).read_text(encoding="utf-8"), flags=re.S)
        for selector, body in re.findall(r"([^{}]*:root[^{}]*)\{([^{}]*)\}", text):
            for name, value in re.findall(r"(--[\w-]+):\s*([^;]+);", body):
                color = color_of(value)
                if color:
                    found["dark" if "dark" in selector else "light"][name] = color
    found["dark"] = found["light"] | found["dark"]
    return found


def color_of(text):
    if match := re.fullmatch(r"#([0-9a-f]{6})", text.strip()):
        return *bytes.fromhex(match[1]), 1.0
    if match := re.fullmatch(r"rgba?\((\d+)[ ,]+(\d+)[ ,]+(\d+)(?:[ ,/]+([\d.]+)(%?))?\)", text.strip()):
        share = float(match[4] or 1) / (100 if match[5] else 1)
        return int(match[1]), int(match[2]), int(match[3]), share
    return None


def over(top, below):
    """A translucent colour over another."""
    share = top[3]
    return *(share * a + (1 - share) * b for a, b in zip(top[:3], below[:3])), 1.0


def linear(color):
    return [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in (value / 255 for value in color[:3])]


def luminance(color):
    return sum(weight * value for weight, value in zip((0.2126, 0.7152, 0.0722), linear(color)))


def contrast(one, other):
    high, low = sorted((luminance(one), luminance(other)), reverse=True)
    return (high + 0.05) / (low + 0.05)


def lab(color, eyes="all cones"):
    """CIELAB (D65) of a colour, with a colour vision deficiency."""
    rgb = linear(color)
    r, g, b = (min(1, max(0, sum(m * c for m, c in zip(row, rgb)))) for row in EYES[eyes])
    x = (0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / 0.95047
    y = 0.2126729 * r + 0.7151522 * g + 0.0721750 * b
    z = (0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / 1.08883
    f = [t ** (1 / 3) if t > 216 / 24389 else (24389 / 27 * t + 16) / 116 for t in (x, y, z)]
    return 116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])


def delta_e(one, other):
    """CIEDE2000 of two CIELAB colours (Sharma, Wu and Dalal 2005)."""
    (l1, a1, b1), (l2, a2, b2) = one, other
    mean_c = (math.hypot(a1, b1) + math.hypot(a2, b2)) / 2
    g = 0.5 * (1 - math.sqrt(mean_c ** 7 / (mean_c ** 7 + 25 ** 7)))
    a1, a2 = (1 + g) * a1, (1 + g) * a2
    c1, c2 = math.hypot(a1, b1), math.hypot(a2, b2)
    h1, h2 = math.degrees(math.atan2(b1, a1)) % 360, math.degrees(math.atan2(b2, a2)) % 360
    turn = 0 if c1 * c2 == 0 else (h2 - h1 + 180) % 360 - 180
    if c1 * c2 and (h2 - h1) % 360 == 180:
        turn = 180
    big_h = 2 * math.sqrt(c1 * c2) * math.sin(math.radians(turn / 2))
    mean_l, mean_c = (l1 + l2) / 2, (c1 + c2) / 2
    mean_h = h1 + h2 if c1 * c2 == 0 else (h1 + turn / 2) % 360
    t = (1 - 0.17 * math.cos(math.radians(mean_h - 30)) + 0.24 * math.cos(math.radians(2 * mean_h))
         + 0.32 * math.cos(math.radians(3 * mean_h + 6)) - 0.20 * math.cos(math.radians(4 * mean_h - 63)))
    s_l = 1 + 0.015 * (mean_l - 50) ** 2 / math.sqrt(20 + (mean_l - 50) ** 2)
    s_c, s_h = 1 + 0.045 * mean_c, 1 + 0.015 * mean_c * t
    r_t = (-2 * math.sqrt(mean_c ** 7 / (mean_c ** 7 + 25 ** 7))
           * math.sin(math.radians(60 * math.exp(-((mean_h - 275) / 25) ** 2))))
    dl, dc, dh = (l2 - l1) / s_l, (c2 - c1) / s_c, big_h / s_h
    return math.sqrt(dl * dl + dc * dc + dh * dh + r_t * dc * dh)
