"""The command line: thin. Each command calls the library and prints; what can be piped goes to standard output.

One module per command, imported when its command is asked for. Exit codes: 0 done and all agree, 1 something differs,
2 the input cannot be read or used.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from importlib import import_module
from itertools import chain
from typing import Any

import click

from livesheet.diagnostics import near_miss
from livesheet.said import say
from mechsheet import __version__
from mechsheet.diagnostics import MechsheetError

from .common import TASKS, Explained, in_options, write_commands
from .speaking import fault_told, told
from .streams import ended_by_signals, ending_well, prepare_streams

CONTEXT = {"help_option_names": ["-h", "--help"], "max_content_width": 100}


class Modules(Mapping[str, click.Command]):
    """The commands by name: each is called as its module, which is imported when it is asked for."""

    def __getitem__(self, name: str) -> click.Command:
        if name not in iter(self):  # a word that somebody typed
            raise KeyError(name)
        command: click.Command = getattr(import_module(f".{name}", __name__), name)
        return command

    def __iter__(self) -> Iterator[str]:
        return chain.from_iterable(TASKS.values())

    def __len__(self) -> int:
        return sum(map(len, TASKS.values()))


class Commands(Explained, click.Group):
    """The group of commands: suggests near misses, and turns a user's mistakes into messages."""

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """As click does, with a suggestion for a misspelt command."""
        name = args[0] if args else ""
        if name and not name.startswith("-") and self.get_command(ctx, name) is None:
            every = self.list_commands(ctx)
            hint = near_miss(name, every) or say("commands: {names}", names=", ".join(every))
            ctx.fail(told(say('no command is called "{name}": {hint}', name=name, hint=hint)))
        return super().resolve_command(ctx, args)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """By what somebody wants to do."""
        write_commands(self, formatter)

    def main(self, *args: Any, **options: Any) -> Any:
        """As click does, on any code page, with any end: see `streams`."""
        prepare_streams()
        with ended_by_signals(), ending_well():
            return super().main(*args, **options)

    def make_context(self, *args: Any, **options: Any) -> click.Context:
        """As click does; here help is printed."""
        with ending_well():
            return super().make_context(*args, **options)

    def invoke(self, ctx: click.Context) -> Any:
        """Run the command; a MechsheetError ends it with code 2 and one message per fault."""
        with ending_well():
            try:
                return super().invoke(ctx)
            except MechsheetError as error:
                click.echo("\n".join(fault_told(in_options(fault)) for fault in error.faults), err=True)
                ctx.exit(2)


@click.group(cls=Commands, commands=Modules(), context_settings=CONTEXT)
@click.version_option(__version__, prog_name="mechsheet")
def main() -> None:
    """Compile the description of a planar mechanism into a proven spreadsheet workbook.

    \b
    mechsheet new four-bar -o mine.toml      start from a packaged description
    mechsheet build mine.toml                write mine.xlsx
    mechsheet check mine.xlsx                recalculate it and compare with numpy
    """
