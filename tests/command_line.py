"""The command line in this process, as a user types it."""

from click.testing import CliRunner

from mechsheet.cli import main


def run(*arguments, text=None, environment=None):
    """What a command does with `text` typed into it; an exception that is not its end is a fault of ours."""
    result = CliRunner().invoke(main, [str(argument) for argument in arguments], input=text, env=environment)
    assert result.exception is None or isinstance(result.exception, SystemExit), (arguments, result.exception)
    return result


def printed(*arguments, code=0):
    """What a command prints that ends with such a code."""
    result = run(*arguments)
    assert result.exit_code == code, result.output
    return result.output
