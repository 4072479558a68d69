"""Of what is said of a workbook and of files: the check, what is missing on this machine, what cannot be written."""

from __future__ import annotations

CHECKS: dict[str, str] = {
    "{file}: all agree": "{file}: hepsi uyuşuyor",
    "{file}: NOTHING WAS COMPARED": "{file}: HİÇBİR ŞEY KARŞILAŞTIRILMADI",
    "{file}: all compared agree; {but}": "{file}: karşılaştırılanların hepsi uyuşuyor; {but}",
    "{file}: all values agree, BUT IT SAYS ITSELF THAT SOMETHING IS WRONG": (
        "{file}: bütün değerler uyuşuyor, AMA BİR ŞEYİN YANLIŞ OLDUĞUNU KENDİSİ SÖYLÜYOR"
    ),
    "  {judge:<14} nothing was compared": "  {judge:<14} hiçbir şey karşılaştırılmadı",
    "  the line under its title says: {line}": "  başlığının altındaki satır: {line}",
    "no value is stored": "kayıtlı değer yok",
    "nothing was compared: {judge}": "hiçbir şey karşılaştırılmadı: {judge}",
    "{count} cell was not computed": "{count} hücre hesaplanmadı",
    "{count} cells were not computed": "{count} hücre hesaplanmadı",
    "mechsheet itself failed on this file, please report it: {kind}: {error}": (
        "mechsheet'in kendisi bu dosyada yanıldı, lütfen bildirin: {kind}: {error}"
    ),
    "it carries no description": "içinde tanımı yok",
    "{file}: EDITED, NOTHING WAS COMPARED": "{file}: DEĞİŞTİRİLMİŞ, HİÇBİR ŞEY KARŞILAŞTIRILMADI",
    "{file}: EDITED, all compared agree; {but}": "{file}: DEĞİŞTİRİLMİŞ, karşılaştırılanlar uyuşuyor; {but}",
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
    "no `inertia` of {links}, with a mass that turns: 0 was taken": (
        "{links} için `inertia` verilmemiş, kütlesi dönüyor: 0 alındı"
    ),
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
    'no sheet of this workbook is called "{title}"': 'bu çalışma kitabının "{title}" adlı sayfası yok',
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
    # the stored values, and what is remarked of formulas
    "{count} formula": "{count} formül",
    "{count} formulas": "{count} formül",
    "{count} differs": "{count} farklı",
    "{count} differ": "{count} farklı",
    "{formulas}: {equal} as stored, {differ}": "{formulas}: {equal} kayıtlı değerle aynı, {differ}",
    "  no value is stored: nothing was compared": "  kayıtlı değer yok: hiçbir şey karşılaştırılmadı",
    "  {count} has no stored value": "  {count} formülün kayıtlı değeri yok",
    "  {count} have no stored value": "  {count} formülün kayıtlı değeri yok",
    "  {count} more was not computed: its stored value was taken": (
        "  {count} formül daha hesaplanmadı: kayıtlı değeri alındı"
    ),
    "  {count} more were not computed: their stored values were taken": (
        "  {count} formül daha hesaplanmadı: kayıtlı değerleri alındı"
    ),
    "  {count} more changes by itself (NOW, RAND ...): left out, its stored value was taken": (
        "  {count} formül daha kendiliğinden değişir (NOW, RAND ...): dışarıda bırakıldı, kayıtlı değeri alındı"
    ),
    "  {count} more change by themselves (NOW, RAND ...): left out, their stored values were taken": (
        "  {count} formül daha kendiliğinden değişir (NOW, RAND ...): dışarıda bırakıldı, kayıtlı değerleri alındı"
    ),
    "  {count} more is ignored": "  {count} formül daha sayılmadı",
    "  {count} more are ignored": "  {count} formül daha sayılmadı",
    "  {count} more difference is accepted by the baseline": "  {count} fark daha baseline ile kabul edilmiş",
    "  {count} more differences are accepted by the baseline": "  {count} fark daha baseline ile kabul edilmiş",
    "  {count} more was {why}": "  {count} formül daha {why}",
    "  {count} more were {why}": "  {count} formül daha {why}",
    "saved by LibreOffice without being computed: open the file there, press Ctrl+Shift+F9, save it again": (
        "LibreOffice tarafından hesaplanmadan kaydedilmiş: dosyayı orada açın, Ctrl+Shift+F9'a basın, yeniden kaydedin"
    ),
    "  {count} reads cells that differ themselves; the others, by their functions:": (
        "  {count} tanesi kendileri farklı olan hücreleri okuyor; ötekiler, fonksiyonlarına göre:"
    ),
    "  {count} read cells that differ themselves; the others, by their functions:": (
        "  {count} tanesi kendileri farklı olan hücreleri okuyor; ötekiler, fonksiyonlarına göre:"
    ),
    "  {cells:>7} {kind}{size}  {functions}": "  {cells:>7} {kind}{size}  {functions}",
    " by {size:.1e}": ", fark {size:.1e}",
    "number": "sayı",
    "text": "metin",
    "type": "tür",
    "error": "hata",
    "which error": "hangi hata",
    "references": "başvurular",
    "nothing": "boş",
    "cannot be joined": "birleşemiyor",
    "          computed {ours}, stored {theirs}": "          hesaplanan {ours}, kayıtlı {theirs}",
    "  and {count} group more": "  ve {count} grup daha",
    "  and {count} groups more": "  ve {count} grup daha",
    "and {count} more": "ve {count} tane daha",
    "{places} and {count} more": "{places} ve {count} tane daha",
    "    {places}": "    {places}",
    "  {line}": "  {line}",
    "{line}": "{line}",
    "{where}: {line}": "{where}: {line}",
    "{message} ({hint})": "{message} ({hint})",
    # who was asked, and what they say
    "stored values": "kayıtlı değer",
    "reference": "referans",
    "search": "arama",
    "                 {subject} {ours}, {judge} {theirs}": "                 {subject} {ours}, {judge} {theirs}",
    'the sheet "{title}" is missing: not compared: {judge}': '"{title}" sayfası yok: karşılaştırılmadı: {judge}',
    "no description inside: only recalculated, not compared with the reference": (
        "içinde tanım yok: yalnız yeniden hesaplandı, referansla karşılaştırılmadı"
    ),
    "with these dimensions and modes no row exists: there is no position to compare, only that none is shown": (
        "bu boyutlar ve montajla hiçbir satır yok: karşılaştırılacak konum da yok, yalnız gösterilmediğine bakıldı"
    ),
    "the reference cannot be asked: compared is only that no number is shown of what depends on them": (
        "referansa sorulamıyor: yalnız bunlara bağlı hiçbir sayının gösterilmediğine bakıldı"
    ),
    "{symbol} has no value with these dimensions: {why}": "bu boyutlarla {symbol} değersiz: {why}",
    "{name} has no value": "{name} değersiz",
    "{mode} is {now:+d}; the description's sketch means {meant:+d}": (
        "{mode} şimdi {now:+d}; tanımdaki eskiz {meant:+d} diyor"
    ),
    "{name} does not carry the same description: not compared": "{name} aynı tanımı taşımıyor: karşılaştırılmadı",
    "{program} was not asked: it cannot read names that begin with a letter beyond ASCII ({names})": (
        "{program} programına sorulmadı: ASCII dışı bir harfle başlayan adları okuyamaz ({names})"
    ),
    "{program} was not asked: it does not know ranges like INDEX(…):INDEX(…); with the layout page it can be": (
        "{program} programına sorulmadı: INDEX(…):INDEX(…) gibi aralıkları bilmez; page düzeninde sorulabilir"
    ),
    # what somebody has changed
    "  edited: {where} {what}{note}": "  değiştirilmiş: {where} {what}{note}",
    "          was {was}": "          önce {was}",
    "          is  {now}": "          şimdi {now}",
    "  edited: {count} more place (all with --json)": "  değiştirilmiş: {count} yer daha (hepsi --json ile)",
    "  edited: {count} more places (all with --json)": "  değiştirilmiş: {count} yer daha (hepsi --json ile)",
    "has another formula": "başka bir formül taşıyor",
    "has a formula of its own": "sütunundan ayrı bir formül taşıyor",
    "was overwritten": "üzerine yazılmış",
    "was emptied": "boşaltılmış",
    "holds a formula in place of a number": "sayı yerine formül içeriyor",
    "holds another number": "başka bir sayı içeriyor",
    "is a name that was changed": "adının yeri değiştirilmiş",
    "is a sheet that is not as it was": "sayfası eskisi gibi değil",
    "was deleted": "silinmiş",
    "was inserted": "araya eklenmiş",
    "empty": "boş",
    "missing": "yok",
    " (filled over {area})": " ({area} boyunca doldurulmuş)",
    " inside a filled range": ", doldurulmuş bir aralığın içine",
    'the sheet "{title}" is your own': '"{title}" sayfası sizin',
    'the sheet "{title}" is called "{now}" now': '"{title}" sayfasının adı şimdi "{now}"',
    "{sheet}: {places} inserted": "{sheet}: {places} eklenmiş",
    "{sheet} {places}": "{sheet} {places}",
    "column {first}": "{first} sütunu",
    "columns {first} to {last}": "{first} ile {last} arası sütunlar",
    "row {first}": "{first}. satır",
    "rows {first} to {last}": "{first}-{last} satırları",
    "{sheet}: texts changed in {cells}": "{sheet}: şu hücrelerde metin değişmiş: {cells}",
    "{sheet}: cells of your own in {cells}": "{sheet}: sizin hücreleriniz: {cells}",
    "{symbol} is {now}, was {was}": "{symbol} şimdi {now}, önce {was} idi",
    "{symbol} is {now}, was not given": "{symbol} şimdi {now}, önce verilmemişti",
    "{differing} of {formulas} formulas differ: was it built by another version of mechsheet?": (
        "{formulas} formülden {differing} tanesi farklı: mechsheet'in başka bir sürümüyle mi kuruldu?"
    ),
    "{file}: STALE, all values agree": "{file}: ESKİ, bütün değerler uyuşuyor",
    "  stale: {what}": "  eski: {what}",
    "{file} says {key} = {now}, the workbook was built with {was}: build it anew, or use mechsheet pull": (
        "{file} dosyasında {key} = {now}, çalışma kitabı ise {was} ile kuruldu: yeniden kurun ya da mechsheet pull kullanın"
    ),
    # what is pulled
    "{name}: {was} -> {now}": "{name}: {was} -> {now}",
    "not given": "verilmemiş",
    "taken away": "kaldırıldı",
    "tolerance of {symbol}": "{symbol} toleransı",
    "driver value {index}": "tahrikin {index}. değeri",
    "value {index} of driver {order}": "{order}. tahrikin {index}. değeri",
    "{key} of driver {order}": "{order}. tahrikin {key} değeri",
    "{key} of joint {order}": "{order}. mafsalın {key} değeri",
    "{key} of the driver": "tahrikin {key} değeri",
    "{key} {index} of the driver": "tahrikin {index}. {key} değeri",
    "{key} {index} of table {table}": "{table}. tablonun {index}. {key} değeri",
    "{symbol}, taken out of the synthesis": "{symbol}, sentezden çıkarıldı",
    "the task's {named}": "görevdeki {named}",
    "{key} of {link}{axis}": "{link}: {key}{axis}",
    "{key} of load {number}{axis}": "{number}. yükün {key} değeri{axis}",
}
