"""Which findings there are of a mechanism, in the order in which they stand.

The line under the title says all in one: whether it closes, what it is, how well it transmits force; or what is wrong,
and where.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from livesheet.formula.nodes import Call, Node
from mechsheet.model import Mechanism
from mechsheet.sheet.classification import Classification
from mechsheet.sheet.findings import cam, closing, forces, limits, ratios
from mechsheet.sheet.findings.finding import Finding, Level, Line, good
from mechsheet.sheet.findings.four_bars import FourBarType
from mechsheet.sheet.findings.inputs import Inputs
from mechsheet.sheet.findings.other_sheets import OtherSheets
from mechsheet.sheet.findings.reading import Reading
from mechsheet.sheet.findings.task import LargestMiss, Task
from mechsheet.sheet.findings.transmission import Transmission
from mechsheet.sheet.quoted import formula, joined


def findings_of(mechanism: Mechanism, found: Classification, by_rows: bool = False) -> list[Finding]:
    """The findings of a workbook; `found`: what can be said of the mechanism.

    by_rows  only those that rows alone tell, which a page has
    """
    findings = [OtherSheets(), *_closing(found, by_rows), *_motion(mechanism, found), *_effort(mechanism, found)]
    return [finding for finding in findings if finding.by_rows] if by_rows else findings


def _closing(found: Classification, by_rows: bool) -> Iterator[Finding]:
    """Whether and how well it closes."""
    yield Inputs()
    if found.task is not None:
        yield Task(found.task)
        if by_rows:
            yield LargestMiss(found.task)
    yield closing.RowsClosed()
    if found.limits:
        yield from (limits.Limits(), limits.InputEnd("from"), limits.InputEnd("to"), limits.Passes())
    yield from (closing.LargestGap(), closing.Leaps())
    if found.newton:
        yield from (
            closing.SameAssembly(),
            closing.LargestResidual(),
            closing.PassesNeeded(),
            closing.LeastDeterminant(),
        )


def _motion(mechanism: Mechanism, found: Classification) -> Iterator[Finding]:
    """What links it has, how far they go, how well they transmit force."""
    yield from (FourBarType(loop, first=loop is found.four_bars[0]) for loop in found.four_bars)
    yield from (ratios.Swing(link.angle_symbol) for link in found.swings)
    yield from (ratios.Stroke(joint.symbol) for joint in found.strokes)
    yield from (ratios.TimeRatio(symbol) for symbol in found.returning)
    if mechanism.driver.law is None and not mechanism.driver.uneven:
        yield from (ratios.SlowWay(symbol) for symbol in found.returning)
    yield from (Transmission(group, found.transmission) for group in found.transmission)


def _effort(mechanism: Mechanism, found: Classification) -> Iterator[Finding]:
    """Velocities, forces, cams, a flywheel."""
    if found.rates:
        yield forces.DeadCentres()
        yield forces.Agrees("velocities_fit", "velocity", "rates")
        yield forces.Agrees("accelerations_fit", "acceleration", "rates")
    if found.forces:
        yield forces.LargestEffort()
        yield from map(forces.LargestBesides, found.besides)
        yield from (forces.LargestForce(), forces.Agrees("effort_fits", "torque", "effort"))
        if mechanism.assumed_inertia:
            yield forces.AssumedInertia()
    if mechanism.cam is not None:
        yield from cam.profile_findings(mechanism.cam, found.cam)
        if found.forces:
            yield from cam.contact_findings(mechanism, found.cam)
    yield from cam.motion_findings(mechanism)
    if found.flywheel:
        yield from (forces.MeanTorque(), forces.EnergyChange(), forces.FlywheelInertia())


def words_where_well(on: Reading, findings: Iterable[Finding]) -> Node:
    """What the line under the title says where nothing is wrong: what each finding adds, in order."""
    parts = [finding.in_title(on) for finding in findings]
    first, last = [part.first for part in parts], [part.last for part in parts]
    return joined(*first, joined(*(part.here for part in parts)), *last)


def title_words(on: Reading, findings: Sequence[Finding], well: Node) -> Node:
    """The line under the title: what the first finding that overrules it says, else what is said where all is `well`."""
    title = well
    for finding in reversed(findings):
        title = finding.overrules(on, title)
    return title


def title_levels(on: Reading, lines: Iterable[Line]) -> list[Level]:
    """It is as bad as the worst line that decides it, and good where every row closes and no line says otherwise."""
    levels = [level for line in lines for level in line.levels if level.decides]

    def some(kind: str) -> Node:
        tests = (formula("IFERROR(test,FALSE)", test=level.test) for level in levels if level.kind == kind)
        return Call("OR", tuple(tests))

    everywhere = good("count=rows", count=on.value("rows_closed"), rows=on.of_rows)
    return [Level("bad", some("bad")), Level("look", some("look")), everywhere]
