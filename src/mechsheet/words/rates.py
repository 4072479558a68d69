"""The words of velocities and accelerations in the workbook, in both languages."""

from __future__ import annotations

RATES: dict[str, tuple[str, str]] = {
    "name.speed": ("speed", "hız"),
    "name.acceleration": ("acceleration", "ivme"),
    "block.motion": ("Motion of the driver", "Tahrik hareketi"),
    "motion.speed": ("speed of the driver", "tahrik hızı"),
    "motion.speed.own": ("speed of the driver, in its own unit", "tahrik hızı, kendi biriminde"),
    "motion.acceleration": ("acceleration of the driver", "tahrik ivmesi"),
    "motion.acceleration.own": ("acceleration of the driver, in its own unit", "tahrik ivmesi, kendi biriminde"),
    "rates.title": ("Velocity and acceleration", "Hız ve ivme"),
    "rates.dead": ("dead centre: {links}", "ölü konum: {links}"),
    "rates.head": ("Dead centre?", "Ölü konum mu?"),
    "checks.dead": ("What the sheet {rates} says", "{rates} sayfasının sözleri"),
    "checks.velocity": ("velocities fit, group {number}", "hızlar uyuyor, {number}. grup"),
    "checks.acceleration": ("accelerations fit, group {number}", "ivmeler uyuyor, {number}. grup"),
    "verdict.dead_centres": ("dead centres", "ölü konum"),
    "verdict.dead_centres.none": ("no position is a dead centre", "hiçbir konum ölü konum değil"),
    "verdict.dead_centres.some": (
        "no velocities there: see the sheet {rates}", "orada hız yok: {rates} sayfasına bakın"
    ),
    "verdict.velocities_fit": ("velocities", "hızlar"),
    "verdict.accelerations_fit": ("accelerations", "ivmeler"),
    "verdict.rates.fit": ("they fit the links: rounding only", "uzuvlarla uyuşuyor: yalnız yuvarlama"),
    "verdict.rates.not": ("they do not fit the links: see {sheet}", "uzuvlarla uyuşmuyor: {sheet} sayfasına bakın"),
}  # fmt: skip
