"""Every word of the workbook that is not the description's own, in both languages."""

from __future__ import annotations

from typing import Literal

Language = Literal["en", "tr"]

WORDS: dict[str, tuple[str, str]] = {
    # sheets
    "sheet.mechanism": ("Mechanism", "Mekanizma"),
    "sheet.positions": ("Positions", "Konumlar"),
    "sheet.drawing": ("Drawing", "Çizim"),
    "sheet.checks": ("Checks", "Denetim"),
    "sheet.notes": ("Notes", "Notlar"),
    "sheet.table": ("Table", "Tablo"),
    "sheet.description": ("Description", "Tanım"),
    # names of cells that no description chooses
    "name.start": ("start", "başlangıç"),
    "name.step": ("step", "adım"),
    "name.stop": ("stop", "bitiş"),
    "position.driver": ("the driver there", "tahrikin oradaki değeri"),
    "name.position": ("position", "konum"),
    # blocks of the first sheet
    "block.dimensions": ("Dimensions", "Boyutlar"),
    "block.derived": ("Derived from them", "Bunlardan türetilenler"),
    "block.sweep": ("Sweep of the driver", "Tahrik aralığı"),
    "block.assembly": ("Assembly", "Montaj"),
    "block.position": ("Position shown", "Gösterilen konum"),
    "block.variables": ("At this position", "Bu konumda"),
    "block.summary": ("Over the whole sweep", "Bütün çevrim boyunca"),
    "block.stands": ("How it stands", "Durum"),
    "head.symbol": ("Symbol", "Simge"),
    "head.value": ("Value", "Değer"),
    "head.unit": ("Unit", "Birim"),
    "head.tolerance": ("±", "±"),
    "head.meaning": ("Meaning", "Anlamı"),
    "head.number": ("No.", "No"),
    "head.status": ("Position", "Konum"),
    "head.exists": ("exists", "var mı"),
    "column.shown": ("the same in degrees", "aynısı, derece olarak"),
    "column.guarded": ("the same, in rows that exist", "aynısı, var olan satırlarda"),
    "column.radians": ("the driver in radians", "tahrik, radyan olarak"),
    "column.blank": ("value or nothing, for the summaries", "değer ya da boş, özetler için"),
    "stands.assembles": ("assembles in", "montaj olan satırlar"),
    "stands.all": ("all {rows} rows", "{rows} satırın tümü"),
    "stands.some": ("some rows do not exist", "bazı satırlar yok"),
    "stands.gap": ("first row without a position", "konumu olmayan ilk satır"),
    "stands.none": ("none", "yok"),
    "head.at": ("at", "yeri"),
    "group.driver": ("Driver", "Tahrik"),
    "group.outputs": ("Outputs", "Çıktılar"),
    "group": ("Group", "Grup"),
    "status.ok": ("ok", "tamam"),
    "status.open": ("does not close: {links}", "kapanmıyor: {links}"),
    "status.undetermined": ("undetermined: {links}", "belirsiz: {links}"),
    "sweep.start": ("first value of the driver", "tahrikin ilk değeri"),
    "sweep.step": ("step from row to row", "satırdan satıra adım"),
    "sweep.stop": ("last value (rows are fixed: {rows})", "son değer (satır sayısı sabit: {rows})"),
    "position.number": ("row of the table, 0 to {last}", "tablo satırı, 0 ile {last} arası"),
    "unit.number": ("", ""),
    "hint.positive.title": ("A length", "Bir uzunluk"),
    "hint.positive": (
        "{symbol} is the distance of two joints: a number greater than 0.",
        "{symbol} iki mafsalın uzaklığıdır: 0'dan büyük bir sayı olmalı.",
    ),
    "hint.number": ("{symbol}: a number.", "{symbol}: bir sayı."),
    "hint.number.title": ("A number", "Bir sayı"),
    "hint.mode": ("+1 or -1: which of the two assemblies.", "+1 veya -1: iki montajdan hangisi."),
    "hint.mode.title": ("Assembly", "Montaj"),
    "hint.position": ("A whole number from 0 to {last}.", "0 ile {last} arasında bir tam sayı."),
    "hint.position.title": ("Position", "Konum"),
    "hint.step": ("Any number but 0.", "0 dışında bir sayı."),
    "take.max": ("largest {symbol}", "en büyük {symbol}"),
    "take.min": ("smallest {symbol}", "en küçük {symbol}"),
    "take.range": ("range of {symbol}", "{symbol} aralığı"),
    "take.first": ("first {symbol}", "ilk {symbol}"),
    "take.last": ("last {symbol}", "son {symbol}"),
    "take.mean": ("mean {symbol}", "ortalama {symbol}"),
    "chart.angles": ("Angles against {driver}", "{driver} ile açılar"),
    "chart.displacements": ("Displacements against {driver}", "{driver} ile ötelenmeler"),
    "chart.outputs": ("{symbol} against {driver}", "{driver} ile {symbol}"),
    "chart.path": ("Path of {points}", "{points} yörüngesi"),
    "table.about": ("{value} over {rows} and {columns}", "{rows} ve {columns} değerlerine göre {value}"),
    "table.hint": (
        "The yellow cells of the head row may be changed, and so may the dimensions on the first sheet. "
        "#N/A: the links cannot be joined there.",
        "Başlık satırındaki sarı hücreler ve ilk sayfadaki boyutlar değiştirilebilir. "
        "#YOK (#N/A): uzuvlar orada birleştirilemez.",
    ),
    "source": ("Source: {source}", "Kaynak: {source}"),
    "footer": ("made with mechsheet", "mechsheet ile hazırlanmıştır"),
}  # fmt: skip


def words(language: Language, key: str, **parts: object) -> str:
    """The text of a key in a language, its {parts} filled in."""
    text = WORDS[key][1 if language == "tr" else 0]
    return text.format(**parts) if parts else text
