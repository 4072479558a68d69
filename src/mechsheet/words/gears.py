"""The words of gears, belts, racks and further drivers in the workbook, in both languages."""

from __future__ import annotations

GEARS: dict[str, tuple[str, str]] = {
    "block.gears": ("Gears", "Dişliler"),
    "block.drivers": ("Driven besides", "Ayrıca tahrik edilen"),
    "gears.gear.ratio": (
        "gear ratio of {link} to {on}: negative where they turn against each other",
        "{link} / {on} dişli oranı: ters dönerlerse eksi",
    ),
    "gears.belt.ratio": (
        "belt ratio of {link} to {on}: negative for a crossed belt", "{link} / {on} kayış oranı: çapraz kayışta eksi"
    ),
    "gears.rack.radius": ("pitch radius of {link} on the rack {on}", "{link}: {on} kremayeri üzerinde yuvarlanma yarıçapı"),
    "gears.gear.phase": ("angle of {link} where that of {on} is 0", "{on} açısı 0 iken {link} açısı"),
    "gears.belt.phase": ("angle of {link} where that of {on} is 0", "{on} açısı 0 iken {link} açısı"),
    "gears.rack.phase": ("{on} where the angle of {link} is 0", "{link} açısı 0 iken {on} ötelenmesi"),
    "drawing.wheel": ("wheel {link}", "{link} çarkı"),
    "drawing.belt": ("belt to {link}", "{link} kayışı"),
    "drawing.rack": ("rack {link}", "{link} kremayeri"),
    "drivers.value": ("held by hand: the same in every row", "elle verilir: her satırda aynı"),
    "drivers.listed": ("typed, row by row", "satır satır yazılır"),
}  # fmt: skip
