"""Of the mechanism: links, joints, the driver, gears, degrees of freedom, assemblies."""

from __future__ import annotations

MECHANISM: dict[str, str] = {
    # links and points
    "the first link of the file is the ground, and that is {link}": "dosyadaki ilk uzuv sabit uzuvdur; o da {link}",
    "write [links.{name}] before the other links": "[links.{name}] bölümünü öteki uzuvlardan önce yazın",
    "the first link of the file is the ground: write the fixed link first": (
        "dosyadaki ilk uzuv sabit uzuvdur: sabit uzvu en başa yazın"
    ),
    'the point "{point}" occurs once: nothing is joined there': '"{point}" noktası bir kez geçiyor: orada birleşen yok',
    "the first link is the ground; its number is 1": "ilk uzuv sabit uzuvdur; numarası 1'dir",
    "the number {number} is taken by the link {link}": "{number} numarasını {link} uzvu taşıyor",
    "numbers count upwards from the link before, unless `number` is given": (
        "`number` verilmedikçe numaralar önceki uzuvdan başlayarak artar"
    ),
    "points of {link}": "{link} uzvunun noktaları",
    "the link {link} has no point {point}": "{link} uzvunda {point} noktası yok",
    "a distance is negative: {ra:.6g} and {rb:.6g}": "uzaklıklardan biri eksi: {ra:.6g} ve {rb:.6g}",
    "{points} lie at the same place, so no side can be told": "{points} aynı yerde, taraf söylenemez",
    "no point lies {ra:.6g} from {first} and {rb:.6g} from {second}: these two are {between:.6g} apart": (
        "{first} noktasına {ra:.6g}, {second} noktasına {rb:.6g} uzaklıkta nokta yok: bu ikisinin arası {between:.6g}"
    ),
    "no chain of joints leads from the link {name} to the ground": "{name} uzvundan sabit uzva giden mafsal dizisi yok",
    "it is joined to {others} only": "yalnız {others} ile mafsallı",
    "it shares no point with another link": "başka hiçbir uzuvla ortak noktası yok",
    "the link {name} is driven: it is needed": "{name} uzvu tahrik edilir: gereklidir",
    "the link {link} is joined at no point": "{link} uzvu hiçbir noktada mafsallı değil",
    "the link {link} is joined at {points}": "{link} uzvu şurada mafsallı: {points}",
    "{message} and slides at {joints}": "{message}; şurada kayar: {joints}",
    "a link can be left out that joins two others by two revolute joints": (
        "çözümün dışında bırakılabilen uzuv, iki uzvu iki döner mafsalla birleştirendir"
    ),
    'give its points by coordinates: B = ["a3", 0]': 'noktalarını koordinatla verin: B = ["a3", 0]',
    "{symbol} is the length of {link} from {start} to {end}: it must be greater than 0, not {value:.12g}": (
        "{symbol}, {link} uzvunun {start}–{end} uzunluğudur: 0'dan büyük olmalıdır, {value:.12g} olamaz"
    ),
    "which way the link points at first is said by the driver's start or by the sketch": (
        "uzvun başta hangi yöne baktığını tahrikin başlangıcı ya da eskiz söyler"
    ),
    "a chart at true scale has no axes of its own": "gerçek ölçekli grafiğin kendi eksenleri yoktur",
    "an axis ends above where it begins": "eksen başladığı yerden büyük bir değerde biter",
    "points of a redundant link cannot be given by distances": "fazladan uzvun noktaları uzaklıklarla verilemez",
    "no link is called {name}": "{name} adlı uzuv yok",
    "no link has a point {point}": "hiçbir uzuvda {point} noktası yok",
    "no point is called {name}": "{name} adlı nokta yok",
    # sliding joints
    "{on} cannot slide on itself: `link` and `on` are the same": "{on} kendi üzerinde kayamaz: `link` ile `on` aynı",
    "the point {point} belongs to {on} itself: it must be a point of another link": (
        "{point} noktası zaten {on} uzvunun: başka bir uzvun noktası olmalıdır"
    ),
    "the point {point} is a point of {on} too, which pins it there: it cannot slide": (
        "{point} noktası {on} uzvunun da noktası, orada mafsallanır: kayamaz"
    ),
    "take it out of the points of {on}": "onu {on} uzvunun noktalarından çıkarın",
    "is missing: the point {point} belongs to {owners}": "eksik: {point} noktası şu uzuvların: {owners}",
    "no default fits; name the displacement": "kendiliğinden ad verilemez; ötelenmeye ad verin",
    # the driver
    "no sliding joint is called {name}": "{name} adlı kayar mafsal yok",
    "goes with `link`; a driven joint has its two links already": (
        "`link` ile verilir; tahrik edilen mafsalın iki uzvu bellidir"
    ),
    "the driven displacement is called {symbol} already": "tahrik edilen ötelenmenin adı zaten {symbol}",
    "leave it out here, or give the same symbol to the joint": "burada yazmayın ya da mafsala aynı simgeyi verin",
    "the link {link} cannot turn: it is the ground": "{link} uzvu sabit uzuvdur: dönemez",
    "the link {link} cannot turn: it is `relative_to` as well": (
        "{link} uzvu kendisine göre dönemez: `relative_to` da odur"
    ),
    "the link {link} is the ground": "{link} uzvu sabit uzuvdur",
    'drive the other one: link = "{other}", with the opposite sign of the values': (
        'ötekini tahrik edin: link = "{other}", değerler ters işaretli'
    ),
    "the step is zero": "adım sıfır",
    "a step of {step} never leads from {start} to {stop}: it must be positive": (
        "{step} adımıyla {start} değerinden {stop} değerine varılmaz: adım artı olmalıdır"
    ),
    "a step of {step} never leads from {start} to {stop}: it must be negative": (
        "{step} adımıyla {start} değerinden {stop} değerine varılmaz: adım eksi olmalıdır"
    ),
    "the sweep has {rows:,} rows; a sheet holds at most {most:,} below its headings": (
        "tahrik {rows:,} satır tutar; bir sayfaya başlıkların altında en çok {most:,} satır sığar"
    ),
    "{count} values, where [driver] has {rows} rows: one is needed for each": (
        "{count} değer var, [driver] {rows} satır: her satıra bir değer gerekir"
    ),
    "in {text}: {name} is not driven": "{text} içinde: {name} tahrik edilmiyor",
    "in {text}: {name} is neither a dimension nor a driver": "{text} içinde: {name} ne boyut ne tahrik",
    "{name} is driven already, by {other}": "{name} zaten tahrik ediliyor: {other}",
    "drive another joint": "başka bir mafsalı tahrik edin",
    "{symbol} is a list of values, which says nothing of its speed": "{symbol} bir değer listesi, hızı bilinmez",
    "write `follows` in place of `values`, or take masses, loads and derivatives away": (
        "`values` yerine `follows` yazın ya da kütleleri, yükleri ve türevleri çıkarın"
    ),
    "write `follows` in place of `values`, or take `speed` out of [driver]": (
        "`values` yerine `follows` yazın ya da [driver] altından `speed` anahtarını çıkarın"
    ),
    "two-way tables have no value of {symbol}, which is listed row by row": (
        "iki yönlü tablolarda {symbol} değeri yok: o satır satır listelenmiş"
    ),
    "write `follows` or `value` in place of `values`, or take the tables away": (
        "`values` yerine `follows` ya da `value` yazın ya da tabloları kaldırın"
    ),
    "{what} of the driver's motion": "tahrik hareketinde {what}",
    "time": "zaman",
    "start": "başlangıç",
    "stop": "bitiş",
    "duration": "süre",
    "rename it: the driver has a motion law": "adını değiştirin: tahrikin bir hareket kanunu var",
    "goes with `step` or `values`: here the {key} follows from the motion law": (
        "`step` ya da `values` ile verilir: burada {key} hareket kanunundan çıkar"
    ),
    "leave out {key}, or motion": "{key} ya da motion anahtarını kaldırın",
    "start and stop are the same: the driver does not move": "start ile stop aynı: tahrik hareket etmez",
    "the motion takes {seconds:g} s: it must take more than 0": "hareket {seconds:g} s sürer: 0'dan uzun olmalıdır",
    "rate of {of}": "{of} hızı ya da ivmesi",
    "rename it: the driver has a speed": "adını değiştirin: tahrikin bir hızı var",
    "the point has the name of a displacement: {symbol}.v would be the velocity of either": (
        "noktanın adı bir ötelenmeninkiyle aynı: {symbol}.v ikisinin de hızı olurdu"
    ),
    "goes with `speed`": "`speed` ile verilir",
    "a driver at rest has speed = 0": "duran tahrikte speed = 0",
    "a list of them goes with `values`: one {key} for each": "liste `values` ile verilir: her birine bir {key}",
    "or give one for all rows": "ya da bütün satırlara tek bir değer verin",
    "1 value, where [driver] has {rows} rows: one is needed for each": (
        "1 değer var, [driver] {rows} satır: her satıra bir değer gerekir"
    ),
    "has 1 number for {rows} values of the driver": "tahrikin {rows} değerine 1 sayı var",
    "has {count} numbers for {rows} values of the driver": "tahrikin {rows} değerine {count} sayı var",
    "give one {key} for each of `values`": "`values` içindeki her değere bir {key} verin",
    "{unit} is no unit of this {key}: the driver is {what}": "{unit} bu {key} için birim değil: tahrik bir {what}",
    "a displacement": "ötelenme",
    "{text} depends on the driver and has no derivative where {corner} has a corner": (
        "{text} tahrike bağlı ve {corner} fonksiyonunun köşesinde türevi yok"
    ),
    "{text} depends on the driver: {error}": "{text} tahrike bağlı: {error}",
    "give the driver an `acceleration`": "tahrike bir `acceleration` verin",
    "needs the driver's speed": "tahrikin hızını gerektirir",
    "write `speed` in [driver]": "[driver] altına `speed` yazın",
    "{where}{name} is a velocity or an acceleration: it needs the driver's speed": (
        "{where}{name} bir hız ya da ivme: tahrikin hızını gerektirir"
    ),
    "{name} is a point of the ground: it does not move": "{name} sabit uzvun noktası: hareket etmez",
    "{name} is a {what}: it needs the driver's speed": "{name} ({what}) tahrikin hızını gerektirir",
    "the driver's values are listed one by one: there is no sweep to change": (
        "tahrikin değerleri tek tek listelenmiş: değiştirilecek adım yok"
    ),
    "give [driver] start, stop and step in place of `values`": (
        "[driver] altında `values` yerine start, stop ve step verin"
    ),
    "the driver moves by a motion law: its rows are equally spaced in time, there is no step": (
        "tahrik bir hareket kanununa uyar: satırları eşit zaman aralıklıdır, adım yoktur"
    ),
    "--rows says how many there are": "kaç satır olduğunu --rows söyler",
    "a sheet holds at most {most:,} rows below its headings, not {count:,.15g}": (
        "bir sayfaya başlıkların altında en çok {most:,} satır sığar, {count:,.15g} değil"
    ),
    "start and stop are the same: no step makes {rows} rows": "start ile stop aynı: hiçbir adım {rows} satır etmez",
    "expected a whole number, found {text}": "tam sayı beklenir, bulunan: {text}",
    "a sweep has at least {least} rows, not {count:.15g}": "en az {least} satır olur, {count:.15g} değil",
    "this is the default; give the joint a `symbol` of its own": "bu kendiliğinden verilen ad; mafsala bir `symbol` verin",
    # gears
    "write arm = {name}": "arm = {name} yazın",
    "no link shares a point with both {wheels}": "hiçbir uzvun ikisiyle de ortak noktası yok: {wheels}",
    "the {key} is 0: nothing would turn with it": "{key} 0: onunla hiçbir şey dönmez",
    "radius": "yarıçap",
    "ratio": "çevrim oranı",
    "must be less than 90 degrees to either side": "her iki yana 90 dereceden küçük olmalıdır",
    "usual are 20 and 14.5 degrees": "yaygın olanlar 20 ve 14.5 derecedir",
    "{link} is one link: no gear can turn it against itself": (
        "{link} tek uzuvdur: hiçbir dişli onu kendisine göre döndüremez"
    ),
    "{link} and {on} slide on each other and keep their angle: no gear can turn them": (
        "{link} ile {on} birbiri üzerinde kayar, açıları değişmez: hiçbir dişli onları döndüremez"
    ),
    "the arm {arm} is one of the wheels": "{arm} kolu çarklardan biri",
    "the arm {arm} does not carry the axis of {lacking}: they share no point": (
        "{arm} kolu {lacking} çarkının eksenini taşımıyor: ortak noktaları yok"
    ),
    "{link} is a side of the sliding joint itself: the pinion must be a third link": (
        "{link} kayar mafsalın kendi uzvu: pinyon üçüncü bir uzuv olmalıdır"
    ),
    "the arm {arm} is no side of the sliding joint": "{arm} kolu kayar mafsalın uzuvlarından değil",
    "its sides: {sides}": "uzuvları: {sides}",
    "the pinion {link} is not pivoted on {which}: they share no point": (
        "{link} pinyonu {which} üzerinde yataklı değil: ortak noktaları yok"
    ),
    "the {kind} between {names} is in no group of links that it could be solved with": (
        "{names} arasındaki {kind}, birlikte çözülebileceği bir uzuv grubunun içinde değil"
    ),
    "what it ties is held without it, or by more links than are solved all at once": (
        "bağladıkları onsuz da tutuluyor, ya da birlikte çözülenden daha çok uzuvla"
    ),
    "gear": "dişli",
    "belt": "kayış",
    "rack": "kremayer",
    # degrees of freedom
    "the mobility is {count}, but {need}: {terms} = {count}": (
        "serbestlik derecesi {count}, ama {need}: {terms} = {count}"
    ),
    "one driver needs 1": "bir tahrik için 1 gerekir",
    "{drivers} drivers need {drivers}": "{drivers} tahrik için {drivers} gerekir",
    "3 x ({links} - 1) - 2 x {revolute} revolute - 2 x {prismatic} prismatic - {slots} pin-slot": (
        "3 x ({links} - 1) - 2 x {revolute} döner - 2 x {prismatic} kayar - {slots} yarıkta pim"
    ),
    "{terms} - {count} gear, belt or rack": "{terms} - {count} dişli, kayış ya da kremayer",
    "{count} drivers would be needed, {given}: join the loose links, remove {surplus} of the freedoms, or add [[drivers]]": (
        "{count} tahrik gerekir, {given}: boştaki uzuvları mafsallayın, {surplus} serbestliği kaldırın ya da "
        "[[drivers]] ekleyin"
    ),
    "one is given": "biri verilmiş",
    "{drivers} are given": "{drivers} tanesi verilmiş",
    "one driver too many: take {surplus} of the drivers away": "tahrikler fazla: {surplus} tanesini kaldırın",
    "it is a structure: nothing can move. Remove a joint, or a link with two joints": (
        "bu bir yapıdır, hiçbir şey hareket edemez: bir mafsalı ya da iki mafsallı bir uzvu kaldırın"
    ),
    "there are more joints than a movable chain can have: remove some, or make two links that never move apart one": (
        "mafsallar, hareketli bir zincirinkinden fazla: bir kısmını kaldırın ya da birbirine göre "
        "hareket etmeyen iki uzvu bir yapın"
    ),
    "{bodies} cannot move against each other (joints {joints}): describe them as one link, or remove a joint": (
        "{bodies} birbirine göre hareket edemez (mafsallar: {joints}): onları tek uzuv yapın ya da bir mafsalı kaldırın"
    ),
    "{bodies} are over-constrained (joints {joints}): describe them as one link, or remove a joint": (
        "{bodies} fazla kısıtlı (mafsallar: {joints}): onları tek uzuv yapın ya da bir mafsalı kaldırın"
    ),
    '"{body}" is loose: it has too few joints to be held by the rest': (
        '"{body}" boşta: ötekilerin onu tutmasına mafsalları yetmiyor'
    ),
    "every link but the ground needs at least two joints": "sabit uzuv dışında her uzva en az iki mafsal gerekir",
    "a {kind} ties {both}, and each of them is driven: they cannot all be": (
        "bir {kind} şunları bağlıyor: {both}; her biri de tahrik ediliyor: hepsi birden olmaz"
    ),
    "take the gear or one of the drivers away": "dişliyi ya da tahriklerden birini kaldırın",
    'the link "{name}" is redundant: left out of the solution, its length checked in every row': (
        '"{name}" uzvu fazladan: çözümün dışında bırakıldı, uzunluğu her satırda denetleniyor'
    ),
    "{links} would do as well; write `redundant = true` under the one that is meant, then nothing more is said": (
        "{links} de olurdu; hangisi ise altına `redundant = true` yazın, artık söylenmez"
    ),
    "write `redundant = true` under it, then nothing more is said of it": (
        "altına `redundant = true` yazın, artık söylenmez"
    ),
    'the link "{name}" is marked as redundant, but may hold the others': (
        '"{name}" uzvu fazladan diye işaretli, ama ötekileri tutuyor olabilir'
    ),
    "without the mark both its joints count": "işaret olmazsa iki mafsalı da sayılır",
    "it moves all the same: some of its links or joints say what others say already": (
        "yine de hareket eder: kimi uzuv ya da mafsallar başkalarının söylediğini söylüyor"
    ),
    '{before} together with "{other}"': '{before}, "{other}" ile birlikte',
    'the link "{name}" is redundant and may be left out{together}: the rest moves in the same way without it': (
        '"{name}" uzvu fazladan, kaldırılabilir{together}: kalanı onsuz da aynı hareket eder'
    ),
    'the sliding joint "{name}" is redundant and may be left out{together}: the rest moves in the same way without it': (
        '"{name}" kayar mafsalı fazladan, kaldırılabilir{together}: kalanı onsuz da aynı hareket eder'
    ),
    "leave it out of the description (its points can be points of another link, its forces are another matter)": (
        "onu tanımdan çıkarın (noktaları başka bir uzvun noktaları olabilir, kuvvetleri ayrı konudur)"
    ),
    "write `redundant = true` under it: it follows the others, and its length is checked in every row": (
        "altına `redundant = true` yazın: ötekileri izler, uzunluğu her satırda denetlenir"
    ),
    # what cannot be solved, and assemblies
    'link "{link}" and link "{relative_to}" share no point: a link can only be turned about a revolute joint': (
        '"{link}" uzvu ile "{relative_to}" uzvunun ortak noktası yok: bir uzuv ancak bir döner mafsal çevresinde döndürülür'
    ),
    '"{link}" is joined to {others}: name one of them as relative_to': (
        '"{link}" şunlarla mafsallı: {others}; birini relative_to olarak verin'
    ),
    "no link": "hiçbiri",
    '"{twice}" is driven against two links that move with it: such a chain is not supported yet': (
        '"{twice}" kendisiyle hareket eden iki uzva göre tahrik ediliyor: böyle bir zincir henüz desteklenmiyor'
    ),
    "let one of the driven joints be on a link that is known": (
        "tahrik edilen mafsallardan biri konumu bilinen bir uzuvda olsun"
    ),
    "links {names} form a group that must be solved all at once, and takes more than {most} unknowns": (
        "{names} uzuvları hep birlikte çözülmesi gereken bir grup oluşturuyor, bilinmeyenleri {most} sayısından çok"
    ),
    "driving another link often helps": "başka bir uzvu tahrik etmek çoğu kez yeter",
    "links {first} and {second} are held by sliders alone ({outer_first}, {inner}, {outer_second}): "
    "their angles are fixed and their position is not": (
        "{first} ile {second} uzuvlarını yalnız kızaklar tutuyor ({outer_first}, {inner}, {outer_second}): "
        "açıları belli, yerleri değil"
    ),
    "one of the three joints must be a revolute joint": "üç mafsaldan biri döner mafsal olmalıdır",
    "the lines of {first} and {second} are parallel in every position: they never meet": (
        "{first} ile {second} doğruları her konumda paralel: hiç kesişmezler"
    ),
    "change the angle of one of them": "birinin açısını değiştirin",
    "the links cannot be joined at any value of the driver: {links}": (
        "uzuvlar tahrikin hiçbir değerinde birleşemiyor: {links}"
    ),
    "check the lengths of these links and the distance of their outer joints": (
        "bu uzuvların boylarını ve dış mafsallarının uzaklığını gözden geçirin"
    ),
    "the sketch lies between the two assemblies of {group}": "eskiz, şunun iki montajının arasında: {group}",
    "the sketch lies between two assemblies of {group}": "eskiz, şunun iki montajının arasında: {group}",
    "{first} has {plus}; {second} has {minus}: sketch a point nearer to the one that is meant": (
        "{first} iken {plus}; {second} iken {minus}; eskizde bir noktayı istenene daha yakın çizin"
    ),
    "+1 is at {plus}; -1 is at {minus}: sketch a point nearer to the one that is meant": (
        "+1: {plus}; -1: {minus}; eskizde bir noktayı istenene daha yakın çizin"
    ),
    "the sketch lies between two of the {count} assemblies of {group}": (
        "eskiz, {count} montajdan ikisinin arasında: {group}"
    ),
    "{assemblies}: sketch a point nearer to the one that is meant": (
        "{assemblies}; eskizde bir noktayı istenene daha yakın çizin"
    ),
    "{hint}; {fits}: if it was drawn there, write at = {at}": "{hint}; {fits}: orada çizildiyse at = {at} yazın",
    "the sketch fits {positions}": "eskiz şuraya uyuyor: {positions}",
    "two assemblies of {group} meet in the first position": "ilk konumda iki montaj birleşiyor: {group}",
    "at {place} they are apart: begin the sweep there, or walk it the other way": (
        "{place} iken ayrıdırlar: taramayı orada başlatın ya da ters yönde yürütün"
    ),
    "{group} are free to move while the driver stands: the equations are singular at {first} and at {other}": (
        "tahrik dururken serbestçe hareket edebiliyor: {group}; denklemler {first} iken de {other} iken de tekil"
    ),
    "legs that are equal and parallel hold nothing: give one of them another length or place": (
        "eşit ve paralel ayaklar bir şey tutmaz: birine başka bir boy ya da yer verin"
    ),
    "begin the sweep at another value of the driver, or walk it the other way": (
        "tahriki başka bir değerden başlatın ya da ters yönde yürütün"
    ),
    "{what}: {group} have no closed form, each row needs the row above": (
        "{what}: {group} kapalı biçimde çözülmez, her satıra bir üstteki gerekir"
    ),
    "{what}: the values of {symbol} are listed row by row, they do not follow from the driver": (
        "{what}: {symbol} değerleri satır satır listelenmiş, tahrikten çıkmıyor"
    ),
    "the layout page cannot hold this": "tek sayfalık düzene sığmaz",
    'layout = "sheets" does': 'layout = "sheets" olur',
    "a written solution cannot hold this": "yazılı çözümde olmaz",
    "octave, python and vba can": "octave, python ve vba ile olur",
    "a workbook with functions cannot hold this": "fonksiyonlu çalışma kitabında olmaz",
    "`export --to vba` can": "`export --to vba` ile olur",
    "a two-way table cannot hold this": "iki yönlü tabloda olmaz",
    "leave the table out": "tabloyu kaldırın",
    "the step to {symbol} = {value:.6g} is too large: Newton's method loses the links": (
        "{symbol} = {value:.6g} değerine adım çok büyük: Newton yöntemi uzuvları kaybediyor"
    ),
    "the step to {symbol} = {value:.6g} is too large: Newton's method lands on another assembly": (
        "{symbol} = {value:.6g} değerine adım çok büyük: Newton yöntemi başka montaja düşüyor"
    ),
    "take a much smaller step, or end the sweep before": "çok daha küçük bir adım alın ya da daha önce bitirin",
    "a step of {step:.4g} works": "{step:.4g} adımı olur",
    "write rows = {rows} in motion": "motion içine rows = {rows} yazın",
    "from the position that the sketch shows {links} cannot be followed to the first one: "
    "they come apart at {symbol} = {value:.4g}": (
        "eskizdeki konumdan ilk konuma izlenemiyor, {symbol} = {value:.4g} değerinde ayrılıyorlar: {links}"
    ),
    "begin the sweep at {symbol} = {start:.4g}, where it exists, or sketch a position of the first one's stretch": (
        "tahriki bulunduğu {symbol} = {start:.4g} değerinde başlatın ya da eskizde ilk konumun aralığından bir konum çizin"
    ),
    "the sketch cannot show this position: there {links} cannot be joined": (
        "eskiz bu konumu gösteremez, orada birleşemiyorlar: {links}"
    ),
    "check `at`, which is in the driver's unit, and the lengths of these links": (
        "tahrikin biriminde olan `at` değerini ve bu uzuvların boylarını gözden geçirin"
    ),
    '"{name}" is not known here': '"{name}" burada bilinmiyor',
    "the task has no solution": "görevin çözümü yok",
    "give it another one": "başka bir görev verin",
    # a sketch that is doubtful
    '"{point}" is a point of the ground: sketching it decides nothing': (
        '"{point}" sabit uzvun noktası: onu eskize koymak bir şey belirlemez'
    ),
    "{name} is sketched {angle:.3g} degrees away from where the phase puts it": (
        "{name} eskizde, faz açısının koyduğu yerden {angle:.3g} derece ötede"
    ),
    "{name} is sketched {length:.4g} {unit} away from where the phase puts it": (
        "{name} eskizde, fazın koyduğu yerden {length:.4g} {unit} ötede"
    ),
    "write phase = {phase:.4g}, or sketch {name} elsewhere": (
        "phase = {phase:.4g} yazın ya da eskizde {name} başka yerde olsun"
    ),
    "the sketch is read at the first position, {where}, but it fits {fits}": (
        "eskiz ilk konumda okunur, {where}, oysa şuna uyuyor: {fits}"
    ),
    "write at = {at} in [assembly], or sketch the first position": (
        "[assembly] altına at = {at} yazın ya da ilk konumun eskizini verin"
    ),
    "the sketch is said to show {where}, but it fits {fits}": (
        "eskizin {where} konumunu gösterdiği söyleniyor, oysa şuna uyuyor: {fits}"
    ),
    "write at = {at}, or sketch the position at {where}": "at = {at} yazın ya da {where} konumunun eskizini verin",
    "the sketch of {name} is far from every position; at {where} it is at {lies}": (
        "{name} eskizi bütün konumlardan uzak; {where} iken yeri {lies}"
    ),
    "check the dimensions and the sketch": "boyutları ve eskizi gözden geçirin",
    "on the way from the described dimensions to these the assembly of {links} ends: the sketch means another now": (
        "tarif edilen boyutlardan bunlara giderken montaj sona eriyor, eskizin şimdi gösterdiği başka bir montaj: {links}"
    ),
    "with these dimensions the sketch means another assembly of {links} than the described one, with which a workbook "
    "goes on when they are typed": (
        "bu boyutlarla eskiz başka bir montajı gösteriyor; boyutlar çalışma kitabına yazılınca tarif edilen montaj sürer: "
        "{links}"
    ),
    "--set {mode}={number} takes that one": "--set {mode}={number} onu alır",
    "sketch the position that is meant, or choose with --set {mode}=1 ... {count}": (
        "istenen konumu eskizde gösterin ya da --set {mode}=1 ... {count} ile seçin"
    ),
}
