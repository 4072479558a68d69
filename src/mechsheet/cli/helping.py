"""How help reads: what a command does, its options, then examples; the commands by what somebody wants to do."""

from __future__ import annotations

import inspect
from collections.abc import Iterable, Iterator

import click

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
