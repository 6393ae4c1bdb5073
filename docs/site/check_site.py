#!/usr/bin/env python3
"""Checks a generated site: every page has a title, every link, anchor, picture and style exists, and no page
needs a network.

    check_site.py FOLDER
"""
import html.parser
import pathlib
import re
import sys
import urllib.parse

FETCHED = {"img": ["src"], "script": ["src"], "link": ["href"], "source": ["src"], "iframe": ["src"],
           "video": ["src", "poster"]}


class Page(html.parser.HTMLParser):
    def __init__(self, file):
        super().__init__()
        self.title, self.anchors, self.links, self.fetched = "", set(), [], []
        self.in_title = self.in_picture = False
        self.feed(file.read_text())

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        if tag == "svg":
            self.in_picture = True  # its <title> is not the page's
        self.in_title = tag == "title" and not self.in_picture
        self.anchors.update(values[key] for key in ("id", "name") if values.get(key))
        if tag == "a" and values.get("href"):
            self.links.append(values["href"])
        self.fetched += [values[key] for key in FETCHED.get(tag, []) if values.get(key)]

    def handle_endtag(self, tag):
        self.in_title = False
        self.in_picture = self.in_picture and tag != "svg"

    def handle_data(self, data):
        if self.in_title:
            self.title += data


def faults_of(folder):
    pages = {file: Page(file) for file in sorted(folder.rglob("*.html"))}
    faults = [] if pages else [f"{folder}: no page"]
    for file, page in pages.items():
        name = file.relative_to(folder)
        if not page.title.strip():
            faults.append(f"{name}: no title")
        for link in page.fetched:
            parts = urllib.parse.urlparse(link)
            if parts.netloc or parts.scheme not in ("", "data"):
                faults.append(f"{name}: fetches {link}; a page must need no network")
        for link in page.links + page.fetched:
            faults += [f"{name}: {fault}" for fault in faults_of_link(link, file, pages)]
    for style in folder.rglob("*.css"):
        asked = [link.strip("'\"") for link in re.findall(r"url\(([^)]*)\)", style.read_text())]
        faults += [f"{style.relative_to(folder)}: {fault}"
                   for link in asked for fault in faults_of_link(link, style, {})]
    return faults, len(pages), sum(len(page.links) for page in pages.values())


def faults_of_link(link, file, pages):
    parts = urllib.parse.urlparse(link)
    if parts.scheme or parts.netloc:
        return []  # external: not checked
    target = (file.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else file
    if not target.is_file():
        return [f"{link} leads nowhere"]
    anchor = urllib.parse.unquote(parts.fragment)
    if anchor and target in pages and anchor not in pages[target].anchors:
        return [f"{link}: {target.name} has no {anchor}"]
    return []


def main():
    faults, pages, links = faults_of(pathlib.Path(sys.argv[1]).resolve())
    print("\n".join(faults) + ("\n" if faults else "") + f"{pages} pages, {links} links, {len(faults)} faults",
          file=sys.stderr)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
