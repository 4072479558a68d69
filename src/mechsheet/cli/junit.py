"""The report of `mechsheet check --junit`: what build servers show of tests, a case for each judge of each file."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING
from xml.etree.ElementTree import Element, SubElement, indent, tostring

if TYPE_CHECKING:
    from mechsheet.checking import Report
    from mechsheet.diagnostics import Fault

_ILLEGAL = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def junit(reports: Sequence[Report], faults: Iterable[Fault]) -> bytes:
    """The XML: failures where something differs or was edited, errors where a file cannot be judged. No times in it."""
    suite = Element("testsuite", name="mechsheet check")
    for report in reports:
        for item in report.comparisons:
            case = SubElement(suite, "testcase", classname=_legal(report.file), name=item.judge)
            if not item.agrees:
                text = f"{item.where}: {item.subject} {item.ours}, {item.judge} {item.theirs or 'nothing'}"
                _add(case, "failure", f"worst {item.worst:.2e}", text)
        case = SubElement(suite, "testcase", classname=_legal(report.file), name="formulas as built")
        if report.edits:
            lines = [f"{edit.where} ({edit.kind}): was {edit.was}, is {edit.now}" for edit in report.edits]
            _add(case, "failure", f"{len(lines)} edited", "\n".join(lines))
    for fault in faults:
        case = SubElement(suite, "testcase", classname=_legal(fault.file or "mechsheet"), name="read")
        _add(case, "error", fault.message, str(fault))
    cases = suite.findall("testcase")
    suite.set("tests", str(len(cases)))
    suite.set("failures", str(sum(case.find("failure") is not None for case in cases)))
    suite.set("errors", str(sum(case.find("error") is not None for case in cases)))
    root = Element("testsuites")
    root.append(suite)
    indent(root)
    found: bytes = tostring(root, encoding="utf-8", xml_declaration=True)
    return found + b"\n"


def _add(case: Element, kind: str, message: str, text: str) -> None:
    SubElement(case, kind, message=_legal(message)).text = _legal(text)


def _legal(text: str) -> str:
    return _ILLEGAL.sub("\ufffd", text)
