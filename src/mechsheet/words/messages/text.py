"""Of the text itself: typing mistakes, keys and what may stand in them, names, expressions."""

from __future__ import annotations

TEXT: dict[str, str] = {
    # what joins other texts
    "": "",
    "{first} and {last}": "{first} ve {last}",
    "{first} or {last}": "{first} ya da {last}",
    "{first}, or {last}": "{first}, ya da {last}",
    "{what}: {names}": "{what}: {names}",
    "{what}: none": "{what}: yok",
    "{near} {all}": "{near} {all}",
    "{where}{message}": "{where}{message}",
    "in {text}: ": "{text} içinde: ",
    "in {text}: {message}": "{text} içinde: {message}",
    "{why}": "{why}",
    'did you mean "{name}"? {case}': '"{name}" mi demek istediniz? {case}',
    'did you mean "{name}"?': '"{name}" mi demek istediniz?',
    # the file
    "there is no such file": "böyle bir dosya yok",
    "there is {file}: Notepad has added .txt; rename it": "{file} var: .txt ekini Not Defteri koymuş; adını değiştirin",
    "this is a directory; name a description, a .toml file": (
        "bu bir klasör; bir tanımın, yani bir .toml dosyasının adını verin"
    ),
    "cannot be read: {reason}": "okunamıyor: {reason}",
    "larger than {most:,} bytes: this is no description": "{most:,} bayttan büyük: bu bir tanım değil",
    "larger than {most:,} characters: this is no description": "{most:,} harften uzun: bu bir tanım değil",
    'saved as UTF-16 (some editors call it "Unicode")': 'UTF-16 olarak kaydedilmiş (bazı düzenleyicilerde "Unicode")',
    'save the file with the encoding "UTF-8"': 'dosyayı "UTF-8" kodlamasıyla kaydedin',
    "a workbook carries its description inside; name the .toml file here": (
        "çalışma kitabı tanımını içinde taşır; burada .toml dosyasının adını verin"
    ),
    "a binary file, not a description (TOML text)": "metin olmayan bir dosya; tanım TOML metnidir",
    "not UTF-8 text: byte {byte:#04x} fits nowhere": "UTF-8 metni değil: {byte:#04x} baytı hiçbir harf olamaz",
    "the description is empty": "tanım boş",
    'begin with "mechsheet new"': '"mechsheet new" ile başlayın',
    "not Unicode text": "Unicode metni değil",
    "lists or tables stand too deep inside one another": "listeler ya da tablolar çok derin iç içe",
    "a number has too many digits": "bir sayının çok fazla basamağı var",
    # TOML
    "broken TOML: {reason}{column}": "bozuk TOML: {reason}{column}",
    " (column {column})": " (sütun {column})",
    "the line ends inside a text": "satır bir metnin içinde bitiyor",
    "the line goes on behind its value": "satır değerinden sonra sürüyor",
    "a line is a [heading] or key = value": "bir satır ya [başlık] ya da anahtar = değer olur",
    "this key is there already": "bu anahtar zaten var",
    "the heading [{heading}] is there already": "[{heading}] başlığı zaten var",
    "a quotation mark is missing": "bir tırnak işareti eksik",
    "texts and expressions stand in quotes": "metinler ve ifadeler tırnak içinde yazılır",
    'the list is not closed: write "]"': 'liste kapanmamış: "]" yazın',
    'the heading is not closed: write "]"': 'başlık kapanmamış: "]" yazın',
    # typing mistakes
    "a blank that is no ordinary one stands here: U+{code:04X}": "burada olağan olmayan bir boşluk var: U+{code:04X}",
    "it comes from a web page or a word processor; type a space in its place": (
        "bir web sayfasından ya da kelime işlemciden gelmiş; yerine boşluk tuşuna basın"
    ),
    "this table in braces does not end on its line": "ayraçlar içindeki bu tablo kendi satırında bitmiyor",
    "{ … } stands on one line, commas between its keys": "{ … } tek satırda yazılır, anahtarları virgülle ayrılır",
    "a key and its value are joined by =, not by :": "anahtar ile değeri arasına : değil = konur",
    'write "=" in its place': 'yerine "=" yazın',
    "what stands in brackets is separated by commas, not by ;": "köşeli ayraçtakiler ; ile değil virgülle ayrılır",
    'write "," in its place': 'yerine "," yazın',
    "quotation marks of a word processor ({signs}) around {content}": (
        "{content} çevresinde kelime işlemcinin tırnakları ({signs}) var"
    ),
    'write {new}, with the " of the keyboard': 'klavyedeki " ile {new} yazın',
    "write {new}": "{new} yazın",
    "write {new} = …": "{new} = … yazın",
    "the text that begins here is not closed": "burada başlayan metin kapanmamış",
    "in {heading} a name needs quotes: {why}": "{heading} içinde bir adın tırnağa gereği var: {why}",
    "this key needs quotes: {why}": "bu anahtarın tırnağa gereği var: {why}",
    "without them only a-z, A-Z, 0-9, _ and - are allowed, found {shown}": (
        "tırnaksız yalnız a-z, A-Z, 0-9, _ ve - olur, bulunan: {shown}"
    ),
    "a blank": "boşluk",
    "the heading {heading} is not closed": "{heading} başlığı kapanmamış",
    "what begins here with {sign} is not closed": "burada {sign} ile başlayan kapanmamış",
    'write "{end}" at its end': 'sonuna "{end}" yazın',
    "a comment begins with #, not with //": "yorum // ile değil # ile başlar",
    'write "#" in its place': 'yerine "#" yazın',
    "a list stands in square brackets, not in round ones": "liste yuvarlak değil köşeli ayraç içinde yazılır",
    "write {{ formula = {new} }}": "{{ formula = {new} }} yazın",
    "texts and expressions stand in quotes, found {text}": (
        "metinler ve ifadeler tırnak içinde yazılır, bulunan: {text}"
    ),
    "found {text}: {why}": "bulunan {text}: {why}",
    "not the way in which TOML writes numbers": "TOML sayıları böyle yazmaz",
    "the decimal sign is a point": "ondalık işareti noktadır",
    "the decimal sign is a point: write [{items}]": "ondalık işareti noktadır: [{items}] yazın",
    "{sign} (U+{code:04X}) is not the minus sign of a keyboard": "{sign} (U+{code:04X}) klavyedeki eksi işareti değil",
    "the unit {unit} stands behind the number": "sayının arkasında {unit} birimi duruyor",
    "units that are known: {units}": "bilinen birimler: {units}",
    "{text} is neither a number nor an expression": "{text} ne bir sayı ne de bir ifade",
    "{text} has a unit where a plain number is needed": "{text} birimli, burada birimsiz bir sayı gerekir",
    "{text} where {unit} are needed": "{text} verilmiş, burada {unit} gerekir",
    "a number in {unit} is written with its unit behind it": "{unit} birimindeki bir sayı birimiyle birlikte yazılır",
    "the value says its unit already": "değer birimini kendisi söylüyor",
    "{hint}, without quotes": "{hint}, tırnaksız",
    "expected a number, found {text}": "sayı beklenir, bulunan: {text}",
    "a plain number in {whose} own unit, or an expression": "kendi biriminde bir sayı ya da bir ifade",
    "has no value: {names} have none": "değeri yok, çünkü şunların değeri yok: {names}",
    "has no value: {name} has none": "değeri yok, çünkü {name} değersiz",
    # what may stand where
    "expected {shape}, found {value}": "{shape} beklenir, bulunan: {value}",
    "write {key} = {value} in the first line": "ilk satıra {key} = {value} yazın",
    "expected a finite number, found {value}": "sonlu bir sayı beklenir, bulunan: {value}",
    "expected a number from {least:g} on, found {value}": (
        "{least:g} ya da daha büyük bir sayı beklenir, bulunan: {value}"
    ),
    "{value} is out of range: sizes from {smallest:g} to {largest:g} are allowed": (
        "{value} sınırların dışında: {smallest:g} ile {largest:g} arasındaki büyüklükler olur"
    ),
    "a number": "bir sayı",
    "true or false": "true ya da false",
    "a number or an expression in quotes": "bir sayı ya da tırnak içinde bir ifade",
    "a text in quotes": "tırnak içinde bir metin",
    'a text in quotes or { en = "…", tr = "…" }': 'tırnak içinde bir metin ya da { en = "…", tr = "…" }',
    "tables with a heading in double brackets": "başlığı çift köşeli ayraçlı tablolar",
    "a list": "bir liste",
    "a table": "bir tablo",
    "a list of {count}": "{count} ögeli bir liste",
    "an empty list": "boş bir liste",
    "a huge number": "çok büyük bir sayı",
    "a date or time": "bir tarih ya da saat",
    "the text {text}": "{text} metni",
    "the whole number {least}": "{least} tam sayısı",
    "a whole number from {least} to {most}": "{least} ile {most} arasında bir tam sayı",
    "at least one item": "en az bir öge",
    "at most {most:,} items": "en çok {most:,} öge",
    "expected exactly {least} {what}, found {found}": "tam {least} {what} beklenir, bulunan: {found}",
    "expected exactly {least} {what}s, found {found}": "tam {least} {what} beklenir, bulunan: {found}",
    "expected at least {least} {what}, found {found}": "en az {least} {what} beklenir, bulunan: {found}",
    "expected at least {least} {what}s, found {found}": "en az {least} {what} beklenir, bulunan: {found}",
    "expected at most {most} {what}s, found {found}": "en çok {most} {what} beklenir, bulunan: {found}",
    "{count}: {names}": "{count}: {names}",
    "write [[{key}]] instead of [{key}]": "[{key}] yerine [[{key}]] yazın",
    'a derived dimension is written { formula = "…" }': 'türetilen boyut { formula = "…" } diye yazılır',
    'write { formula = "…" }': '{ formula = "…" } yazın',
    "write one heading for each {what}: [{key}.name]": "her {what} için bir başlık yazın: [{key}.ad]",
    'write "{plain}"': '"{plain}" yazın',
    "{value} is not supported yet: it is reserved for a later version": (
        "{value} henüz desteklenmiyor: sonraki bir sürüm için ayrılmıştır"
    ),
    '"{key}" is not supported yet: {why}': '"{key}" henüz desteklenmiyor: {why}',
    "it is reserved for a later version": "sonraki bir sürüm için ayrılmıştır",
    "joints are taken to be free of it": "mafsallar sürtünmesiz sayılır",
    'a load against the motion may stand for it: [[loads]] with torque = "-0.2*omega14"': (
        'yerine harekete karşı bir yük konabilir: [[loads]] altında torque = "-0.2*omega14"'
    ),
    "unknown key": "bilinmeyen anahtar",
    "unknown language": "bilinmeyen dil",
    "is missing: {note}": "eksik: {note}",
    "{keys} is missing": "{keys} eksik",
    "{keys} is missing: give {choice}": "{keys} eksik: {choice} verin",
    "{keys} are missing: give {choice}": "{keys} eksik: {choice} verin",
    "is not complete: give {choice}": "tam değil: {choice} verin",
    "{both} exclude each other: give {choice}": "{both} bir arada olmaz: {choice} verin",
    "one text in quotes serves both languages": "tırnak içinde tek bir metin iki dile de yeter",
    "the text is empty": "metin boş",
    "the text has {count} characters; at most {longest} are allowed": (
        "metin {count} harfli; en çok {longest} harf olur"
    ),
    "a tab": "sekme",
    "a character that a workbook cannot carry": "çalışma kitabının taşıyamadığı bir işaret",
    "the text holds {name}: U+{code:04X}": "metinde {name} var: U+{code:04X}",
    # names
    "{name} must begin with a letter, a digit or _ and go on with letters, digits, - and _": (
        "{name} bir harf, rakam ya da _ ile başlamalı, harf, rakam, - ve _ ile sürmelidir"
    ),
    "it becomes the stem of file names": "dosya adları ondan yapılır",
    "{name} cannot be the stem of a file: Windows keeps that name for a device": (
        "{name} dosya adı olamaz: Windows bu adı bir aygıta ayırır"
    ),
    "unknown layout {layout}": "bilinmeyen düzen: {layout}",
    "unknown language {language}": "bilinmeyen dil: {language}",
    'languages: "en", "tr"': 'diller: "en", "tr"',
    'layouts: "sheets", "page"': 'düzenler: "sheets", "page"',
    "format {given} is not known: this program reads format {format}": (
        "{given} biçimi bilinmiyor: bu program {format} biçimini okur"
    ),
    "the name {name} must begin with a letter and go on with letters, digits, - and _": (
        "{name} adı bir harfle başlamalı, harf, rakam, - ve _ ile sürmelidir"
    ),
    "{message} (at most {most})": "{message} (en çok {most} harf)",
    "the name {name} is taken by the {what}{line}": "{name} adını zaten şu taşıyor: {what}{line}",
    "the name {name} differs too little from {other}, the {what}{line}": (
        "{name} adı {other} adına çok benziyor; o, şunun adı: {what}{line}"
    ),
    " (line {line})": " (satır {line})",
    "names must differ by more than case and the dots of i and ı": (
        "adlar büyük-küçük harften ve i ile ı noktasından fazlasıyla ayrılmalıdır"
    ),
    "the name {name} {reason}": "{name} adı {reason}",
    "the cell name {name} {reason}": "{name} hücre adı {reason}",
    "must begin with a letter and go on with letters, digits and _": (
        "bir harfle başlamalı, harf, rakam ve _ ile sürmelidir"
    ),
    "is longer than 60 characters": "60 harften uzun",
    "means something else in expressions": "ifadelerde başka bir anlama gelir",
    "rename it": "adını değiştirin",
    "rename one of them": "birinin adını değiştirin",
    "rename it: the {what} has a cell of that name": "adını değiştirin: bu adı taşıyan bir hücre var ({what})",
    "rename it: this {what} has a cell of that name": "adını değiştirin: bu adı taşıyan bir hücre var ({what})",
    "{what} {names} depend on one another in a circle": "{what} {names} birbirine bağlı, bir çember oluşturuyor",
    "{name} depends on itself": "{name} kendisine bağlı",
    # expressions
    "the expression has more than {most} operators below one another": "ifadede {most} katmandan fazla işlem iç içe",
    "has no value: {error}": "değeri yok: {error}",
    "with {used}": "şunlarla: {used}",
    "expressions compute in radians: leave degrees() out": "ifadeler radyanla hesaplar: degrees() yazmayın",
    "{text} is {kind} where {needed} is needed": "{text}: {needed} gereken yerde {kind}",
    "an angle": "açı",
    "a length": "uzunluk",
    "a number of degrees": "derece sayısı",
    "{name} is not a dimension": "{name} bir boyut değil",
    "{name} is an output; only dimensions are allowed here": "{name} bir çıktı; burada yalnız boyutlar olur",
    "{name} differs from row to row; only dimensions are allowed here": (
        "{name} satırdan satıra değişir; burada yalnız boyutlar olur"
    ),
    "unknown unit {unit}": "bilinmeyen birim: {unit}",
    "{unit} cannot be the unit of lengths": "{unit} uzunluk birimi olamaz",
    "{message} at column {column}": "{message} (sütun {column})",
    "expected {expected}, found {found}": "{expected} beklenir, bulunan: {found}",
    '"{text}"': '"{text}"',
    "the end": "metnin sonu",
    "an operator or the end": "bir işlem işareti ya da metnin sonu",
    'an operator or ")"': 'bir işlem işareti ya da ")"',
    'a number, a name, a function or "("': 'bir sayı, bir ad, bir fonksiyon ya da "("',
    '"(" after the function {text}': '{text} fonksiyonundan sonra "("',
    "expected a formula, found nothing": "bir formül beklenir, hiçbir şey yok",
    "nested deeper than {most} levels": "{most} katmandan derin iç içe",
    "{text} is too large a number": "{text} çok büyük bir sayı",
    'unexpected character "{character}"': 'beklenmeyen işaret "{character}"',
    "a text without its closing quotation mark": "kapanış tırnağı olmayan bir metin",
    'angles are in radians here; write "radians(30)" for 30 degrees': (
        'burada açılar radyandır; 30 derece için "radians(30)" yazın'
    ),
    'multiply with "*"': 'çarpma işareti "*"',
    'divide with "/"': 'bölme işareti "/"',
    'write the minus sign "-"': 'eksi işareti olarak "-" yazın',
    'write "sqrt(...)"': '"sqrt(...)" yazın',
    "use round parentheses": "yuvarlak ayraç kullanın",
    'write "^" for a power': 'kuvvet için "^" yazın',
    'the decimal sign is "."; "," stands between arguments only': 'ondalık işareti "."; "," yalnız argümanları ayırır',
    'a product is written with "*"': 'çarpım "*" ile yazılır',
    'pi is a number: write it without parentheses, "2*pi"': 'pi bir sayıdır, ayraçsız yazılır: "2*pi"',
    "functions: {names}": "fonksiyonlar: {names}",
    "unknown function {text} at column {column}": "bilinmeyen fonksiyon {text} (sütun {column})",
    "{text} takes {takes}, found {count}, at column {column}": "{text} {takes} alır, {count} bulundu (sütun {column})",
    "1 argument": "1 argüman",
    "{least} arguments": "{least} argüman",
    "at least 1 argument": "en az 1 argüman",
    "there is none": "değer yok",
    "the result is not a finite number": "sonuç sonlu bir sayı değil",
    "division by zero": "sıfıra bölme",
    "zero to the power of {exponent:g} is a division by zero": "sıfırın {exponent:g}. kuvveti sıfıra bölmedir",
    "zero to the power of zero is not defined": "sıfırın sıfırıncı kuvveti tanımlı değil",
    "{base:g} to the power of {exponent:g} is not a real number": "{base:g} üssü {exponent:g} gerçek bir sayı değil",
    "{base:g} to the power of {exponent:g} is too large": "{base:g} üssü {exponent:g} çok büyük",
    "the square root of {x:g} is not a real number": "{x:g} sayısının karekökü gerçek bir sayı değil",
    "the logarithm of {x:g} is not a real number": "{x:g} sayısının logaritması gerçek bir sayı değil",
    "the direction of the point (0, 0) is not defined": "(0, 0) noktasının doğrultusu tanımlı değil",
    "exp({x:g}) is too large": "exp({x:g}) çok büyük",
    "the {function} of {x:g} does not exist: it must lie between -1 and 1": (
        "{x:g} için {function} yoktur: sayı -1 ile 1 arasında olmalıdır"
    ),
    "arc sine": "ark sinüs",
    "arc cosine": "ark kosinüs",
}
