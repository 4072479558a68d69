"""The words of a study's summary workbook and picture, in both languages."""

from __future__ import annotations

STUDY: dict[str, tuple[str, str]] = {
    "best": ("Best designs", "En iyi tasarımlar"),
    "front": ("Front", "Cephe"),
    "settings": ("Study", "Çalışma"),
    "title.one": ("{title}: {count} of {kept} design", "{title}: {kept} tasarımdan {count}"),
    "title": ("{title}: {count} of {kept} designs", "{title}: {kept} tasarımdan {count}"),
    "about": (
        "Designs that meet all conditions, the best first. The command in the last column builds its workbook.",
        "Bütün koşulları sağlayan tasarımlar, en iyisi başta. Son sütundaki komut o tasarımın çalışma kitabını kurar.",
    ),
    "rank": ("rank", "sıra"),
    "design": ("design", "tasarım"),
    "on_front": ("on the front", "cephede"),
    "yes": ("yes", "evet"),
    "command": ("command", "komut"),
    "description": ("description", "tanım"),
    "folder": ("folder of the study", "çalışmanın klasörü"),
    "front.title": ("Pareto front", "Pareto cephesi"),
    "front.about": (
        "No design is at least as good in every objective and better in one.",
        "Hiçbir tasarım her amaçta en az bu kadar iyi, birinde daha iyi değildir.",
    ),
    "front.thinned": ("{shown} designs, evenly taken of {all}", "{all} tasarımdan eşit aralıkla {shown} tasarım"),
    "remarks": ("what the workbook says", "çalışma kitabının notu"),
    "apart": ("Set apart", "Ayrılanlar"),
    "apart.title.one": ("Set apart: {count} of {apart} design", "Ayrılan {apart} tasarımdan {count}"),
    "apart.title": ("Set apart: {count} of {apart} designs", "Ayrılan {apart} tasarımdan {count}"),
    "apart.about": (
        "They meet the conditions by numbers that their workbooks mark (rows only, grows without bound): not ranked.",
        "Koşulları, çalışma kitaplarının işaretlediği sayılarla (yalnız satırlar, sınırsız büyür) sağlar: sıralanmaz.",
    ),
    "settings.apart": ("of these set apart: not ranked", "bunlardan ayrılanlar: sıralanmadı"),
    "minimize": ("small", "küçük"),
    "maximize": ("large", "büyük"),
    "designs": ("designs tried", "denenen tasarım"),
    "kept": ("designs that meet all conditions", "bütün koşulları sağlayan tasarım"),
    "share": ("share", "pay"),
    "rows": ("positions of each design", "her tasarımın konum sayısı"),
    "sample": ("sample", "örnekleme"),
    "seed": ("seed", "tohum"),
    "grid": ("grid: all combinations", "ızgara: bütün birleşimler"),
    "sobol": ("Sobol sequence", "Sobol dizisi"),
    "vary": ("dimensions that vary", "değişen boyutlar"),
    "conditions": (
        "conditions, and how many designs failed each first",
        "koşullar ve her birine ilk takılan tasarım sayısı",
    ),
    "objectives": ("objectives", "amaçlar"),
    "versions": ("computed with", "hesaplayan"),
    "cloud": ("other designs kept", "kalan öteki tasarımlar"),
    "parallel": ("Best designs: each line a design, each axis from its least to its largest value",
                 "En iyi tasarımlar: her çizgi bir tasarım, her eksen en küçükten en büyük değere"),
}  # fmt: skip


def study_words(language: str, key: str, **parts: object) -> str:
    """A phrase in "en" or "tr"."""
    return STUDY[key][1 if language == "tr" else 0].format(**parts)
