"""The solution written out as a textbook would, as a document that LaTeX and Markdown then set.

Given; the driver; for each group of the equations list its loop closure equation, that equation's real and imaginary parts,
the steps in their order with symbols and with numbers, and the check that the numbers close the loop; the result.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, Node, Number, Symbol, symbols
from livesheet.formula.scalar import evaluate
from livesheet.said import Words, say
from mechsheet.exporting.job import Job
from mechsheet.exporting.mathtext import RATIO, Pen, Position, packed, point_math, seen, symbol_math
from mechsheet.exporting.program import one_line, quantity
from mechsheet.kinematics.equations import CAM, Equation, Group, Loop, need_one_position
from mechsheet.synthesis.writing import says
from mechsheet.units import LENGTH, RAD, Unit
from mechsheet.words.catalogue import words
from mechsheet.words.symbols import GREEK

LINE = 66
"""Characters of LaTeX that numbers and their result may share a line with."""

WIDE, TOO_WIDE = 76, 130
"""Characters seen on a line: sums are broken there; what cannot be is set small, or (numbers only) left out."""

MOST_LINES = 3
"""Of numbers, before they are left out."""


@dataclass(frozen=True, slots=True)
class Math:
    """LaTeX in the middle of a text."""

    code: str


Inline = tuple[str | Math, ...]


def marked_up(parts: Inline, escaped: Callable[[str], str]) -> str:
    """A line as LaTeX and Markdown both have it: formulas between dollars, words with their signs escaped."""
    return "".join(f"${part.code}$" if isinstance(part, Math) else escaped(part) for part in parts)


@dataclass(frozen=True, slots=True)
class Heading:
    """A heading; level 1 is the document's title."""

    level: int
    text: str


@dataclass(frozen=True, slots=True)
class Paragraph:
    """A text."""

    parts: Inline


@dataclass(frozen=True, slots=True)
class Display:
    """Equations on lines of their own, aligned at `&`."""

    lines: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Table:
    """Rows under a head; `numbers` tells which columns are set to the right."""

    head: tuple[Inline, ...]
    rows: tuple[tuple[Inline, ...], ...]
    numbers: tuple[int, ...]


Block = Heading | Paragraph | Display | Table


def solution(job: Job) -> list[Block]:
    """The document. Raises MechanismError where there is no position."""
    what, hint = say("a written solution cannot hold this"), say("octave, python and vba can")
    need_one_position(job.compiled.equations, what, "to", hint)
    return _Writer(Position(job.mechanism, job.at)).document()


class _Writer:
    def __init__(self, position: Position) -> None:
        self.position = position
        self.pen = Pen(position)
        self.mechanism = position.sample.plan.mechanism
        self.equations = position.sample.equations
        self.blocks: list[Block] = []

    def say(self, text: Words) -> str:
        return text.of(self.pen.language)

    def text(self, key: str, **parts: object) -> str:
        return words(self.pen.language, f"solution.{key}", **parts)

    def heading(self, level: int, text: str) -> None:
        self.blocks.append(Heading(level, text))

    def paragraph(self, *parts: str | Math) -> None:
        self.blocks.append(Paragraph(parts))

    def document(self) -> list[Block]:
        """All of it, in order."""
        self.opening()
        self.given()
        self.driver()
        for group in self.equations.groups:
            self.group(group, group.closure)
        cam = [equation for equation in self.equations.columns if equation.group == CAM]
        if cam:
            self.heading(2, self.text("cam"))
            self.steps(cam)
        outputs = [equation for equation in self.equations.columns if equation.role == "output"]
        if outputs:
            self.heading(2, self.text("outputs"))
            self.steps(outputs)
        self.result()
        return self.blocks

    # --- what is given ----------------------------------------------------------------------------------------

    def opening(self) -> None:
        mechanism = self.mechanism
        self.heading(1, one_line(self.say(mechanism.title)))
        source = one_line(self.say(mechanism.source))
        if source:
            self.paragraph(f"{self.text('source')}: {source}")
        units = self.text("units", unit=one_line(mechanism.length_unit)) if mechanism.length_unit else ""
        self.paragraph(f"{units} {self.text('how')}".strip())

    def given(self) -> None:
        self.heading(2, self.text("given"))
        rows = []
        for dim in self.mechanism.dimensions:
            if not dim.derived:
                label = one_line(self.say(dim.label)) if dim.label else ""
                node = quantity(dim.value, dim.unit)
                rows.append(((Math(symbol_math(dim.symbol)),), (Math(self.exact(node, dim.symbol)),), (label,)))
        if rows:
            self.table(("symbol", "value", "meaning"), rows, (1,))
        lines = []
        for dim in self.mechanism.dimensions:
            if not isinstance(dim.value, float):
                unit = self.pen.units[dim.symbol]
                lines += self.step(dim.symbol, says(dim.value), unit)
        for equation in self.equations.constants:
            for step in self.position.steps[equation.symbol]:
                if step.symbol != self.equations.tolerance and not al.is_simple(step.expression):
                    lines += self.step(step.symbol, step.expression, step.unit)
        if lines:
            self.paragraph(self.text("follows") + ":")
            self.blocks.append(Display(tuple(lines)))

    def exact(self, node: Node, symbol: str) -> str:
        """A given value as it was written, with its unit: it is not rounded."""
        if isinstance(node, Number | Call) or al.value_of(node) is not None:
            return self.pen.formula(node) + ("" if _degrees(node) else self.pen.unit_math(self.pen.units[symbol]))
        return self.pen.result(symbol)

    def driver(self) -> None:
        symbol = self.mechanism.driver.symbol
        self.heading(2, self.text("driver"))
        self.paragraph(self.text("driven"))
        self.blocks.append(Display((f"{symbol_math(symbol)} &= {self.pen.result(symbol)}",)))
        self.steps(equation for equation in self.equations.columns if equation.group == 0)

    # --- a group ----------------------------------------------------------------------------------------------

    def group(self, group: Group, loop: Loop) -> None:
        title = f"{self.text('group')} {group.number} ({group.kind}): {one_line(self.say(group.label))}"
        self.heading(2, title)
        self.heading(3, self.text("loop"))
        self.loop(loop, group)
        self.heading(3, self.text("steps"))
        points = [f"{name}" for name in group.pins]
        self.paragraph(self.text(group.kind).format(*points))
        if group.mode:
            text = one_line(self.say(group.mode_words))
            mode = f"{symbol_math(group.mode)} = {group.mode_value:+d}"
            self.paragraph(f"{self.text('mode')} ", Math(mode), f": {text}")
        self.steps(equation for equation in self.equations.columns if equation.group == group.number)
        self.heading(3, self.text("check"))
        self.check(loop)

    def loop(self, loop: Loop, group: Group) -> None:
        pen = self.pen
        lines = []
        named = loop.left_way != loop.right_way
        if named:
            lines += _equated(_way(loop.left_way), _way(loop.right_way))
        lines += _equated(*([pen.vector(vector) for vector in side] for side in (loop.left, loop.right)))
        self.paragraph(self.text("vectors" if named else "complex"))
        self.blocks.append(Display(tuple(lines)))
        self.paragraph(self.text("scalars"))
        scalars: list[str] = []
        for part in (al.cos, al.sin):
            left, right = (
                [pen.formula(node) for v in side if not al.is_zero(node := al.mul(v.length, part(v.angle)))]
                for side in (loop.left, loop.right)
            )
            scalars += _equated(left, right) if left or right else []
        self.blocks.append(Display(tuple(scalars)))
        solved = [eq.symbol for eq in self.equations.columns if eq.group == group.number and eq.role == "variable"]
        unknown = [name for name in loop.reads if name in solved or name in group.unknowns]
        between = f" {self.text('and')} "
        parts: list[str | Math] = [f"{self.text('unknowns')} "]
        for index, name in enumerate(unknown):
            parts += [between if index else "", Math(symbol_math(name))]
        self.paragraph(*parts, ".")

    def check(self, loop: Loop) -> None:
        """Each vector in numbers, and the sums of both sides."""
        rows: list[tuple[Inline, ...]] = []
        for side, name in ((loop.left, "left"), (loop.right, "right")):
            total = 0j
            for vector in side:
                length, angle = self.number(vector.length), self.number(vector.angle.expression())
                cosine, sine = self.number(al.cos(vector.angle)), self.number(al.sin(vector.angle))
                total += complex(length * cosine, length * sine)
                rows.append(
                    _cells(
                        self.pen.vector(vector), self.pen.shown(length, LENGTH), self.pen.shown(angle, RAD),
                        self.pen.rounded(cosine, RATIO), self.pen.rounded(sine, RATIO),
                        self.pen.shown(length * cosine, LENGTH), self.pen.shown(length * sine, LENGTH),
                    )
                )  # fmt: skip
            empty: list[Inline] = [()] * 4
            sums = _cells(self.pen.shown(total.real, LENGTH), self.pen.shown(total.imag, LENGTH))
            rows.append(((self.text(name),), *empty, *sums))
        self.blocks.append(
            Table(
                ((self.text("vector"),), (self.text("length"),), (self.text("angle"),), (Math(r"\cos"),),
                 (Math(r"\sin"),), (self.text("real"),), (self.text("imaginary"),)),
                tuple(rows), (1, 2, 3, 4, 5, 6),
            )
        )  # fmt: skip

    def number(self, node: Node) -> float:
        """The value of an expression at the position, in internal units."""
        return evaluate(node, {name: self.position.values[name] for name in symbols(node)})

    # --- steps ------------------------------------------------------------------------------------------------

    def steps(self, equations: Iterable[Equation]) -> None:
        """Each equation with what it means, with symbols, with numbers."""
        for step in (step for equation in equations for step in self.position.steps[equation.symbol]):
            if step.counts_turns:
                value = Math(self.pen.rounded(self.position.values[step.symbol], "number"))
                self.paragraph(Math(symbol_math(step.symbol)), f": {self.text('turns')} ", value)
                continue
            label = one_line(self.say(step.label))
            self.paragraph(label + ":") if label != step.symbol else None
            self.blocks.append(Display(tuple(self.step(step.symbol, step.expression, step.unit))))

    def step(self, symbol: str, node: Node, unit: Unit) -> list[str]:
        """symbol = expression = numbers = value, on one, two or three lines."""
        pen = self.pen
        name, result = symbol_math(symbol), pen.result(symbol)
        if al.value_of(node) is not None:
            return [f"{name} &= {result}"]
        lines = _broken(f"{name} &= ", packed(pen.terms(node, pen.formula), WIDE))
        if not symbols(node) or isinstance(node, Symbol):
            return [*lines[:-1], f"{lines[-1]} = {result}"]
        numbers = packed(pen.terms(node, lambda part: pen.substituted(part, unit)), WIDE)
        widest = max(seen(line) for line in numbers)
        if widest > TOO_WIDE or len(numbers) > MOST_LINES:
            return [*lines, f"&= {result}"]
        if len(numbers) == 1 and len(numbers[0]) + len(result) <= LINE:
            return [*lines, f"&= {numbers[0]} = {result}"]
        if widest > WIDE:  # in the style of a text the parts of a fraction are set small
            style = r"\textstyle" if numbers[0].startswith(r"\frac") else r"\scriptstyle"
            numbers = [f"{{{style} {line}}}" for line in numbers]
        return [*lines, *_broken("&= ", numbers), f"&= {result}"]

    def result(self) -> None:
        """All variables, points and outputs at the position."""
        self.heading(2, self.text("result"))
        kinds = ("variable", "point", "rate", "force", "output")
        rows = []
        for equation in self.equations.columns:
            if equation.role in kinds:
                label = one_line(self.say(equation.label))
                text = label if label != equation.symbol else ""
                rows.append(((Math(symbol_math(equation.symbol)),), (Math(self.pen.result(equation.symbol)),), (text,)))
        self.table(("symbol", "value", "meaning"), rows, (1,))

    def table(self, head: tuple[str, ...], rows: Sequence[tuple[Inline, ...]], numbers: tuple[int, ...]) -> None:
        self.blocks.append(Table(tuple((self.text(word),) for word in head), tuple(rows), numbers))


def _degrees(node: Node) -> bool:
    return isinstance(node, Call) and node.name == "RADIANS"


def _cells(*codes: str) -> tuple[Inline, ...]:
    return tuple((Math(code),) for code in codes)


def _way(steps: tuple[tuple[str, str], ...]) -> list[str]:
    """The vectors of a side by the names of their ends."""
    return [rf"\overrightarrow{{{point_math(start)}{point_math(end)}}}" for start, end in steps]


def _equated(left: Sequence[str], right: Sequence[str]) -> list[str]:
    """left = right on one line, or each side on lines of its own."""
    sides = [packed(side or ["0"], WIDE) for side in (left, right)]
    if len(sides[0]) == len(sides[1]) == 1 and seen(sides[0][0] + sides[1][0]) <= WIDE:
        return [f"{sides[0][0]} &= {sides[1][0]}"]
    return [*_broken("& ", sides[0]), *_broken("&= ", sides[1])]


def _broken(head: str, lines: Sequence[str]) -> list[str]:
    """The lines of one side, those after the first a little to the right."""
    return [head + lines[0], *(rf"&\quad {line}" for line in lines[1:])]


HEAD = r"""\documentclass[a4paper,11pt]{article}
\usepackage[margin=22mm]{geometry}
\usepackage{amsmath}
\usepackage{longtable}
\usepackage{iftex}
\ifPDFTeX\usepackage[utf8]{inputenc}\else\usepackage{fontspec}\fi
\setlength{\parindent}{0pt}
\setlength{\parskip}{4pt}
\sloppy
\allowdisplaybreaks
\AtBeginDocument{\setlength{\abovedisplayskip}{3pt}\setlength{\belowdisplayskip}{5pt}}
\begin{document}
"""

LONG = 24
"""Rows from which on a table is broken over pages."""

HEADINGS = {2: "section*", 3: "subsection*"}

_SIGNS = {
    "\\": r"\textbackslash{}", "{": r"\{", "}": r"\}", "$": r"\$", "&": r"\&", "#": r"\#", "%": r"\%", "_": r"\_",
    "^": r"\textasciicircum{}", "~": r"\textasciitilde{}", "→": r"$\to$", "–": "--", "—": "---", "−": r"$-$",
    "°": r"$^\circ$", "·": r"$\cdot$", "×": r"$\times$", "²": r"$^2$", "³": r"$^3$", "µ": r"$\mu$", "≤": r"$\le$",
    "≥": r"$\ge$", "±": r"$\pm$", "∠": r"$\angle$", "√": r"$\surd$", "<": r"$<$", ">": r"$>$", "|": r"$|$", '"': "''",
} | {letter: f"$\\{name}$" for name, letter in GREEK.items()}  # fmt: skip


def latex(job: Job) -> list[bytes]:
    """The document in UTF-8."""
    parts = [HEAD]
    for block in solution(job):
        # no paragraph ends before equations: they would stand further down
        parts += ["" if isinstance(block, Display) else "\n", _latex_block(block), "\n"]
    return ["".join([*parts, "\n\\end{document}\n"]).encode()]


def _latex_block(block: Block) -> str:
    match block:
        case Heading(1, text):
            return rf"{{\LARGE\bfseries {_latex_escaped(text)}\par}}"
        case Heading(level, text):
            return rf"\{HEADINGS[level]}{{{_latex_escaped(text)}}}"
        case Paragraph(parts):
            return marked_up(parts, _latex_escaped)
        case Display(lines):
            return "\\begin{align*}\n" + " \\\\\n".join(lines) + "\n\\end{align*}"
        case Table():
            return _latex_table(block)


def _latex_table(table: Table) -> str:
    """A table; a long one may go on on the next page. Texts in the last column are wrapped."""
    last = len(table.head) - 1
    columns = ["r" if index in table.numbers else "l" for index in range(len(table.head))]
    if last not in table.numbers:
        columns[last] = "p{95mm}"
    rows = [table.head, *table.rows]
    lines = [" & ".join(marked_up(cell, _latex_escaped) for cell in row) + r" \\" for row in rows]
    kind, place = ("longtable", "[l]") if len(rows) > LONG else ("tabular", "")
    lines.insert(1, r"\hline" + (r"\endhead" if kind == "longtable" else ""))
    return "\n".join([rf"\begin{{{kind}}}{place}{{{''.join(columns)}}}", *lines, rf"\end{{{kind}}}\par\smallskip"])


def _latex_escaped(text: str) -> str:
    """Signs that LaTeX would read as its own, and letters that its fonts do not have."""
    return "".join(_SIGNS.get(letter, letter) for letter in text)


def markdown(job: Job) -> list[bytes]:
    """The document in UTF-8."""
    return [("\n\n".join(_markdown_block(block) for block in solution(job)) + "\n").encode()]


def _markdown_block(block: Block) -> str:
    match block:
        case Heading(level, text):
            return f"{'#' * level} {_markdown_escaped(text)}"
        case Paragraph(parts):
            return marked_up(parts, _markdown_escaped)
        case Display(lines):
            return "$$\n\\begin{aligned}\n" + " \\\\\n".join(lines) + "\n\\end{aligned}\n$$"
        case Table(head, rows, numbers):
            rule = ["--:" if index in numbers else "---" for index in range(len(head))]
            written = [f"| {' | '.join(marked_up(cell, _markdown_escaped) for cell in row)} |" for row in (head, *rows)]
            return "\n".join([written[0], f"| {' | '.join(rule)} |", *written[1:]])


def _markdown_escaped(text: str) -> str:
    """Signs that Markdown would read as its own."""
    return re.sub(r"([\\`*_{}\[\]<>#|$~])", r"\\\1", text)
