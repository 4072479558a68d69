"""An audit in words, for the terminal and for pages."""

from __future__ import annotations

from mechsheet.homework.audit import Audit, FaultFound
from mechsheet.words.catalogue import is_key, marks_of, said


def lines(audit: Audit) -> list[str]:
    """A line for each asked quantity, then faults, marks and remarks."""
    wide = max((len(symbol) for symbol in audit.asked), default=0)
    cells = max((len(one.cells) for one in audit.asked.values()), default=0)
    found = [
        f"{symbol:<{wide}}  {one.cells:<{cells}}  {said(audit.language, one.verdict)}".rstrip()
        for symbol, one in audit.asked.items()
    ]
    found += [fault_line(fault, audit.language) for fault in audit.faults]
    marks = marks_of(audit.language, audit.follow_through, audit.of)
    if audit.plain != audit.follow_through:
        marks += f" ({said(audit.language, 'marks.plain', plain=f'{audit.plain:g}')})"
    found.append(marks)
    found += [said(audit.language, "remark", text=text) for text in audit.remarks]
    return found


def fault_line(fault: FaultFound, language: str) -> str:
    """`Sayfa1!B13:B31  RADIANS(A13)-Alfa1: a term too many; RADIANS(A13) makes theta13, theta15 right`."""
    text = said(language, "fault", cells=fault.cells, formula=fault.formula, kind=kind_words(fault.kind, language))
    if fault.mend:
        key = "mend" if fault.rights else "mend.wanted"
        text += "; " + said(language, key, mend=fault.mend, rights=", ".join(fault.rights))
    return text


def kind_words(kind: str, language: str) -> str:
    """A kind of fault in a language."""
    return said(language, kind) if is_key(f"homework.{kind}") else kind
