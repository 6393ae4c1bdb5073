"""docs/ as a site: titles, links, formulas, no console messages.

    test_site.py [FOLDER_FOR_PICTURES]
"""
import importlib.util
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from browser import NO_BROWSER, Browser, find_browser
from waiting import TIMEOUT

ROOT = pathlib.Path(__file__).resolve().parents[2]
PICTURES = pathlib.Path(sys.argv.pop(1)) if len(sys.argv) > 1 else None
spec = importlib.util.spec_from_file_location("check_site", ROOT / "docs/site/check_site.py")
check_site = importlib.util.module_from_spec(spec)
sys.dont_write_bytecode = True
spec.loader.exec_module(check_site)

HAS_GENERATOR = bool(shutil.which("sphinx-build") and pathlib.Path("/usr/share/javascript/katex").is_dir())


class Checker(unittest.TestCase):
    """Errors that check_site.py finds."""

    def faults(self, **pages):
        with tempfile.TemporaryDirectory() as place:
            for name, body in pages.items():
                (pathlib.Path(place) / f"{name}.html").write_text(body)
            return check_site.faults_of(pathlib.Path(place).resolve())[0]

    def test_valid_links(self):
        self.assertEqual(self.faults(a="<title>A</title><a href='b.html#here'>b</a><a href='https://example.org'>",
                                     b="<title>B</title><p id='here'><img src='data:image/png;base64,AA'>"), [])

    def test_missing_files_of_styles(self):
        with tempfile.TemporaryDirectory() as place:
            folder = pathlib.Path(place).resolve()
            (folder / "a.html").write_text("<title>A</title>")
            (folder / "a.css").write_text("@import url(b.css); p { background: url('data:image/png;base64,AA') }")
            self.assertEqual(check_site.faults_of(folder)[0], ["a.css: b.css leads nowhere"])

    def test_each_error_is_reported(self):
        title = "<title>A</title>"
        for body, said in (("<svg><title>picture</title></svg>", "no title"),
                           (title + "<a href='c.html'>", "leads nowhere"),
                           (title + "<a href='#there'>", "has no there"),
                           (title + "<img src='p.png'>", "leads nowhere"),
                           (title + "<video src='f.mp4'>", "leads nowhere"),
                           (title + "<video poster='p.png'>", "leads nowhere"),
                           (title + "<script src='https://cdn.example.org/x.js'></script>", "no network"),
                           (title + "<link href='//fonts.example.org/x.css'>", "no network")):
            faults = self.faults(a=body)
            self.assertEqual(len(faults), 1, body)
            self.assertIn(said, faults[0])


@unittest.skipUnless(HAS_GENERATOR, "no Sphinx or KaTeX: scripts/setup --docs")
class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.site = pathlib.Path(cls.temporary.name) / "site"
        # As scripts/generate/site, without the check of packages.
        made = subprocess.run(["sphinx-build", "-q", "-W", "--keep-going", "-c", ROOT / "docs/site", "-d",
                               cls.site.parent / "doctrees", "-b", "html", ROOT / "docs", cls.site],
                              capture_output=True, text=True, timeout=TIMEOUT)
        if made.returncode:
            raise AssertionError(made.stderr)
        cls.pages = sorted(cls.site.rglob("*.html"))

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_answers_to_the_lessons_are_in_no_menu(self):
        self.assertTrue((self.site / "learn/lessons/instructor.html").is_file())
        menus = [re.search(r'class="sidebar-tree".*?</aside>', page.read_text(), re.S) for page in self.pages]
        links = [link for menu in menus if menu for link in re.findall(r'href="([^"]*)"', menu[0])]
        self.assertTrue(any(link.endswith("01_six_integrators/lesson.html") for link in links))
        self.assertFalse([link for link in links if link.endswith("instructor.html")])

    def test_titles_and_links(self):
        faults, pages, links = check_site.faults_of(self.site.resolve())
        self.assertEqual(faults, [])
        self.assertGreater(pages, 40)
        self.assertGreater(links, 1000)

    def test_all_pages_of_docs(self):
        for page in (ROOT / "docs").rglob("*.md"):
            self.assertTrue((self.site / page.relative_to(ROOT / "docs")).with_suffix(".html").is_file(), page)

    def test_formulas_are_rendered(self):
        lesson = (self.site / "learn/lessons/01_six_integrators/lesson.html").read_text()
        self.assertGreater(lesson.count('class="katex"'), 20)
        self.assertNotIn("$\\omega", lesson)

    def test_a_picture_that_links_to_a_film_is_a_video(self):
        shown = 0
        for page in (ROOT / "docs").rglob("*.md"):
            films = page.read_text().count(".mp4)")
            html = (self.site / page.relative_to(ROOT / "docs")).with_suffix(".html").read_text()
            self.assertEqual(
                len(re.findall(r'<video controls[^>]* src="[^"]*\.mp4" poster="[^"]*\.png"', html)), films, page)
            shown += films
        self.assertEqual(shown, 3)

    @unittest.skipUnless(find_browser(), NO_BROWSER)
    def test_theme_follows_the_browser_and_a_click(self):
        for dark in (False, True):
            with Browser(width=1500, height=900, dark=dark) as page:
                page.call("Page.navigate", url=(self.site / "understand/contact.html").as_uri())
                page.wait_for("location.protocol === 'file:' && document.readyState === 'complete'")
                red = "Number(getComputedStyle(document.body).backgroundColor.match(/[0-9]+/)[0])"
                self.assertEqual(page.evaluate(red) < 50, dark)
                page.evaluate("document.querySelector('.theme-toggle-content .theme-toggle').click()")
                self.assertEqual(page.evaluate(red) < 50, not dark)

    @unittest.skipUnless(find_browser(), NO_BROWSER)
    def test_search_without_a_server(self):
        with Browser() as page:
            page.call("Page.navigate", url=(self.site / "search.html").as_uri() + "?q=torsional")
            page.wait_for("document.querySelectorAll('#search-results li').length > 3")
            self.assertEqual(page.errors, [])

    @unittest.skipUnless(find_browser(), NO_BROWSER)
    def test_all_pages_open_without_console_messages_or_network(self):
        with Browser(width=1280, height=900) as page:
            for file in self.pages:
                page.errors.clear()
                page.requests.clear()
                page.call("Page.navigate", url=file.as_uri())
                page.wait_for(f"location.href === {file.as_uri()!r} && document.readyState === 'complete'")
                self.assertEqual(page.errors, [], file.name)
                self.assertEqual([url for url in page.requests if not url.startswith(("file:", "data:"))], [], file)
                if PICTURES and file.stem in ("index", "lesson", "contact"):
                    page.picture(PICTURES / f"{file.parent.name}_{file.stem}.png")


if __name__ == "__main__":
    sys.exit(unittest.main())
