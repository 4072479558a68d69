"""The text of a module in Basic to its functions, as plain data: expressions are trees, variables are symbols in them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import TypeAlias

from ..diagnostics import Fault
from ..formula.lexer import Token
from ..formula.nodes import Call, Node, Number, Symbol
from ..said import reason, say
from .expressions import MOST_NESTED, NotReadError, expression, tokens, too_deep


@dataclass(frozen=True, slots=True)
class Assign:
    """A variable gets a value."""

    name: str
    value: Node


@dataclass(frozen=True, slots=True)
class If:
    """Conditions with what is done where the first of them holds, and what is done where none does."""

    branches: tuple[tuple[Node, Statements], ...]
    otherwise: Statements = ()


@dataclass(frozen=True, slots=True)
class For:
    """A variable that counts."""

    name: str
    first: Node
    last: Node
    step: Node
    body: Statements


@dataclass(frozen=True, slots=True)
class Do:
    """Again and again while the conditions hold: `before` each round, `after` it; None: always."""

    before: Node | None
    after: Node | None
    body: Statements


@dataclass(frozen=True, slots=True)
class Exit:
    """Out of the innermost "for" or "do", or of the "function"."""

    kind: str


@dataclass(frozen=True, slots=True)
class GoTo:
    """On at a label."""

    label: str


@dataclass(frozen=True, slots=True)
class Label:
    """A place to go to."""

    name: str


@dataclass(frozen=True, slots=True)
class OnError:
    """From here on an error goes on at a label; an empty one: it ends the function."""

    label: str


Statement: TypeAlias = Assign | If | For | Do | Exit | GoTo | Label | OnError
Statements: TypeAlias = tuple[Statement, ...]


@dataclass(frozen=True, slots=True)
class Parameter:
    """`by_value` False: what the function assigns to it would change the caller's variable."""

    name: str
    optional: bool = False
    by_value: bool = False


@dataclass(frozen=True, slots=True)
class Function:
    """A function.

    name       as it is written; all other names are in small letters
    whole      variables that hold whole numbers: what is assigned to them is rounded
    constants  of the module and of the function
    """

    name: str
    line: int
    parameters: tuple[Parameter, ...]
    body: Statements
    whole: frozenset[str]
    constants: dict[str, Node]


_HEAD = re.compile(r"(?:(?:public|private|friend)\s+)?function\s+(\w+)[%&!#@]?\s*\((.*)\)(?:\s+as\s+(\w+))?$", re.I)
_SUB = re.compile(r"(?:(?:public|private|friend|static)\s+)*(?:sub|property|type|enum)\b", re.I)
_LABEL = re.compile(r"(\w+)$")
_WHOLE = ("integer", "long", "byte")
_NUMBERS = (*_WHOLE, "double", "single", "variant", "currency", "boolean")
_KEPT = re.compile(r"(?:(?:public|private|global|dim)\s+)(?!const\b|function\b|sub\b)(\w.*)$", re.I)


def decoded(content: bytes) -> str:
    """The text of a module: Excel exports them in the code page of Windows, Turkish ones in its Turkish one."""
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("cp1254", "replace")


def functions_in(text: str, source: str = "") -> tuple[list[Function], list[Fault]]:
    """The functions of a module that can be read, and of each of the others why it cannot."""
    found: list[Function] = []
    faults: list[Fault] = []
    constants: dict[str, Node] = {}
    kept: set[str] = set()
    lines = list(_statements(text))
    place = 0
    while place < len(lines):
        number, line = lines[place]
        place += 1
        head = _HEAD.match(line)
        if head:
            end = _end_of(lines, place, "function")
            try:
                found.append(_function(head, number, lines[place:end], constants, kept))
            except _LineError as error:
                message = say("the function {name} is left out: {found} is not read", name=head[1], found=error.found)
                hint = say("arithmetic, If, For, Do, Exit and GoTo to a label further down are")
                faults.append(Fault(message, file=source, line=error.line, about="routine", hint=hint))
            place = end + 1
        elif match := _SUB.match(line):
            place = _end_of(lines, place, match[0].split()[-1].lower()) + 1
        elif re.match(r"(?:(?:public|private|global)\s+)?const\b", line, re.I):
            try:
                constants |= _constants(line, number)
            except _LineError as error:
                kept.add(_bare(error.found.split()[0]) if error.found else "")
        elif match := _KEPT.match(line):
            kept |= {name.strip().split()[0].split("(")[0].lower() for name in match[1].split(",") if name.strip()}
    return found, faults


@dataclass
class _LineError(Exception):
    """What cannot be read, and in which line."""

    line: int
    found: str


def _statements(text: str) -> Iterator[tuple[int, str]]:
    """Number and text of each statement: lines that go on are one, comments are left out, a colon ends a statement."""
    joined, start = "", 0
    for number, line in enumerate(text.splitlines(), 1):
        bare = _without_comment(line).strip()
        start = start or number
        if bare.endswith(" _") or bare == "_":
            joined += bare[:-1] + " "
            continue
        whole, first = (joined + bare).strip(), start
        joined, start = "", 0
        if not whole or whole.lower().startswith(("rem ", "#")):
            continue
        head, colon, rest = whole.partition(":")
        if colon and _LABEL.match(head) and not rest.startswith("=") and head.lower() not in ("else", "do", "loop"):
            yield first, f"{head}:"
            whole = rest.strip()
        if re.match(r"if\b", whole, re.I):  # what stands in one line behind Then goes with it
            yield first, whole
            continue
        for part in _parted(whole, ":"):
            if part.strip():
                yield first, part.strip()


def _without_comment(line: str) -> str:
    return next(iter(_parted(line, "'")), "")


def _parted(text: str, sign: str) -> list[str]:
    """The parts of a text between the signs that stand in no text of it."""
    parts, inside, begun = [], False, 0
    for place, letter in enumerate(text):
        if letter == '"':
            inside = not inside
        elif letter == sign and not inside and text[place : place + 2] != ":=":
            parts.append(text[begun:place])
            begun = place + 1
    return [*parts, text[begun:]]


def _end_of(lines: Sequence[tuple[int, str]], place: int, kind: str) -> int:
    pattern = re.compile(rf"end\s+{kind}\b", re.I)
    return next((at for at in range(place, len(lines)) if pattern.match(lines[at][1])), len(lines))


def _function(
    head: re.Match[str], number: int, lines: Sequence[tuple[int, str]], constants: dict[str, Node], kept: set[str]
) -> Function:
    name, given, kind = head[1], head[2], (head[3] or "variant").lower()
    body = _Body(list(lines), dict(constants), set(kept))
    parameters = []
    for part in given.split(",") if given.strip() else ():
        words = part.split("=")[0].replace("()", " ()").split()
        named = [word for word in words if word.lower() not in ("byval", "byref", "optional", "as")]
        if not named or "()" in words or "=" in part or (len(named) > 1 and named[1].lower() not in _NUMBERS):
            raise _LineError(number, part.strip())
        lower = [word.lower() for word in words]
        parameters.append(Parameter(_bare(named[0]), "optional" in lower, "byval" in lower))
        if len(named) > 1 and named[1].lower() in _WHOLE:
            body.whole.add(_bare(named[0]))
    if kind not in _NUMBERS:
        raise _LineError(number, kind)
    if kind in _WHOLE:
        body.whole.add(name.lower())
    body.kept -= {parameter.name for parameter in parameters}
    found = body.block(())
    return Function(name, number, tuple(parameters), found, frozenset(body.whole), body.constants)


def _bare(name: str) -> str:
    return name.rstrip("%&!#@$").lower()


@dataclass
class _Body:
    """The statements of a function that are left."""

    lines: list[tuple[int, str]]
    constants: dict[str, Node]
    kept: set[str]
    whole: set[str] = field(default_factory=set)
    depth: int = 0

    def block(self, ends: tuple[str, ...]) -> Statements:
        """Statements up to one that begins with one of the words, which is left."""
        self.deeper()
        found: list[Statement] = []
        while self.lines:
            number, line = self.lines[0]
            word = line.split()[0].lower()
            if word in ends or " ".join(line.lower().split()[:2]) in ends:
                break
            self.lines.pop(0)
            try:
                found += self.statement(number, line, word)
            except NotReadError as error:
                raise _LineError(number, reason(error) or line) from None
        if ends and not self.lines:
            raise NotReadError(ends[-1])
        self.depth -= 1
        return tuple(found)

    def deeper(self) -> None:
        """One level more of blocks within each other, up to the limit."""
        self.depth += 1
        if self.depth > MOST_NESTED:
            raise too_deep()

    def statement(self, number: int, line: str, word: str) -> list[Statement]:
        """What a line says, with the lines that belong to it."""
        listed = () if line.endswith(":") else tokens(line)
        match word:
            case _ if line.endswith(":"):
                return [Label(line[:-1].lower())]
            case "dim":
                return self.declared(line)
            case "const":
                self.constants |= _constants(line, number)
                return []
            case "if":
                return [self.choice(line)]
            case "for":
                return [self.counted(list(listed))]
            case "do":
                return [self.repeated(list(listed))]
            case "while":
                body = self.block(("wend",))
                self.lines.pop(0)
                return [Do(self.read(list(listed)[1:]), None, body)]
            case "exit" if len(listed) == 2 and listed[1].text in ("for", "do", "function"):
                return [Exit(listed[1].text)]
            case "goto" if len(listed) == 2:
                return [GoTo(listed[1].text)]
            case "on" if [each.text for each in listed[:3]] == ["on", "error", "goto"] and len(listed) == 4:
                return [OnError("" if listed[3].text == "0" else listed[3].text)]
        return [self.assigned(list(listed))]

    def declared(self, line: str) -> list[Statement]:
        """Dim: kinds of variables; what is no number is refused."""
        for part in line[3:].split(","):
            words = part.split()
            kind = words[2].lower() if len(words) == 3 and words[1].lower() == "as" else "variant"
            if "(" in part or (len(words) not in (1, 3)) or kind not in _NUMBERS:
                raise NotReadError(part.strip())
            name = _bare(words[0])
            self.kept.discard(name)
            if kind in _WHOLE or words[0][-1] in "%&":
                self.whole.add(name)
        return []

    def assigned(self, listed: list[Token]) -> Statement:
        if listed and listed[0].text == "let":
            listed = listed[1:]
        if len(listed) < 3 or listed[0].kind != "name" or listed[1].text != "=" or listed[0].text in self.kept:
            raise NotReadError(" ".join(each.text for each in listed[:4]))
        return Assign(listed[0].text, self.read(listed[2:]))

    def read(self, listed: list[Token]) -> Node:
        """An expression; variables of the module keep their values between calls, which no formula can."""
        kept = next((each.text for each in listed if each.kind == "name" and each.text in self.kept), None)
        if kept is not None:
            raise NotReadError(kept)
        return expression(listed)

    def choice(self, line: str) -> If:
        """If with its branches, in one line or in several."""
        match = re.match(r"if\b(.*?)\bthen\b(.*)$", line, re.I)
        if match is None:
            raise NotReadError(line)
        condition = self.read(tokens(match[1]))
        if match[2].strip():
            done, *other = re.split(r"\belse\b", match[2], maxsplit=1, flags=re.I)
            return If(((condition, self.in_line(done)),), self.in_line(other[0]) if other else ())
        branches = [(condition, self.block(_BRANCHES))]
        otherwise: Statements = ()
        while True:
            _, line = self.lines.pop(0)
            lower = line.lower()
            if lower.startswith("elseif"):
                again = re.match(r"elseif\b(.*)\bthen$", line, re.I)
                if again is None:
                    raise NotReadError(line)
                condition = self.read(tokens(again[1]))
                branches.append((condition, self.block(_BRANCHES)))
            elif lower == "else":
                otherwise = self.block(("end if", "endif"))
            else:
                return If(tuple(branches), otherwise)

    def in_line(self, text: str) -> Statements:
        """Statements behind Then or Else in one line."""
        self.deeper()
        found: list[Statement] = []
        for part in _parted(text, ":"):
            if part.strip():
                found += self.statement(0, part.strip(), part.split()[0].lower())
        self.depth -= 1
        return tuple(found)

    def counted(self, listed: list[Token]) -> For:
        words = [each.text if each.kind == "name" else "" for each in listed]
        if len(listed) < 6 or listed[2].text != "=" or "to" not in words:
            raise NotReadError(" ".join(each.text for each in listed))
        to = words.index("to")
        step = words.index("step") if "step" in words else len(listed)
        by: Node = self.read(listed[step + 1 :]) if step < len(listed) else Number(1.0)
        body = self.block(("next",))
        self.lines.pop(0)
        return For(listed[1].text, self.read(listed[3:to]), self.read(listed[to + 1 : step]), by, body)

    def repeated(self, listed: list[Token]) -> Do:
        before = self.condition(listed[1:])
        body = self.block(("loop",))
        _, line = self.lines.pop(0)
        return Do(before, self.condition(tokens(line)[1:]), body)

    def condition(self, listed: list[Token]) -> Node | None:
        if not listed:
            return None
        if listed[0].text not in ("while", "until"):
            raise NotReadError(listed[0].text)
        node = self.read(listed[1:])
        return node if listed[0].text == "while" else Call("NOT", (node,))


_BRANCHES = ("elseif", "else", "end if", "endif")


def _constants(line: str, number: int) -> dict[str, Node]:
    """The constants of a line; a text is none of ours."""
    found: dict[str, Node] = {}
    listed = line[re.search(r"\bconst\b", line, re.I).end() :]  # type: ignore[union-attr]
    for part in listed.split(","):
        name, _, value = part.partition("=")
        try:
            found[_bare(name.split()[0])] = expression(tokens(value))
        except (NotReadError, IndexError):
            raise _LineError(number, part.strip()) from None
    return {name: node for name, node in found.items() if not isinstance(node, Symbol)}
