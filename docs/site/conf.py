"""Sphinx configuration of the offline documentation site: scripts/generate/site.

KaTeX renders formulas at build time (katex_lines.js, one process for all pages), so pages contain them as HTML and
MathML and need no script.
"""
import atexit
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).parent
sys.path.insert(0, str(HERE))
sys.dont_write_bytecode = True
import commands

PROGRAM = HERE.parents[1] / "build/release/twinarm"
KATEX = pathlib.Path("/usr/share/javascript/katex")  # Debian's libjs-katex
NORMALIZE = pathlib.Path("/usr/share/javascript/normalize.css/normalize.css")  # imported by Furo

ANSWERS = "learn/lessons/instructor"

project = "twinarm"
html_title = "twinarm"
copyright = "the authors of twinarm; BSD-3-Clause"
language = "en"
smartquotes = False  # an option is --json, and JSON has straight quotes
root_doc = "index"
extensions = ["myst_parser"]
exclude_patterns = ["site"]
highlight_language = "none"

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4  # of each heading, as GitHub has them
suppress_warnings = ["myst.header"]

html_theme = "furo"
html_static_path = ["static"]
html_css_files = ["katex.min.css", "site.css"]
html_show_sphinx = False
html_show_search_summary = False  # a page on disk may not read the others
html_copy_source = False
html_math_renderer = "katex"
html_theme_options = {"navigation_with_keys": True}


class Katex:
    """KaTeX in a child process: one formula per input line, its HTML per output line."""

    process = None

    def html(self, formula, display):
        if self.process is None:
            self.process = subprocess.Popen(["node", HERE / "katex_lines.js", KATEX / "katex.js"], text=True,
                                            stdin=subprocess.PIPE, stdout=subprocess.PIPE)
            atexit.register(self.process.kill)
        self.process.stdin.write(json.dumps({"formula": formula, "display": display}) + "\n")
        self.process.stdin.flush()
        answer = json.loads(self.process.stdout.readline())
        if "error" in answer:
            raise ValueError(f"{answer['error']} in {formula}")
        return answer["html"]


katex = Katex()


def visit_inline(translator, node):
    translator.body.append(katex.html(node.astext(), False))
    raise_skip()


def visit_block(translator, node):
    translator.body.append(f'<div class="formula">{katex.html(node.astext(), True)}</div>')
    raise_skip()


def raise_skip():
    from docutils.nodes import SkipNode
    raise SkipNode


def name_what_is_outside(app, docname, source):
    """A link to a Markdown file outside docs/ becomes plain text: that file is in the sources, not on the site."""
    here = pathlib.Path(app.env.doc2path(docname)).parent

    def words(link):
        target = (here / link[2]).resolve()
        outside = not target.is_relative_to(pathlib.Path(app.srcdir).resolve())
        return link[1] if outside and target.is_file() else link[0]  # a broken link stays, and is reported

    source[0] = re.sub(r"\[([^\]]*)\]\((\.\./[^)#]*\.md)(?:#[^)]*)?\)", words, source[0])


def set_the_commands(app, docname, source):
    """Inserts the program's manual; without a built program, a line that says so."""
    if docname != "reference/commands":
        return
    program = os.environ.get("TWINARM_PROGRAM", PROGRAM)
    try:
        made = subprocess.run([program, "help", "--man"], capture_output=True, text=True, check=True, timeout=60)
        text = commands.markdown_of(made.stdout)
    except (OSError, subprocess.SubprocessError):
        text = ("**Not here: the program was not built when this site was made.** "
                "`scripts/build`, then `scripts/generate/site`.")
        print(f"scripts/generate/site: {program} is not built: the site is made without the list of commands",
              file=sys.stderr)
    source[0] = source[0].replace("<!-- commands -->", text)


def link_the_headers(app, docname, source):
    """Links the pages that Doxygen generates from the headers (scripts/generate/site)."""
    if docname == "reference/cpp_api" and os.environ.get("TWINARM_HEADERS"):
        source[0] = source[0].replace("<!-- headers -->", '<p><a href="../headers/index.html">To the headers</a></p>')


def make_toctrees(app, docname, source):
    """index.md is the one table of contents: the links of each section become a toctree. A page that it does not link
    is an error, except the lessons and the texts of the analytic cases. The answers to the lessons are in no menu."""
    if docname == ANSWERS:
        source[0] = f"---\norphan: true\n---\n{source[0]}"
    if docname != root_doc:
        return
    listed = set()
    for caption, text in re.findall(r"^## (.+?)\n(.*?)(?=^## |\Z)", source[0], re.M | re.S):
        pages = re.findall(r"\]\((\w[^)#:]*)\.md\)", text)
        if "learn/lessons/README" in pages:
            lessons = sorted(name for name in app.env.found_docs if name.endswith("/lesson"))
            pages[pages.index("learn/lessons/README") + 1:0] = lessons
        listed |= set(pages)
        pages = [page for page in pages if page != ANSWERS]
        source[0] += "\n".join(["", "```{toctree}", ":hidden:", f":caption: {caption}", "", *pages, "```", ""])
    lost = sorted(name for name in app.env.found_docs - listed - {root_doc} if not name.startswith("reference/cases/"))
    if lost:
        raise ValueError(f"docs/index.md does not link {', '.join(lost)}")


def show_videos(app, pagename, templatename, context, doctree):
    """A picture that links to an MP4 file becomes that video, with the picture as its poster."""
    context["body"] = re.sub(
        r'<a [^>]*href="([^"]+\.mp4)"[^>]*>\s*(?:<span[^>]*>)?'
        r'<img alt="([^"]*)"[^>]* src="([^"]+)"[^>]*>(?:</span>)?\s*</a>',
        r'<video controls preload="none" src="\1" poster="\3" aria-label="\2"></video>', context.get("body", ""))


def complete_roles(app, pagename, templatename, context, doctree):
    """Captions of the tables of contents are headings, which need a level; the keyboard scrolls wide program text."""
    context["body"] = context.get("body", "").replace("<pre>", '<pre tabindex="0">')
    for part in ("body", "toc", "furo_navigation_tree"):
        context[part] = context.get(part, "").replace('role="heading"', 'role="heading" aria-level="2"')


def bring_styles(app, error):
    """Adds KaTeX's styles, and what Debian's Furo lacks: its base style, the module that its script imports (a page
    opened from disk cannot import modules), and dark colours."""
    if error:
        return
    static = pathlib.Path(app.outdir) / "_static"
    shutil.copy(KATEX / "katex.min.css", static)
    shutil.copytree(KATEX / "fonts", static / "fonts", dirs_exist_ok=True)
    shutil.copy(NORMALIZE, static / "styles")
    furo = static / "styles/furo.css"
    style = furo.read_text().replace("/javascript/normalize.css/", "")
    dark = re.search(r'body\[data-theme="dark"\] \{([^}]*)\}', style)[1]
    auto = f'@media screen and (prefers-color-scheme: dark) {{ body:not([data-theme="light"]) {{{dark}}} }}'
    furo.write_text(f"{style}\n{auto}\n")
    script = static / "scripts/furo.js"
    scroll = (static / "scripts/gumshoe-patched.js").read_text()
    script.write_text(scroll + script.read_text().replace('import Gumshoe from "./gumshoe-patched.js";', ""))


def setup(app):
    app.connect("html-page-context", show_videos)
    app.connect("html-page-context", complete_roles, priority=900)  # after Furo's
    app.connect("build-finished", bring_styles)
    app.connect("source-read", name_what_is_outside)
    app.connect("source-read", set_the_commands)
    app.connect("source-read", link_the_headers)
    app.connect("source-read", make_toctrees)
    app.add_html_math_renderer("katex", (visit_inline, None), (visit_block, None))
