"""Of formulas and what they compute: what cannot be parsed, is not known, or cannot be computed; names of cells."""

from __future__ import annotations

FORMULAS: dict[str, str] = {
    # what cannot be parsed
    "{text} is outside the sheet,": "{text} sayfanın dışında",
    "{text} is not a reference of a sheet,": "{text} bir sayfa başvurusu değil",
    "{text} is not a structured reference,": "{text} bir tablo başvurusu değil",
    'a constant beside ":", where references stand, before': '":" yanında başvuru yerine bir sabit',
    "the rows of an array differ in length": "dizinin satırları eşit uzunlukta değil",
    "a constant of an array": "bir dizi sabiti",
    "a reference or a name": "bir başvuru ya da ad",
    'a value, a reference, a function or "("': 'bir değer, bir başvuru, bir fonksiyon ya da "("',
    'a separator or "}"': 'bir ayırıcı ya da "}"',
    "a formula nested deeper than {most} levels cannot be written": "{most} katmandan derin iç içe bir formül yazılamaz",
    # names
    "has {count} characters; {most} are allowed": "{count} karakter; en çok {most} olur",
    "has combining marks: write accented letters as single characters": (
        "birleşen işaretler içeriyor: aksanlı harfleri tek karakter olarak yazın"
    ),
    "must begin with a letter or _ and go on with letters, digits, _ or .": (
        "bir harf ya da _ ile başlamalı, harf, rakam, _ ya da . ile sürmelidir"
    ),
    "looks like the address of a cell": "bir hücre adresine benziyor",
    "looks like an address in R1C1 form, in some language": "bir dilde R1C1 biçiminde bir adrese benziyor",
    "is a single letter, and letters stand for a row or a column in some language's Excel: R and C, Z and S, ...": (
        "tek harf; bir dilin Excel'inde tek harf satır ya da sütun demektir: R ile C, Z ile S, ..."
    ),
    "is reserved by spreadsheet programs": "tablo programlarına ayrılmış",
    "is the name of a function": "bir fonksiyonun adı",
    # what is not known
    "unknown name {name}": "bilinmeyen ad {name}",
    "unknown function {name}": "bilinmeyen fonksiyon {name}",
    "an unknown function": "bilinmeyen bir fonksiyon",
    "{name} needs scipy, which is not installed": "{name} için scipy gerekir, kurulu değil",
    "{name} is defined in this file's {macros}": "{name} bu dosyanın {macros} kodunda tanımlı",
    "the name {name} stands for itself: {circle}": "{name} adı kendisini gösteriyor: {circle}",
    "names that stand for one another, more than {most} deep": "birbirini gösteren adlar, {most} katmandan derin",
    "{text} takes {takes}, found {count}": "{text} {takes} alır, {count} bulundu",
    "at least {least} arguments": "en az {least} argüman",
    "{least} to {most} arguments": "{least} ile {most} arası argüman",
    "a reference to another workbook": "başka bir çalışma kitabına başvuru",
    "{message}: it is not computed again and again here, stored values are kept": (
        "{message}: burada tekrar tekrar hesaplanmaz, kayıtlı değerler korunur"
    ),
    '"{text}" is no regular expression, as which this workbook takes it': (
        '"{text}" bir düzenli ifade değil, bu çalışma kitabı ise onu öyle alır'
    ),
    "{message}: the stored value is kept": "{message}: kayıtlı değer korunur",
    "{why}, {text}: stored values are kept": "{why}, {text}: kayıtlı değerler korunur",
    "{name} gives another value at every recalculation": "{name} her yeniden hesaplamada başka bir değer verir",
    # what cannot be computed
    "{message} (and more cells)": "{message} (ve başka hücreler)",
    "circular reference: {circle}": "döngüsel başvuru: {circle}",
    "circular reference: {circle} (and more of them)": "döngüsel başvuru: {circle} (başkaları da var)",
    "dynamic arrays whose sizes do not settle": "boyu bir türlü yerine oturmayan dinamik diziler",
    "a cell that is filled twice": "iki kez doldurulan bir hücre",
    "a formula nested too deeply": "çok derin iç içe bir formül",
    "an array where a single value is wanted": "tek değer istenen yerde bir dizi",
    "an array of {height} x {width} cells is not computed": "{height} x {width} hücrelik bir dizi hesaplanmaz",
    "not computed: it takes more than {most} steps": "hesaplanmadı: {most} adımdan fazlası gerekiyor",
    "not computed: functions took more than {most} steps in this workbook": (
        "hesaplanmadı: bu çalışma kitabında fonksiyonlar {most} adımdan fazlasını aldı"
    ),
    "texts of more than {most} characters are not computed": "{most} karakterden uzun metinler hesaplanmaz",
    "not finished after {seconds:g} seconds": "{seconds:g} saniyede bitmedi",
    "--seconds gives it more time": "--seconds ile daha çok süre verilir",
    "a regular expression that could take very long": "çok uzun sürebilecek bir düzenli ifade",
    'CELL("{what}") is not supported': 'CELL("{what}") desteklenmez',
    'CELL("{what}") without a reference is not supported': 'başvurusuz CELL("{what}") desteklenmez',
    'INFO("{what}") is not supported': 'INFO("{what}") desteklenmez',
    "FORMULATEXT of a formula that cannot be written: {problem}": "yazılamayan bir formülün FORMULATEXT'i: {problem}",
    "not computed, by a fault of this program: {kind}: {problem}": (
        "hesaplanmadı, bu programın hatası: {kind}: {problem}"
    ),
    # of the reference, which reads descriptions in its own way
    "{node} is no expression of a description": "{node} bir tanımda geçebilecek bir ifade değil",
    '"{name}" is not defined': '"{name}" tanımlı değil',
    '"{asked}" needs "{symbol}", which is no dimension': '"{asked}" için "{symbol}" gerekir, o ise bir boyut değil',
    '"{unknown}" is no dimension; {near_miss}': '"{unknown}" bir boyut değil; {near_miss}',
    "dimensions in a circle: {names}": "birbirine dönen boyutlar: {names}",
    'points of "{name}" in a circle: {names}': '"{name}" uzvunda birbirine dönen noktalar: {names}',
    "the driver does not get from {start:g} to {stop:g} in steps of {step:g}": (
        "tahrik {step:g} adımlarla {start:g} değerinden {stop:g} değerine varmaz"
    ),
    'the sketch names "{point}", which is no point': 'eskizde adı geçen "{point}" bir nokta değil',
    'the sketch names "{symbol}", which is no variable': 'eskizde adı geçen "{symbol}" bir değişken değil',
    'the start names "{name}", which is no link': 'başlangıçta adı geçen "{name}" bir uzuv değil',
    "{unknown} unknown coordinates of links and {conditions} conditions from joints and drivers: "
    "the mobility is not the number of drivers": (
        "uzuvların {unknown} bilinmeyen koordinatı, mafsallarla tahriklerin {conditions} koşulu var: "
        "serbestlik derecesi tahrik sayısına eşit değil"
    ),
    "joints and driver hold some links more than once and leave others loose": (
        "mafsallar ve tahrik kimi uzuvları birden çok kez tutuyor, ötekileri boşta bırakıyor"
    ),
}
