"""A task on paper: the figure, what is given, the links, joints and driver in words, what is asked; no answer anywhere.

The words are those of the task's sheet (`statement`); symbols and names of points are set as the figure has them.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from livesheet.workbook import Rich
from mechsheet.compiled import Compiled, compiled_of
from mechsheet.homework.classroom.exercise import drawn, with_dimensions
from mechsheet.homework.classroom.figure import Figure, figure_of
from mechsheet.homework.classroom.statement import Names, Statement
from mechsheet.homework.expected_values import asked_of
from mechsheet.model import Mechanism
from mechsheet.plotting.paper import LINE, Paper, bound
from mechsheet.plotting.pictures import settings
from mechsheet.shapes.positions import in_digits
from mechsheet.units import behind_number
from mechsheet.words.catalogue import said

FIGURE = 92.0
"""How high the figure is at most, in mm."""

LAST = 3
"""Lines that a heading has below it on its page, at least."""


def task_pdf(mechanism: Mechanism, people: Sequence[tuple[str, str]] = (), seed: int = 0) -> bytes:
    """The PDF of a task with the description's own dimensions; or one for each of `people` (id, name), with theirs.

    Raises MechsheetError where no dimensions can be drawn, MissingProgramError without matplotlib.
    """
    figure = figure_of(mechanism)
    tasks: list[tuple[Compiled, str]] = [(compiled_of(mechanism), "")]
    if people:
        students, _ = drawn(mechanism, people, seed)
        owned = [(with_dimensions(mechanism, one.dimensions), f"{one.id}  {one.name}".strip()) for one in students]
        tasks = [(compiled_of(own), who) for own, who in owned]
    with settings():
        pages = [page.figure for compiled, who in tasks for page in _Task(compiled, who, figure).pages]
        return bound(pages, mechanism.title.of(mechanism.language))


class _Task:
    """One task: its pages, filled one after the other."""

    def __init__(self, compiled: Compiled, who: str, figure: Figure) -> None:
        mechanism = compiled.mechanism
        self.mechanism, self.language = mechanism, mechanism.language
        self.pages = [Paper()]
        self.names = Names(compiled)
        told = Statement(compiled, list(asked_of(mechanism).marks))
        self.page.paragraph(mechanism.title.of(self.language), 16, "#1F4E79", bold=True)
        self.page.down += 0.4 * LINE
        self.page.paragraph(f"{self.text('student')}: {who or '.' * 60}")
        self.page.down += 0.8 * LINE
        varies = mechanism.exercise is not None and bool(mechanism.exercise.vary)
        self.page.drawing(figure.scene, mechanism.length_unit, FIGURE, figure.below(True) if varies and who else None)
        self._given(told)
        self._lines("derived", [line for _, line in told.derived()])
        self._lines("links", told.links())
        self._lines("joints", told.joints())
        self._lines("loads", told.loads())
        self._lines("driver", [*told.driver(), self._rows(told), *told.assemblies()])
        self._lines("asked", [*told.meanings(), *told.marks()])

    @property
    def page(self) -> Paper:
        """The one that is being filled."""
        return self.pages[-1]

    def text(self, key: str, **parts: object) -> str:
        """Words of a task."""
        return said(self.language, f"task.{key}", **parts)

    def _given(self, told: Statement) -> None:
        rows = []
        for dim, number, label in told.given():
            unit = behind_number(self.mechanism.shown(dim.unit).text)
            rows.append((self.names.plain(dim.symbol), f"{in_digits(number, 10)}{unit}", self.names.plain(label)))
        self._heading("given")
        self.page.columns(rows, 2 if len(rows) > 3 else 1)

    def _heading(self, key: str) -> None:
        if self.page.room < (LAST + 2) * LINE:
            self.pages.append(Paper())
        self.page.heading(self.text(key))

    def _lines(self, key: str, several: Iterable[Rich]) -> None:
        """A heading with its lines; nothing where there are none."""
        found = list(several)
        if found:
            self._heading(key)
        for one in found:
            if self.page.room < 2 * LINE:
                self.pages.append(Paper())
            self.page.flow(self.names.set(one.parts))

    def _rows(self, told: Statement) -> Rich:
        """For which values of the driver: the first two and the last."""
        driver = self.mechanism.driver
        shown = [in_digits(float(each), 6) for each in told.rows()]
        listed = ", ".join(shown) if len(shown) <= 8 else f"{shown[0]}, {shown[1]}, {shown[2]} … {shown[-1]}"
        values_text = f"{listed}{behind_number(driver.unit.text)}"
        return Rich(((self.text("rows", symbol=driver.symbol, values=values_text, count=len(shown)), ""),))
