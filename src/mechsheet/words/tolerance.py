"""The words of tolerances in the workbook, in both languages."""

from __future__ import annotations

TOLERANCE: dict[str, tuple[str, str]] = {
    "sheet.tolerance": ("Tolerance", "Tolerans"),
    "tolerance.title": ("Tolerances and sensitivity", "Toleranslar ve duyarlılık"),
    "hint.tolerance.title": ("Tolerance", "Tolerans"),
    "hint.tolerance": ("± in the dimension's own unit; 0 or more.", "Boyutun kendi biriminde ±; 0 ya da daha büyük."),
    "block.bands": ("± by the tolerances", "Toleranslarla ±"),
    "bands.head.root": ("RSS", "RSS"),
    "bands.groups": ("Groups", "Gruplar"),
    "bands.of": ("{symbol}: by each dimension, and its band", "{symbol}: her boyuta göre türevi ve bandı"),
    "bands.worst": ("± worst case", "± en kötü durum"),
    "bands.root": ("± RSS", "± RSS"),
    "bands.low": ("lower end", "alt uç"),
    "bands.high": ("upper end", "üst uç"),
    "bands.dead": ("dead centre", "ölü konum"),
    "bands.largest": ("largest", "en geniş"),
    "bands.derivative": ("derivative", "türev"),
    "bands.share": ("share", "pay"),
    "bands.shown": ("shown", "gösterilen"),
    "bands.none": ("no number: a dead centre, or no position", "sayı yok: ölü konum ya da konum yok"),
    "bands.largest.at": ("largest at {driver} = {place}", "en geniş: {driver} = {place}"),
    "bands.mostly": ("mostly {name} ({share} %)", "en çok {name} (%{share})"),
    "extremes.band": ("derivatives, {symbol}", "türevler, {symbol}"),
    "chart.band.low": ("{symbol}, lower end", "{symbol}, alt uç"),
    "chart.band.high": ("{symbol}, upper end", "{symbol}, üst uç"),
    "notes.use.tolerance": (
        "The sheet {tolerance} has the change of a quantity by each dimension that has a tolerance, the driver standing. "
        "The ± cells beside the dimensions are inputs. Worst case: all tolerances at the end that hurts. RSS, root of the "
        "sum of squares: independent dimensions; as sure as the tolerances are kept. Both are of first order.",
        "{tolerance} sayfasında, tahrik dururken her toleranslı boyutun bir niceliği ne kadar değiştirdiği vardır. "
        "Boyutların yanındaki ± hücreleri giriştir. En kötü durum: bütün toleranslar kötü uçlarında. RSS: karelerin "
        "toplamının karekökü; bağımsız boyutlar içindir ve toleranslar kadar güvenlidir. İkisi birinci mertebedendir.",
    ),
}  # fmt: skip
