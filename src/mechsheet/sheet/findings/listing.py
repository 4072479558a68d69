"""Which findings there are of a mechanism, in the order in which they stand."""

from __future__ import annotations

from collections.abc import Iterator

from mechsheet.model import Mechanism
from mechsheet.sheet.classification import Classification
from mechsheet.sheet.findings import cam, closing, forces, limits, newton, rates, ratios
from mechsheet.sheet.findings.finding import Finding
from mechsheet.sheet.findings.four_bars import FourBarType
from mechsheet.sheet.findings.inputs import Inputs
from mechsheet.sheet.findings.other_sheets import OtherSheets
from mechsheet.sheet.findings.task import LargestMiss, Task
from mechsheet.sheet.findings.transmission import Transmission


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
        yield from (newton.SameAssembly(), newton.LargestResidual(), newton.PassesNeeded(), newton.LeastDeterminant())


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
        yield rates.DeadCentres()
        yield rates.Agrees("velocities_fit", "velocity", "rates")
        yield rates.Agrees("accelerations_fit", "acceleration", "rates")
    if found.forces:
        yield forces.LargestEffort()
        yield from map(forces.LargestBesides, found.besides)
        yield from (forces.LargestForce(), rates.Agrees("effort_fits", "torque", "effort"))
        if mechanism.assumed_inertia:
            yield forces.AssumedInertia()
    if mechanism.cam is not None:
        yield from cam.profile_findings(mechanism.cam)
        if found.forces:
            yield from cam.contact_findings(mechanism, found.cam)
    yield from cam.motion_findings(mechanism)
    if found.flywheel:
        yield from (forces.MeanTorque(), forces.EnergyChange(), forces.FlywheelInertia())
