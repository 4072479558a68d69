"""Write the pages of docs that follow from the code: the command line, the keys, the library, the gallery of templates.

`make reference`; a test holds the pages up to date.
"""

from __future__ import annotations

import inspect
from pathlib import Path

import click

import mechsheet
from mechsheet.cli import main as commands
from mechsheet.description.grammar import (
    Either,
    Integer,
    Items,
    Kinds,
    Named,
    Number,
    Quantity,
    Shape,
    Table,
    Text,
    WithUnit,
    Words,
    YesNo,
)
from mechsheet.description.schema import DESCRIPTION
from mechsheet.library.building import FORMATS

DOCS = Path(__file__).parent.parent / "docs"
TEMPLATES = DOCS.parent / "templates"
ACROSS = 3
"""Pictures in a row of the gallery."""
WIDTH = 92
NOTE = "<!-- made by `make reference`: change the code, not this page -->\n"


def command_line() -> str:
    """The help of every command."""
    width = {"max_content_width": WIDTH, "terminal_width": WIDTH}
    context = click.Context(commands, info_name="mechsheet", **commands.context_settings | width)
    parts = [
        NOTE,
        "# The command line\n",
        "Exit codes: 0 done and all agree, 1 something differs, 2 the input cannot be read or used. "
        "Whatever can be piped goes to standard output, everything else to standard error. "
        "Where a description is expected, `-` is standard input. Long tasks show their progress, but only on a terminal. "
        "Nothing is printed in colour, so `NO_COLOR` has nothing to turn off. "
        "Messages are in Turkish if the description is Turkish (or `--language tr` is given), or if the machine is set to "
        "Turkish (`LANG=tr_TR.UTF-8`, or Windows in Turkish), and in English otherwise. Help is in English, and what other "
        "programs read (`--json`, `--junit`) does not depend on the language.\n",
        "The shell completes commands, options and templates after "
        '`eval "$(_MECHSHEET_COMPLETE=bash_source mechsheet)"` '
        "(`zsh_source` for zsh, `_MECHSHEET_COMPLETE=fish_source mechsheet | source` for fish).\n",
        f"```text\n{_stripped(commands.get_help(context))}\n```\n",
    ]
    for name in commands.list_commands(context):
        command = commands.get_command(context, name)
        assert command is not None
        below = click.Context(command, info_name=name, parent=context, **width)
        parts.append(f"## mechsheet {name}\n")
        parts.append(f"```text\n{_stripped(command.get_help(below))}\n```\n")
    return "\n".join(parts)


def _stripped(text: str) -> str:
    return "\n".join(line.rstrip() for line in text.splitlines())


def keys() -> str:
    """A table for each table of the description: key, what it holds, what it means."""
    parts = [
        NOTE,
        "# Keys of a description\n",
        "Every key that format 1 knows. [The description](description.md) explains them with examples; "
        'anything else is refused with file, line and key. Where a number is held, it may have its unit: `"20 mm"`. '
        "Editors complete and check them with the schema that `mechsheet schema` prints.\n",
    ]
    _tables("", DESCRIPTION, parts)
    return "\n".join(parts)


def _tables(path: str, table: Table, parts: list[str]) -> None:
    parts.append(f"## {f'`{path}`' if path else 'The file'}\n")
    lines = ["| key | holds | |", "|---|---|---|"]
    below: list[tuple[str, Table]] = []
    for name, key in table.keys.items():
        needed = " (required)" if key.required else ""
        lines.append(f"| `{name}` | {_held(key.shape)} | {_escaped(key.note)}{needed} |")
        below += [(_joined(path, name, suffix), found) for suffix, found in _inner(key.shape)]
    parts.append("\n".join(lines) + "\n")
    for ways in table.ways:
        parts.append("One of: " + "; or ".join(", ".join(f"`{key}`" for key in way) for way in ways) + ".\n")
    for place, found in below:
        _tables(place, found, parts)


def _joined(path: str, name: str, suffix: str) -> str:
    return f"{path}.{name}{suffix}" if path else f"{name}{suffix}"


def _inner(shape: Shape) -> list[tuple[str, Table]]:
    """The tables below a key, with what stands between."""
    match shape:
        case Table():
            return [("", shape)]
        case Named(item, keys=keys):
            own = [("", Table(keys))] if keys else []
            return own + [(f".NAME{suffix}", found) for suffix, found in _inner(item)]
        case Items(item):
            return [(f"[]{suffix}", found) for suffix, found in _inner(item)]
        case Kinds(key, tables):
            return [(f' with {key} = "{name}"', found) for name, found in tables.items()]
        case Either(shapes):
            return [pair for part in shapes for pair in _inner(part)]
        case _:
            return []


def _held(shape: Shape) -> str:
    """What a key holds, in words."""
    match shape:
        case Number(least):
            return "number" if least is None else f"number, at least {least:g}"
        case Integer(least, most):
            return f"whole number, {least}" if least == most else f"whole number, {least} to {most}"
        case YesNo():
            return "`true` or `false`"
        case Quantity():
            return "number or expression"
        case WithUnit():
            return "number with its unit"
        case Text(choices=choices, names=names):
            return " or ".join(f'`"{choice}"`' for choice in choices) or (f"name of a {names}" if names else "text")
        case Words():
            return "text, or `{ en = …, tr = … }`"
        case Items(item, note=note):
            return note or f"list: {_held(item)}"
        case Named(item, what):
            return f"{what} = {_held(item)}"
        case Either(shapes):
            return " or ".join(_held(part) for part in shapes)
        case _:
            return "table"


def _escaped(text: str) -> str:
    return text.replace("|", "\\|")


def library() -> str:
    """The public names of the package with their signatures and docstrings."""
    parts = [
        NOTE,
        "# The library\n",
        "`import mechsheet` gives the names below; nothing heavy is loaded before it is used. "
        "Everything else is inside and may change.\n",
    ]
    for name in mechsheet.__all__:
        if name.startswith("__"):
            continue
        thing = getattr(mechsheet, name)
        if inspect.isclass(thing):
            parts.append(f"## class `{name}`\n\n{_docstring(thing)}")
            parts += [
                f"### `{name}.{key}{_signature(member)}`\n\n{_docstring(member)}"
                for key, member in sorted(vars(thing).items())
                if not key.startswith("_") and (inspect.isfunction(member) or isinstance(member, property))
                and inspect.getdoc(member)
            ]  # fmt: skip
        else:
            parts.append(f"## `{name}{_signature(thing)}`\n\n{_docstring(thing)}")
    return "\n".join(parts)


def _signature(thing: object) -> str:
    """`(name: str = "x") -> int`, spelt alike by every version of Python: annotations are texts in our sources."""
    if not inspect.isfunction(thing):
        return ""
    parts = []
    for parameter in inspect.signature(thing).parameters.values():
        if parameter.name == "self":
            continue
        note = "" if parameter.annotation is parameter.empty else f": {parameter.annotation}"
        default = "" if parameter.default is parameter.empty else f" = {parameter.default!r}"
        if parameter.kind is parameter.KEYWORD_ONLY and not any(part.startswith("*") for part in parts):
            parts.append("*")
        star = {parameter.VAR_POSITIONAL: "*", parameter.VAR_KEYWORD: "**"}.get(parameter.kind, "")
        parts.append(f"{star}{parameter.name}{note}{default}")
    returned = thing.__annotations__.get("return", "None")
    return f"({', '.join(parts)}) -> {returned}".replace("'", '"')


def _docstring(thing: object) -> str:
    text = inspect.getdoc(thing) or ""
    return f"```text\n{text}\n```\n"


def gallery() -> str:
    """Every template: its picture, what it is (the first words of its description), its files."""
    cells = [_template(path) for path in sorted(TEMPLATES.glob("*.toml"))]
    cells += [""] * (-len(cells) % ACROSS)
    rows = [f"| {' | '.join(cells[at : at + ACROSS])} |" for at in range(0, len(cells), ACROSS)]
    parts = [
        NOTE,
        "# Gallery\n",
        "Every mechanism below comes with mechsheet: `mechsheet new NAME` writes its description, `mechsheet build` makes "
        "its workbook. The workbooks are also ready-made: download one and open it; you need not install anything. "
        "*Page* is the same on [one sheet](workbook.md#one-sheet).\n",
        "|" + " |" * ACROSS,
        "|" + "---|" * ACROSS,
        *rows,
    ]
    return "\n".join(parts) + "\n"


def _template(path: Path) -> str:
    """A cell of the gallery."""
    comment = path.read_text(encoding="utf-8").partition("\n# ")[2].partition("\n#\n")[0].replace("\n#", "")
    name, files = path.stem, [("description", f"../templates/{path.name}")]
    for layout, label in (("", ""), ("-page", "page ")):
        files += [
            (f"{label}{ending}", f"../generated/{name}{layout}.{ending}")
            for ending in FORMATS
            if (DOCS.parent / "generated" / f"{name}{layout}.{ending}").exists()
        ]
    links = " · ".join(f"[{label}]({target})" for label, target in files)
    return f"![{name}](pictures/{name}.png)<br>**{name}**<br>{comment}<br>{links}"


PAGES = {"command-line.md": command_line, "gallery.md": gallery, "keys.md": keys, "library.md": library}


def main() -> None:
    """Write them all."""
    for name, page in PAGES.items():
        (DOCS / name).write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
