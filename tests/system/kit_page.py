"""The page of a kit as a reader sees it: tables and sentences, lengths in mm."""

import html
import re

INCH = 25.4


class Page:
    """Tables as rows of words, their first the headings; lengths of the kit's numbers in mm."""

    def __init__(self, path):
        with open(path, encoding="utf8") as file:
            self.text = file.read()
        self.tables = [[[html.unescape(cell) for cell in re.findall(r"<t[dh][^>]*>(.*?)</t[dh]>", row)]
                        for row in re.findall(r"<tr[^>]*>(.*?)</tr>", table, re.S)]
                       for table in re.findall(r"<table[^>]*>(.*?)</table>", self.text, re.S)]
        self.unit = INCH if "Shifts of vertices (in)" in self.text or "between flat" in self.text and \
            re.search(r"Springs between [^<]*\(in\)", self.text) else 1.0
        self.warnings = re.findall(r'<strong>Springs contradict the verdict</strong><p>(.*?)</p>', self.text)

    def length(self, words):
        return float(words) * self.unit

    def rows(self, *heads):
        """Rows of every table with these first headings."""
        for table in self.tables:
            if table and tuple(table[0][:len(heads)]) == heads:
                yield from table[1:]

    def shifts(self):
        return {vertex: (self.length(dx), self.length(dy)) for vertex, dx, dy in self.rows("vertex", "dx")}

    def springs(self):
        """Of each spring: two flat lengths; length and stroke at the end; both trends."""
        return {row[0]: ([self.length(n) for n in row[2:4]], [self.length(n) for n in row[4:6]], row[6:])
                for row in self.rows("no.", "ends", "diagonal, flat")}

    def histories(self):
        """Lengths by degree of each spring."""
        found = {}
        for table in self.tables:
            if table and table[0] and table[0][0] == "angle (°)":
                for row in table[1:]:
                    for name, length in zip(table[0][1:], row[1:]):
                        found.setdefault(name, {})[round(float(row[0]), 6)] = self.length(length)
        return found

    def sheets(self):
        """Sheets, area of the parts in mm2, the least number of sheets; distances of the marks."""
        count, area, least = re.search(r"<p>(\d+) of [^;]*; parts of (\d+) cm² need at least (\d+)\.", self.text).groups()
        marks = re.search(r"are ([\d.]+) (mm|in) apart along the lower edge and ([\d.]+)", self.text)
        scale = INCH if marks[2] == "in" else 1
        return int(count), 100 * float(area), int(least), (scale * float(marks[1]), scale * float(marks[3]))
