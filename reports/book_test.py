#!/usr/bin/python3
"""book_test.py BUILD SOURCE FOLDER: all pages of the manual, without figures and numbers of a run, and what holds between them.

Every link leads to a page and a place that exist, nothing is requested from a network, no page has more elements than a browser
shows within a second, and every page has a title of its own. With Chromium the search finds words and shows their page, from the
disk. Ends with 77 if node or Chromium is missing; VOUSSOIR_NO_SKIP=1 makes that a failure.
"""
import html.parser
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import urllib.parse

sys.dont_write_bytecode = True
import check_drawings

build, source, folder = (pathlib.Path(text).resolve() for text in sys.argv[1:4])
pages = folder / "manual"
# a browser shows 20,000 in a second on an idle core; the largest page of a whole run had 7,500
MOST_ELEMENTS, MOST_OF_FIRST = 12000, 1000


class Page(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.elements, self.ids, self.links, self.loaded, self.titles = 0, set(), [], [], []
        self.in_title = False
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.elements += 1
        values = dict(attributes)
        if "id" in values:
            expect(values["id"] not in self.ids, f"{values['id']} is the anchor of one place only")
            self.ids.add(values["id"])
        if tag == "a" and "href" in values:
            self.links.append(values["href"])
        elif tag in ("script", "link", "img"):
            self.loaded.append(values.get("src", values.get("href", "")))
        self.in_title = tag == "title"

    def handle_data(self, data):
        if self.in_title:
            self.titles.append(data)
            self.in_title = False


def stop(status, text):
    if status == 77 and os.environ.get("VOUSSOIR_NO_SKIP") == "1":
        status = 1
    sys.exit(print(text) or status)


def expect(truth, what):
    if not truth:
        stop(1, f"failed: {what}")


def make():
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "reports").mkdir(parents=True)
    cases = sorted(path.parent.name for path in source.glob("cases/*/README.md"))
    (folder / "reports" / "verdicts.json").write_text(json.dumps(
        {"commit": "none", "compared_with": "", "failures": [], "moved": [], "rows": [], "cases": [{"name": name, "state": "run"} for name in cases]}))
    keys = subprocess.run([build / "app" / "voussoir", "docs"], capture_output=True, check=True)
    (folder / "reports" / "scene_keys.md").write_bytes(keys.stdout)
    done = subprocess.run([build / "reports" / "voussoir_manual", "--source", source, "--build", folder, "--out", f"{pages}.html"],
                          capture_output=True, text=True, check=False)
    expect(done.returncode == 0, f"the manual is made: {done.stderr}")
    expect("no page has" not in done.stdout, f"the manual has what its texts link to: {done.stdout}")
    return cases


def check_links(read):
    links = 0
    for name, page in read.items():
        for link in page.links:
            if re.match("https?:", link):
                continue
            file, _, place = urllib.parse.unquote(link).partition("#")
            if file.startswith("pictures/"):
                expect((pages / file).exists(), f"{name}: {link} exists")
                continue
            target = file or name
            expect(target in read, f"{name}: {link} leads to a page")
            expect(not place or place in read[target].ids, f"{name}: {link} leads to a place of that page")
            links += 1
    return links


def main():
    cases = make()
    read = {path.name: Page(path.read_text()) for path in sorted(pages.glob("*.html"))}
    for name in cases:
        expect(f"{name.replace('_', '-')}.html" in read, f"{name} has a page")
    links = check_links(read)
    for name, page in read.items():
        expect(page.elements <= (MOST_OF_FIRST if name == "index.html" else MOST_ELEMENTS), f"{name} has {page.elements} elements: it opens within a second")
        for file in page.loaded:
            expect(file.startswith("data:") or (not re.match("[a-z]+:|//", file) and (pages / file).exists()), f"{name} loads {file} from its folder")
    broken = check_drawings.broken(pages)
    expect(not broken, f"drawings are well-formed: {broken}")
    titles = [page.titles[0] for page in read.values()]
    expect(len(set(titles)) == len(titles), f"every page has a title of its own: {sorted(title for title in titles if titles.count(title) > 1)}")
    for file in (*pages.glob("*.css"), pages / "manual.js"):
        expect(not re.search("https?://|@import", file.read_text()), f"{file.name} names no address of a network")
    print(f"{len(read)} pages, {links} links, at most {max(page.elements for page in read.values())} elements a page, "
          f"{sum(path.stat().st_size for path in pages.rglob('*') if path.is_file()) / 1e6:.1f} MB")

    node = shutil.which("node") or shutil.which("nodejs")
    if not (node and shutil.which("chromium") and shutil.which("chromedriver")):
        stop(77, "SKIPPED: node, chromium or chromedriver is not installed, the search is not tried")
    done = subprocess.run([node, source / "reports" / "searched_manual_test.mjs", pages], capture_output=True, text=True, check=False)
    expect(done.returncode == 0, f"the search from the disk:\n{done.stdout}{done.stderr}")


main()
