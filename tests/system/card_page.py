"""Pages of a card or of a kit's guide: card_page.py REPORT.css PAGE.html [CARD.json].

Colours are those of the report's page; no text is fainter than 4.5:1 on any ground it may lie on, light or dark; a card's
banner has the verdict of its JSON, and each bar the numbers of its row."""

import colorsys
import html
import json
import re
import sys

LEAST = 4.5
THEMES = ("light", "dark")


def variables(block):
    return dict(re.findall(r"--([\w-]+): ?([^;}]+)", block))


def report_colours(css):
    light, dark = (re.search(selector + r" \{(.*?)\n\}", css, re.S)[1] for selector in (":root", r':root\[data-theme="dark"\]'))
    return variables(light), variables(dark)


class Style:
    def __init__(self, page):
        self.css = re.search(r"<style>(.*?)</style>", page, re.S)[1]
        light, dark = re.findall(r":root\{(.*?)\}", self.css, re.S)
        assert f"@media screen and (prefers-color-scheme:dark){{:root{{{dark}}}}}" in self.css, "dark pages are printed"
        self.theme = variables(light), variables(dark)

    def check_colours(self, report):
        for own, others, theme in zip(self.theme, report, THEMES):
            for name, colour in own.items():
                if name not in ("row-fill", "panel-edge"):
                    assert others[name] == colour, (theme, name, colour, others.get(name))

    def rgb(self, colour, theme):
        """The colour of CSS: #rrggbb, a variable, hsl with the fill of rows, a mixture in sRGB."""
        if mixed := re.fullmatch(r"color-mix\(in srgb,(.+) (\d+)%,(.+)\)", colour):
            share = int(mixed[2]) / 100
            return [share * a + (1 - share) * b for a, b in zip(self.rgb(mixed[1], theme), self.rgb(mixed[3], theme))]
        if row := re.fullmatch(r"hsl\((\d+),var\(--row-fill\)\)", colour):
            saturation, lightness = (float(n) / 100 for n in re.findall(r"(\d+)%", self.theme[theme]["row-fill"]))
            return list(colorsys.hls_to_rgb(int(row[1]) / 360, lightness, saturation))
        if name := re.fullmatch(r"var\(--([\w-]+)\)", colour):
            return self.rgb(self.theme[theme][name[1]], theme)
        assert re.fullmatch("#[0-9a-f]{6}", colour), colour
        return [int(colour[k:k + 2], 16) / 255 for k in (1, 3, 5)]

    def expanded(self, colour):
        """Where --says stands, each colour that it has."""
        says = sorted(set(re.findall(r"--says:(var\(--[\w-]+\))", self.css)))
        return [colour.replace("var(--says)", word) for word in says] if "var(--says)" in colour else [colour]

    def rules(self):
        for selector, body in re.findall(r"([^{}]+)\{([^{}]*)\}", self.css):
            yield selector.strip(), dict(re.findall(r"(?:^|;)(color|background|fill):([^;!]+)", body))

    def pairs(self, page):
        """Colours of text with the grounds on which they may lie: the rule's own, or each ground of the page."""
        grounds = {"var(--card)"}
        inks = set()
        for selector, body in self.rules():
            if "color" in body and "background" in body:
                yield from ((body["color"], ground) for ground in self.expanded(body["background"]))
            elif body.get("background", "none").startswith(("var", "color-mix")):
                grounds.update(self.expanded(body["background"]))
            elif "color" in body:
                inks.update(self.expanded(body["color"]))
            if selector.endswith("text") and "fill" in body:
                for figure in re.findall(r"<figure.*?</figure>", page, re.S):
                    if "<text" in figure:
                        yield from ((body["fill"], under) for under in re.findall(r"fill:(var[^;]+|hsl[^;]+\))", figure))
        assert len(inks) >= 3 and len(grounds) >= 2, (inks, grounds)
        yield from ((ink, ground) for ink in inks | {"var(--ink)"} for ground in grounds)

    def contrast(self, one, other, theme):
        def luminance(colour):
            linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in self.rgb(colour, theme)]
            return sum(weight * c for weight, c in zip((0.2126, 0.7152, 0.0722), linear))
        low, high = sorted((luminance(one), luminance(other)))
        return (high + 0.05) / (low + 0.05)

    def check_contrast(self, page):
        pairs = set(self.pairs(page))
        for theme, name in enumerate(THEMES):
            for ink, ground in pairs:
                found = self.contrast(ink, ground, theme)
                assert found >= LEAST, f"{ink} on {ground}, {name}: {found:.2f}"
        for colour in re.findall(r"(?:fill|stroke):([^;\"]+)", page.split("</style>")[1]):
            assert colour == "none" or colour.startswith(("var(--", "hsl(")), colour
        return len(pairs)


def check_banner(page, card):
    (kind, heading, words), = re.findall(r'<div class="verdict (\w+)"><strong>(.*?)</strong><p>(.*?)</p>', page)
    held = card["passes_if_held_flat"] and not card["passes"]
    assert (kind, heading) == (("passes", "Passes") if card["passes"] else
                               ("caution", "Passes if held at flat") if held else ("fails", "Does not pass")), (kind, heading)
    asked, failed = card["asked"], [line for line in card["lines"] if line["passes"] is False]
    if kind == "fails":
        assert f"fails {len(failed)} of {asked} requirements: " in words, words
        names = html.unescape(words.split("requirements: ")[1].rstrip(".")).split("; ")
        assert names == [line["what"].split(",")[0] for line in failed], names
    else:
        assert f"meets all {asked} requirements" in words, words


def check_bars(page, card):
    table = re.search(r'<table class="requirements">(.*?)</table>', page, re.S)[1]
    rows = re.findall(r'<tr class="(pass|fail)">(.*?)</tr>', table, re.S)
    lines = [line for line in card["lines"] if line["passes"] is not None]
    assert len(rows) == len(lines) == card["asked"]
    for (kind, row), line in zip(rows, lines):
        result, quantity, required, actual, _, left = re.findall(r"<td[^>]*>(.*?)</td>", row)
        assert (kind == "pass") == (result == "pass") == line["passes"], line
        assert html.unescape(re.sub("<.*?>", "", quantity)) == line["what"], quantity
        words = re.sub("<.*?>", "", left)
        if line["found"] is None:
            assert words == "no result" and "<svg" not in left, left
            continue
        label = re.search(r'role="img" aria-label="(.*?)"', left)[1]
        assert label == f"actual {actual}, required {required}: {words}", label
        wanted, found = line["wanted"], line["found"]
        start, width = map(float, re.search(r'class="value" x="([\d.]+)%" width="([\d.]+)%"', left).groups())
        limit = float(re.search(r'x1="([\d.]+)%"', left)[1])
        zero = start + width if found < 0 else start
        tip = start if found < 0 else start + width
        assert abs((tip - zero) * wanted - (limit - zero) * found) <= 0.02 * (abs(wanted) + abs(found)), left
        difference = (found - wanted) * (1 if line["bound"] == "at_least" else -1)
        if number := re.match(r"[\d.]+(e[-+]\d+)?", words):
            assert abs(float(number[0]) - abs(difference)) <= 6e-3 * abs(difference), (words, difference)
            assert words.endswith("left") == line["passes"], words
        else:
            assert abs(difference) <= 1e-9 * max(abs(found), abs(wanted)), (words, difference)
            assert words == ("none left" if line["passes"] else "just missed"), words


def main(css, name, card=None):
    with open(css, encoding="utf8") as file:
        report = report_colours(file.read())
    with open(name, encoding="utf8") as file:
        page = file.read()
    assert "<script" not in page and not re.search(r'(?:src|href)="|url\(|@import', page), "it is not self-contained"
    style = Style(page)
    style.check_colours(report)
    style.check_contrast(page)
    if card is None:
        return
    with open(card, encoding="utf8") as file:
        card = json.load(file)
    check_banner(page, card)
    check_bars(page, card)


main(*sys.argv[1:])
