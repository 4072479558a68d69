"""The report of `--junit`: what build servers show of tests, a case for each sheet and each judge of each file."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from livesheet.formats.xml_text import legal
from mechsheet.checking.stored_lines import cell_text, grouped, remark_line

if TYPE_CHECKING:
    from livesheet.diagnostics import Fault
    from mechsheet.checking import Report, Stored

MOST = 100
"""Cells of a sheet that are listed."""

Outcome = tuple[str, str, str]
"""What becomes of a case: "failure", "error", "skipped" or "" (passed), with a message and a text."""

PASSED: Outcome = ("", "", "")


def junit(reports: Sequence[Report], faults: Iterable[Fault], strict: bool) -> bytes:
    """The XML: failures where something differs or was edited, errors where a file cannot be judged. No times in it.

    strict  what could not be compared or computed fails; otherwise it counts as skipped
    """
    suite = Element("testsuite", name="mechsheet check")
    for report in reports:
        for name, outcome in _cases(report, "failure" if strict else "skipped"):
            _add(suite, report.file, name, outcome)
    for fault in faults:
        _add(suite, fault.file or "mechsheet", "read", ("error", fault.message, str(fault)))
    cases = suite.findall("testcase")
    suite.set("tests", str(len(cases)))
    for kind, total in (("failure", "failures"), ("error", "errors"), ("skipped", "skipped")):
        suite.set(total, str(sum(case.find(kind) is not None for case in cases)))
    root = Element("testsuites")
    root.append(suite)
    indent(root)
    found: bytes = tostring(root, encoding="utf-8", xml_declaration=True)
    return found + b"\n"


def _cases(report: Report, doubtful: str) -> Iterator[tuple[str, Outcome]]:
    """The cases of one file: its sheets, what is remarked of them, the other judges, what was edited."""
    if report.stored is not None:
        for title in report.stored.sheets:
            yield f"sheet {title}", _sheet(report.stored, title)
        yield from _remarked(report.stored, doubtful)
    for item in report.comparisons:
        if report.stored is not None and item is report.comparisons[0]:
            continue  # told sheet by sheet
        text = f"{item.where}: {item.subject} {item.ours}, {item.judge} {item.theirs or 'nothing'}"
        fine: Outcome = PASSED if item.cells else (doubtful, "nothing was compared", "")
        yield item.judge, fine if item.agrees else ("failure", f"worst {item.worst:.2e}", text)
    if report.red_line:
        yield "line under the title", ("failure", report.red_line, "")
    if report.stale:
        yield "description", ("failure", "its description has been changed", report.stale)
    if report.nameless:
        yield "description", (doubtful, "it carries no description", "")
    for fault in report.missing:
        yield fault.message, ("skipped", fault.message, fault.hint)
    lines = [f"{edit.where} ({edit.kind}): was {edit.was}, is {edit.now}" for edit in report.edits]
    yield "formulas as built", ("failure", f"{len(lines)} edited", "\n".join(lines)) if lines else PASSED


def _sheet(stored: Stored, title: str) -> Outcome:
    """The stored values of one sheet."""
    found = [item for item in stored.own() if item.sheet == title]
    lines = [
        f"{item.address} ={item.formula}: computed {cell_text(item.ours) or 'nothing'}, "
        f"stored {cell_text(item.theirs) or 'nothing'}"
        for item in found[:MOST]
    ]
    if len(found) > MOST:
        lines.append(f"and {len(found) - MOST} more")
    return ("failure", f"{len(found)} differ", "\n".join(lines)) if found else PASSED


def _remarked(stored: Stored, doubtful: str) -> Iterator[tuple[str, Outcome]]:
    """What could not be computed or compared: one case for each function that is not known, whatever its cells."""
    from mechsheet.checking.stored import COMPUTE_ANEW

    for fault, places in grouped(stored.remarks):
        kind = doubtful if fault.doubtful else "skipped"
        yield fault.message, (kind, fault.message, remark_line(fault, places))
    if stored.nothing_stored:
        yield "stored values", (doubtful, "no value is stored: nothing was compared", "")
    if stored.uncomputed:
        yield "computed cells", (doubtful, COMPUTE_ANEW, ", ".join(stored.uncomputed[:MOST]))


def _add(suite: Element, file: str, name: str, outcome: Outcome) -> None:
    file, name, kind, message, text = (legal(part, "\ufffd") for part in (file, name, *outcome))
    case = SubElement(suite, "testcase", classname=file, name=name)
    if kind:
        SubElement(case, kind, message=message).text = text
