"""Help as a newcomer reads it: what a command does, its options, examples that work; every command under a heading."""

import shlex

import click
import pytest

from command_line import run
from mechsheet.cli import main
from mechsheet.cli.common import TASKS, example_lines, paragraphs

COMMANDS = sorted(main.commands)
SCREEN = 50
"""Lines of a terminal window of ordinary height."""
ACROSS = 80
"""Its width: longer examples would be broken anywhere."""


def help_of(*command: str) -> str:
    return run(*command, "--help").output


@pytest.mark.parametrize("name", COMMANDS)
def test_help_fits_a_screen_and_ends_with_examples(name):
    lines = help_of(name).rstrip().splitlines()
    assert len(lines) <= SCREEN
    assert max(map(len, lines)) <= ACROSS
    start = lines.index("Examples:")
    assert all(line.startswith("  ") for line in lines[start + 1 :])
    assert lines[start + 1].startswith(f"  mechsheet {name}")


@pytest.mark.parametrize("name", COMMANDS)
def test_examples_name_options_that_exist(name):
    command = main.commands[name]
    known = {option for parameter in command.params for option in (*parameter.opts, *parameter.secondary_opts)}
    examples = example_lines(paragraphs(command.help)[1])
    assert examples
    for line in examples:
        used = [word.partition("=")[0] for word in shlex.split(line.split("   ")[0], comments=True)]
        assert {word for word in used if word.startswith("-")} <= known | {"-h", "--help"}


def test_every_command_stands_under_a_heading_once():
    text = help_of()
    assert "Further commands" not in text
    lines = text.split("Options:")[1].split("Examples:")[0].splitlines()
    listed = [line.split()[0] for line in lines if line.startswith("  ")]
    assert sorted(word for word in listed if not word.startswith("-")) == COMMANDS
    assert not any(line.endswith("...") for line in lines)  # nothing is cut off


def test_a_letter_means_one_option_in_every_command():
    meant: dict[str, set[str]] = {}
    for command in main.commands.values():
        for option in (parameter for parameter in command.params if isinstance(parameter, click.Option)):
            for letter in (spelling for spelling in option.opts if not spelling.startswith("--")):
                meant.setdefault(letter, set()).add(option.opts[-1])
    assert all(len(options) == 1 for options in meant.values()), meant


def test_headings_name_no_command_that_is_not_there():
    assert {name for names in TASKS.values() for name in names} <= set(COMMANDS)
