"""What may be typed into cells, and how cells look under conditions, in OpenDocument's words."""

from __future__ import annotations

from dataclasses import dataclass

from livesheet.formula.nodes import Node
from livesheet.formula.printer import print_formula
from livesheet.workbook import Area, Conditional, Sheet, Validation

from ..xml_text import attribute
from .styles import OdsStyles
from .text import address, paragraphs

_KINDS = {
    "decimal": "cell-content-is-decimal-number() and ",
    "whole": "cell-content-is-whole-number() and ",
}


@dataclass(frozen=True, slots=True)
class Rules:
    """The rules of one sheet.

    maps         area -> <style:map> element, in the order of the sheet
    validations  area -> name of the <table:content-validation>
    """

    maps: tuple[tuple[Area, str], ...]
    validations: tuple[tuple[Area, str], ...]

    @property
    def areas(self) -> list[Area]:
        """All areas that have a rule."""
        return [area for area, _ in (*self.maps, *self.validations)]


def sheet_rules(sheet: Sheet, styles: OdsStyles, number: int) -> Rules:
    """The rules of a sheet; its validations are numbered from `number` + 1."""
    maps = tuple((rule.area, _map(rule, sheet.title, styles)) for rule in sheet.conditionals)
    names = tuple((rule.area, f"val{number + i}") for i, rule in enumerate(sheet.validations, 1))
    return Rules(maps, names)


def _map(rule: Conditional, title: str, styles: OdsStyles) -> str:
    base = address(title, rule.area.first_row, rule.area.first_col)
    condition = f"is-true-formula({_formula(rule.condition)})"
    return (
        f'<style:map style:condition="{attribute(condition)}"'
        f' style:apply-style-name="{styles.conditional(rule.style)}" style:base-cell-address="{attribute(base)}"/>'
    )


def content_validations(sheets: tuple[Sheet, ...]) -> str:
    """The <table:content-validations> of the document, "" when it has none; numbered as `sheet_rules` names them."""
    rules = [(sheet.title, rule) for sheet in sheets for rule in sheet.validations]
    body = "".join(_validation(f"val{i}", title, rule) for i, (title, rule) in enumerate(rules, 1))
    return f"<table:content-validations>{body}</table:content-validations>" if body else ""


def _validation(name: str, title: str, rule: Validation) -> str:
    base = address(title, rule.area.first_row, rule.area.first_col)
    display = ' table:display-list="unsorted"' if rule.kind == "list" else ""
    kind = "stop" if rule.stop else "warning"
    help_message = _message("help-message", "", rule.input_title, rule.input_message)
    error_message = _message("error-message", f' table:message-type="{kind}"', rule.error_title, rule.error_message)
    return (
        f'<table:content-validation table:name="{name}" table:condition="{attribute(_condition(rule))}"'
        f' table:allow-empty-cell="true"{display} table:base-cell-address="{attribute(base)}">'
        f"{help_message}{error_message}</table:content-validation>"
    )


def _message(element: str, kind: str, title: str, text: str) -> str:
    shown = f' table:title="{attribute(title)}"' if title else ""
    body = paragraphs(text) if text else ""
    return f'<table:{element}{kind}{shown} table:display="true">{body}</table:{element}>'


def _condition(rule: Validation) -> str:
    if rule.kind == "list":
        if rule.low is not None:
            return f"of:cell-content-is-in-list({_formula(rule.low)})"
        choices = ";".join('"' + choice.replace('"', '""') + '"' for choice in rule.choices)
        return f"of:cell-content-is-in-list({choices})"
    if rule.kind == "custom":
        return f"of:is-true-formula({_formula(rule.low)})"
    if rule.operator == "between":
        return f"of:{_KINDS[rule.kind]}cell-content-is-between({_formula(rule.low)},{_formula(rule.high)})"
    return f"of:{_KINDS[rule.kind]}cell-content(){rule.operator}{_formula(rule.low)}"


def _formula(node: Node | None) -> str:
    if node is None:
        raise ValueError("a rule without its formula reached the writer")
    return print_formula(node, "openformula")
