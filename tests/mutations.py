"""Seeded damage to descriptions, as people do it: keys, values, types, units, commas, quotes, names, sizes, points."""

import random
import re

VALUES = (
    "0", "-1", "1e-90", "1e90", "1e300", "nan", "inf", "-inf", "true", "2021-05-27", '""', '"a1"', '"1/0"', '"sqrt(-1)"',
    '"min(a1)"', '"max()"', '"atan2(1)"', '"theta13"', '"A.x"', "[]", "{}", "[1, 2]", '["a1"]', '"62,3"', "62,3", "62.3 mm",
    '"62.3 mm"', "−5", "“a1”", "‘a1’", ".5", "5.", "07", "1_000", "0x1F", '"(a1"', '"a1 +"', '"2a1"', '"a1^-2"', '"-2^2"',
    '"deg"', '"°"', '"rad"', '"mm"', '"1"', '"gear"', '"crank"', '"ground"', "{ r = 1, angle = 30 }", "{ value = 3 }",
    '{ formula = "a1" }', '{ distances = { A = 1, B = 1 }, side = "left" }', '"ln(0)"', '"acos(2)"', '"exp(1000)"',
)  # fmt: skip
LETTERS = "çğıİöşüÇĞÖŞÜéß "
SIGNS = [
    '"',
    "'",
    ",",
    "[",
    "]",
    "{",
    "}",
    "=",
    ".",
    "#",
    "\n",
    "\t",
    "\\",
    "\u00a0",
    "\ufeff",
    ";",
    ":",
    "“",
    "”",
    "−",
    "\0",
]
EXTRA = (
    "at = 40",
    "at = 1e9",
    'at = "a1"',
    "A0 = [0, 0]",
    "unknown = 3",
    '[outputs.q]\nformula = "A0.x"',
    "[[charts]]\npaths = []",
    '[[tables]]\nrows = "theta12"\ncolumns = { a1 = [1, 2] }\nvalue = "theta13"',
    "[links.extra]\npoints = { A = [0, 0], B = [1, 1] }",
    "[links.free]\npoints = { Q = [0, 0] }",
    '[dimensions.loop]\nformula = "loop"',
)
_NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?![\w.])")
_WORD = re.compile(r"\b[A-Za-z][A-Za-z0-9_]*\b")


def mutated(text: str, seed: int) -> str:
    """The text with one to three damages; the same for the same seed."""
    dice = random.Random(seed)
    for _ in range(dice.randint(1, 3)):
        text = dice.choice(DAMAGES)(text, dice)
    return text


def _line(text: str, dice: random.Random) -> tuple[list[str], int]:
    """The lines, and one of them that says something."""
    lines = text.split("\n")
    telling = [place for place, line in enumerate(lines) if line.strip() and not line.startswith("#")]
    return lines, dice.choice(telling or [0])


def drop_line(text: str, dice: random.Random) -> str:
    lines, place = _line(text, dice)
    return "\n".join(lines[:place] + lines[place + 1 :])


def double_line(text: str, dice: random.Random) -> str:
    lines, place = _line(text, dice)
    return "\n".join([*lines[: place + 1], lines[place], *lines[place + 1 :]])


def swap_lines(text: str, dice: random.Random) -> str:
    lines, place = _line(text, dice)
    other = _line(text, dice)[1]
    lines[place], lines[other] = lines[other], lines[place]
    return "\n".join(lines)


def add_line(text: str, dice: random.Random) -> str:
    lines, place = _line(text, dice)
    return "\n".join([*lines[: place + 1], dice.choice(EXTRA), *lines[place + 1 :]])


def other_value(text: str, dice: random.Random) -> str:
    lines, place = _line(text, dice)
    key, equals, _ = lines[place].partition(" = ")
    lines[place] = f"{key} = {dice.choice(VALUES)}" if equals else lines[place]
    return "\n".join(lines)


def _replace_one(pattern: re.Pattern[str], text: str, dice: random.Random, new: str) -> str:
    found = list(pattern.finditer(text))
    if not found:
        return text
    one = dice.choice(found)
    return text[: one.start()] + new + text[one.end() :]


def other_number(text: str, dice: random.Random) -> str:
    """A size that is huge, tiny, negative, zero, or another sound one."""
    plain = f"{dice.uniform(-300, 300):.4g}"
    return _replace_one(
        _NUMBER, text, dice, dice.choice(["0", "-1", "1e-9", "1e9", "1e99", "1e-99", "1e308", plain, plain])
    )


def comma_in_number(text: str, dice: random.Random) -> str:
    return _replace_one(_NUMBER, text, dice, f"{dice.randint(0, 99)},{dice.randint(0, 99)}")


def piece_of_value(text: str, dice: random.Random) -> str:
    return _replace_one(_NUMBER, text, dice, dice.choice(VALUES))


def other_word(text: str, dice: random.Random) -> str:
    """Points, links, symbols and keys for one another."""
    return _replace_one(_WORD, text, dice, dice.choice(_WORD.findall(text) or ["x"]))


def renamed(text: str, dice: random.Random) -> str:
    """A name everywhere with another letter in it, in keys without quotes too."""
    word = dice.choice(_WORD.findall(text) or ["x"])
    return re.sub(rf"\b{word}\b", word + dice.choice(LETTERS), text)


def other_sign(text: str, dice: random.Random) -> str:
    place = dice.randrange(len(text) or 1)
    return text[:place] + dice.choice([*SIGNS, ""]) + text[place + dice.randint(0, 1) :]


def smart_quotes(text: str, dice: random.Random) -> str:
    lines, place = _line(text, dice)
    lines[place] = re.sub(r'"([^"]*)"', dice.choice([r"“\1”", r"‘\1’", r"„\1“", r"«\1»", r'“\1"']), lines[place])
    return "\n".join(lines)


def circle(text: str, dice: random.Random) -> str:
    """Two dimensions that need each other."""
    names = re.findall(r"^(\w+) = (?:\{|[\d.])", text, re.MULTILINE)[:8] or ["a1"]
    first, second = dice.choice(names), dice.choice(names)
    pattern = re.compile(rf"^{first} = .*$", re.MULTILINE)
    return pattern.sub(f'{first} = {{ formula = "{second} + 1" }}', text, count=1)


DAMAGES = (
    drop_line, double_line, swap_lines, add_line, other_value, other_value, other_number, other_number, other_number,
    comma_in_number, piece_of_value, other_word, other_word, renamed, other_sign, smart_quotes, circle,
)  # fmt: skip
