"""The words of audits, exercises and marks, in both languages."""

from __future__ import annotations

HOMEWORK: dict[str, tuple[str, str]] = {
    # verdicts
    "right": ("right", "doğru"),
    "in part": ("right, but not in all the rows asked for", "doğru, ama istenen satırların tümünde değil"),
    "follows": ("right but for an earlier fault", "önceki hata dışında doğru"),
    "wrong": ("wrong", "yanlış"),
    "other assembly": ("of the other assembly", "öteki montaja ait"),
    "not live": ("right, but does not follow the dimensions", "doğru, ama boyutlara bağlı değil"),
    "unclear": (
        "one of several columns without its name: nothing says that it is meant",
        "adı yazılmamış birkaç sütundan biri: hangisinin kastedildiği belli değil",
    ),
    "missing": ("missing", "yok"),
    # kinds of faults
    "term too many": ("a term too many", "fazladan bir terim"),
    "term missing": ("a term is missing", "bir terim eksik"),
    "sign": ("the other sign", "işaret ters"),
    "sign of a square": ("-x^2 is (-x)^2 in a cell", "hücrede -x^2, (-x)^2 demektir"),
    "factor too many": ("a factor too many", "fazladan bir çarpan"),
    "factor missing": ("a factor is missing", "bir çarpan eksik"),
    "operator": ("another operator", "işlem yanlış"),
    "brackets": ("brackets", "ayraçlar"),
    "exponent": ("an exponent", "üs"),
    "square root": ("a square root", "karekök"),
    "reference": ("another cell is meant", "başka bir hücre gerekli"),
    "range": ("another range of cells is meant", "başka bir hücre aralığı gerekli"),
    "anchor": ("the anchor $", "$ ile sabitleme"),
    "radians and degrees": ("radians and degrees", "radyan ve derece"),
    "function": ("another function is meant", "başka bir fonksiyon gerekli"),
    "order of arguments": ("arguments in the other order", "bağımsız değişkenlerin sırası ters"),
    "order of a difference": ("a difference the other way round", "çıkarma ters yönde"),
    "order of a quotient": ("a quotient upside down", "bölme ters"),
    "quadrant": ("ATAN loses the quadrant", "ATAN çeyreği kaybeder"),
    "other root": ("the other root or another zero of the angle", "açının öteki kökü veya başka bir başlangıcı"),
    "value of pi": ("the value of pi", "pi değeri"),
    "typed number": ("a typed number", "elle yazılmış bir sayı"),
    "breaks its column": ("not the formula of its column", "sütununun formülü değil"),
    "wrong number": ("a wrong number", "yanlış bir sayı"),
    "no number": ("no number", "sayı yok"),
    "typed over": ("a number typed over the formula of its column", "sütunun formülünün yerine yazılmış sayı"),
    "two changes": ("two faults in one formula", "bir formülde iki hata"),
    "no single change mends it": ("no single change corrects it", "tek bir değişiklik düzeltmiyor"),
    "other dimension": ("not the student's own dimension", "öğrencinin kendi boyutu değil"),
    # the terminal
    "fault": ("{cells}  {formula}: {kind}", "{cells}  {formula}: {kind}"),
    "mend.wanted": ("{mend} is wanted", "olması gereken {mend}"),
    "mend": ("{mend} makes {rights} right", "{mend} ile {rights} doğru olur"),
    "marks": ("{marks} of {of} marks", "{of} üzerinden {marks} puan"),
    "marks.of_one": ("{marks} of {of} mark", "{of} üzerinden {marks} puan"),
    "marks.plain": ("{plain} without follow-through", "hata takibi olmadan {plain}"),
    "remark": ("remark: {text}", "not: {text}"),
    # what a workbook seems to be
    "recognised": ("{file}: {title} (template {template})", "{file}: {title} (şablon {template})"),
    "unrecognised": (
        "{file}: no linkage of the templates fits its numbers; there are",
        "{file}: şablonlardaki hiçbir mekanizma sayılarına uymuyor; bulunanlar",
    ),
    "driver": ("driver", "tahrik"),
    "otherwise": ("from another zero, or in the other sense", "başka bir başlangıçtan ya da ters yönde"),
    "taken as zero": ("taken as 0, no cell has it: {symbols}", "hücresi yok, 0 alındı: {symbols}"),
    "not there": (
        "not in the workbook; in the description in proportion: {symbols}",
        "çalışma kitabında yok; tanımda orantılı alınır: {symbols}",
    ),
    "unexplained": ("nothing that is known: {cells}", "ne olduğu bilinmeyen: {cells}"),
    # remarks
    "remark.comma": (
        "{count} numbers were typed as texts with a decimal comma; they are read as numbers",
        "{count} sayı ondalık virgüllü metin olarak yazılmış; sayı olarak okundu",
    ),
    "remark.comma.one": (
        "1 number was typed as a text with a decimal comma; it is read as a number",
        "1 sayı ondalık virgüllü metin olarak yazılmış; sayı olarak okundu",
    ),
    "remark.large": (
        "a large workbook: only its first 200,000 formulas were looked at",
        "büyük bir çalışma kitabı: yalnız ilk 200.000 formülüne bakıldı",
    ),
    "remark.clockwise": ("{symbol} is counted clockwise", "{symbol} saat yönünde ölçülmüş"),
    "remark.backwards": ("{symbol} is counted in the other direction", "{symbol} ters yönde ölçülmüş"),
    "remark.zero": ("{symbol} is counted from {offset:.4g}°", "{symbol} {offset:.4g}° doğrultusundan ölçülmüş"),
    "remark.unit": (
        "{symbol} is written in another unit of length: times {factor:g}",
        "{symbol} başka bir uzunluk biriminde yazılmış: {factor:g} ile çarpılınca",
    ),
    "remark.unit.number": (
        "{symbol} is written in another unit: times {factor:.6g}",
        "{symbol} başka bir birimde yazılmış: {factor:.6g} ile çarpılınca",
    ),
    "remark.sign": ("typed with the other sign: {symbols}", "ters işaretle yazılmış: {symbols}"),
    "remark.own": (
        "the sheet's own dimensions hold: {given}",
        "sayfanın kendi boyutları geçerlidir: {given}",
    ),
    "remark.absent": (
        "no cell was found for {symbols}: the description's values are taken",
        "{symbols} için hücre bulunamadı: tanımdaki değerler alındı",
    ),
    "remark.dead": ("{symbol} does not follow {dimensions}", "{symbol}, {dimensions} değişince değişmiyor"),
    "remark.typed": ("{symbol} is typed as numbers", "{symbol} sayı olarak yazılmış"),
    "remark.zero.driver": (
        "the driver is counted clockwise or from another zero",
        "tahrik açısı saat yönünde veya başka bir doğrultudan ölçülmüş",
    ),
    "remark.law.driver": (
        "the driver's values are computed from another column, of times for example",
        "tahrik değerleri başka bir sütundan, örneğin zamandan hesaplanmış",
    ),
    "remark.part": (
        "{symbols}: the table answers {answered} of the {asked} rows asked for; the marks are in proportion",
        "{symbols}: tablo istenen {asked} satırın {answered} tanesini yanıtlıyor; puan bu orandadır",
    ),
    "remark.instead": (
        "the column headed {symbol} is {other}, and the other way round",
        "{symbol} başlıklı sütun {other} büyüklüğüdür; başlıkları yer değiştirmiş",
    ),
    "remark.rows": ("{symbol} is right in {right} of {rows} rows", "{symbol} {rows} satırın {right} tanesinde doğru"),
    "remark.suspect": (
        "{symbol} in {cell}: {found:.6g} found, {wanted:.6g} wanted",
        "{symbol}, {cell} hücresinde: bulunan {found:.6g}, olması gereken {wanted:.6g}",
    ),
    "remark.suspect.none": (
        "{symbol} in {cell}: no number found, {wanted:.6g} wanted",
        "{symbol}, {cell} hücresinde: sayı yok, olması gereken {wanted:.6g}",
    ),
    "remark.again": ("{term} stands in {cell} as well", "{term} {cell} hücresinde de var"),
    "remark.first": (
        "first formula that is nothing of the mechanism though all that it reads is: {cell}",
        "okuduğu her şey mekanizmaya ait olduğu halde kendisi olmayan ilk formül: {cell}",
    ),
    # the sheet that a student is given
    "task.sheet": ("Task", "Ödev"),
    "task.student": ("Student", "Öğrenci"),
    "task.hint": (
        "Yellow cells are your dimensions. Fill in the empty columns with formulas that read them.",
        "Sarı hücreler sizin boyutlarınızdır. Boş sütunları bunları okuyan formüllerle doldurun.",
    ),
    "task.figure": ("Figure", "Şekil"),
    "task.scale": ("The figure has other dimensions than yours.", "Şeklin boyutları sizinkilerden farklıdır."),
    "task.given": ("Given", "Verilenler"),
    "task.derived": ("What follows from it", "Bunlardan çıkanlar"),
    "task.links": ("Links and their points", "Uzuvlar ve noktaları"),
    "task.joints": ("Joints", "Mafsallar"),
    "task.driver": ("Driver and assembly", "Tahrik ve montaj"),
    "task.asked": ("Asked", "İstenenler"),
    "task.assembly": ("assembly", "montaj"),
    "task.pins": (
        "Links that have a point of the same name are pinned together there.",
        "Aynı adlı noktası olan uzuvlar orada mafsalla bağlıdır.",
    ),
    "task.axes": ("x to the right, y upwards in the figure", "şekilde x sağa, y yukarı"),
    "task.driven": ("driven:", "tahrik edilen:"),
    "task.against": ("against", "şuna göre:"),
    "task.direction": ("direction {along}", "{along} doğrultusu"),
    "task.way": ("direction in which {symbol} grows", "{symbol} uzaklığının büyüdüğü yön"),
    "task.loads": ("What acts", "Etkiyenler"),
    "task.gravity": ("gravity", "yerçekimi"),
    "task.torque": ("torque", "moment"),
    "task.force": ("force", "kuvvet"),
    "task.on": ("on {link}", "({link} üzerine)"),
    "task.at": ("at", "yeri:"),
    "task.axis": ("its first part in the", "birinci bileşeni:"),
    "task.spring": ("spring {between}", "{between} yayı"),
    "task.stiffness": ("stiffness", "direngenlik"),
    "task.free": ("free length", "serbest boy"),
    "task.damping": ("damping", "sönüm"),
    "task.related": ("as the relation above has it", "yukarıdaki bağıntıya göre"),
    "task.less": ("less", "eksi"),
    "task.and": ("and", "artı"),
    "task.along": ("along {line}", "{line} boyunca"),
    "task.left": ("to the left of {line}", "{line} solunda"),
    "task.turned": ("counter-clockwise from {line} by", "{line} doğrultusundan saat yönünün tersine"),
    "task.way_of_line": ("in the direction", "doğrultusu"),
    "task.from": ("from", "başlangıcı"),
    "task.from_point": ("from {start}:", "{start} noktasından:"),
    "task.slide": (
        "{symbol} is the distance of {point} from there, positive that way",
        "{symbol}, {point} noktasının oradan uzaklığıdır, bu yönde artı",
    ),
    "task.angles": (
        "Directions are counted counter-clockwise from x. Formulas take angles in radians.",
        "Doğrultular x yönünden saat yönünün tersine ölçülür. Formüllerde açılar radyandır.",
    ),
    # marks
    "marks.class": ("Class", "Sınıf"),
    "marks.faults": ("Faults", "Hatalar"),
    "marks.id": ("id", "no"),
    "marks.name": ("name", "ad"),
    "marks.file": ("file", "dosya"),
    "marks.count": ("faults", "hata sayısı"),
    "marks.total": ("total (of {of})", "toplam ({of} üzerinden)"),
    "marks.overrule": ("overruled", "elle verilen"),
    "marks.mark": ("mark", "not"),
    "marks.words": ("remarks", "açıklama"),
    "marks.kind": ("kind of fault", "hata türü"),
    "marks.often": ("how often", "kaç kez"),
    "marks.student": ("student", "öğrenci"),
    "marks.cells": ("cells", "hücreler"),
    "marks.formula": ("formula", "formül"),
    "marks.mend": ("correction", "düzeltme"),
    "marks.hint": (
        "A number in the yellow column replaces the total. Amber: not right as it stands. Red: no marks.",
        "Sarı sütuna yazılan sayı toplamın yerine geçer. Turuncu: bu haliyle doğru değil. Kırmızı: puan yok.",
    ),
    "marks.nothing": ("no workbook was handed in", "dosya verilmedi"),
    "marks.unreadable": ("cannot be judged: {why}", "değerlendirilemedi: {why}"),
    "marks.unknown": ("belongs to nobody in the list", "listedeki kimseye ait değil"),
    "marks.twice": ("more than one workbook; this one was taken", "birden çok dosya var; bu alındı"),
    "marks.others": ("the dimensions are those of {who}", "boyutlar {who} öğrencisinin"),
    "page.asked": ("Quantity", "Büyüklük"),
    "page.cells": ("Cells", "Hücreler"),
    "page.verdict": ("Verdict", "Sonuç"),
    "page.marks": ("Marks", "Puan"),
    # what cannot be judged
    "no table": (
        "no table was found: a column of at least three numbers with others, or formulas, beside it",
        "tablo bulunamadı: yanında başka sayılar ya da formüller olan en az üç sayılık bir sütun yok",
    ),
    "no position": (
        "with the numbers of this sheet the mechanism has no position",
        "bu sayfadaki sayılarla mekanizmanın hiçbir konumu yok",
    ),
}  # fmt: skip


def marks_of(language: str, marks: float, of: float) -> str:
    """How many marks of how many: of one, or of several."""
    return said(language, "marks.of_one" if of == 1 else "marks", marks=f"{marks:g}", of=f"{of:g}")


def said(language: str, key: str, **parts: object) -> str:
    """The text of a key in a language, its {parts} filled in."""
    text = HOMEWORK[key][1 if language == "tr" else 0]
    return text.format(**parts) if parts else text
