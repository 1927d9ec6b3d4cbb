"""Reads letters that are drawn as lines by pictures of its own, five dots wide and seven high."""

import functools
import math

PICTURES = {
    "0": ".###. #...# #...# #...# #...# #...# .###.", "1": "..#.. .##.. #.#.. ..#.. ..#.. ..#.. ..#..",
    "2": ".###. #...# ....# ...#. ..#.. .#... #####", "3": "##### ...#. ..#.. ...#. ....# #...# .###.",
    "4": "...#. ..##. .#.#. #..#. ##### ...#. ...#.", "5": "##### #.... ####. ....# ....# #...# .###.",
    "6": ".###. #.... #.... ####. #...# #...# .###.", "7": "##### ....# ...#. ..#.. .#... .#... .#...",
    "8": ".###. #...# #...# .###. #...# #...# .###.", "9": ".###. #...# #...# .#### ....# ....# .###.",
    "A": "..#.. .#.#. #...# #...# ##### #...# #...#", "b": "#.... #.... #.... ####. #...# #...# ####.", "c": ".###. #...# #.... #.... #.... #...# .###.",
    "r": "#.##. ##..# #.... #.... #.... #.... #....", "s": ".###. #...# #.... .###. ....# #...# .###."}


def box(points):
    return [f(p[k] for p in points) for f in (min, max) for k in (0, 1)]


def dots(points):
    """In a box of five to seven, its middle in the origin."""
    left, low, right, high = box(points)
    scale = 6 / max(high - low, 1e-9)
    return [((x - (left + right) / 2) * scale, (y - (low + high) / 2) * scale) for x, y in points]


DOTS = {letter: dots([(column, 6 - row) for row, line in enumerate(picture.split())
                      for column, dot in enumerate(line) if dot == "#"]) for letter, picture in PICTURES.items()}


def far(some, others):
    return sum(min(math.dist(p, q) for q in others) for p in some) / len(some)


def letter_of(strokes, turn):
    """How unlike the likest letter is, and that letter: mean distances of its dots and of points on the strokes."""
    c, s = math.cos(turn), math.sin(turn)
    points = [(a[0] + k / 12 * (b[0] - a[0]), a[1] + k / 12 * (b[1] - a[1]))
              for stroke in strokes for a, b in zip(stroke, stroke[1:]) for k in range(13)]
    points = dots([(c * x + s * y, c * y - s * x) for x, y in points])
    return likest(tuple((round(x, 2), round(y, 2)) for x, y in points))


@functools.cache
def likest(points):
    return min((far(points, picture) + far(picture, points), letter) for letter, picture in DOTS.items())


def letters_of(paths):
    """Strokes of each letter: one within the box of those before belongs to them."""
    letters = []
    for points, _ in paths:
        last, own = box(sum(letters[-1], [])) if letters else [0, 0, 0, 0], box(points)
        if all(last[k] - 1e-4 <= own[k] and own[k + 2] <= last[k + 2] + 1e-4 for k in (0, 1)):
            letters[-1].append(points)
        else:
            letters.append([points])
    return letters


def words_of(paths, turns):
    """(x, y, words, turned_deg) of each word, in the order of strokes; every one begins with A, b, r or s. All are turned
    by the same of these angles (radians): that at which they are likest letters."""
    letters = letters_of(paths)
    some = letters[:12]
    turn = min(turns, key=lambda turn: sum(letter_of(letter, turn)[0] for letter in some)) if len(turns) > 1 else turns[0]
    words = []
    for letter in letters:
        read = letter_of(letter, turn)[1]
        if read in "Abrs" or not words:
            words.append(["", []])
        words[-1][0] += read
        words[-1][1] += sum(letter, [])
    c, s = math.cos(turn), math.sin(turn)
    for read, points in words:
        left, low, right, _ = box([(c * x + s * y, c * y - s * x) for x, y in points])
        x, y = (left + right) / 2, low  # the middle of its base line
        yield (c * x - s * y, s * x + c * y, read, math.degrees(turn))
