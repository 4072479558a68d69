"""Dialects that are written and never read: programming languages and the textbook. One table each.

`calls` lists every function that equations use; what has no counterpart that behaves as the sheet does (a complex root in
Octave, a maximum that passes over NaN) is a helper function that the written program brings along, under the name given
here. Functions of any number of arguments are written as functions of two (`pairwise`).
"""

from __future__ import annotations

from dataclasses import replace

from .dialects import COMPARISONS, MATHEMATICS, Dialect
from .nodes import Binary, Call, Node, Number, Unary

_PAIRWISE = ("AND", "OR", "MAX", "MIN")

OCTAVE = Dialect(
    "octave",
    {**COMPARISONS, **MATHEMATICS},
    prefix=45,
    postfix=0,
    spelling={"=": "==", "<>": "~=", "*": ".*", "/": "./", "^": ".^"},
    argument=", ",
    spaced=frozenset(("+", "-", "*", "/", *COMPARISONS)),
    small=True,
    calls={
        "ABS": "abs({0})",
        "ACOS": "arc(@acos, {0})",
        "AND": "and({0}, {1})",
        "ASIN": "arc(@asin, {0})",
        "ATAN": "atan({0})",
        "ATAN2": "direction({0}, {1})",
        "COS": "cos({0})",
        "EXP": "exp({0})",
        "IF": "choose({0}, {1}, {2})",
        "ISNUMBER": "isfinite({0})",
        "LN": "logarithm({0})",
        "MAX": "larger({0}, {1})",
        "MIN": "smaller({0}, {1})",
        "NA": "NaN",
        "NOT": "not({0})",
        "OR": "or({0}, {1})",
        "PI": "pi",
        "POWER": "raised({0}, {1})",
        "ROUND": "rounded({0}, {1})",
        "SIGN": "sign({0})",
        "SIN": "sin({0})",
        "SQRT": "root({0})",
        "TAN": "tan({0})",
    },
)
"""GNU Octave and MATLAB. `^` leans left in both; both go on with complex numbers where a real one does not exist."""

PYTHON = Dialect(
    "python",
    {**COMPARISONS, **MATHEMATICS},
    prefix=45,
    postfix=0,
    leans_right=frozenset("^"),
    spelling={"=": "==", "<>": "!=", "^": "**"},
    argument=", ",
    spaced=frozenset(("+", "-", "*", "/", *COMPARISONS)),
    small=True,
    calls={
        "ABS": "np.abs({0})",
        "ACOS": "np.arccos({0})",
        "AND": "np.logical_and({0}, {1})",
        "ASIN": "np.arcsin({0})",
        "ATAN": "np.arctan({0})",
        "ATAN2": "_direction({0}, {1})",
        "COS": "np.cos({0})",
        "DEGREES": "np.degrees({0})",
        "EXP": "np.exp({0})",
        "IF": "np.where({0}, {1}, {2})",
        "ISNUMBER": "np.isfinite({0})",
        "LN": "np.log({0})",
        "MAX": "np.maximum({0}, {1})",
        "MIN": "np.minimum({0}, {1})",
        "NA": "np.nan",
        "NOT": "np.logical_not({0})",
        "OR": "np.logical_or({0}, {1})",
        "PI": "np.pi",
        "POWER": "np.power({0}, {1})",
        "RADIANS": "np.radians({0})",
        "ROUND": "_rounded({0}, {1})",
        "SIGN": "np.sign({0})",
        "SIN": "np.sin({0})",
        "SQRT": "np.sqrt({0})",
        "TAN": "np.tan({0})",
    },
)
"""numpy, on arrays."""

LATEX = Dialect(
    "latex",
    {**COMPARISONS, **MATHEMATICS},
    prefix=35,
    postfix=0,
    leans_right=frozenset("^"),
    spelling={"<>": r"\ne", "<=": r"\le", ">=": r"\ge", "*": r"\,"},
    argument=r";\ ",
    spaced=frozenset(("+", "-", *COMPARISONS)),
    small=True,
    calls={
        "ABS": r"\left|{0}\right|",
        "ACOS": r"\arccos\left({0}\right)",
        "AND": r"{0} \wedge {1}",
        "ASIN": r"\arcsin\left({0}\right)",
        "ATAN": r"\arctan\left({0}\right)",
        "ATAN2": r"\operatorname{{arctan2}}\left({0};\ {1}\right)",
        "COS": r"\cos\left({0}\right)",
        "DEGREES": r"\frac{{180}}{{\pi}}\left({0}\right)",
        "EXP": r"\exp\left({0}\right)",
        "IF": r"\begin{{cases}}{1} & {0} \\ {2} &\end{{cases}}",
        "LN": r"\ln\left({0}\right)",
        "MAX": r"\max\left({0};\ {1}\right)",
        "MIN": r"\min\left({0};\ {1}\right)",
        "OR": r"{0} \vee {1}",
        "PI": r"\pi",
        "RADIANS": r"\frac{{\pi}}{{180}}\left({0}\right)",
        "ROUND": r"\operatorname{{round}}\left({0}\right)",
        "SIGN": r"\operatorname{{sgn}}\left({0}\right)",
        "SIN": r"\sin\left({0}\right)",
        "SQRT": r"\sqrt{{{0}}}",
        "TAN": r"\tan\left({0}\right)",
    },
    short={"COS": r"\cos {0}", "SIN": r"\sin {0}", "TAN": r"\tan {0}"},
    shapes={"/": r"\frac{{{0}}}{{{1}}}", "^": "{0}^{{{1}}}"},
    sets_signs_apart=True,
)
"""Mathematics as a textbook sets it, in LaTeX and in Markdown. arctan2 takes x first, as the cell beside it does."""

NUMBERS = replace(LATEX, name="numbers", spelling={**LATEX.spelling, "*": r" \cdot "}, short={})
"""The same with numbers in place of symbols: 2 · 3 needs a dot."""

BASIC = Dialect(
    "basic",
    {**COMPARISONS, **MATHEMATICS},
    prefix=60,
    postfix=0,
    argument=", ",
    spaced=frozenset(("+", "-", "*", "/", "^", *COMPARISONS)),
    calls={
        "ABS": "Abs({0})",
        "ACOS": "ArcCos({0})",
        "AND": "({0} And {1})",
        "ASIN": "ArcSin({0})",
        "ATAN": "Atn({0})",
        "COS": "Cos({0})",
        "DEGREES": "(({0}) * 180 / PiValue())",
        "EXP": "Exp({0})",
        "IF": "IIf({0}, {1}, {2})",
        "LN": "Log({0})",
        "MAX": "MaxOf({0}, {1})",
        "MIN": "MinOf({0}, {1})",
        "MOD": "Modulo({0}, {1})",
        "NOT": "(Not ({0}))",
        "OR": "({0} Or {1})",
        "PI": "PiValue()",
        "POWER": "(({0}) ^ ({1}))",
        "RADIANS": "(({0}) * PiValue() / 180)",
        "SIGN": "Sgn({0})",
        "SIN": "Sin({0})",
        "SQRT": "Sqr({0})",
        "TAN": "Tan({0})",
    },
    sets_signs_apart=True,
)
"""VBA, and the Basic of LibreOffice, where -x ^ 2 is (-x) ^ 2: what has a sign gets parentheses under a power. Log is the
natural logarithm. A direction (ATAN2) is a function that the program brings along under its own name."""

GEOGEBRA = Dialect(
    "geogebra",
    {**COMPARISONS, **MATHEMATICS},
    prefix=60,
    postfix=0,
    spelling={"=": "==", "<>": "!="},
    argument=", ",
    spaced=frozenset(("+", "-", "*", "/", "^", *COMPARISONS)),
    calls={
        "ABS": "abs({0})",
        "ACOS": "acos({0})",
        "AND": "({0} && {1})",
        "ASIN": "asin({0})",
        "ATAN": "atan({0})",
        "ATAN2": "atan2({1}, {0})",
        "COS": "cos({0})",
        "EXP": "exp({0})",
        "IF": "If[{0}, {1}, {2}]",
        "ISNUMBER": "IsDefined[{0}]",
        "LN": "ln({0})",
        "MAX": "Max[{0}, {1}]",
        "MIN": "Min[{0}, {1}]",
        "MOD": "(({0}) - ({1}) * floor(({0}) / ({1})))",
        "NA": "?",
        "NOT": "!({0})",
        "OR": "({0} || {1})",
        "PI": "pi",
        "POWER": "(({0}) ^ ({1}))",
        "ROUND": "round({0}, {1})",
        "SIGN": "sgn({0})",
        "SIN": "sin({0})",
        "SQRT": "sqrt({0})",
        "TAN": "tan({0})",
    },
    sets_signs_apart=True,
)
"""Expressions of GeoGebra, whose atan2 takes y first. What is undefined (?) makes undefined whatever reads it."""

WRITTEN: dict[str, Dialect] = {dialect.name: dialect for dialect in (OCTAVE, PYTHON, LATEX, NUMBERS, BASIC, GEOGEBRA)}


def pairwise(node: Node) -> Node:
    """MAX(a; b; c) as MAX(MAX(a; b); c), SUMSQ(a; b) as a^2 + b^2, CHOOSE as IF in IF; of a single argument the argument
    itself."""
    if not isinstance(node, Call):
        return node
    if node.name == "CHOOSE":
        return chosen_by_ifs(node)
    if node.name == "SUMSQ":
        squares = [Binary("^", arg, Number(2.0)) for arg in node.args]
        total: Node = squares[0]
        for square in squares[1:]:
            total = Binary("+", total, square)
        return total
    if node.name not in _PAIRWISE:
        return node
    result = node.args[0]
    for arg in node.args[1:]:
        result = Call(node.name, (result, arg))
    return result


def chosen_by_ifs(node: Call) -> Node:
    """CHOOSE(k; a; b; c) as IF(k > 2.5; c; IF(k > 1.5; b; a)), for languages without such a function."""
    number, *values = node.args
    result = values[0]
    for place, value in enumerate(values[1:], 1):
        result = Call("IF", (Binary(">", number, Number(place + 0.5)), value, result))
    return result


def real_powers(node: Node) -> Node:
    """As `pairwise`; a power whose exponent is no whole number is a function, which can refuse a negative base."""
    match node:
        case Binary("^", _, Number(value)) | Binary("^", _, Unary("-", Number(value))) if value.is_integer():
            return node
        case Binary("^", base, exponent):
            return Call("POWER", (base, exponent))
    return pairwise(node)


def plain_degrees(node: Node) -> Node:
    """As `real_powers`; degrees as x pi / 180, where a language has no function for them."""
    match node:
        case Call("RADIANS", (x,)):
            return Binary("/", Binary("*", x, Call("PI")), Number(180.0))
        case Call("DEGREES", (x,)):
            return Binary("/", Binary("*", x, Number(180.0)), Call("PI"))
    return real_powers(node)


def signs_apart(node: Node) -> Node:
    """As `pairwise`, but halved: Basic gives up on calls nested deep. A power of something with a sign is a function."""
    match node:
        case Call("MAX" | "MIN" as name, args) if len(args) > 2:
            half = len(args) // 2
            return Call(name, (signs_apart(Call(name, args[:half])), signs_apart(Call(name, args[half:]))))
        case Binary("^", Unary("-") as base, exponent):
            return Call("POWER", (base, exponent))
    return pairwise(node)
