"""Of what is said of a workbook and of files: the check, what is missing on this machine, what cannot be written."""

from __future__ import annotations

CHECKS: dict[str, str] = {
    "{file}: all agree": "{file}: hepsi uyuşuyor",
    "{file}: EDITED, all values agree": "{file}: DEĞİŞTİRİLMİŞ, bütün değerler uyuşuyor",
    "{file}: EDITED, AND SOMETHING DIFFERS": "{file}: DEĞİŞTİRİLMİŞ VE BİR ŞEY FARKLI",
    "{file}: SOMETHING DIFFERS": "{file}: BİR ŞEY FARKLI",
    "value": "değerde",
    "values": "değerde",
    "  {judge:<14} agrees  {worst:6.0e} in {cells:>6} {values:<6}  {where}": (
        "  {judge:<14} uyuşuyor  {worst:6.0e}, {cells:>6} {values:<6}  {where}"
    ),
    "  {judge:<14} DIFFERS {worst:6.0e} in {cells:>6} {values:<6}  {where}": (
        "  {judge:<14} FARKLI    {worst:6.0e}, {cells:>6} {values:<6}  {where}"
    ),
    "  note: {remark}": "  not: {remark}",
    "  note: {message}: skipped": "  not: {message}: atlandı",
    "the step misses the stop ({stop}): the last row is {last}": "adım bitişe ({stop}) denk gelmiyor: son satır {last}",
    "undetermined at {place}: {links}": "{place} konumunda belirsiz: {links}",
    "undetermined in {count} positions, the first at {place}: {links}": (
        "{count} konumda belirsiz, ilki {place}: {links}"
    ),
    "the sketch says nothing about group {group}: mode +1 was taken, {mode}; a point under [assembly] decides": (
        "eskiz {group}. grup için bir şey söylemiyor: +1 alındı, {mode}; [assembly] altında bir nokta karar verir"
    ),
    "{package} is not installed": "{package} kurulu değil",
    "{package} is not installed: {use}": "{package} kurulu değil: {use}",
    "it draws the pictures": "resimleri o çizer",
    "cannot be written: {reason}": "yazılamıyor: {reason}",
    "is not the name of a file in this folder": "bu klasörde bir dosyanın adı olamaz",
    "for example mine.toml": "örneğin benim.toml",
    "there is no such baseline": "böyle bir karşılaştırma dosyası (baseline) yok",
    "write one with --update-baseline": "--update-baseline ile bir tane yazın",
    "no entry of a baseline: file, cell, computed, stored, with tabs between them": (
        "baseline satırı değil: dosya, hücre, hesaplanan, kayıtlı; aralarında sekme"
    ),
    'the sheet "{title}" is missing': '"{title}" sayfası yok',
    'the sheet "{lost}" of the mechanism\'s workbook is missing': 'mekanizmanın çalışma kitabındaki "{lost}" sayfası yok',
    "holds a formula now; only numbers can be taken over": "şimdi bir formül içeriyor; yalnız sayılar alınabilir",
    "must hold a number, not {what}": "bir sayı içermelidir, {what} değil",
    "an empty cell": "boş hücre",
    "{symbol} must be a number, not {what}": "{symbol} bir sayı olmalıdır, {what} değil",
    "{message}, not {value}": "{message}; bulunan: {value}",
    "{symbol} of the task must be greater than 0": "görevdeki {symbol} 0'dan büyük olmalıdır",
    "{symbol} is the distance of two joints and must be greater than 0": (
        "{symbol} iki mafsalın uzaklığıdır ve 0'dan büyük olmalıdır"
    ),
    "{symbol} is the time of the motion and must be greater than 0": (
        "{symbol} hareketin süresidir ve 0'dan büyük olmalıdır"
    ),
    "{symbol} must be 1 or -1": "{symbol} 1 ya da -1 olmalıdır",
    "{symbol} must be 1 to {count}": "{symbol} 1 ile {count} arasında olmalıdır",
    "the driver's values are not all numbers": "tahrikin değerlerinin hepsi sayı değil",
    "the values of {symbol} are not all numbers": "{symbol} değerlerinin hepsi sayı değil",
    "carries no description: it was not built by mechsheet, or its sheet is gone": (
        "içinde tanım yok: mechsheet kurmamış ya da sayfası silinmiş"
    ),
    'describes "{name}"; {shown} was built from "{other}"': (
        '"{name}" mekanizmasını tanımlıyor; {shown} ise "{other}" için kurulmuş'
    ),
    "a length of the same name may mean another one there; enter the changes by hand": (
        "aynı adlı uzunluk orada başka bir şey olabilir; değişiklikleri elle girin"
    ),
    'has no link "{name}" with the points {points}, as {shown} has': (
        '{shown} dosyasındaki gibi {points} noktaları olan "{name}" uzvu yok'
    ),
    'has no joint of "{link}" on "{on}" at {point}, as {shown} has': (
        '{shown} dosyasındaki gibi {point} noktasında "{link}" ile "{on}" arasında mafsal yok'
    ),
    "the workbook has changed {name}; here that is no input, or something else": (
        "çalışma kitabında {name} değişmiş; burada o bir giriş değil ya da başka bir şey"
    ),
    "is {held} here and {now} in {shown}; it was {was} when that was built": (
        "burada {held}, {shown} içinde {now}; o kurulurken {was} idi"
    ),
    "make the two agree first": "önce ikisini uyuşturun",
    'no program is called "{program}"': '"{program}" adlı program yok',
    "programs: {programs}": "programlar: {programs}",
    "programs are named by texts: {programs}": "programlar metinle adlandırılır: {programs}",
    "{program} reads .xlsx only": "{program} yalnız .xlsx okur",
    "libreoffice and gnumeric read both formats": "libreoffice ve gnumeric iki biçimi de okur",
    "LibreOffice could not open it": "LibreOffice açamadı",
    "ONLYOFFICE could not open it": "ONLYOFFICE açamadı",
    "ONLYOFFICE's document-builder is not installed": "ONLYOFFICE document-builder kurulu değil",
    "{command} (100 MB, AGPL, runs as a program of its own)": "{command} (100 MB, AGPL, ayrı bir program olarak çalışır)",
    "{name} did not answer within {timeout} s": "{name} {timeout} s içinde yanıt vermedi",
    "{name} failed: {reason}": "{name} başarısız oldu: {reason}",
    "{value} cannot be the largest difference: expected a number from 0 on": (
        "{value} en büyük fark olamaz: 0 ya da daha büyük bir sayı beklenir"
    ),
}
