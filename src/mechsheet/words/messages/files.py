"""Of files: workbooks that cannot be read or written, what the system says of them."""

from __future__ import annotations

FILES: dict[str, str] = {
    # what the system says (diagnostics.system_reason)
    "No such file or directory": "böyle bir dosya ya da klasör yok",
    "Permission denied": "izin yok",
    "Is a directory": "bu bir klasör",
    "Not a directory": "bir klasör değil",
    "File name too long": "dosya adı çok uzun",
    "Input/output error": "giriş/çıkış hatası",
    "No space left on device": "diskte yer kalmadı",
    "Broken pipe": "okuyan taraf kapandı",
    "Bad file descriptor": "açık bir dosya değil",
    # why nothing can be written there
    "the disk is full": "disk dolu",
    "the disk quota is used up": "disk kotası dolmuş",
    "no permission to write here (or the file is open in another program)": (
        "buraya yazma izni yok (ya da dosya başka bir programda açık)"
    ),
    "the disk is read-only": "disk salt okunur",
    "there is no such folder": "böyle bir klasör yok",
    "this is a folder": "bu bir klasör",
    "this is a file, not a folder": "bu bir dosya, klasör değil",
    "the file name is too long": "dosya adı çok uzun",
    "the link leads round to itself": "simgesel bağlantı dönüp kendisini gösteriyor",
    "a null character in the name": "adın içinde boş (NUL) karakter var",
    'no format is called "{suffix}"': '"{suffix}" adlı dosya biçimi yok',
    "a recalculated {suffix} is written as {suffix}": "yeniden hesaplanan bir {suffix} yine {suffix} olarak yazılır",
    "only values are changed, not the format": "yalnız değerler değişir, dosya biçimi değişmez",
    "an .xls is read, not written": ".xls okunur, yazılmaz",
    "save it as .xlsx first, then recalculate that": "önce .xlsx olarak kaydedin, sonra onu yeniden hesaplatın",
    # what a workbook cannot hold
    'the sheet name "{title}" {reason}': '"{title}" sayfa adı {reason}',
    'the name of a function "{name}" {reason}': '"{name}" fonksiyon adı {reason}',
    'the cell name "{name}" {reason}': '"{name}" hücre adı {reason}',
    "is empty": "boş",
    "is longer than {most} characters": "{most} karakterden uzun",
    "holds one of {names}": "şunlardan birini içeriyor: {names}",
    "holds a control character": "bir denetim karakteri içeriyor",
    "begins or ends with an apostrophe": "kesme işaretiyle başlıyor ya da bitiyor",
    "is reserved by Excel": "Excel'e ayrılmış",
    "is the name of two sheets (large and small letters are the same)": (
        "iki sayfanın adı (büyük ve küçük harf ayrımı yoktur)"
    ),
    'is the same name as "{other}" to some programs': 'kimi programlar için "{other}" ile aynı ad',
    "stands for a formula of {length} characters, {most} are allowed": (
        "{length} karakterlik bir formülü gösteriyor, en çok {most} karakter olur"
    ),
    'stands on a sheet "{sheet}" that does not exist': 'olmayan bir sayfada duruyor: "{sheet}"',
    "a text of {count} characters, a cell holds {most}": "{count} karakterlik bir metin, bir hücreye {most} sığar",
    "{last_row} rows, a sheet holds {most}": "{last_row} satır, bir sayfaya {most} sığar",
    "{last_col} columns, a sheet holds {most}": "{last_col} sütun, bir sayfaya {most} sığar",
    "a choice may neither be empty nor hold a comma": "bir seçenek ne boş olabilir ne de virgül içerebilir",
    "the choices have more than {most} characters together": "seçenekler toplam {most} karakterden uzun",
    'the chart "{title}" has {count} series, 1 to {most} are allowed': (
        '"{title}" grafiğinde {count} seri var, 1 ile {most} arası olur'
    ),
    'the control "{name}" goes from {low} to {high}, 0 to {most} is allowed': (
        '"{name}" denetimi {low} ile {high} arasında, 0 ile {most} arası olur'
    ),
    "the formula has {length} characters, Excel allows {most}": "formül {length} karakter, Excel {most} karakter alır",
    "the formula holds a text of {longest} characters, Excel allows {most}": (
        "formülün içinde {longest} karakterlik bir metin var, Excel {most} karakter alır"
    ),
    # what a file is in place of a workbook
    "this is a folder, not a workbook": "bu bir klasör, çalışma kitabı değil",
    "this is no zip file": "bu bir zip dosyası değil",
    "the file is empty": "dosya boş",
    "not a workbook: {missing}": "çalışma kitabı değil: {missing}",
    "a table as text (.csv)? save it as .xlsx first": "metin biçiminde bir tablo mu (.csv)? önce .xlsx olarak kaydedin",
    "the workbook is protected by a password": "çalışma kitabı parolayla korunuyor",
    "save it without a password": "parolasız kaydedin",
    "save it as .xlsx without a password": ".xlsx olarak, parolasız kaydedin",
    "save it as .xlsx": ".xlsx olarak kaydedin",
    "save it as .ods": ".ods olarak kaydedin",
    "save the file in LibreOffice": "dosyayı LibreOffice'te kaydedin",
    "an .xls of the old kind": "eski türden bir .xls",
    "rename it to .xls, or save it as .xlsx": "uzantısını .xls yapın ya da .xlsx olarak kaydedin",
    "a flat OpenDocument file (.fods), which is not read": "düz bir OpenDocument dosyası (.fods), okunmaz",
    "an XML spreadsheet of 2003": "2003 yılının XML tablosu",
    "a web page, not a workbook": "bir web sayfası, çalışma kitabı değil",
    "a PDF, not a workbook": "bir PDF, çalışma kitabı değil",
    "a workbook of Excel 95 or older, which is not read": "Excel 95 ya da daha eski bir çalışma kitabı, okunmaz",
    "a zip file with the suffix of an .xls": "uzantısı .xls olan bir zip dosyası",
    "rename it to .xlsx or .ods": "uzantısını .xlsx ya da .ods yapın",
    "a spreadsheet of Apple Numbers (.numbers), which is not read": "bir Apple Numbers tablosu (.numbers), okunmaz",
    "a text document (.docx), not a workbook": "bir metin belgesi (.docx), çalışma kitabı değil",
    "a presentation (.pptx), not a workbook": "bir sunu (.pptx), çalışma kitabı değil",
    "an .xlsb, which is not read": "bir .xlsb, okunmaz",
    "an .xlsx with another file's suffix": "uzantısı başka bir .xlsx",
    "an OpenDocument file (.ods) with another file's suffix": "uzantısı başka bir OpenDocument dosyası (.ods)",
    "an OpenDocument {kind}, not a spreadsheet": "bir OpenDocument dosyası ({kind}), tablo değil",
    "not a spreadsheet but {kind}": "tablo değil: {kind}",
    "not a workbook: the zip file holds no part {content}": "çalışma kitabı değil: zip dosyasında {content} parçası yok",
    "not a workbook: the zip file holds no part xl/workbook.xml": (
        "çalışma kitabı değil: zip dosyasında xl/workbook.xml parçası yok"
    ),
    "not a workbook: no stream in it is called Workbook": "çalışma kitabı değil: içinde Workbook adlı bir akış yok",
    "it does not begin as an .xls does": "bir .xls gibi başlamıyor",
    "it does not begin as a workbook does": "bir çalışma kitabı gibi başlamıyor",
    "larger than {most} MB: this is no .xls": "{most} MB'tan büyük: bu bir .xls değil",
    "{count} parts, at most {most} are read": "{count} parça, en çok {most} parça okunur",
    "{count} sheets, at most {most} are read": "{count} sayfa, en çok {most} sayfa okunur",
    "more than {most} sheets": "{most} sayfadan çok",
    "unpacks to more than {most} GiB": "açılınca {most} GiB'tan büyük",
    "packed more than {most} to 1: this is no workbook": "{most} kattan çok sıkıştırılmış: bu bir çalışma kitabı değil",
    "a value longer than {most} MB: this is no workbook": "{most} MB'tan uzun bir değer: bu bir çalışma kitabı değil",
    "cells repeated more than {most} times: this is no workbook": (
        "{most} kereden çok yinelenen hücreler: bu bir çalışma kitabı değil"
    ),
    "array formulas over more than {most} cells: this is no workbook": (
        "{most} hücreden çoğunu kaplayan dizi formülleri: bu bir çalışma kitabı değil"
    ),
    # what is damaged in it
    "the file is damaged or cut off ({problem})": "dosya bozuk ya da yarım ({problem})",
    "the file is damaged or cut off ({why})": "dosya bozuk ya da yarım ({why})",
    "the file is damaged ({problem})": "dosya bozuk ({problem})",
    "the file is damaged (parts overlap)": "dosya bozuk (parçalar üst üste biniyor)",
    "the file is damaged (cut off)": "dosya bozuk (yarım kalmış)",
    "two parts have this name": "iki parça bu adı taşıyor",
    "the part is missing": "parça yok",
    "the part is encrypted with a password": "parça parolayla şifrelenmiş",
    "the part declares a document type, which no workbook does": (
        "parça bir belge türü bildiriyor; hiçbir çalışma kitabı bunu yapmaz"
    ),
    "the part is no proper XML ({reason})": "parça düzgün XML değil ({reason})",
    "the part is no proper XML (text that is not UTF-8)": "parça düzgün XML değil (UTF-8 olmayan metin)",
    "the part is written in an encoding that is not read ({problem})": (
        "parça okunmayan bir karakter kodlamasıyla yazılmış ({problem})"
    ),
    "the part is written in {encoding}, not in UTF-8": "parça UTF-8 ile değil {encoding} ile yazılmış",
    "the part is no OpenDocument content": "parça bir OpenDocument içeriği değil",
    "the part uses other namespace prefixes than usual: it can be read, but not written": (
        "parça alışılmamış ad alanı önekleri kullanıyor: okunabilir, yazılamaz"
    ),
    "rows or cells out of order: the sheet can be read, but no other cells can be set in it": (
        "satırlar ya da hücreler sırasız: sayfa okunabilir, ama başka hücrelerine değer verilemez"
    ),
    "the workbook has no sheet": "çalışma kitabında sayfa yok",
    "the workbook has no sheet with cells": "çalışma kitabında hücreli bir sayfa yok",
    'two sheets are called "{title}"': 'iki sayfanın adı "{title}"',
    'the sheet "{title}" has no part in the file': '"{title}" sayfasının dosyada parçası yok',
    'the sheets "{owner}" and "{title}" have the same part': '"{owner}" ve "{title}" sayfalarının parçası aynı',
    'the sheet "{title}" is not where the workbook says': '"{title}" sayfası çalışma kitabının söylediği yerde değil',
    "two sheets in the same place": "aynı yerde iki sayfa",
    "its head is cut off": "başı eksik",
    "sectors of no known size": "boyu bilinmeyen sektörler",
    "a sector that is not there": "olmayan bir sektör",
    "a table that is named twice": "iki kez adı geçen bir tablo",
    "its list of tables runs in a circle": "tablo listesi dönüp başına geliyor",
    "a stream that runs in a circle": "dönüp başına gelen bir akış",
    "the stream {name} is shorter than it says": "{name} akışı bildirdiğinden kısa",
    "a record ends in the middle": "bir kayıt ortasında bitiyor",
    "the workbook ends in the middle": "çalışma kitabı ortasında bitiyor",
    "half a letter": "yarım bir harf",
    # cells
    "days are counted from {null_date}, which is not supported": "günler {null_date} tarihinden sayılıyor, desteklenmez",
    "a cell outside the sheet": "sayfanın dışında bir hücre",
    'a cell outside the sheet "{title}"': '"{title}" sayfasının dışında bir hücre',
    '"{place}" is no row of a sheet': '"{place}" bir sayfanın satırı değil',
    '"{place}" is no cell of row {row}': '"{place}", {row}. satırın bir hücresi değil',
    '"{text}" is no number': '"{text}" bir sayı değil',
    '"{text}" is no date': '"{text}" bir tarih değil',
    '"{text}" is no number, date or time': '"{text}" ne sayı ne tarih ne saat',
    '"{text}" is no number of repetitions': '"{text}" bir yineleme sayısı değil',
    "{value} is no number of a cell": "{value} bir hücrenin sayısı olamaz",
    "there is no shared text {text}": "{text} numaralı ortak metin yok",
    "there is no shared text {number}": "{number} numaralı ortak metin yok",
    'there is no type of value called "{kind}"': '"{kind}" adlı değer türü yok',
    "an array formula that leaves the sheet": "sayfadan taşan bir dizi formülü",
    'an array formula that leaves the sheet "{title}"': '"{title}" sayfasından taşan bir dizi formülü',
    "an array formula without a proper area": "alanı düzgün olmayan bir dizi formülü",
    # formulas that keep their values
    "every value is rounded as it is shown (a setting of this workbook): stored values are kept": (
        "her değer gösterildiği gibi yuvarlanır (bu çalışma kitabının bir ayarı): kayıtlı değerler korunur"
    ),
    "switch “precision as displayed” off to have it computed": (
        "hesaplatmak için “görüntülenen duyarlık” ayarını kapatın"
    ),
    "years of two digits count from {year} here; they are taken as from {usual}": (
        "iki basamaklı yıllar burada {year} yılından sayılır; {usual} yılından sayılmış gibi alınırlar"
    ),
    "{message}: stored values are kept": "{message}: kayıtlı değerler korunur",
    "{message} of ={shown}: stored values are kept": "{message}, ={shown}: kayıtlı değerler korunur",
    "a formula of {count} characters, which is not read: stored values are kept": (
        "{count} karakterlik bir formül, okunmaz: kayıtlı değerler korunur"
    ),
    'a formula in the notation "{notation}", which is not read: stored values are kept': (
        '"{notation}" yazımıyla bir formül, okunmaz: kayıtlı değerler korunur'
    ),
    "a shared formula that is not in the file: stored values are kept": (
        "dosyada olmayan ortak bir formül: kayıtlı değerler korunur"
    ),
    "the shared formula {number} has no text: stored values are kept": (
        "{number} numaralı ortak formülün metni yok: kayıtlı değerler korunur"
    ),
    "the what-if table {where} is not computed: stored values are kept": (
        "{where} durum (what-if) tablosu hesaplanmaz: kayıtlı değerler korunur"
    ),
    "the token {token:#04x} of a formula is not known": "formülün {token:#04x} simgesi bilinmiyor",
    "the token {token:#04x} of a formula is not known here": "formülün {token:#04x} simgesi burada bilinmiyor",
    "the function number {number}, which is not known": "bilinmeyen {number} numaralı fonksiyon",
    "nested deeper than {most} levels": "{most} katmandan derin iç içe",
    "the words over a column in place of a reference": "başvuru yerine bir sütunun üstündeki sözler",
    "a constant of an array that is none": "dizi olmayan bir dizi sabiti",
    "a formula that is not complete": "tam olmayan bir formül",
    "a formula that is cut off": "yarım kalmış bir formül",
    "a reference to sheets that are not there": "olmayan sayfalara bir başvuru",
    "a reference to a workbook that is not there": "olmayan bir çalışma kitabına bir başvuru",
    "a name that is not there": "olmayan bir ad",
    "a name that cannot be read": "okunamayan bir ad",
}
