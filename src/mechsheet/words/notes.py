"""The words of the sheet of notes, in both languages: whole sentences, where the other sheets have labels."""

from __future__ import annotations

NOTES: dict[str, tuple[str, str]] = {
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
        "First value and step of the driver {driver} may be changed. There are {rows} rows; for more, insert them above the "
        "last one, in every sheet with a row for each position (the hidden {checks}, too), and fill the row above down over "
        "them and the last one.",
        "{driver} tahrikinin ilk değeri ve adımı değiştirilebilir. {rows} satır vardır; daha çoğu için her konuma bir satır "
        "ayıran bütün sayfalarda (gizli {checks} sayfasında da) son satırın üstüne satır ekleyin, üstteki satırı bunların "
        "ve son satırın üzerine doldurun.",
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
    "notes.use.summaries": (
        "A sheet {table} shows a number of the whole sweep for many values of two dimensions, which may be changed at its "
        "edges. Its helpers are folded away right of the chart.",
        "{table} sayfası, iki boyutun çeşitli değerleri için bütün çevrimin bir sayısını gösterir; kenarlarındaki "
        "değerler değiştirilebilir. Yardımcı hücreler grafiğin sağında katlıdır.",
    ),
    "notes.use.checks": (
        "The sheet {checks} measures every row anew by geometry, and counts the cells of the table that hold no formula any "
        "more. The line under the title of {mechanism} is red when something is wrong, and says where.",
        "{checks} sayfası her satırı geometrik olarak yeniden ölçer ve tabloda artık formül olmayan hücreleri sayar. "
        "Bir sorun varsa {mechanism} sayfasında başlığın altındaki satır kırmızıdır ve yerini söyler.",
    ),
    "notes.use.grashof": (
        "Grashof: shortest + longest link − the other two of a four-bar. Below 0 the shortest can turn fully, at 0 all four "
        "can lie in one line (change point), above 0 none can turn fully.",
        "Grashof: dört çubuğun en kısa + en uzun uzvu − öteki ikisi. 0'dan küçükse en kısa uzuv tam dönebilir, 0 ise dört "
        "uzuv bir doğru üzerine gelebilir, 0'dan büyükse hiçbiri tam dönemez.",
    ),
    "notes.use.extremes": (
        "The sheet {extremes} computes further positions between the rows: there lie the limits and the "
        "smallest and largest values that the first sheet names.",
        "{extremes} sayfası satırların arasındaki konumları hesaplar: ilk sayfadaki sınırlar, en küçük ve en büyük değerler "
        "oradadır.",
    ),
    "notes.use.hidden": (
        "{hidden} are hidden: they hold the proof and what the drawing is made of. To see them, click a sheet's tab with "
        "the right button and choose Unhide (in Calc: Show Sheet).",
        "{hidden} gizlidir: kanıtı ve çizimin verilerini taşırlar. Görmek için bir sayfa sekmesine sağ tıklayıp Göster'i "
        "(Calc'ta: Sayfayı Göster) seçin.",
    ),
    "notes.use.delete": (
        "This sheet {notes} and the sheets of two-way tables may be deleted: nothing reads them. The others read one "
        "another; without one of them cells show #REF!, or charts are empty.",
        "Bu {notes} sayfası ve iki yönlü tablo sayfaları silinebilir: onları okuyan yoktur. Ötekiler birbirini okur; biri "
        "silinirse hücreler #REF! gösterir ya da grafikler boş kalır.",
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
    "notes.assumptions.cosines": (
        "Angles of a triangle come from the law of cosines, as written here. In the cells it is an arctan2, whose "
        "second leg is four times the area: where the links lie in a line, rounding may ask the arccosine for a "
        "cosine of 1.0000000000000002, an error, and in a thin triangle it loses digits.",
        "Üçgenin açıları, burada yazıldığı gibi kosinüs teoremindendir. Hücrelerde arctan2 vardır, "
        "ikinci kenarı alanın dört katıdır: uzuvlar bir doğru üzerindeyken yuvarlama 1,0000000000000002 gibi bir "
        "kosinüs verebilir, arkkosinüs orada hatadır; ince bir üçgende de basamak yitirir.",
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
    "notes.head.formula": ("The cell's formula (in English)", "Hücrenin formülü (İngilizce adlarla)"),
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
        "ok, or which links cannot be joined",
        "tamam, ya da hangi uzuvların birleşmediği",
    ),
    "notes.above": ("row above", "üst satır"),
    "notes.missing": ("#N/A", "#YOK"),
    "notes.otherwise": ("otherwise", "değilse"),
    "notes.or": ("or", "veya"),
    "notes.and": ("and", "ve"),
    "notes.round": ("round", "yuvarla"),
    "notes.is_number": ("is a number", "bir sayı"),
}  # fmt: skip
