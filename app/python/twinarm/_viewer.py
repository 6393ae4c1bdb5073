"""The replay page of a recording."""
import os
import pathlib
import shutil
import subprocess
import webbrowser

from twinarm import _core
from twinarm._recording import Recording


def _program():
    """The program of this build or installation: build/PRESET/twinarm, or bin/twinarm."""
    here = pathlib.Path(__file__).resolve()
    for place in (here.parents[2] / "twinarm", here.parents[4] / "bin" / "twinarm"):
        if place.is_file() and os.access(place, os.X_OK):
            return str(place)
    found = shutil.which("twinarm")
    if found:
        return found
    raise FileNotFoundError("view() needs the program `twinarm`, which is not beside the module and not in PATH: "
                            "build it by scripts/build")


def view(recording, page=None, *, open=True):
    """Writes the page that replays a recording (animation, plots, energy balance), as `twinarm export` does,
    and opens it in the browser.

      recording  a file, or a Recording
      page       the HTML file; default: beside the recording, with the ending .html
      open       False: only write it

    Returns the path of the page. Raises InputError for files that are not recordings.
    """
    file = pathlib.Path(recording.file if isinstance(recording, Recording) else os.fspath(recording))
    page = pathlib.Path(page) if page is not None else file.with_suffix(".html")
    done = subprocess.run([_program(), "export", str(file), str(page)], stdin=subprocess.DEVNULL,
                          capture_output=True, text=True)
    if done.returncode != 0:
        raise _core.InputError(done.stderr.strip())
    if open:
        webbrowser.open(page.resolve().as_uri())
    return page
