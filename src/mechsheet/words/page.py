"""The words of the layout `page`, in both languages."""

from __future__ import annotations

PAGE: dict[str, tuple[str, str]] = {
    "page.note": (
        "Angles by the law of cosines. A cosine is rounded to 12 digits, so that 1 + 10⁻¹⁶ at a dead centre is no "
        "error. Near dead centres the arccosine loses digits: an angle of a triangle within 0.03° of 0° or 180° is "
        "known to 10⁻⁹ rad, at worst to 10⁻⁶ rad; elsewhere to 10⁻¹². #N/A: no position there. For more rows copy the"
        " last one down.",
        "Açılar kosinüs teoremi ile. Kosinüs 12 basamağa yuvarlanır; böylece ölü konumda 1 + 10⁻¹⁶ hata vermez. Ölü "
        "konumlara yakın yerde arkkosinüs basamak yitirir: 0° veya 180°'ye 0,03°'den yakın bir üçgen açısı 10⁻⁹ rad, "
        "en kötü durumda 10⁻⁶ rad doğruluktadır; başka yerde 10⁻¹². #YOK: orada konum yok. Daha çok satır için son "
        "satırı aşağı kopyalayın.",
    ),
    "page.note.plain": (
        "#N/A: no position there. For more rows copy the last one down.",
        "#YOK: orada konum yok. Daha çok satır için son satırı aşağı kopyalayın.",
    ),
    "page.note.summaries": (
        "Two-way tables of summaries are in the layout of several sheets.",
        "Özetlerin iki yönlü tabloları çok sayfalı düzendedir.",
    ),
    "page.note.legs": (
        "A leg of a right triangle by the arcsine of its angle, rounded to 12 digits, so that 1 + 10⁻¹⁶ at a dead "
        "centre is no error. Near dead centres the arcsine loses digits: an angle within 0.03° of ±90° is known to "
        "10⁻⁹ rad, at worst to 10⁻⁶ rad; elsewhere to 10⁻¹². #N/A: no position there. For more rows copy the last one"
        " down.",
        "Dik üçgenin kenarı, açısının arksinüsü ile; sinüs 12 basamağa yuvarlanır, böylece ölü konumda 1 + 10⁻¹⁶ hata"
        " vermez. Ölü konumlara yakın yerde arksinüs basamak yitirir: ±90°'ye 0,03°'den yakın bir açı 10⁻⁹ rad, en "
        "kötü durumda 10⁻⁶ rad doğruluktadır; başka yerde 10⁻¹². #YOK: orada konum yok. Daha çok satır için son "
        "satırı aşağı kopyalayın.",
    ),
    "page.start": ("first value of {driver}", "{driver} ilk değeri"),
    "page.step.words": ("from row to row", "satırdan satıra"),
    "page.position": ("row that is drawn, from 0", "çizilen satır, 0'dan"),
    "page.group": ("group {number}: {links}", "{number}. grup: {links}"),
    "page.open": ("does not close: {links}", "kapanmıyor: {links}"),
    "page.undetermined": ("undetermined: {links}", "belirsiz: {links}"),
    "page.open.group": ("does not close: group ", "kapanmıyor, grup: "),
    "page.undetermined.group": ("undetermined: group ", "belirsiz, grup: "),
    "page.length": ("distance {name}", "{name} uzaklığı"),
    "page.rows": ("rows that close", "kapanan satır"),
    "page.of": ("of ", "/ "),
    "page.bound": ("longest that closes, or turns fully", "kapanan ya da tam dönen en uzun boy"),
    "page.inputs": ("the first that cannot be; 0: none", "olamayacak ilk hücre; 0: yok"),
    "page.take.rows": ("{label} (these rows)", "{label} (bu satırlarda)"),
    "page.drawing": ("For the drawing", "Çizim için"),
}  # fmt: skip
