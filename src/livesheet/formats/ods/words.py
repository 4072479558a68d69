"""The element and attribute names of OpenDocument that reading a workbook needs, with the prefixes of the file at hand."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from .text import NAMESPACES

KINDS = ("text", "spreadsheet", "presentation", "drawing", "chart", "image", "database", "formula")
"""What the body of a document can be."""


@dataclass(frozen=True, slots=True)
class Words:
    """Names as they are written in one file; `openformula` begins its formulas.

    not_text     elements inside a paragraph whose text is not the cell's
    passed_over  elements around the tables that hold text or tables of their own
    around_rows  elements of a table that rows stand in or come after
    """

    root: str
    kinds: Mapping[str, str]
    table: str
    row: str
    cells: frozenset[str]
    paragraph: str
    space: str
    tab: str
    line_break: str
    not_text: frozenset[str]
    passed_over: frozenset[str]
    around_rows: frozenset[str]
    named_range: str
    named_expression: str
    database_range: str
    null_date: str
    settings: str
    iteration: str
    calculating: Mapping[str, str]
    status: str
    table_name: str
    rows_repeated: str
    visibility: str
    columns_repeated: str
    matrix_rows: str
    matrix_columns: str
    formula: str
    value_type: str
    value: str
    string_value: str
    boolean_value: str
    date_value: str
    time_value: str
    extended_type: str
    space_count: str
    range_address: str
    target_address: str
    base_cell: str
    expression: str
    date_value_of_null: str
    openformula: str


def words_of(attributes: Mapping[str, str]) -> Words:
    """The names in a file whose root element has these attributes."""
    prefixes = {uri: key[6:] for key, uri in attributes.items() if key.startswith("xmlns:")}
    named = _namer(prefixes)
    return Words(
        root=named("office", "document-content"),
        kinds={named("office", kind): kind for kind in KINDS},
        table=named("table", "table"),
        row=named("table", "table-row"),
        cells=frozenset((named("table", "table-cell"), named("table", "covered-table-cell"))),
        paragraph=named("text", "p"),
        space=named("text", "s"),
        tab=named("text", "tab"),
        line_break=named("text", "line-break"),
        not_text=frozenset(
            (named("office", "annotation"), named("text", "note"), named("text", "ruby-text"), named("draw", "frame"))
        ),
        passed_over=frozenset(
            (
                named("table", "tracked-changes"),
                named("table", "shapes"),
                named("table", "dde-links"),
                named("office", "forms"),
                named("office", "automatic-styles"),
            )
        ),
        around_rows=frozenset(
            (
                named("table", "table-rows"),
                named("table", "table-header-rows"),
                named("table", "table-row-group"),
                named("text", "soft-page-break"),
            )
        ),
        named_range=named("table", "named-range"),
        named_expression=named("table", "named-expression"),
        database_range=named("table", "database-range"),
        null_date=named("table", "null-date"),
        settings=named("table", "calculation-settings"),
        iteration=named("table", "iteration"),
        calculating={
            "case": named("table", "case-sensitive"),
            "expressions": named("table", "use-regular-expressions"),
            "wildcards": named("table", "use-wildcards"),
            "whole": named("table", "search-criteria-must-apply-to-whole-cell"),
            "shown": named("table", "precision-as-shown"),
            "year": named("table", "null-year"),
        },
        status=named("table", "status"),
        table_name=named("table", "name"),
        rows_repeated=named("table", "number-rows-repeated"),
        visibility=named("table", "visibility"),
        columns_repeated=named("table", "number-columns-repeated"),
        matrix_rows=named("table", "number-matrix-rows-spanned"),
        matrix_columns=named("table", "number-matrix-columns-spanned"),
        formula=named("table", "formula"),
        value_type=named("office", "value-type"),
        value=named("office", "value"),
        string_value=named("office", "string-value"),
        boolean_value=named("office", "boolean-value"),
        date_value=named("office", "date-value"),
        time_value=named("office", "time-value"),
        extended_type=named("calcext", "value-type"),
        space_count=named("text", "c"),
        range_address=named("table", "cell-range-address"),
        target_address=named("table", "target-range-address"),
        base_cell=named("table", "base-cell-address"),
        expression=named("table", "expression"),
        date_value_of_null=named("table", "date-value"),
        openformula=named("of", "="),
    )


def _namer(prefixes: Mapping[str, str]) -> Callable[[str, str], str]:
    def named(usual: str, local: str) -> str:
        return f"{prefixes.get(NAMESPACES[usual], usual)}:{local}"

    return named
