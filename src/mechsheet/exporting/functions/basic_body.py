"""What every procedure of Basic is written with: names, assignments line by line, comments; the words that are taken."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable, Mapping

from livesheet.formula.nodes import Call, Node, Symbol, transform
from livesheet.formula.printer import print_formula
from mechsheet.exporting.lowering import Step
from mechsheet.exporting.program import ascii_word, identifiers
from mechsheet.kinematics.newton.newton_equations import ITERATED

WIDTH = 100
"""Characters of a line; VBA takes 1,023 and 24 continuations."""

_WORDS = """
abs alias and any append application arccos arcsin array as asc atn attribute base boolean byref byte byval
call case cbool cbyte ccur cdate cdbl cdec cells chr cint circle clng close compare const cos createobject
csng cstr currency cvar cverr date dateserial day debug decimal declare defbool defint deftype dim dir do
double each else elseif empty end enum environ eof eqv erase err error event exit exp explicit false fix for
format friend function get global gosub goto hex hour if iif imp implements in input instr int integer is
isarray isdate isempty iserror ismissing isnull isnumeric isobject kill lbound lcase left len lenb let lib
like line lock log long loop lset ltrim maxof me mid minof minute mod modulo month msgbox name new next
noposition not nothing now null object oct on open option optional or output paramarray pi pivalue preserve
print private property pset public put raiseevent randomize range read redim rem replace reset resume return
right rnd round rset rtrim scale second seek select set sgn shared sin single space spc split sqr static step
stop str strconv string sub tab tan text then time timer timeserial to trim true type typename typeof ubound
ucase unlock until userform val variant vartype wait weekday wend while width with withevents workbook
worksheet write xlerrna xor year
"""

KEYWORDS = tuple(_WORDS.split())
"""Words that are taken: of the language, and of what the module brings along."""

INFALLIBLE = ("length",)
"""The functions whose value is always a number."""

DECLARED = 5
"""Variables declared in one line."""


class Body:
    """The lines of one procedure. A step that has no number goes to `NoPosition`.

    calls  key of a function -> how it is called, `{0}` being its first argument
    taken  names that something else has
    """

    def __init__(self, calls: Mapping[str, str], taken: Iterable[str]) -> None:
        self.calls = calls
        self.fallible = calls.keys() - {*INFALLIBLE} | {"ASIN", "ACOS"}
        self.names: dict[str, str] = {}
        self.taken = [*KEYWORDS, *taken]
        self.types: dict[str, str] = {}
        self.lines: list[str] = []
        self.jumps = False

    def called(self, symbol: str, shown: str) -> str:
        """A name in this procedure."""
        self.names[symbol] = identifiers([shown], self.taken)[shown]
        self.taken.append(self.names[symbol])
        return self.names[symbol]

    def declared(self) -> list[str]:
        """The variables."""
        lines = []
        for kind in ("Double", "Variant"):
            names = [name for name, of in self.types.items() if of == kind]
            for start in range(0, len(names), DECLARED):
                declared = (f"{name} As {kind}" for name in names[start : start + DECLARED])
                lines.append(f"    Dim {', '.join(declared)}")
        return lines

    def steps(self, steps: Iterable[Step]) -> None:
        """All of them, each with a variable of its own."""
        for step in steps:
            self.assign(self.called(step.symbol, shown_name(step.symbol)), step)

    def assign(self, target: str, step: Step, declared: bool = False) -> None:
        """`target = expression`; where there is no number, the procedure ends. declared: the target has a type already."""
        expression = step.expression
        if step.missing is not None:
            self.jumps = True
            self.line(f"If {self.said(self.apart(step.missing))} Then GoTo NoPosition")
        if isinstance(expression, Call) and expression.name in self.fallible:
            call = Call(expression.name, tuple(self.apart(arg) for arg in expression.args))
            self.line(f"{target} = {self.said(call)}")
            if not declared:
                self.types[target] = "Variant"
                self.jumps = True
                self.line(f"If IsError({target}) Then GoTo NoPosition")
            return
        if not declared:
            self.types[target] = "Double"
        self.line(f"{target} = {self.said(self.apart(expression))}")

    def apart(self, node: Node) -> Node:
        """The expression with variables in place of the calls in it whose value may be an error."""

        def change(part: Node) -> Node:
            if not isinstance(part, Call) or part.name not in self.fallible:
                return part
            symbol = f"part {len(self.names)}"
            self.assign(self.called(symbol, "part"), Step(symbol, part))
            return Symbol(symbol)

        return transform(node, change)

    def said(self, node: Node) -> str:
        """The text of an expression."""
        return print_formula(node, "basic", lambda part: self.names[part.name], self.calls)

    def line(self, text: str) -> None:
        """A line, broken where it is long."""
        self.lines += wrapped("    " + text, "        ")


def shown_name(symbol: str) -> str:
    """What a symbol is called: within a pass as in the table."""
    return symbol.removesuffix(ITERATED.format(symbol=""))


def ascii_text(text: str) -> str:
    """A text in ASCII: ğ is g, θ is theta, what has no letter is a question mark."""
    for sign, instead in (("→", "->"), ("–", "-"), ("−", "-"), ("°", "deg"), ("’", "'"), ("×", "x")):
        text = text.replace(sign, instead)
    plain = "".join(ascii_word(sign) if sign.isalpha() and not sign.isascii() else sign for sign in text)
    plain = unicodedata.normalize("NFKD", plain)
    return plain.encode("ascii", "replace").decode("ascii")


def rule(title: str) -> str:
    """A heading in the module."""
    return comment(f"--- {title} ".ljust(WIDTH - 2, "-"))


def comment(text: str) -> str:
    """A comment of one line."""
    return f"' {ascii_text(text)}".rstrip()


def wrapped(line: str, indent: str) -> list[str]:
    """A line in pieces, with ` _` at the end of each but the last; broken after a comma, or at a blank."""
    lines = []
    while len(line) > WIDTH:
        at = line.rfind(", ", len(indent) + 1, WIDTH - 2) + 1 or line.rfind(" ", len(indent) + 1, WIDTH - 2)
        if at < 0:
            break
        lines.append(line[:at] + " _")
        line = indent + line[at + 1 :]
    return [*lines, line]
