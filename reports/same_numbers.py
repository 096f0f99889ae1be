#!/usr/bin/python3
"""same_numbers.py MANUAL.print.html MANUAL.pdf: whether the printed manual has the text and numbers of the page.

Every title, every row of a table with its numbers, and every line of a scene must be in the PDF's text, and every
title of the first two levels in its outline; the list of contents must have the page on which each title is. Blanks do not count, since print breaks lines elsewhere. Names the missing
ones, and ends with 1; with 77 without poppler-utils.
"""
import html.parser
import re
import shutil
import subprocess
import sys


def squeezed(text):
    return "".join(text.split())


drawn = "\0"  # marks a formula or picture within a text, whose letters the PDF has in another order


class Page(html.parser.HTMLParser):
    """titles: (level, text); rows: texts of table rows; lines: of preformatted text; contents: (anchor, title) of the list that has page numbers"""

    def __init__(self):
        super().__init__(convert_charrefs=True)
        self.titles, self.rows, self.lines, self.contents = [], [], [], []
        self.entry = None
        self.open, self.skipped, self.hidden = [], 0, 0

    def handle_starttag(self, tag, attributes):
        if tag in ("script", "style", "svg", "math"):
            self.skipped += 1
            if self.open:
                self.open[-1][1] += drawn
        values = dict(attributes)
        if tag == "li":
            self.entry = ""
        elif tag == "span" and "data-page" in values:
            self.contents.append((values["data-page"], self.entry))
        if tag == "br" or self.skipped:
            return
        if tag in ("h1", "h2", "h3", "h4", "tr", "pre"):
            self.open.append([tag, ""])

    def handle_endtag(self, tag):
        if tag in ("script", "style", "svg", "math"):
            self.skipped -= 1
        elif self.open and tag == self.open[-1][0]:
            text = self.open.pop()[1]
            if tag == "tr":
                self.rows.append(text)
            elif tag == "pre":
                self.lines += text.splitlines()
            else:
                self.titles.append((int(tag[1]), text))

    def handle_data(self, data):
        if self.entry is not None and not self.skipped:
            self.entry += data
        if self.open and not self.skipped:
            self.open[-1][1] += data


def wrong_contents(page, pdf, raw):
    """entries of the list of contents without the number of the page that the place is on, and whose title is not there"""
    places = subprocess.run(["pdfinfo", "-dests", pdf], capture_output=True, check=True, text=True).stdout
    number = {name: int(line) for line, name in re.findall(r'^\s*(\d+) .*"(.*)"$', places, re.M)}
    sheets = [squeezed(text) for text in raw.split("\f")]
    listed = "".join(sheets[: min(number.values(), default=1)])
    return [title for anchor, title in page.contents
            if anchor not in number or squeezed(f"{title}{number[anchor]}") not in listed or squeezed(title) not in sheets[number[anchor] - 1]]


def main(manual, pdf):
    for tool in ("pdftotext", "pdftohtml", "pdfinfo"):
        if not shutil.which(tool):
            print(f"SKIPPED: {tool} is not installed (package poppler-utils), the PDF is not compared")
            return 77
    page = Page()
    with open(manual, encoding="utf-8") as file:
        page.feed(file.read())
    raw = subprocess.run(["pdftotext", "-raw", pdf, "-"], capture_output=True, check=True, text=True).stdout
    # a long line may continue on the next page
    foot = re.compile(r"\f\d+ / \d+\s*Voussoir, manual\s*")
    printed = squeezed(foot.sub("", "\f" + raw))
    outline = subprocess.run(["pdftohtml", "-xml", "-i", "-stdout", pdf], capture_output=True, check=True, text=True).stdout
    outline = outline[outline.find("<outline>"):]

    missing = []
    for what, texts in (("title", [title for _, title in page.titles]), ("row", page.rows), ("line", page.lines)):
        missing += [f"{what}: {text.strip()[:120]}" for text in texts
                    if any(squeezed(part) not in printed for part in text.split(drawn))]
    in_outline = squeezed(html.unescape(outline))
    missing += [f"outline: {title}" for level, title in page.titles if level <= 2 and squeezed(title) not in in_outline]
    missing += [f"contents: {title}" for title in wrong_contents(page, pdf, raw)]
    for text in missing[:20]:
        print(f"the PDF lacks {text}")
    print(f"{len(page.titles)} titles, {len(page.rows)} rows and {len(page.lines)} lines of the manual, and {len(page.contents)} page numbers, compared with the PDF, "
          f"{len(missing)} missing")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2]))
