"""Functions as a module of Basic: VBA for Excel, and LibreOffice Basic. ASCII bytes; the same text runs in both.

What differs between the two is avoided: -x ^ 2 is written with parentheses, an error value is asked for at once (LibreOffice
counts with it), xlErrNA is declared (LibreOffice does not know it), pi is computed (the editor of Excel cuts constants to 15
digits). A position that does not exist is CVErr(xlErrNA): #N/A in Excel, the text "Error 2042" in LibreOffice.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable, Mapping, Sequence

from mechsheet.exporting.functions import Function
from mechsheet.exporting.identifiers import ascii_word, identifiers
from mechsheet.exporting.lowering import Step
from mechsheet.exporting.routines import Parameter
from mechsheet.formula.nodes import Call, Node, Symbol, transform
from mechsheet.formula.printer import print_formula
from mechsheet.model import Words
from mechsheet.units import Unit

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

DECLARED = 5
"""Variables declared in one line."""

INFALLIBLE = ("length",)
"""The functions whose value is always a number."""

HELPERS = """\
Private Function PiValue() As Double
    PiValue = 4 * Atn(1)
End Function

Private Function MaxOf(ByVal x As Double, ByVal y As Double) As Double
    If x > y Then MaxOf = x Else MaxOf = y
End Function

Private Function MinOf(ByVal x As Double, ByVal y As Double) As Double
    If x < y Then MinOf = x Else MinOf = y
End Function

Private Function Modulo(ByVal x As Double, ByVal y As Double) As Double
    Modulo = x - y * Int(x / y)
End Function

Private Function ArcSin(ByVal x As Double) As Variant
    If Abs(x) > 1 Then
        ArcSin = CVErr(xlErrNA)
    ElseIf Abs(x) = 1 Then
        ArcSin = x * 2 * Atn(1)
    Else
        ArcSin = Atn(x / Sqr((1 - x) * (1 + x)))
    End If
End Function

Private Function ArcCos(ByVal x As Double) As Variant
    If Abs(x) > 1 Then
        ArcCos = CVErr(xlErrNA)
    ElseIf x = -1 Then
        ArcCos = 4 * Atn(1)
    Else
        ArcCos = 2 * Atn(Sqr((1 - x) / (1 + x)))
    End If
End Function
"""
"""What Basic does not have."""

ANGLE = """\
    If {x} > 0 Then
        {name} = Atn({y} / {x})
    ElseIf {x} < 0 Then
        If {y} < 0 Then {name} = Atn({y} / {x}) - PiValue() Else {name} = Atn({y} / {x}) + PiValue()
    ElseIf {y} = 0 Then
        {name} = CVErr(xlErrNA)
    Else
        {name} = Sgn({y}) * PiValue() / 2
    End If
"""
"""The direction of a vector, which Basic does not have: the arc tangent in its quadrant."""


def module(functions: Sequence[Function], opening: Iterable[str], name: str, language: str) -> str:
    """The module's text, lines ended by a line feed.

    opening  lines of the comment at its head
    name     what the module is called; "" leaves that line out (LibreOffice keeps the name elsewhere)
    """
    names = function_names(functions)
    calls = {function.key: _call(names[function.key], len(function.parameters)) for function in functions}
    parts = [f'Attribute VB_Name = "{name}"'] if name else []
    parts += ["Option Explicit", "", *(_comment(line) for line in opening), ""]
    parts += ["Private Const xlErrNA As Long = 2042", ""]
    for basic, title in ((True, _BASIC), (False, _MECHANISM)):
        chosen = [function for function in functions if function.basic == basic]
        if not chosen:
            continue
        parts += [_rule(title.of(language)), ""]
        if not basic:
            parts += [*_parameters(chosen[0], language), ""]
        parts += [_Writer(function, names, calls, language).text() for function in chosen]
    parts += [_rule(_HELPERS.of(language)), "", HELPERS]
    return "\n".join(parts)


_BASIC = Words("Basic functions", "Temel fonksiyonlar")
_MECHANISM = Words("Functions of the mechanism", "Mekanizmanın fonksiyonları")
_HELPERS = Words("What Basic does not have", "Basic'te bulunmayanlar")


def _call(name: str, count: int) -> str:
    return f"{name}({', '.join(f'{{{index}}}' for index in range(count))})"


def _parameters(function: Function, language: str) -> list[str]:
    """The parameters that all functions of a mechanism share."""
    lines = [_comment(Words("Parameters, in this order:", "Parametreler, bu sırayla:").of(language))]
    for part, shown in zip(function.routine.parameters, function.parameters, strict=True):
        default = function.modes.get(part.symbol)
        words = Words("; {0} when left out", "; yazılmazsa {0}").of(language).format(default) if default else ""
        lines.append(_comment(f"    {shown}: {part.label.of(language)}{_unit(part.unit)}{words}"))
    return lines


def function_names(functions: Sequence[Function]) -> dict[str, str]:
    """Key of a function -> its name in Basic."""
    keys = {function.name: function.key for function in functions}
    return {keys[shown]: name for shown, name in identifiers(keys, KEYWORDS).items()}


def ascii_text(text: str) -> str:
    """A text in ASCII: ğ is g, θ is theta, what has no letter is a question mark."""
    for sign, instead in (("→", "->"), ("–", "-"), ("−", "-"), ("°", "deg"), ("’", "'"), ("×", "x")):
        text = text.replace(sign, instead)
    plain = "".join(ascii_word(sign) if sign.isalpha() and not sign.isascii() else sign for sign in text)
    plain = unicodedata.normalize("NFKD", plain)
    return plain.encode("ascii", "replace").decode("ascii")


class _Writer:
    """One function, line by line."""

    def __init__(self, function: Function, names: Mapping[str, str], calls: Mapping[str, str], language: str) -> None:
        self.function = function
        self.calls = calls
        self.fallible = (names.keys() - set(INFALLIBLE)) | {"ASIN", "ACOS"}
        self.language = language
        self.name = names[function.key]
        self.names: dict[str, str] = {}
        self.taken = [*KEYWORDS, *names.values()]
        self.types: dict[str, str] = {}
        self.lines: list[str] = []
        self.jumps = False
        for part, shown in zip(function.routine.parameters, function.parameters, strict=True):
            self.called(part.symbol, shown)

    def called(self, symbol: str, shown: str) -> str:
        """A name in this function."""
        self.names[symbol] = identifiers([shown], self.taken)[shown]
        self.taken.append(self.names[symbol])
        return self.names[symbol]

    def text(self) -> str:
        """The function with the comment over it."""
        routine = self.function.routine
        parameters = [self.names[part.symbol] for part in routine.parameters]
        given = [f"ByVal {self.names[part.symbol]} As Double" for part in routine.parameters if not self.optional(part)]
        left_out = [self.names[part.symbol] for part in routine.parameters if self.optional(part)]
        given += [f"Optional ByVal {name} As Variant" for name in left_out]
        if routine.key == "angle":
            self.lines += ANGLE.format(name=self.name, x=parameters[0], y=parameters[1]).splitlines()
        else:
            self.body()
        head = _wrapped(f"Public Function {self.name}({', '.join(given)}) As Variant", "    ")
        ending = []
        if self.jumps:
            ending = ["    Exit Function", "NoPosition:", f"    {self.name} = CVErr(xlErrNA)"]
        return "\n".join([*self.comment(), *head, *self.declarations(), *self.lines, *ending, "End Function", ""])

    def optional(self, part: Parameter) -> bool:
        """True for a configuration that may be left out."""
        return part.symbol in self.function.modes

    def comment(self) -> list[str]:
        """What the function is, and its parameters (those of a mechanism stand at the head of its functions)."""
        routine = self.function.routine
        lines = [_comment(routine.about.of(self.language) + _unit(routine.unit))]
        if self.function.basic:
            for part in routine.parameters:
                lines.append(
                    _comment(f"    {self.names[part.symbol]}: {part.label.of(self.language)}{_unit(part.unit)}")
                )
        return lines

    def declarations(self) -> list[str]:
        """Variables, the way out, and the configurations that were left out."""
        lines = []
        for kind in ("Double", "Variant"):
            names = [name for name, of in self.types.items() if of == kind]
            for start in range(0, len(names), DECLARED):
                declared = (f"{name} As {kind}" for name in names[start : start + DECLARED])
                lines.append(f"    Dim {', '.join(declared)}")
        if self.jumps:
            lines.append("    On Error GoTo NoPosition")
        for symbol, value in self.function.modes.items():
            lines.append(f"    If IsMissing({self.names[symbol]}) Then {self.names[symbol]} = {value}")
        return lines

    def body(self) -> None:
        """The steps and the result."""
        routine = self.function.routine
        self.jumps = bool(routine.steps)
        for step in routine.steps:
            self.assign(self.called(step.symbol, step.symbol), step)
        self.assign(self.name, Step(self.name, routine.result, routine.missing))

    def assign(self, target: str, step: Step) -> None:
        """`target = expression`; where there is no number, the function ends."""
        expression = step.expression
        if step.missing is not None:
            self.jumps = True
            self.line(f"If {self.said(self.apart(step.missing))} Then GoTo NoPosition")
        if isinstance(expression, Call) and expression.name in self.fallible:
            call = Call(expression.name, tuple(self.apart(arg) for arg in expression.args))
            self.line(f"{target} = {self.said(call)}")
            if target != self.name:
                self.types[target] = "Variant"
                self.jumps = True
                self.line(f"If IsError({target}) Then GoTo NoPosition")
            return
        if target != self.name:
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
        self.lines += _wrapped("    " + text, "        ")


def _unit(unit: Unit) -> str:
    return f" [{unit.symbol}]" if unit.kind == "angle" else ""


def _rule(title: str) -> str:
    return _comment(f"--- {title} ".ljust(WIDTH - 2, "-"))


def _comment(text: str) -> str:
    return f"' {ascii_text(text)}".rstrip()


def _wrapped(line: str, indent: str) -> list[str]:
    """A line in pieces, with ` _` at the end of each but the last; broken after a comma, or at a blank."""
    lines = []
    while len(line) > WIDTH:
        at = line.rfind(", ", len(indent) + 1, WIDTH - 2) + 1 or line.rfind(" ", len(indent) + 1, WIDTH - 2)
        if at < 0:
            break
        lines.append(line[:at] + " _")
        line = indent + line[at + 1 :]
    return [*lines, line]
