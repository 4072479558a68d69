"""A description that is built in no time, and how the command line is called with it."""

from click.testing import CliRunner, Result

from mechsheet.cli import main

CRANK = """format = 1
[mechanism]
name = "yoke"
title = { en = "Yoke at θ", tr = "Çatal ışığı" }
[dimensions]
a2 = 30
[links.ground]
points = { A0 = [0, 0] }
[links.crank]
points = { A0 = [0, 0], A = ["a2", 0] }
[links.block]
points = { A = [0, 0] }
[links.yoke]
points = { P = [0, 0] }
[[joints]]
type = "prismatic"
link = "block"
on = "yoke"
point = "A"
through = "P"
angle = 90
[[joints]]
type = "prismatic"
link = "yoke"
on = "ground"
point = "P"
through = "A0"
[driver]
link = "crank"
start = 0
stop = 360
step = 90
[assembly]
P = [30, 0]
"""


def run(*arguments: object, text: str | bytes | None = None) -> Result:
    """The command line in this process; an exception that is not its end is a fault of ours."""
    result = CliRunner().invoke(main, [str(argument) for argument in arguments], input=text)
    assert result.exception is None or isinstance(result.exception, SystemExit), (arguments, result.exception)
    return result
