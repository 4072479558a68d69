"""Of arguments, files and changes: values that are typed, workbooks that are built, pulled, exported and drawn."""

from __future__ import annotations

LIBRARY: dict[str, str] = {
    "nothing is called {name}": "{name} adlı bir şey yok",
    "names": "adlar",
    # values and names
    "a {kind} is no value of one cell: {value}": "{kind} türü bir hücrenin değeri olamaz: {value}",
    "one number, for example 66.5": "bir sayı, örneğin 66.5",
    "write {number}": "{number} yazın",
    "write {number:g}, without quotes": "tırnaksız {number:g} yazın",
    "expected a number, found {value}": "bir sayı beklenir, bulunan: {value}",
    "expected a number, found {value!r:.60}": "bir sayı beklenir, bulunan: {value!r:.60}",
    "expected a finite number, found {value!s:.60}": "sonlu bir sayı beklenir, bulunan: {value!s:.60}",
    "expected a whole number, found {found:g}": "bir tam sayı beklenir, bulunan: {found:g}",
    "{number} is no number that a cell can hold": "{number} bir hücrenin tutabileceği bir sayı değil",
    "{names}: computed as the textbook's functions, as this file gives no other definition": (
        "{names}: bu dosya başka bir tanım vermediğinden ders kitabının fonksiyonları olarak hesaplandı"
    ),
    "expected a mapping of values": "adlarıyla değerler beklenir",
    '{"a1": 65}: the dimension, and its value in its own unit': '{"a1": 65}: boyut ve kendi birimindeki değeri',
    'no sheet is called "{name}"': '"{name}" adlı sayfa yok',
    "sheets: {titles}": "sayfalar: {titles}",
    '"{cells}" is no range of cells': '"{cells}" bir hücre aralığı değil',
    "for example Sheet1!A1:C9": "örneğin Sheet1!A1:C9",
    'the name "{text}" stands for no cells of one sheet': '"{text}" adı tek bir sayfanın hücrelerini göstermiyor',
    'the name "{text}" leads to no sheet': '"{text}" adı hiçbir sayfaya götürmüyor',
    '"{text}" is no range, name or sheet': '"{text}" ne aralık ne ad ne sayfa',
    "{name!r} is no name of a cell": "{name!r} bir hücre adı değil",
    "{where!r} is no name of a cell": "{where!r} bir hücre adı değil",
    'a text: "a1", "Sheet!B2"': 'bir metin: "a1", "Sheet!B2"',
    'a text: "a1", "Sheet!B2", "Sheet!B2:D9"': 'bir metin: "a1", "Sheet!B2", "Sheet!B2:D9"',
    '"{name}" is no cell of this workbook': '"{name}" bu çalışma kitabının bir hücresi değil',
    'no cell is named "{name}"': '"{name}" adlı hücre yok',
    "names: {names}": "adlar: {names}",
    "no sheet of this workbook": "bu çalışma kitabında böyle bir sayfa yok",
    "computed by a formula: set what it is computed from": "bir formülle hesaplanır: hesaplandığı değeri verin",
    # dimensions, modes and the task that are typed
    "no dimension is called {name}": "{name} adlı boyut yok",
    "the dimension {name} is derived from others": "{name} boyutu başkalarından türetilmiş",
    "change the dimensions in its formula instead; {inputs}": "formülündeki boyutları değiştirin; {inputs}",
    "the dimension {name} is found by the synthesis": "{name} boyutunu sentez bulur",
    "change its task instead: {names}": "görevini değiştirin: {names}",
    "expected true, found {value}": "true beklenir, bulunan: {value}",
    "expected a list of numbers, found {value}": "sayılardan bir liste beklenir, bulunan: {value}",
    "expected a number, found the list {value}": "bir sayı beklenir, bulunan liste: {value}",
    "for example --set psi=[60,80,105], or --set psi.2=80 for one of them": (
        "örneğin --set psi=[60,80,105], biri için --set psi.2=80"
    ),
    "an assembly mode is 1 or -1, not {value}": "montaj biçimi 1 ya da -1'dir, {value} değil",
    "{name} is the number of one of 1 assembly, not {value}": "{name} için tek montaj var, numarası 1; {value} değil",
    "{name} is the number of one of {count} assemblies, not {value}": (
        "{name}, {count} montajdan birinin numarasıdır, {value} değil"
    ),
    "the assembly mode {name} is found by the synthesis": "{name} montaj biçimini sentez bulur",
    "change its task instead, or take it out of [assembly]": "görevini değiştirin ya da onu [assembly] içinden çıkarın",
    "no group of links has the assembly mode {name}": "{name} montaj biçimi hiçbir uzuv grubunun değil",
    "no sketch says {left}": "hiçbir eskiz bunu söylemez: {left}",
    "the assemblies of {group} are one: no sketch tells them apart": (
        "{group} için bütün montajlar aynı: hiçbir eskiz onları ayıramaz"
    ),
    "no template is called {name}": "{name} adlı şablon yok",
    # what is built and written
    "no format is named": "hiçbir dosya biçimi verilmemiş",
    "formats: {formats}": "dosya biçimleri: {formats}",
    'no {what} is called "{unknown}"': '"{unknown}" adlı {what} yok',
    "format": "dosya biçimi",
    "kind of functions": "fonksiyon türü",
    "known: {names}": "bilinenler: {names}",
    "one file, and its ending says .{ending}: it cannot be {given}": (
        "tek dosya, uzantısı da .{ending} diyor: {given} olamaz"
    ),
    'a workbook ends with .xlsx or .ods, not with "{suffix}"': (
        'çalışma kitabının uzantısı .xlsx ya da .ods olur, "{suffix}" değil'
    ),
    "a folder of that name: {name}/": "o adda bir klasör: {name}/",
    "takes one workbook": "tek bir çalışma kitabı alır",
    "is not as build wrote it (somebody has saved changes, or it is another file): left as it is": (
        "build komutunun yazdığı gibi değil (biri değiştirip kaydetmiş ya da başka bir dosya): olduğu gibi bırakıldı"
    ),
    "keep its changes with mechsheet pull, choose another name with -o, or overwrite it with --force": (
        "değişiklikleri mechsheet pull ile alın, -o ile başka ad verin ya da --force ile üzerine yazın"
    ),
    "cannot be replaced: {reason}": "yerine yazılamıyor: {reason}",
    "cannot be read: {reason}": "okunamıyor: {reason}",
    # exports and pictures
    'no kind of export is called "{name}"': '"{name}" adlı dışa aktarma türü yok',
    "kinds: {kinds}": "türler: {kinds}",
    "for example {name}{suffix}": "örneğin {name}{suffix}",
    "the file's name is a name in its language too: letters, digits and _ ({kind})": (
        "dosyanın adı o dilde de bir addır: harf, rakam ve _ ({kind})"
    ),
    "{name} holds the whole sweep": "{name} bütün hareketi içerir",
    "kinds that take it: {others}": "bunu alan türler: {others}",
    "one position or several: at and frames exclude each other": (
        "ya bir konum ya birkaç konum: at ile frames birlikte verilmez"
    ),
    "{frames} frames: from 1 to {most} can be written": "{frames} kare: 1 ile {most} arası yazılabilir",
    "{frames} frames: the sweep has 1 position to draw": "{frames} kare: harekette çizilecek 1 konum var",
    "{frames} frames: the sweep has {count} positions to draw": "{frames} kare: harekette çizilecek {count} konum var",
    "no position of the sweep exists": "hareketin hiçbir konumu yok",
    '"{name}" is called by the file itself: a function of that name would stand in its way': (
        '"{name}" dosyanın kendi içinde çağrılır: o adda bir fonksiyon buna engel olur'
    ),
    "for example {name}_mechanism.m": "örneğin {name}_mechanism.m",
    '"{name}" is a module or a word of Python: nobody could import this one': (
        '"{name}" Python\'un bir modülü ya da sözcüğü: bu dosya import edilemez'
    ),
    "for example {name}_mechanism.py": "örneğin {name}_mechanism.py",
    "{what} take dimensions, and those of this mechanism are found by a synthesis": (
        "{what} boyut alır, bu mekanizmanınkileri ise sentez bulur"
    ),
    "functions in Basic": "Basic fonksiyonları",
    "constructions for GeoGebra": "GeoGebra çizimleri",
    "workbooks with functions": "fonksiyonlu çalışma kitapları",
    "give the dimensions as numbers (`show --dimensions` prints them); other exports have the synthesis": (
        "boyutları sayı olarak verin (`show --dimensions` yazar); öteki dışa aktarmalarda sentez vardır"
    ),
    "functions of {count} arguments (dimensions, driver, configurations): VBA takes {most}": (
        "{count} bağımsız değişkenli fonksiyonlar (boyutlar, tahrik, montajlar): VBA en çok {most} alır"
    ),
    "write dimensions that never change as plain numbers": "hiç değişmeyen boyutları düz sayı olarak yazın",
    "the ending of the name says how to draw": "nasıl çizileceğini adın uzantısı söyler",
    "endings: {endings}; or a folder: {name}/": "uzantılar: {endings}; ya da bir klasör: {name}/",
    "{at:g} lies outside of the sweep, which is what a .{kind} shows": (
        "{at:g}, .{kind} dosyasının gösterdiği hareketin dışında"
    ),
    "draw a .svg or .png, or widen the sweep": "bir .svg ya da .png çizin ya da hareketi genişletin",
    "no position at {symbol} = {at:g}{unit}: {why}": "{symbol} = {at:g}{unit} için konum yok: {why}",
    "the sweep has positions at {symbol} = {ranges}": "hareketin konumları: {symbol} = {ranges}",
    'unknown language "{language}"': 'bilinmeyen dil "{language}"',
    'languages: "en", "tr"': 'diller: "en", "tr"',
    "there are no velocities of points and no forces to draw": "çizilecek nokta hızı da kuvvet de yok",
    "give the driver a speed, or the links masses or loads": "tahrike hız ya da uzuvlara kütle ya da yük verin",
    'say whose: points = ["{point}"] in [rates]': 'hangilerinin olduğunu söyleyin: [rates] altında points = ["{point}"]',
    "the layout page cannot hold the {steps} steps of a synthesis of kind {kind}": (
        "{kind} türündeki sentezin {steps} adımı page düzenine sığmaz"
    ),
    'layout = "sheets" has a sheet for them': 'layout = "sheets" düzeninde onların bir sayfası vardır',
    "bands are not found where links must be solved all at once: {group}": (
        "uzuvların hep birden çözüldüğü yerde tolerans bantları bulunmaz: {group}"
    ),
    "leave [tolerance] out; positions are found": "[tolerance] kısmını yazmayın; konumlar bulunur",
    'no dimension with a tolerance changes "{name}"': 'toleransı olan hiçbir boyut "{name}" değerini değiştirmez',
    "give another dimension a tolerance, or leave it out of `of`": (
        "başka bir boyuta tolerans verin ya da onu `of` listesinden çıkarın"
    ),
    # lists of a class
    "is a file: a folder is written": "bir dosya: yazılacak olan bir klasördür",
    "is no text in UTF-8": "UTF-8 metni değil",
    "save it as CSV UTF-8": "CSV UTF-8 olarak kaydedin",
    'no column is called "id"': '"id" adlı sütun yok',
    "a line without an id": "numarası (id) olmayan bir satır",
    "the same id as line {line}": "{line}. satırla aynı numara (id)",
    "an id too much like {other} of line {line}": "{line}. satırdaki {other} ile karışacak bir numara (id)",
    "nobody is in this list": "bu listede kimse yok",
    "no workbook is named": "hiçbir çalışma kitabı verilmemiş",
    "no workbook ({suffixes}) in this folder": "bu klasörde çalışma kitabı ({suffixes}) yok",
    "is not the key that mechsheet exercise writes": "mechsheet exercise komutunun yazdığı anahtar değil",
}
