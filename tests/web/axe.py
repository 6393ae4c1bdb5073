"""Rules of WCAG 2.1, levels A and AA, on a page in the browser: axe-core, from the packages of app/web."""
import json
import pathlib
import subprocess
import unittest

from waiting import TIMEOUT

WEB = pathlib.Path(__file__).resolve().parents[2] / "app/web"
SCRIPT = WEB / "node_modules/axe-core/axe.min.js"
TAGS = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa"]


def script():
    """Source of axe-core; installs the packages of the lock file if they are missing."""
    if not SCRIPT.is_file():
        done = subprocess.run(["npm", "ci", "--ignore-scripts", "--prefer-offline", "--loglevel=error"], cwd=WEB,
                              capture_output=True, text=True, timeout=TIMEOUT)
        if not SCRIPT.is_file():
            raise unittest.SkipTest(f"no axe-core: npm ci in app/web needs a network {done.stderr[-200:]}")
    return SCRIPT.read_text(encoding="utf-8")


def violations(page):
    """'rule: element: what is wrong' of each element that violates a rule."""
    if not page.evaluate("typeof axe === 'object'"):
        page.call("Runtime.evaluate", expression=script())
    return page.evaluate("""axe.run(document, {runOnly: %s, resultTypes: ['violations'], iframes: false}).then(found =>
        found.violations.flatMap(({id, nodes}) => nodes.map(({target, failureSummary}) =>
            `${id}: ${target}: ${failureSummary.replace(/\\s+/g, ' ').slice(0, 300)}`)))""" % json.dumps(TAGS))
