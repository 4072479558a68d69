"""What the commands share: how help reads, options, a progress line, and mistakes told with the description's lines."""

from __future__ import annotations

import contextlib
import inspect
import re
import sys
import warnings
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from livesheet.diagnostics import Fault, OutputError, readable_name
from livesheet.replacing import is_stream
from livesheet.said import Said, say
from mechsheet.arguments.outputs import file_in, folder_ready, is_there
from mechsheet.diagnostics import DescriptionWarning, MechanismError, MechsheetError
from mechsheet.words.catalogue import LANGUAGES

from .speaking import fault_told, language_of, speak, told

if TYPE_CHECKING:
    from mechsheet.model import Mechanism

Command = TypeVar("Command", bound=Callable[..., Any])

FILE = click.Path(path_type=Path)
"""The type of what names a file or a folder."""

STANDARD_INPUT = Path("-")


def described(path: Path, settings: Iterable[str] = (), **others: Any) -> Mechanism:
    """The mechanism of a file, or of standard input when it is called `-`, with `a1=65` of --set and other `Overrides`."""
    from mechsheet.description import MAX_BYTES, Overrides, text_of
    from mechsheet.description.text.source import read_text
    from mechsheet.library.changed import loads

    pairs, faults = _pairs(settings)
    overrides = Overrides(pairs, **others)
    try:
        if path != STANDARD_INPUT:
            text = read_text(path)
        else:
            content = b"" if sys.stdin is None else sys.stdin.buffer.read(MAX_BYTES + 1)  # None: it was closed
            text = text_of(content, _name_of(path))
        speak(overrides.language or language_of(text))
        mechanism = loads(text, _name_of(path), overrides)
    except MechsheetError as error:
        if not faults:
            raise
        raise MechsheetError([*faults, *error.faults]) from error
    if faults:
        raise MechsheetError(faults)
    return mechanism if path == STANDARD_INPUT else replace(mechanism, file=path.stem)


def _name_of(path: Path) -> str:
    return "<stdin>" if path == STANDARD_INPUT else readable_name(path)


@contextlib.contextmanager
def at_lines_of(mechanism: Mechanism, path: Path) -> Iterator[None]:
    """What is wrong with a mechanism, and what is doubtful, is told with the description's file and line."""
    from mechsheet.description.report import located

    def at_line(error: MechanismError) -> MechsheetError:
        return located(error, mechanism.listing, _name_of(path))

    speak(mechanism.language)
    with doubts_told(at_line):
        try:
            yield
        except MechanismError as error:
            raise at_line(error) from error


def in_file(path: Path) -> Callable[[MechanismError], MechsheetError]:
    """Where doubts are, when only the file is known."""
    return lambda error: MechanismError(replace(fault, file=fault.file or _name_of(path)) for fault in error.faults)


@contextlib.contextmanager
def doubts_told(at: Callable[[MechanismError], MechsheetError]) -> Iterator[None]:
    """Doubts about a mechanism become lines on standard error; `at` says where they are."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", DescriptionWarning)
        yield
    doubts = [warning.message.fault for warning in caught if isinstance(warning.message, DescriptionWarning)]
    for fault in at(MechanismError(dict.fromkeys(doubts))).faults if doubts else ():
        click.echo(told(say("warning: {fault}", fault=fault_told(fault))), err=True)
    for warning in caught:
        if not isinstance(warning.message, DescriptionWarning):
            warnings.warn_explicit(warning.message, warning.category, warning.filename, warning.lineno)


_COUNTED = re.compile(r"\b(\d+) of (\d+)$")

WIDTH = 24
"""Signs of a progress bar."""


def bar_of(done: int, whole: int) -> str:
    """`########........`: how much is done."""
    filled = WIDTH * done // max(whole, 1)
    return "#" * filled + "." * (WIDTH - filled)  # signs of every code page


Told = TypeVar("Told")


@contextlib.contextmanager
def on_terminal(line: Callable[[Told], str]) -> Iterator[Callable[[Told], None]]:
    """Say on a terminal how far something is, each time in place of the line before; nothing in a pipe."""
    if sys.stderr is None or not sys.stderr.isatty():
        yield lambda _: None
        return
    try:
        yield lambda what: click.echo(f"\r\033[K{line(what)}", nl=False, err=True)
    finally:
        click.echo("\r\033[K", nl=False, err=True)


def progress(label: str) -> contextlib.AbstractContextManager[Callable[[str], None]]:
    """Say on a terminal what is being done, `set 3 of 100` with a bar; nothing in a pipe."""

    def line(what: str) -> str:
        counted = _COUNTED.search(what)
        bar = f"{bar_of(int(counted[1]), int(counted[2]))} " if counted else ""
        return f"{label}: {bar}{told(what if isinstance(what, Said) else say(what))} …"

    return on_terminal(line)


_QUOTED = re.compile(r"'(?:[^']|'')*'!")
"""A sheet's name in quotes, in which a `=` means nothing."""


def settings_of(options: tuple[str, ...]) -> dict[str, str]:
    """`a1=65` options as a mapping. Raises MechsheetError with all that are something else."""
    pairs, faults = _pairs(options)
    if faults:
        raise MechsheetError(faults)
    return dict(pairs)


def _pairs(options: Iterable[str]) -> tuple[list[tuple[str, str]], list[Fault]]:
    """`a1=65` options as pairs of name and value, in their order; and what is no such pair."""
    found = []
    faults = []
    for pair in options:
        quoted = _QUOTED.match(pair)
        start = quoted.end() if quoted else 0
        name, equals, value = pair[start:].partition("=")
        name = pair[:start] + name
        if not equals or not name.strip() or not value.strip():
            faults.append(
                Fault(say('"{pair}" is not NAME=VALUE', pair=pair), key="--set", hint=say("for example --set a1=65"))
            )
        else:
            found.append((name.strip(), value.strip()))
    return found, faults


_CHANGES = (
    click.option(
        "--set",
        "settings",
        multiple=True,
        metavar="NAME=VALUE",
        help="Change a dimension or a mode; may be repeated.",
    ),
    click.option("--step", metavar="VALUE", help="Step of the driver, in its unit."),
    click.option("--rows", metavar="N", help="Number of positions of the sweep."),
)


def with_options(options: Sequence[Any], command: Command) -> Command:
    """The command with these options, in their order."""
    for option in reversed(options):
        command = option(command)
    return command


def change_options(command: Command) -> Command:
    """The options of every command that reads a description: what is changed in it. See `described`."""
    return with_options(_CHANGES, command)


modules_option = click.option(
    "--functions", "modules", multiple=True, metavar="FILE.bas", type=FILE,
    help="A module in Basic whose functions the workbook calls; may be repeated.",
)  # fmt: skip


def language_option(about: str) -> Callable[[Any], Any]:
    """The option --language; `about` says of what."""
    return click.option("--language", type=click.Choice(LANGUAGES), help=about)


JSON = click.option("--json", "as_json", is_flag=True, help="Print JSON.")

MOST_SECONDS = 120.0
"""A workbook made by hand is judged in a few seconds. One with an endless formula is evaluated hundreds of times."""


def seconds_option(default: float | None = None) -> Callable[[Any], Any]:
    """The option --seconds: how long a file may take."""
    usual = "" if default is None else f", {default:g} if not given"
    return click.option(
        "--seconds", type=click.FloatRange(min=0, min_open=True), default=default, metavar="X",
        help=f"Give up on a file after X seconds{usual}.",
    )  # fmt: skip


# --- what the library calls its arguments, and how the command line spells them ---------------------------------------

_OPTIONS = {
    "at": "--at",
    "design": "--design",
    "frames": "--frames",
    "to": "--to",
    "formats": "--format",
    "functions": "--functions",
    "language": "--language",
    "limit_memory": "--limit-memory",
    "output": "-o",
    "rows": "--rows",
    "step": "--step",
    "workers": "--workers",
}
_OVERRIDES = re.compile(r"overrides: (.*)")


def in_options(fault: Fault) -> Fault:
    """A fault of the library with the option's name in place of the argument's."""
    found = _OVERRIDES.fullmatch(fault.key)
    if found:
        return replace(fault, key=f"--set {found[1]}")
    return replace(fault, key=_OPTIONS.get(fault.key, fault.key)) if fault.line is None else fault


# --- what the shell completes ---------------------------------------------------------------------------------------


def completing(names: Callable[[], Iterable[str]]) -> Callable[[click.Context, click.Parameter, str], list[str]]:
    """`shell_complete` of a value, or of the last one of several with commas, out of `names`, read only then."""

    def complete(context: click.Context, parameter: click.Parameter, begun: str) -> list[str]:
        before, comma, last = begun.rpartition(",")
        return [f"{before}{comma}{name}" for name in names() if name.startswith(last)]

    return complete


FORMATS_COMPLETED = completing(lambda: ("xlsx", "ods"))


# --- where files go -------------------------------------------------------------------------------------------------

STANDARD_OUTPUT = "-"


class OutputName(click.ParamType):  # type: ignore[type-arg, unused-ignore]
    """A name after -o: kept as text, because a slash at its end means a folder."""

    name = "path"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """The text; nothing at all names no file."""
        text = str(value)
        if not text.strip():
            self.fail(told(say("names no file")), param, ctx)
        if "\0" in text:
            self.fail(told(say("a null character stands in no file name")), param, ctx)
        return text

    def shell_complete(self, ctx: click.Context, param: click.Parameter, incomplete: str) -> list[Any]:
        """Files and folders."""
        return click.Path().shell_complete(ctx, param, incomplete)


def output_option(about: str) -> Callable[[Any], Any]:
    """The option -o of every command that writes; `about` says what is written into a file."""
    text = f"{about} A name that ends with / and an existing folder mean a folder to write into."
    return click.option("-o", "--output", type=OutputName(), help=text)


def output_file(output: str | None, default: str, inputs: tuple[Path, ...] = ()) -> Path:
    """The file that -o means, `default` in the folder that it means; never one of the files that are read.

    Raises OutputError for `-`, which the commands that print take before, and for a file of `inputs`.
    """
    if output == STANDARD_OUTPUT:
        raise OutputError(
            Fault(say("this is written to a file, not printed"), key="-o", hint=say("/dev/stdout is a file too"))
        )
    path = file_in(output, default)
    if any(same_file(path, other) for other in inputs):
        hint = say("name another file with -o")
        raise OutputError(Fault(say("is read here: it is not overwritten"), readable_name(path), hint=hint))
    return path


def same_file(one: Path, other: Path) -> bool:
    """Whether two names lead to one file; names of files that are not there yet are compared as they stand."""
    try:
        return one.samefile(other)
    except (OSError, ValueError):
        return False


def write_text(file: Path, text: str, output: str | None) -> None:
    """Write a text into the file that -o means."""
    from livesheet.replacing import replace_file

    with folder_ready(output):
        replace_file(file, text.encode())


def say_written(files: list[Path]) -> None:
    """The files written, one a line, so that another program can read them; a device's name would only disturb."""
    for file in files:
        click.echo(file.as_posix(), err=is_stream(file))


def refuse_existing(path: Path, hint: str = say("choose another name with -o")) -> None:
    """Raise OutputError when there is a file already."""
    if is_there(path) and not is_stream(path):
        raise OutputError(Fault(say("there is a file already: it is left as it is"), readable_name(path), hint=hint))


# --- how help reads ---------------------------------------------------------------------------------------------------

EXAMPLES = "\b\nmechsheet "
"""How a docstring's paragraph of examples begins."""

TASKS = {
    "Make": ("new", "draw", "build", "plot", "export"),
    "Look and judge": ("show", "check", "recalc", "pull"),
    "Choose": ("study",),
    "Teach": ("exercise", "audit", "mark"),
    "This program": ("doctor", "schema"),
}
"""All commands, each under its heading in the list of them."""


def paragraphs(text: str) -> tuple[list[str], list[str]]:
    """The paragraphs of a docstring: (what is said, examples)."""
    every = inspect.cleandoc(text).split("\n\n")
    return [part for part in every if not part.startswith(EXAMPLES)], [p for p in every if p.startswith(EXAMPLES)]


def example_lines(examples: Iterable[str]) -> Iterator[str]:
    """The lines of paragraphs of examples."""
    for paragraph in examples:
        yield from paragraph.split("\n")[1:]


class Explained(click.Command):
    """A command, or the group of them, whose help ends with the examples of its docstring."""

    def format_help_text(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """All but the examples."""
        whole = self.help
        self.help = "\n\n".join(paragraphs(whole or "")[0])
        try:
            super().format_help_text(ctx, formatter)
        finally:
            self.help = whole

    def format_epilog(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """The examples, as they stand."""
        lines = list(example_lines(paragraphs(self.help or "")[1]))
        if lines:
            with formatter.section("Examples"):
                for line in lines:
                    formatter.write(f"{'':>{formatter.current_indent}}{line}\n")
        super().format_epilog(ctx, formatter)


def write_commands(group: click.Group, formatter: click.HelpFormatter) -> None:
    """The commands under the headings of TASKS."""
    width = formatter.width - 6 - max(map(len, group.commands))
    for heading, names in TASKS.items():
        with formatter.section(heading):
            formatter.write_dl([(name, group.commands[name].get_short_help_str(width)) for name in names])
