"""The table that engines are compared on: a four-bar's positions, 12 columns of formulas beside a number, as .xlsx."""

from __future__ import annotations

import zipfile
from pathlib import Path

import numpy as np

INPUTS = {
    "a_1": 70.0, "a_2": 35.0, "a_3": 62.3, "a_4": 56.0, "b_3": 126.6, "gamma_3": 0.62, "start": 0.0, "step": 1.0,
}  # fmt: skip
FIRST = 4
"""The table's first row, as the sheet counts."""
COLUMNS = (
    "start+A{r}*step",  # B  driver [deg]
    "RADIANS(B{r})",
    "a_2*COS(C{r})",  # D  x of A
    "a_2*SIN(C{r})",
    "D{r}-a_1",
    "SQRT(F{r}^2+E{r}^2)",  # G  diagonal
    "ATAN2(F{r},E{r})",
    "ACOS((a_3^2+G{r}^2-a_4^2)/(2*a_3*G{r}))",
    "H{r}+I{r}",  # J  coupler
    "DEGREES(J{r})",
    "D{r}+b_3*COS(J{r}+gamma_3)",
    "E{r}+b_3*SIN(J{r}+gamma_3)",  # M  y of C
)
_HEAD = '<?xml version="1.0" encoding="UTF-8" standalone="yes"?>\n'
_MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
_RELS = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
_PACKAGE = "http://schemas.openxmlformats.org/package/2006"
_TYPES = "application/vnd.openxmlformats-officedocument.spreadsheetml"


def by_hand(rows: int, a_2: float = INPUTS["a_2"]) -> tuple[np.ndarray, ...]:
    """The columns as one would write them in numpy."""
    a_1, a_3, a_4, b_3, gamma_3 = (INPUTS[name] for name in ("a_1", "a_3", "a_4", "b_3", "gamma_3"))
    driver = INPUTS["start"] + np.arange(float(rows)) * step(rows)
    theta12 = np.radians(driver)
    x_a, y_a = a_2 * np.cos(theta12), a_2 * np.sin(theta12)
    x = x_a - a_1
    s = np.sqrt(x**2 + y_a**2)
    phi = np.arctan2(y_a, x)
    psi = np.arccos((a_3**2 + s**2 - a_4**2) / (2 * a_3 * s))
    theta13 = phi + psi
    x_c, y_c = x_a + b_3 * np.cos(theta13 + gamma_3), y_a + b_3 * np.sin(theta13 + gamma_3)
    return driver, theta12, x_a, y_a, x, s, phi, psi, theta13, np.degrees(theta13), x_c, y_c


def step(rows: int) -> float:
    """One turn over all rows."""
    return 360.0 / (rows - 1)


def write_table(path: Path, rows: int, shared: bool) -> None:
    """The workbook, the table on its first sheet.

    Formulas have their full texts, as XlsxWriter writes them, or are shared, as Excel writes them.
    """
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in _small_parts(rows).items():
            archive.writestr(name, _HEAD + text)
        with archive.open("xl/worksheets/sheet1.xml", "w") as part:
            part.write((_HEAD + f'<worksheet xmlns="{_MAIN}"><sheetData>').encode())
            for first in range(0, rows, 1024):
                part.write("".join(_rows(first, min(first + 1024, rows), rows, shared)).encode())
            part.write(b"</sheetData></worksheet>")


def _rows(first: int, last: int, rows: int, shared: bool):
    columns = [column[first:last].tolist() for column in by_hand(rows)]
    for index, values in enumerate(zip(*columns, strict=True), first):
        row = index + FIRST
        cells = [f'<c r="A{row}"><v>{index}</v></c>']
        for col, (text, value) in enumerate(zip(COLUMNS, values, strict=True)):
            letter = chr(66 + col)
            if not shared:
                formula = f"<f>{text.format(r=row)}</f>"
            elif index == 0:
                area = f"{letter}{row}:{letter}{row + rows - 1}"
                formula = f'<f t="shared" ref="{area}" si="{col}">{text.format(r=row)}</f>'
            else:
                formula = f'<f t="shared" si="{col}"/>'
            cells.append(f'<c r="{letter}{row}">{formula}<v>{value!r}</v></c>')
        yield f'<row r="{row}" spans="1:{len(COLUMNS) + 1}">{"".join(cells)}</row>'


def _small_parts(rows: int) -> dict[str, str]:
    """Everything but the table."""
    inputs = {**INPUTS, "step": step(rows)}
    cells = "".join(
        f'<row r="{row}"><c r="A{row}" t="inlineStr"><is><t>{name}</t></is></c><c r="B{row}"><v>{value!r}</v></c></row>'
        for row, (name, value) in enumerate(inputs.items(), 1)
    )
    names = "".join(
        f'<definedName name="{name}">Mechanism!$B${row}</definedName>' for row, name in enumerate(inputs, 1)
    )
    sheets = "".join(
        f'<sheet name="{title}" sheetId="{n}" r:id="rId{n}"/>' for n, title in ((1, "Positions"), (2, "Mechanism"))
    )
    parts = "".join(
        f'<Override PartName="/xl/worksheets/sheet{n}.xml" ContentType="{_TYPES}.worksheet+xml"/>' for n in (1, 2)
    )
    links = "".join(
        f'<Relationship Id="rId{n}" Type="{_RELS}/worksheet" Target="worksheets/sheet{n}.xml"/>' for n in (1, 2)
    )
    styles = (
        '<fonts count="1"><font><sz val="11"/><name val="Calibri"/></font></fonts><fills count="2"><fill><patternFill '
        'patternType="none"/></fill><fill><patternFill patternType="gray125"/></fill></fills><borders count="1"><border>'
        '<left/><right/><top/><bottom/><diagonal/></border></borders><cellStyleXfs count="1"><xf numFmtId="0" fontId="0" '
        'fillId="0" borderId="0"/></cellStyleXfs><cellXfs count="1"><xf numFmtId="0" fontId="0" fillId="0" borderId="0" '
        'xfId="0"/></cellXfs><cellStyles count="1"><cellStyle name="Normal" xfId="0" builtinId="0"/></cellStyles>'
    )
    return {
        "[Content_Types].xml": f'<Types xmlns="{_PACKAGE}/content-types"><Default Extension="rels" '
        f'ContentType="application/vnd.openxmlformats-package.relationships+xml"/><Override PartName="/xl/workbook.xml" '
        f'ContentType="{_TYPES}.sheet.main+xml"/><Override PartName="/xl/styles.xml" '
        f'ContentType="{_TYPES}.styles+xml"/>{parts}</Types>',
        "_rels/.rels": f'<Relationships xmlns="{_PACKAGE}/relationships"><Relationship Id="rId1" '
        f'Type="{_RELS}/officeDocument" Target="xl/workbook.xml"/></Relationships>',
        "xl/workbook.xml": f'<workbook xmlns="{_MAIN}" xmlns:r="{_RELS}"><sheets>{sheets}</sheets>'
        f"<definedNames>{names}</definedNames></workbook>",
        "xl/_rels/workbook.xml.rels": f'<Relationships xmlns="{_PACKAGE}/relationships">{links}<Relationship Id="rId3" '
        f'Type="{_RELS}/styles" Target="styles.xml"/></Relationships>',
        "xl/styles.xml": f'<styleSheet xmlns="{_MAIN}">{styles}</styleSheet>',
        "xl/worksheets/sheet2.xml": f'<worksheet xmlns="{_MAIN}"><sheetData>{cells}</sheetData></worksheet>',
    }
