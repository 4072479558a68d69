"""The four-bar with one output asked for, and other sweeps of a description."""

import re

from mechsheet.description.templates import template_text


def swept(text, rows):
    """A description with another sweep from 0 on: its last value and its step."""
    last, step = rows
    for key, value in (("start", 0), ("stop", last), ("step", step)):
        text = re.sub(rf"(?m)^{key} = .*$", f"{key} = {value}", text, count=1)
    return text


def four_bar(formula, unit=""):
    """The template with one output, and its extremes."""
    text = template_text("four-bar")
    unit = f', unit = "{unit}"' if unit else ""
    return (
        text[: text.index("[outputs]")]
        + f"""
[outputs]
asked = {{ formula = "{formula}"{unit} }}
[summary]
low = {{ of = "asked", take = "min" }}
high = {{ of = "asked", take = "max" }}
"""
    )
