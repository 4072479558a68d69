"""The words of the layout `page`, in both languages."""

from __future__ import annotations

PAGE: dict[str, tuple[str, str]] = {
    "page.note": (
        "Angles by the law of cosines. A cosine is rounded to 12 digits, so that 1 + 10⁻¹⁶ at a dead centre is no error: that "
        "costs nothing elsewhere, but an angle of a triangle within 0.03° of 0° or 180° is known to 10⁻⁹ rad only, in the "
        "dead centre itself to 10⁻⁶ rad. #N/A: no position there. For more rows copy the last one down.",
        "Açılar kosinüs teoremi ile. Kosinüs 12 basamağa yuvarlanır; böylece ölü konumda 1 + 10⁻¹⁶ hata vermez. Bunun başka "
        "yerde bir etkisi yoktur; ancak 0° veya 180°'ye 0,03°'den yakın bir üçgen açısı yalnız 10⁻⁹ rad, tam ölü konumda "
        "10⁻⁶ rad doğruluktadır. #YOK: orada konum yok. Daha çok satır için son satırı aşağı kopyalayın.",
    ),
    "page.note.plain": (
        "#N/A: no position there. For more rows copy the last one down.",
        "#YOK: orada konum yok. Daha çok satır için son satırı aşağı kopyalayın.",
    ),
    "page.note.legs": (
        "A leg of a right triangle by arcsin of its angle, rounded to 12 digits, so that 1 + 10⁻¹⁶ at a dead centre is no error: "
        "within 0.03° of ±90° that angle is known to 10⁻⁹ rad only, at ±90° itself to 10⁻⁶ rad. #N/A: no position there. For "
        "more rows copy the last one down.",
        "Dik üçgenin kenarı açısının arcsin'i ile; sinüs 12 basamağa yuvarlanır, böylece ölü konumda 1 + 10⁻¹⁶ hata vermez: "
        "±90°'ye 0,03°'den yakın açı yalnız 10⁻⁹ rad, tam ±90°'de 10⁻⁶ rad doğruluktadır. #YOK: orada konum yok. Daha çok "
        "satır için son satırı aşağı kopyalayın.",
    ),
    "page.step": ("row above + {step}", "üst satır + {step}"),
    "page.start": ("first value of {driver}", "{driver} ilk değeri"),
    "page.step.words": ("from row to row", "satırdan satıra"),
    "page.position": ("row that is drawn, from 0", "çizilen satır, 0'dan"),
    "page.group": ("group {number}: {links}", "{number}. grup: {links}"),
    "page.open": ("does not close: {links}", "kapanmıyor: {links}"),
    "page.open.group": ("does not close: group ", "kapanmıyor, grup: "),
    "page.length": ("distance {name}", "{name} uzaklığı"),
    "page.rows": ("rows that close", "kapanan satır"),
    "page.of": ("of ", "/ "),
    "page.verdict.all": ("closes in all ", "bütün konumlarda kapanıyor: "),
    "page.verdict.some": ("closes in ", "kapandığı konum: "),
    "page.verdict.of": (" of ", " / "),
    "page.verdict.positions": (" positions", ""),
    "page.transmission": ("least transmission angle in these rows", "bu satırlarda en küçük bağlama açısı"),
    "page.verdict.transmission": ("; transmission angle at least ", "; bağlama açısı en az "),
    "page.verdict.rows": (" in these rows", " (bu satırlarda)"),
    "page.take.rows": ("{label} (these rows)", "{label} (bu satırlarda)"),
    "page.drawing": ("For the drawing", "Çizim için"),
}  # fmt: skip
