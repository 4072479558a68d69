"""One description in both layouts: what each says under its title and beside its numbers, in words and in colour."""

from dataclasses import replace

from placed import places_of

from livesheet.engine import compile_book
from livesheet.evaluation import book_of
from livesheet.workbook import Fill
from mechsheet.compiled import Compiled
from mechsheet.description import Overrides, loads
from mechsheet.sheet import styles

COLOURS = {id(styles.BAD): "red", id(styles.WARN): "amber", id(styles.GOOD): "green"}
RULES = 200
"""The first column beside all others: there the rules of colours stand as formulas."""


class Book:
    """A workbook of one layout, whose yellow cells are typed into."""

    def __init__(self, text, layout, language="en"):
        made = Compiled(loads(text, overrides=Overrides(language=language, layout=layout)))
        self.plan = made.plan
        first = next(sheet for sheet in made.layout.sheets if sheet.title == self.plan.main)
        self.rules = first.conditionals
        fills = [Fill(0, RULES + col, rule.condition) for col, rule in enumerate(self.rules)]
        ruled = replace(first, fills=(*first.fills, *fills))
        sheets = tuple(ruled if sheet is first else sheet for sheet in made.layout.sheets)
        self.book = compile_book(book_of(replace(made.layout, sheets=sheets)))
        self.type()

    def type(self, **inputs):
        spots = places_of(self.plan)
        cells = {
            (spots[key].sheet, spots[key].row, spots[key].col): value
            if value is None or isinstance(value, str)
            else float(value)
            for key, value in inputs.items()
        }
        self.values = self.book.evaluate(cells)
        return self

    def row(self, key):
        return self.plan.blocks["verdicts"].rows[key]

    def words(self, key):
        return self.values.get(self.plan.main, self.row(key), 3 if self.page else 4)

    def number(self, key):
        return self.values.get(self.plan.main, self.row(key), 1)

    def colour(self, row, col):
        """The colour of a cell of the first sheet: of the first rule that holds."""
        for index, rule in enumerate(self.rules):
            area = rule.area
            inside = area.first_row <= row <= area.last_row and area.first_col <= col <= area.last_col
            if inside and self.values.get(self.plan.main, 0, RULES + index) is True:
                return COLOURS.get(id(rule.style), "other")
        return ""

    @property
    def page(self):
        return self.plan.mechanism.layout == "page"

    @property
    def line(self):
        spot = places_of(self.plan)["verdict"]
        return self.values.get(spot.sheet, spot.row, spot.col)

    @property
    def line_colour(self):
        return self.colour(places_of(self.plan)["verdict"].row, 0)
