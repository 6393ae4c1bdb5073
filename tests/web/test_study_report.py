"""Report of `twinarm study`: one sentence and one picture, one page, the rest folded; its names, numbers and colours.

    test_study_report.py PATH/TO/twinarm
"""
import html.parser
import json
import pathlib
import re
import tempfile
import unittest

from axe import violations
from browser import NO_BROWSER, Browser, find_browser
from program import ROOT, main, twinarm
from theme_colors import color_of, contrast

VOID = {"meta", "br", "img", "link", "input", "hr", "wbr"}
SIZES = ((1280, 720), (1920, 1080), (1024, 768), (390, 844))
MAX_HEIGHT = 0.4 * 36605  # [px] at a width of 1280; 36605: before anything was folded
PREFIXES = {"n": 1e-9, "µ": 1e-6, "m": 1e-3, "": 1, "k": 1e3, "M": 1e6}
GAIN = re.compile(r"([\d.]+) ([nµmkM]?)N (?:m/rad|m s/rad)|([\d.]+) ([nµmkM]?)N(?:/m| s/m)")
# Of each pair of colours of text and ground: one element that has it.
COLORS = """(() => { const found = {};
  for (const e of document.querySelectorAll('body *')) {
    if (e.closest('svg') || ![...e.childNodes].some(n => n.nodeType === 3 && n.data.trim())) continue;
    let ground = e;
    while (ground && getComputedStyle(ground).backgroundColor === 'rgba(0, 0, 0, 0)') ground = ground.parentElement;
    found[getComputedStyle(e).color + '|' + getComputedStyle(ground).backgroundColor] = e.outerHTML.slice(0, 80);
  }
  return JSON.stringify(found); })()"""


OUT = None  # folder of the study, which runs once


def setUpModule():
    global OUT
    OUT = pathlib.Path(unittest.enterModuleContext(tempfile.TemporaryDirectory(prefix="twinarm-report-")))
    twinarm("study", "--out", OUT)


class Text(html.parser.HTMLParser):
    """Text with the elements that it is in."""

    def __init__(self, text):
        super().__init__()
        self.open, self.pieces, self.open_details = [], [], 0
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.open_details += tag == "details" and "open" in dict(attributes)
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        pass

    def handle_endtag(self, tag):
        while self.open and self.open.pop() != tag:
            pass

    def handle_data(self, data):
        if data.strip() and "style" not in self.open and "svg" not in self.open:
            self.pieces.append((tuple(self.open), " ".join(data.replace("\u00a0", " ").split())))


def is_folded(path):
    """Whether text in these elements is hidden while all details are closed."""
    inside = path[path.index("details") + 1:] if "details" in path else ()
    return bool(inside) and (inside[0] != "summary" or "details" in inside)


class StudyReport(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.json = json.loads((OUT / "study.json").read_text(encoding="utf-8"))
        cls.html = (OUT / "report.html").read_text(encoding="utf-8")
        cls.text = Text(cls.html)
        cls.names = {name for run in cls.json["variants"] for name in run["name"].split("/")}
        entries = json.loads((ROOT / "assets/study/calibration.json").read_text(encoding="utf-8"))["entries"]
        cls.names |= {part for entry in entries for part in entry["name"].split("/")}
        cls.names |= {p["name"] for entry in entries for p in entry["parameters"] if "_" in p["name"]}

    def prose(self):
        return [(path, text) for path, text in self.text.pieces if not {"code", "pre"} & set(path)]

    def rows(self, heading):
        """Cells of the first table after a heading."""
        table = self.html[self.html.index(heading):]
        body = table[table.index("<tbody>"):table.index("</tbody>")]
        return [[re.sub(r"<[^>]*>", "", cell).replace("\u00a0", " ") for cell in re.findall(r"<td.*?</td>", row)]
                for row in body.split("<tr")[2 if "<tr><td" not in body[:20] else 1:]]

    def test_the_first_layer_is_the_papers_title_one_sentence_and_one_picture(self):
        paper = (ROOT / "docs/understand/paper.md").read_text(encoding="utf-8")
        title = " ".join(re.search(r"The paper is \*(.*?)\*", paper, re.S)[1].split())
        texts = [text for _, text in self.prose()]
        first = texts[:texts.index("Findings")]
        self.assertIn(title, first)
        self.assertIn(self.json["answer"][0], first)
        self.assertEqual(self.html[:self.html.index("<h2>")].count("<figure>"), 1)

    def test_everything_but_one_page_is_in_closed_details(self):
        self.assertEqual(self.text.open_details, 0)
        shown = " ".join(text for path, text in self.prose() if not is_folded(path))
        words = len(shown.split())
        self.assertLess(words, 650)  # a page of text
        self.assertGreater(sum(len(text.split()) for _, text in self.prose()), 10 * words)
        for sentence in self.json["answer"][1:]:  # its conclusion; numbers are folded
            self.assertIn(sentence.split(". ")[0].rstrip("."), shown)
        self.assertEqual(sum(path[-1] == "h2" and "details" not in path for path, _ in self.prose()), 3)

    def test_names_of_programs_are_not_shown_as_prose(self):
        self.assertIn("printed-torsional", self.names)
        self.assertIn("findings_set0", self.names)
        ordinary = {"semi-implicit"}  # a word of the field
        hidden = [name for name in self.names - ordinary if re.search(r"[a-z][-_+]", name)]
        for path, text in self.prose():
            words = re.split(r"[\s,;:()\[\]/]+", text)
            self.assertEqual([w for w in words if w in hidden or "_" in w], [], f"{path[-2:]} {text[:200]}")

    def test_powers_are_superscripts(self):
        for path, text in self.prose():
            self.assertIsNone(re.search(r"\d[eE][+-]?\d|\^", text), f"{path[-2:]} {text[:200]}")
        self.assertIn("10<sup>−", self.html)

    def test_gains_with_si_prefixes_are_those_of_the_json_output(self):
        runs = [run for run in self.json["variants"] if run["name"].startswith("trial/")]
        rows = self.rows("<h2>Update rates</h2>")
        self.assertEqual(len(rows), len(runs))
        for run, cells in zip(runs, rows):
            unit = r"N(/m| s/m)$" if "linear" in run["name"] else r"N m( s)?/rad$"
            for cell, name in ((cells[2], "k"), (cells[3], "b")):
                values = [float(m[1] or m[3]) * PREFIXES[m[2] or m[4] or ""] for m in GAIN.finditer(cell)]
                wanted = sorted({run["gains"][name + "1"], run["gains"][name + "2"]})
                self.assertEqual(len(values), len(wanted), cell)
                for value, gain in zip(sorted(values), wanted):
                    self.assertLessEqual(abs(value / gain - 1), 5.1e-3, cell)
                self.assertRegex(cell, unit)

    def test_claims_that_do_not_hold_come_first(self):
        findings = self.json["findings"]
        holding = sum(f["holds"] for f in findings)
        section = self.html[self.html.index(f"Explanation: {holding} of {len(findings)} claims hold"):]
        first, rest = section.split("<details>", 1)
        self.assertEqual(first.count("<tr><td>"), len(findings) - holding)
        self.assertEqual(rest[:rest.index("</details>")].count("<tr><td>"), holding)

    def test_it_is_one_file_without_script_and_network(self):
        self.assertNotIn("<script", self.html)
        self.assertEqual(re.findall(r'(?:src|href)="(?!data:|recordings/|#)([^"]*)', self.html), [])


@unittest.skipUnless(find_browser(), NO_BROWSER)
class StudyReportInBrowser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = cls.enterClassContext(Browser(timeout=120))

    def open(self, width, height, dark=False, unfold=True):
        self.browser.resize(width, height)
        self.browser.prefer(dark)
        self.browser.call("Page.navigate", url="about:blank")
        self.browser.call("Page.navigate", url=(OUT / "report.html").as_uri())
        self.browser.wait_for("document.readyState === 'complete' && !!document.querySelector('footer')")
        if unfold:
            self.browser.evaluate("document.querySelectorAll('details').forEach(d => { d.open = true; })")
        return self.browser.evaluate

    def test_sentence_and_picture_fit_the_first_screen(self):
        for width, height in SIZES[:3]:
            page = self.open(width, height, unfold=False)
            self.assertLess(page("document.querySelector('.headline').getBoundingClientRect().top"), 200)
            self.assertLess(page("document.querySelector('figure').getBoundingClientRect().bottom"), height)
            self.assertLess(page("document.documentElement.scrollHeight"), MAX_HEIGHT)

    def test_nothing_is_cut(self):
        for width, height in SIZES:
            page = self.open(width, height)
            self.assertLessEqual(page("document.documentElement.scrollWidth"), width)
            wide = json.loads(page("JSON.stringify([...document.querySelectorAll('table')].map(t => t.parentElement)"
                                   ".filter(p => p.scrollWidth > p.clientWidth + 1)"
                                   ".map(p => [p.tabIndex, getComputedStyle(p).overflowX]))"))
            self.assertLessEqual({tuple(w) for w in wide}, {(0, "auto")}, width)
            if width >= 1280:
                self.assertEqual(wide, [], width)

    def test_contrast_of_all_text_in_both_themes(self):
        for dark in (False, True):
            found = json.loads(self.open(1280, 720, dark)(COLORS))
            self.assertGreater(len(found), 5)
            grounds = set()
            for pair, element in found.items():
                text, ground = map(color_of, pair.split("|"))
                grounds.add(sum(ground[:3]) < 382)
                self.assertGreaterEqual(contrast(text, ground), 4.5, f"dark: {dark}, {pair}: {element}")
            self.assertEqual(grounds, {dark})

    def test_rules_of_accessibility(self):
        for dark in (False, True):
            self.open(1280, 720, dark=dark)
            self.assertEqual("\n".join(violations(self.browser)), "")

    def test_print_shows_everything(self):
        page = self.open(680, 960, dark=True, unfold=False)
        hidden = ("[...document.querySelectorAll('td, figure')]"
                  ".filter(e => !e.checkVisibility({contentVisibilityAuto: true})).length")
        self.assertGreater(page(hidden), 1000)
        self.browser.call("Emulation.setEmulatedMedia", media="print")
        self.addCleanup(self.browser.call, "Emulation.setEmulatedMedia", media="")
        self.assertEqual(page(hidden), 0)
        self.assertEqual(page("getComputedStyle(document.body).color"), "rgb(28, 33, 38)")


if __name__ == "__main__":
    main()
