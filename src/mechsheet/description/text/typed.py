"""What people type that TOML does not take: found, told in words, and mended, so that the rest can be read as well.

Only texts that the standard reader has refused come here. The walk is made for broken text: it knows strings, comments,
tables and lists, and where it loses its way it begins again at the next line. Mending never changes the number of lines.
"""

from __future__ import annotations

import re
import tomllib
from dataclasses import dataclass, field

from livesheet.said import say
from mechsheet.description.text.index import BARE_KEY, Path, key_text, line_end
from mechsheet.description.text.numbers import BLANKS, MINUS, Typed, typed_number
from mechsheet.diagnostics import quoted

# Quotation marks of word processors.
_OPEN, _CLOSE = "“”„‟«»", "“”‟«»"
_SINGLE = "‘’‚‛"
_SIGN = rf"[^\s\#\[\]{{}}=:,;\"{_OPEN}{_SINGLE}]"
_PIECE = rf"(?:\((?:[^()\n]|\([^()\n]*\))*\)|{_SIGN})"
"""For a regular expression: a sign of a word, a number or an expression, or a whole argument list with its commas."""
_TOKEN = re.compile(
    rf"""
    (?P<string>\"\"\"(?:[^\\]|\\.)*?\"{{3,5}}|'''.*?'{{3,5}}|"(?:[^"\\\n{_OPEN}]|\\.)*"|'[^'\n]*'|"(?:[^"\\\n]|\\.)*")
    | (?P<smart>[{_OPEN}](?:[^{_OPEN}\n]*[{_CLOSE}]|[^{_OPEN}"\n]*")
        |[{_SINGLE}][^{_SINGLE}'\n]*[{_SINGLE}']|"[^"\n{_OPEN}]*[{_CLOSE}])
    | (?P<comment>\#[^\n]*)
    | (?P<blank>[ \t]+)
    | (?P<odd>[{BLANKS}]+)
    | (?P<line>\n)
    | (?P<open>[\[{{]) | (?P<close>[\]}}]) | (?P<equals>[=:]) | (?P<comma>[,;])
    | (?P<run>{_PIECE}+(?:[ \t]+{_PIECE}+)*)
    | (?P<other>.)
    """,
    re.VERBOSE | re.DOTALL,
)
_DECIMAL_COMMA = re.compile(
    rf"[+\-{MINUS}]?[ {BLANKS}]*[\d.]*\d,\d+(?:[ \t{BLANKS}]*(?:[^\W\d_]+|[°%]))?(?=[ \t]*(?:[,}}\#\n]|$))"
)
"""A number with a decimal comma and what may stand behind it; not `1, 2` of a list, not `a = 1, 2b = …` of a table."""
_HEADING = re.compile(r"\[\[?[A-Za-z_][\w.\- \"]*\]\]?[ \t]*(?:#|\n|$)")
_TO_NEXT = re.compile(r"[^,\]}#\n\"']*")
_HEAD = re.compile(r"(\[\[?)((?:\"[^\"]*\"|'[^']*'|[^\]\"'\#])*)(\]{0,2})")
_EQUALS = re.compile(r"[ \t]*[=:]")
_COMMENT = re.compile(r"[ \t]*//[^\n]*")


@dataclass(frozen=True, slots=True)
class Mistake:
    """One thing that TOML does not take, at `offset` of the text, at the key `path`."""

    offset: int
    path: Path
    message: str
    hint: str


@dataclass(frozen=True, slots=True)
class Meant:
    """A text as it is meant: what TOML does not take is replaced, and told; `keys` has the key of each line."""

    text: str
    mistakes: tuple[Mistake, ...]
    keys: tuple[Path, ...]


def mended(text: str) -> Meant:
    """The text with what is surely meant in place of what TOML does not take, and what that was."""
    walk = _Walk(text)
    walk.run()
    return Meant("".join(walk.parts), tuple(walk.mistakes), (*walk.lines, walk.keys))


@dataclass(slots=True)
class _Level:
    """A list or an inline table that is open: its path, where it began, the number of elements so far."""

    sign: str
    path: Path
    offset: int
    count: int = 0


@dataclass(slots=True)
class _Walk:
    """`expects` is "key", "equals", "value" or "rest" (of a line, or up to a comma)."""

    text: str
    parts: list[str] = field(default_factory=list)
    mistakes: list[Mistake] = field(default_factory=list)
    table: Path = ()
    counts: dict[Path, int] = field(default_factory=dict)
    levels: list[_Level] = field(default_factory=list)
    keys: Path = ()
    lines: list[Path] = field(default_factory=list)
    expects: str = "key"
    at: int = 0

    def run(self) -> None:
        while self.at < len(self.text):
            if self.expects == "value" and not self.in_list() and (comma := _DECIMAL_COMMA.match(self.text, self.at)):
                self.value(comma.group().strip(), self.at)
                self.at = comma.end()
                continue
            found = _TOKEN.match(self.text, self.at)
            if found is None:
                raise AssertionError(f"no token at offset {self.at}")
            begin, self.at = self.at, found.end()
            getattr(self, f"on_{found.lastgroup}")(found.group(), begin)

    def in_list(self) -> bool:
        return bool(self.levels) and self.levels[-1].sign == "["

    def path(self) -> Path:
        """Where the walk is: the key, or the element of a list."""
        return (*self.levels[-1].path, self.levels[-1].count) if self.in_list() else self.keys

    def keep(self, word: str) -> None:
        self.parts.append(word)

    def mend(self, begin: int, new: str, message: str, hint: str = "") -> None:
        """Write `new` in its place, and say so; without a `hint` it is what to write."""
        self.mistakes.append(Mistake(begin, self.path(), message, hint or say("write {new}", new=new)))
        self.parts.append(new)

    # ---- one kind of token each

    def on_comment(self, word: str, begin: int) -> None:
        self.keep(word)

    def on_blank(self, word: str, begin: int) -> None:
        self.keep(word)

    def on_odd(self, word: str, begin: int) -> None:
        message = say("a blank that is no ordinary one stands here: U+{code:04X}", code=ord(word[0]))
        self.mend(begin, " ", message, say("it comes from a web page or a word processor; type a space in its place"))

    def on_line(self, word: str, begin: int) -> None:
        self.keep(word)
        self.lines.append(self.keys)
        if self.in_list():
            return
        if self.levels:
            first = next(level for level in self.levels if level.sign == "{")
            message = say("this table in braces does not end on its line")
            hint = say("{ … } stands on one line, commas between its keys")
            self.mistakes.append(Mistake(first.offset, first.path, message, hint))
        self.levels.clear()
        self.keys, self.expects = self.table, "key"

    def on_open(self, word: str, begin: int) -> None:
        if self.in_list() and self.text[begin - 1] == "\n" and _HEADING.match(self.text, begin):
            self.close_lists()
        if not self.levels and self.expects == "key" and word == "[":
            self.header(begin)
            return
        self.keep(word)
        self.levels.append(_Level(word, self.path(), begin))
        self.keys = self.levels[-1].path
        self.expects = "value" if word == "[" else "key"

    def on_close(self, word: str, begin: int) -> None:
        self.keep(word)
        if self.levels:
            self.keys = self.levels.pop().path
        self.expects = "rest"

    def on_equals(self, word: str, begin: int) -> None:
        if self.expects != "equals":
            self.keep(word)
            return
        if word == ":":
            self.mend(begin, " =", say("a key and its value are joined by =, not by :"), say('write "=" in its place'))
        else:
            self.keep(word)
        self.expects = "value"

    def on_comma(self, word: str, begin: int) -> None:
        if word == ";" and self.levels:
            self.mend(
                begin,
                ",",
                say("what stands in brackets is separated by commas, not by ;"),
                say('write "," in its place'),
            )
        else:
            self.keep(word)
        if self.levels:
            self.levels[-1].count += 1
            self.keys = self.levels[-1].path
            self.expects = "value" if self.in_list() else "key"

    def on_string(self, word: str, begin: int) -> None:
        if self.expects == "key" and word[:3] not in ('"""', "'''"):
            self.on_run(word, begin)
            return
        self.keep(word)
        self.expects = "rest"

    def on_smart(self, word: str, begin: int) -> None:
        content = word[1:-1]
        new = '"' + content.replace("\\", "\\\\").replace('"', '\\"') + '"'
        number = typed_number(content) if self.expects == "value" and self.keys[:1] == ("dimensions",) else None
        if number is not None:
            new = _as_taken(number)
        behind = "rest"
        if self.expects == "key":
            self.keys, behind = (*self.keys, content), "equals"
        signs = " ".join(dict.fromkeys(sign for sign in (word[0], word[-1]) if sign not in "\"'"))
        message = say("quotation marks of a word processor ({signs}) around {content}", signs=signs, content=content)
        self.mend(begin, new, message, say('write {new}, with the " of the keyboard', new=new) if new[0] == '"' else "")
        self.expects = behind

    def on_other(self, word: str, begin: int) -> None:
        found = _TO_NEXT.match(self.text, self.at)
        if word not in f"\"'{_OPEN}{_SINGLE}" or self.expects != "value" or found is None:
            self.keep(word)
            return
        new = f'"{found.group().rstrip()}"'
        self.at = begin + 1 + len(found.group().rstrip())
        self.mend(begin, new, say("the text that begins here is not closed"))
        self.expects = "rest"

    def on_run(self, word: str, begin: int) -> None:
        if self.expects == "value" and not self.is_key_of_next_line():
            self.value(word, begin)
        elif self.expects != "rest":
            self.key(word, begin)
        else:
            self.keep(word)

    # ---- headers, keys and values

    def header(self, begin: int) -> None:
        """`[links.sarkaç]`: the line's table, with the parts that need quotes in quotes."""
        line = self.text[begin : line_end(self.text, begin)]
        found = _HEAD.match(line)
        if found is None or not _parts(found[2]):
            self.keep(line)
            self.at = begin + len(line)
            return
        names, array, closed = _parts(found[2]), found[1] == "[[", found[3] == "]" * len(found[1])
        self.table = self.keys = self.counted(names, array)
        new = found[1] + _with_quotes(names) + "]" * len(found[1])
        if not all(_fits(part) for part in _split(found[2])):
            message = say("in {heading} a name needs quotes: {why}", heading=found.group().strip(), why=_beyond(names))
            self.mend(begin, new, message)
        elif not closed:
            self.mend(begin, new, say("the heading {heading} is not closed", heading=found.group().strip()))
        else:
            self.keep(found.group())
        self.at = begin + found.end()
        self.expects = "rest"

    def counted(self, names: list[str], array: bool) -> Path:
        """The path of a heading: elements of arrays of tables by number."""
        path: Path = ()
        for place, name in enumerate(names):
            path = (*path, name)
            if array and place == len(names) - 1:
                self.counts[path] = self.counts.get(path, -1) + 1
            if path in self.counts:
                path = (*path, self.counts[path])
        return path

    def key(self, word: str, begin: int) -> None:
        names = _parts(word)
        before = self.levels[-1].path if self.levels else self.table
        self.keys = (*before, *names)
        parts = _split(word)
        if all(_fits(part) for part in parts):
            self.keep(word)
        elif _EQUALS.match(self.text, self.at):
            new = _with_quotes(names)
            message = say("this key needs quotes: {why}", why=_beyond(names))
            self.mend(begin, new, message, say("write {new} = …", new=new))
        else:
            self.keep(word)
        self.expects = "equals"

    def is_key_of_next_line(self) -> bool:
        """Inside a list, a word with = behind it: the list was never closed. The walk begins again with this line."""
        if not self.in_list() or not _EQUALS.match(self.text, self.at):
            return False
        self.close_lists()
        return True

    def close_lists(self) -> None:
        """What is open is closed where the last line ended, before its comment."""
        first = self.levels[0]
        end = "]" if first.sign == "[" else "}"
        message = say("what begins here with {sign} is not closed", sign=first.sign)
        self.mistakes.append(Mistake(first.offset, first.path, message, say('write "{end}" at its end', end=end)))
        place = len(self.parts)
        while place and self.parts[place - 1] != "\n":
            place -= 1
        while place and (not self.parts[place - 1].strip() or self.parts[place - 1].startswith("#")):
            place -= 1
        self.parts.insert(place, "".join("]" if level.sign == "[" else "}" for level in reversed(self.levels)))
        self.levels.clear()
        self.keys, self.expects = self.table, "key"

    def value(self, word: str, begin: int) -> None:
        self.expects = "rest"
        if (slashes := _COMMENT.search(self.text, begin, self.at)) and slashes.start() > begin:
            self.at = slashes.start()
            self.value(self.text[begin : self.at], begin)
            self.at = line_end(self.text, begin)
            self.mend(slashes.start(), "", say("a comment begins with #, not with //"), say('write "#" in its place'))
            return
        if _is_value(word):
            self.keep(word)
            return
        number = typed_number(word)
        if number is not None:
            message = say(
                "found {text}: {why}",
                text=quoted(word),
                why=number.why or say("not the way in which TOML writes numbers"),
            )
            self.mend(begin, _as_taken(number), message, number.hint)
            return
        if word[0] == "(" and "," in word and word[-1] == ")":
            self.mend(begin, f"[{word[1:-1]}]", say("a list stands in square brackets, not in round ones"))
            return
        new = '"' + word.strip().replace("\\", "\\\\") + '"'
        of_dimension = self.keys[:1] == ("dimensions",) and len(self.keys) == 2
        hint = say("write {{ formula = {new} }}", new=new) if of_dimension else ""
        self.mend(begin, new, say("texts and expressions stand in quotes, found {text}", text=quoted(word)), hint)


def _as_taken(number: Typed) -> str:
    """A number that was meant as TOML: with its unit in quotes, where that is known."""
    return f'"{number.measured}"' if number.measured is not None else number.text


def _split(dotted: str) -> list[str]:
    """The parts of a dotted key as written, quotes included."""
    return [part.strip() for part in re.findall(r"\s*(\"[^\"]*\"|'[^']*'|[^.\"']+)\s*", dotted)]


def _parts(dotted: str) -> list[str]:
    return [part.strip("\"'") for part in _split(dotted)]


def _with_quotes(names: list[str]) -> str:
    return ".".join(key_text(name) for name in names)


def _fits(part: str) -> bool:
    return part[:1] in "\"'" or BARE_KEY.fullmatch(part) is not None


def _beyond(names: list[str]) -> str:
    """Why names do not stand without quotes."""
    odd = [name for name in names if not BARE_KEY.fullmatch(name)]
    signs = "".join(dict.fromkeys(sign for name in odd for sign in name if not BARE_KEY.fullmatch(sign)))
    shown = say("a blank") if not signs.strip() else quoted(signs)
    return say("without them only a-z, A-Z, 0-9, _ and - are allowed, found {shown}", shown=shown)


def _is_value(word: str) -> bool:
    try:
        tomllib.loads(f"x = {word}")
    except ValueError:
        return False
    return True
