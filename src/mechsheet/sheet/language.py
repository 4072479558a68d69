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
    "column.rounded": ("the same to twelve digits, to find extremes", "aynısı, on iki basamak: uç değerleri bulmak için"),
    "stands.rows": ("positions", "konumlar"),
    "stands.all": ("assembles over the whole range", "bütün aralıkta kapanıyor"),
    "stands.nowhere": ("assembles nowhere", "hiçbir yerde kapanmıyor"),
    "stands.from": ("assembles from", "kapandığı aralık:"),
    "stands.to": ("to", "–"),
    "stands.stretches": ("stretches", "parça"),
    "stands.missing": ("missing", "eksik"),
    "stands.none_missing": ("no row without a position", "konumu olmayan satır yok"),
    "stands.some_missing": ("rows without a position, and the first", "konumu olmayan satırlar ve ilki"),
    "stands.closure": ("gap", "açıklık"),
    "stands.leaps": ("leaps", "sıçrama"),
    "stands.no_leap": ("no leap from row to row", "satırdan satıra sıçrama yok"),
    "stands.some_leaps": ("other branch, or steps too coarse", "başka dal ya da adım çok büyük"),
    "stands.grashof": ("Grashof", "Grashof"),
    "stands.grashof.one": ("{loop}: crank-rocker, {link} turns", "{loop}: krank-sarkaç, {link} tam döner"),
    "stands.grashof.both": ("{loop}: double crank (drag link)", "{loop}: çift krank"),
    "stands.grashof.coupler": ("{loop}: double rocker, Grashof", "{loop}: çift sarkaç (Grashof)"),
    "stands.grashof.none": ("{loop}: triple rocker, not Grashof", "{loop}: üçlü sarkaç (Grashof değil)"),
    "stands.grashof.change": ("{loop}: change point", "{loop}: katlanabilir (sınır durum)"),
    "stands.grashof.open": ("{loop}: cannot be closed", "{loop}: kapatılamaz"),
    "stands.crank": ("crank: turns fully", "krank: tam döner"),
    "stands.rocker": ("rocker: swings by this much", "sarkaç: bu kadar salınır"),
    "stands.turned": ("turns by this much in the sweep", "bu aralıkta bu kadar döner"),
    "stands.stroke": ("stroke", "kurs"),
    "stands.ratio_symbol": ("ratio", "oran"),
    "stands.ratio": ("time ratio of {symbol}, slow way : fast way", "{symbol} zaman oranı, yavaş : hızlı"),
    "stands.no_turn": ("time ratio: needs a sweep of a whole turn", "zaman oranı: tam bir tur gerekir"),
    "stands.fair": ("good transmission", "bağlama iyi"),
    "stands.poor": ("poor, below 40°", "bağlama kötü, 40° altı"),
    "extremes.title": ("Extremes, also between rows", "Uç değerler (satır arası da)"),
    "extremes.min": ("smallest", "en küçük"),
    "extremes.max": ("largest", "en büyük"),
    "extremes.row": ("row", "satır"),
    "extremes.before": ("before", "önceki"),
    "extremes.after": ("after", "sonraki"),
    "extremes.value": ("value", "değer"),
    "extremes.at": ("at driver", "tahrik değeri"),
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
    "checks.title": ("Checks by geometry", "Geometrik denetim"),
    "checks.about": (
        "Lengths and angles measured in the table of positions, against those of the description: differences that are "
        "rounding errors, or something to look at. A leap: between two rows a point moves more than four times as far, "
        "or a link turns more than four times as much, as in the steps before and after; "
        "or a link turns by more than half a turn.",
        "Konum tablosunda ölçülen uzunluk ve açıların tanımdakilerle karşılaştırması: farklar ya yuvarlama hatasıdır ya da "
        "bakılması gereken bir şeydir. Sıçrama: iki satır arasında bir noktanın önceki ve sonraki adımın dört katından "
        "fazla ilerlemesi, bir uzvun dört katından fazla dönmesi ya da yarım turdan fazla dönmesi.",
    ),
    "checks.all": ("All checks", "Tüm denetimler"),
    "checks.clear": ("all clear", "her şey yolunda"),
    "checks.not_clear": ("look at the red cells", "kırmızı hücrelere bakın"),
    "checks.ok": ("ok", "tamam"),
    "checks.look": ("look", "bakın"),
    "checks.worst": ("Largest gap", "En büyük açıklık"),
    "checks.rounding": ("Rounding, up to", "Yuvarlama sınırı"),
    "checks.fixed": ("Fixed points", "Sabit noktalar"),
    "checks.steps": ("Steps of the driver", "Tahrik adımları"),
    "checks.rows": ("Incomplete rows", "Eksik satırlar"),
    "checks.derived": ("Derived dimensions", "Türetilen boyutlar"),
    "checks.position": ("Position shown", "Gösterilen konum"),
    "checks.summaries": ("Summaries", "Özetler"),
    "checks.given": ("Given: length, or x", "Verilen: uzunluk, x"),
    "checks.given.second": ("and y, in the link", "ve y, uzuvda"),
    "checks.most": ("Largest; leaps: count", "En büyük; sıçrama sayısı"),
    "checks.at": ("at {driver} =", "yeri: {driver} ="),
    "checks.verdict": ("Verdict", "Sonuç"),
    "checks.gap": ("gap at {point}", "{point} açıklığı"),
    "checks.kept": ("angle kept", "korunan açı"),
    "checks.slide": ("slide {symbol}", "{symbol} kayması"),
    "checks.motion": ("From row to row", "Satırdan satıra"),
    "checks.move": ("farthest move", "en büyük ilerleme"),
    "checks.turn": ("largest turn", "en büyük dönme"),
    "checks.leap": ("leap", "sıçrama"),
    "notes.use": ("How to use this workbook", "Bu çalışma kitabı nasıl kullanılır"),
    "notes.use.inputs": (
        "Type over any yellow cell of the sheet {mechanism}: every number, drawing and chart follows at once.",
        "{mechanism} sayfasındaki sarı hücrelerden birine yeni bir değer yazın: bütün sayılar, çizim ve "
        "grafikler hemen değişir.",
    ),
    "notes.use.position": (
        "The position cell (0 to {last}), its scroll bar and its spin button choose the row that is drawn and listed.",
        "Konum hücresi (0 ile {last} arası), kaydırma çubuğu ve değer düğmesi, çizilen ve listelenen satırı seçer.",
    ),
    "notes.use.modes": (
        "An assembly mode is +1 or −1: the two ways in which the same links can be put together. Change the "
        "sign to see the other.",
        "Montaj işareti +1 veya −1'dir: aynı uzuvların iki ayrı birleştirilme biçimi. Diğerini görmek için "
        "işareti değiştirin.",
    ),
    "notes.use.sweep": (
        "First value and step of the driver {driver} may be changed; the number of rows ({rows}) stays.",
        "{driver} tahrikinin ilk değeri ve adımı değiştirilebilir; satır sayısı ({rows}) sabittir.",
    ),
    "notes.use.positions": (
        "The sheet {positions} has one row for each value of the driver. Intermediate quantities (grey) can be "
        "folded away: by the marks over the columns.",
        "{positions} sayfasında tahrikin her değeri için bir satır vardır. Ara büyüklükler (gri) gizlenebilir: sütunların "
        "üstündeki işaretlerle.",
    ),
    "notes.use.charts": (
        "Charts leave out rows that do not exist. The drawing and the paths of points are at true scale: a "
        "circle is round.",
        "Grafikler var olmayan satırları atlar. Çizim ve nokta yörüngeleri gerçek orandadır: daire yuvarlak görünür.",
    ),
    "notes.use.tables": (
        "A sheet {table} shows one quantity for many values of a dimension; the values in its head row may be changed.",
        "{table} sayfası, bir boyutun çeşitli değerleri için bir büyüklüğü gösterir; başlık satırındaki "
        "değerler değiştirilebilir.",
    ),
    "notes.use.checks": (
        "The sheet {checks} measures every row anew by geometry. It should say that all is clear; red cells "
        "show where it is not.",
        "{checks} sayfası her satırı geometrik olarak yeniden ölçer. Her şeyin yolunda olduğunu söylemelidir; "
        "kırmızı hücreler sorunun yerini gösterir.",
    ),
    "notes.use.missing": (
        "#N/A means that the links cannot be joined at that value of the driver; a column says which of them.",
        "#YOK (#N/A), tahrikin o değerinde uzuvların birleştirilemediğini belirtir; bir sütun hangileri "
        "olduğunu söyler.",
    ),
    "notes.colours": ("Colours", "Renkler"),
    "notes.sample.input": ("12.5", "12,5"),
    "notes.sample.result": ("12.5", "12,5"),
    "notes.sample.good": ("ok", "tamam"),
    "notes.sample.warning": ("look", "bakın"),
    "notes.sample.bad": ("look", "bakın"),
    "notes.sample.current": ("12.5", "12,5"),
    "notes.sample.no_position": ("#N/A", "#YOK"),
    "notes.colour.input": ("an input: may be changed", "girdi: değiştirilebilir"),
    "notes.colour.result": ("a result: computed by a formula", "sonuç: formülle hesaplanır"),
    "notes.colour.good": ("as it should be", "olması gerektiği gibi"),
    "notes.colour.warning": ("possible, but worth a look", "olabilir, ama bakmaya değer"),
    "notes.colour.bad": ("an error, or no position at all", "hata var ya da hiçbir konum yok"),
    "notes.colour.current": ("the row of the position shown", "gösterilen konumun satırı"),
    "notes.colour.no_position": ("a row without a position", "konumu olmayan satır"),
    "notes.assumptions": ("Assumptions", "Varsayımlar"),
    "notes.assumptions.planar": (
        "All links are rigid and move in parallel planes; joints have no clearance. Lengths are in {unit}.",
        "Bütün uzuvlar rijittir ve paralel düzlemlerde hareket eder; mafsallarda boşluk yoktur. Uzunluk "
        "birimi: {unit}.",
    ),
    "notes.assumptions.angles": (
        "The angle of a link is that of its own x axis from the x axis of the fixed link, counter-clockwise. "
        "The table of links below says where the axes lie.",
        "Bir uzvun açısı, kendi x ekseninin sabit uzvun x ekseniyle saat yönünün tersine yaptığı açıdır. "
        "Eksenlerin yeri aşağıdaki uzuv tablosundadır.",
    ),
    "notes.assumptions.radians": (
        "Formulas compute in radians. arctan2(x; y) is the direction of the point (x; y): x comes first, as "
        "in the cells.",
        "Formüller radyanla hesaplar. arctan2(x; y), (x; y) noktasının doğrultusudur: hücrelerdeki gibi önce "
        "x yazılır.",
    ),
    "notes.assumptions.continuous": (
        "An angle goes on without jumps from row to row, through as many turns as the link makes.",
        "Açılar satırdan satıra sıçramadan, uzvun yaptığı tur sayısı kadar ilerler.",
    ),
    "notes.assumptions.constant_mode": (
        "The assembly mode is the same in all rows. At a change point, where both assemblies meet, it stays "
        "what its cell says.",
        "Montaj işareti bütün satırlarda aynıdır. İki montajın birleştiği sınır konumda da hücredeki değer geçerlidir.",
    ),
    "notes.assumptions.rounding": (
        "At a limit position links may miss one another by a rounding error: up to 1e-12 of the largest "
        "length counts as closed.",
        "Sınır konumda uzuvlar yuvarlama hatası kadar ayrık olabilir: en büyük uzunluğun 1e-12 katına kadar "
        "kapalı sayılır.",
    ),
    "notes.links": ("Links and sliding joints", "Uzuvlar ve kayar mafsallar"),
    "notes.head.symbol": ("Angle, slide", "Açı, kayma"),
    "notes.head.number": ("Link", "Uzuv"),
    "notes.head.points": ("Points, in the link's own frame", "Noktalar, uzvun kendi takımında"),
    "notes.head.link": ("Name", "Adı"),
    "notes.head.key": ("In the description", "Tanımda"),
    "notes.head.equation": ("Equation", "Denklem"),
    "notes.head.place": ("Where", "Yeri"),
    "notes.fixed": ("fixed", "sabit"),
    "notes.left": ("left of {first}→{second}", "{first}→{second} solunda"),
    "notes.right": ("right of {first}→{second}", "{first}→{second} sağında"),
    "notes.prismatic": (
        "{point} of {link} slides on {on}, along a line through",
        "{link} uzvunun {point} noktası {on} üzerinde kayar; doğru:",
    ),
    "notes.pin-slot": (
        "{point} slides in a slot of {on}, along a line through",
        "{point} noktası {on} kanalında kayar; doğru:",
    ),
    "notes.equations": ("Equations, in order of solution", "Denklemler, çözüm sırasıyla"),
    "notes.constants": ("Constants", "Sabitler"),
    "notes.given": ("given", "verilir"),
    "notes.driver": ("the driver, row by row", "tahrik, satır satır"),
    "notes.column.status": (
        "a word on the position: which links cannot be joined",
        "konumun durumu: hangi uzuvlar birleşmiyor",
    ),
    "notes.column.exists": ("1 where all groups close, else 0", "bütün gruplar kapanıyorsa 1, yoksa 0"),
    "notes.first": ("in the first row", "ilk satırda"),
    "notes.above": ("row above", "üst satır"),
    "notes.missing": ("#N/A", "#YOK"),
    "notes.otherwise": ("otherwise", "değilse"),
    "notes.or": ("or", "veya"),
    "notes.and": ("and", "ve"),
    "notes.round": ("round", "yuvarla"),
    "notes.is_number": ("is a number", "bir sayı"),
    "table.about": ("{value} over {rows} and {columns}", "{rows} ve {columns} değerlerine göre {value}"),
    "table.hint": (
        "The yellow cells of the head row may be changed, and so may the dimensions on the first sheet. "
        "#N/A: the links cannot be joined there.",
        "Başlık satırındaki sarı hücreler ve ilk sayfadaki boyutlar değiştirilebilir. "
        "#YOK (#N/A): uzuvlar orada birleştirilemez.",
    ),
    # the drawing
    "drawing.title": ("The drawing in numbers", "Çizimin sayıları"),
    "drawing.note": (
        "Left: the position shown. Right: the whole sweep. X and Y run from -1 to 1 over the window of a chart.",
        "Solda: gösterilen konum. Sağda: bütün çevrim. X ve Y grafiğin penceresinde -1 ile 1 arasındadır.",
    ),
    "drawing.frame": ("Window of the drawing", "Çizimin penceresi"),
    "drawing.path.frame": ("Window of the path of {points}", "{points} yörüngesinin penceresi"),
    "drawing.from": ("from", "en az"),
    "drawing.to": ("to", "en çok"),
    "drawing.middle": ("middle", "orta"),
    "drawing.half": ("half the side", "kenarın yarısı"),
    "drawing.bar": ("scale bar", "ölçek çubuğu"),
    "drawing.bar.label": ("its length in words", "uzunluğu, yazıyla"),
    "drawing.least": ("least {symbol}", "en küçük {symbol}"),
    "drawing.most": ("most {symbol}", "en büyük {symbol}"),
    "drawing.points": ("Points", "Noktalar"),
    "drawing.name.x": ("name at X", "adın X'i"),
    "drawing.name.y": ("name at Y", "adın Y'si"),
    "drawing.name.side": ("side", "yan"),
    "drawing.names": ("Places of the names: which side of a point is free", "Adların yeri: noktanın hangi yanı boş"),
    "drawing.quantities": ("Angles and displacements", "Açılar ve ötelenmeler"),
    "drawing.inner.unit": ("rad", "rad"),
    "drawing.direction": ("direction", "doğrultu"),
    "drawing.guides": ("Sliding joints", "Kayar mafsallar"),
    "drawing.markers": ("Marked in the charts", "Grafiklerde işaretlenenler"),
    "drawing.shapes": ("Shapes", "Şekiller"),
    "drawing.rail": ("guide of {symbol}", "{symbol} kızağı"),
    "drawing.slot": ("slot of {symbol}", "{symbol} kanalı"),
    "drawing.block": ("block of {symbol}", "{symbol} bloğu"),
    "drawing.support": ("support {point}", "{point} mesnedi"),
    "drawing.nothing": ("not possible with these dimensions", "bu boyutlarla olmuyor"),
    "drawing.caption": ("Caption", "Yazı"),
    "drawing.alt": ("{title}: drawing at the position shown", "{title}: gösterilen konumdaki çizim"),
    "source": ("Source: {source}", "Kaynak: {source}"),
    "footer": ("&L{title}&C&A, &P / &N&R{made}", "&L{title}&C&A, &P / &N&R{made}"),
    "made": ("made with mechsheet", "mechsheet ile hazırlanmıştır"),
}  # fmt: skip


def words(language: Language, key: str, **parts: object) -> str:
    """The text of a key in a language, its {parts} filled in."""
    text = WORDS[key][1 if language == "tr" else 0]
    return text.format(**parts) if parts else text
