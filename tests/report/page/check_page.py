#!/usr/bin/env python3
"""Makes a small report and looks at it: check_page.py --build DIR."""

import argparse
import csv
import html.parser
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

HERE = pathlib.Path(__file__).resolve().parent
SECTIONS = ["falloff", "grenade"]
SKIPPED = 77

try:
    import plots
    from section import Point, exponent, number
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(SKIPPED)


def require(condition, text):
    if not condition:
        sys.exit(f"check_page: {text}")


class Page(html.parser.HTMLParser):
    """What the page refers to and what it says."""

    def __init__(self):
        super().__init__()
        self.files, self.headings, self.sentences, self.faults = [], [], [], []
        self.into = None

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        name = attributes.get("src") or attributes.get("href") or ""
        if name and not name.startswith("#"):
            self.files.append(name)
        kinds = {"says": self.sentences, "fault": self.faults}
        self.into = self.headings if tag == "h2" else kinds.get(attributes.get("class"))

    def handle_data(self, data):
        if self.into is not None:
            self.into.append(data)

    def handle_endtag(self, tag):
        self.into = None


def check_arithmetic():
    points = [Point("a", 1, 5), Point("b", 2, 3), Point("c", 3, 4), Point("d", 4, 0)]
    require([p.label for p in plots.front_of(points)] == ["a", "b", "d"], "the front has others")
    require(plots.front_of([Point("a", 1, 1), Point("b", 1, 0)])[0].label == "b", "of a price the least error")
    squares = [Point("", x, 3 * x * x) for x in (1, 10, 1000)]
    require(abs(exponent(squares) - 2) < 1e-12, f"squares grow to {exponent(squares)}")
    for value, text in ((0, "0"), (1.2345, "1.23"), (1234.5, "1,230"), (0.00012345, "0.000123"), (2e-7, "2 x 10^-7")):
        require(number(value) == text, f"{value} is written {number(value)}")


def numbers_in(folder, name):
    """All numbers of the CSV files whose names begin so, as sentences write them."""
    found = set()
    for path in folder.glob(f"{name}*.csv"):
        with open(path, newline="", encoding="utf-8") as file:
            for cell in (cell for row in csv.reader(file) for cell in row):
                try:
                    found.add(number(float(cell)))
                except ValueError:
                    found.update(re.findall(r"\d+", cell))  # a label
    return found


def check_report(build, folder):
    run = [sys.executable, str(HERE / "run.py"), "--build", build, "--out", str(folder), "--quick", "--section", *SECTIONS]
    done = subprocess.run(run, capture_output=True, text=True, check=False)
    require(done.returncode == 0, f"run.py ended with {done.returncode}: {done.stdout}{done.stderr}")
    page = Page()
    page.feed((folder / "index.html").read_text(encoding="utf-8"))
    require(not page.faults, f"faults: {page.faults}")
    require(len(page.headings) == len(SECTIONS), f"sections: {page.headings}")
    require(len(page.sentences) == len(SECTIONS), f"sentences: {page.sentences}")
    for name in page.files:
        require((folder / name).is_file(), f"{name} is not there")
    drawn = sorted(folder.glob("*.svg"))
    require(drawn, "there are no plots")
    for path in drawn:
        root = xml.etree.ElementTree.parse(path).getroot()
        require(root.tag.endswith("}svg"), f"{path.name} is no SVG")
    for name, sentence in zip(SECTIONS, page.sentences):
        known = numbers_in(folder, name)
        said = re.findall(r"\d[\d,]*(?:\.\d+)?(?: x 10\^-?\d+)?", sentence)
        require(said, f"no figures in: {sentence}")
        for figure in said:
            require(figure.rstrip(",") in known, f"{figure} is not in the table of: {sentence}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", required=True)
    options = parser.parse_args()
    check_arithmetic()
    with tempfile.TemporaryDirectory() as folder:
        check_report(options.build, pathlib.Path(folder))
    print("the report is whole")


if __name__ == "__main__":
    main()
