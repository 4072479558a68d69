"""Words of groups that Newton's method solves: their sheet, their lines on the first sheet."""

from __future__ import annotations

NEWTON: dict[str, tuple[str, str]] = {
    "iterations.title": ("Newton's method", "Newton yöntemi"),
    "iterations.head": ("Solved", "Çözüldü mü"),
    "iterations.pass": ("group {group}: pass {number}", "{group}. grup: {number}. yineleme"),
    "iterations.arrived": ("group {group}: arrived, after {number} passes", "{group}. grup: varılan yer, {number} yineleme"),
    "iterations.start": (
       "group {group}: start, from the described dimensions to these in {led} passes, {number} more there",
       "{group}. grup: başlangıç, tarif edilen boyutlardan bunlara {led} yineleme, orada {number} daha",
    ),
    "iterations.starts": ("start values of assembly", "montajın başlangıç değerleri"),
    "iterations.share": ("share of the way", "yolun payı"),
    "iterations.lost": ("assembly lost", "montaj kayboldu"),
    "iterations.needed": ("passes needed", "gereken yineleme"),
    "iterations.about": (
        "x(k+1) = x(k) - J⁻¹ F: each pass begins where the one before has arrived, each row where the row above has.",
        "x(k+1) = x(k) - J⁻¹ F: her yineleme öncekinin vardığı yerden, her satır üstündekinden başlar.",
    ),
    "notes.newton.system": ("the equations, solved by Newton's method", "denklemler, Newton yöntemi ile çözülür"),
    "notes.newton.jacobian": ("its determinant is 0 where two assemblies meet", "iki montaj birleşince determinantı 0 olur"),
    "notes.newton.iteration": ("a fixed number of passes in each row", "her satırda belirli sayıda yineleme"),
    "notes.newton.assembly": ("an assembly of the first position", "ilk konumun bir montajı"),
    "notes.newton.velocities": (
        "group {number}: the derivatives of F = 0, J of the last pass, x′ by Cramer's rule",
        "{number}. grup: F = 0 türevleri, J son yinelemenin, x′ Cramer kuralı ile",
    ),
    "notes.newton.accelerations": (
        "group {number}: the second derivatives; k is what the velocities leave",
        "{number}. grup: ikinci türevler; k hızlardan kalan kısımdır",
    ),
    "notes.newton.forces": (
        "group {number}: what its equations hold (λ) against all that acts along its unknowns (Q)",
        "{number}. grup: denklemlerinin tuttuğu (λ), bilinmeyenleri boyunca etkiyen her şeye (Q) karşı",
    ),
    "newton.start": ("starts at", "başlangıç:"),
    "newton.nowhere": ("no position there", "orada konum yok"),
    "verdict.residual": ("residual", "kalan"),
    "verdict.residual.fine": ("largest residual: the links meet", "en büyük kalan: uzuvlar birleşiyor"),
    "verdict.passes_needed": ("passes", "yineleme"),
    "verdict.passes_needed.fine": ("passes needed, of {passes}", "gereken yineleme, {passes} içinden"),
    "verdict.passes_needed.many": (
        "all {passes} passes are needed: smaller step", "{passes} yineleme yetmiyor: adımı küçültün",
    ),
    "verdict.same_assembly": ("assembly", "montaj"),
    "verdict.same_assembly.kept": ("the same assembly in every row", "her satırda aynı montaj"),
    "verdict.same_assembly.lost": ("rows that may be of another assembly", "başka montajda olabilecek satır"),
    "verdict.same_assembly.begun": (
        "the assembly described ends: perhaps another", "tarif edilen montaj sona eriyor: belki başkası",
    ),
    "verdict.line.ended": (
        "no position found: on the way to these values the assembly described ends",
        "konum bulunamadı: tarif edilen montaj bu değerlere giden yolda sona eriyor",
    ),
    "verdict.least_det": ("least |det|", "en küçük |det|"),
    "verdict.least_det.words": ("nearest to where assemblies meet", "montajların birleştiği yere en yakın"),
    "checks.residual": ("residual, group {number}", "kalan, {number}. grup"),
    "checks.needed": ("passes needed, group {number}", "gereken yineleme, {number}. grup"),
    "checks.det": ("|det|, group {number}", "|det|, {number}. grup"),
    "checks.assembly": ("leap to another assembly", "başka montaja sıçrama"),
}  # fmt: skip
"""Key -> English and Turkish."""
