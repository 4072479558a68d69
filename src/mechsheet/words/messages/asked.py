"""Of what is asked: outputs, charts, tables, masses and loads, tolerances, tasks, studies, exercises; and nouns."""

from __future__ import annotations

ASKED: dict[str, str] = {
    # outputs, charts, tables
    "no point, link angle or displacement is called {name}": "{name} adlı nokta, uzuv açısı ya da ötelenme yok",
    "{name} is no point, link angle or displacement": "{name} bir nokta, uzuv açısı ya da ötelenme değil",
    "the point {name} is sketched as [x, y]": "{name} noktası eskizde [x, y] olarak verilir",
    "no link has a point {name}": "hiçbir uzuvda {name} noktası yok",
    "{where}no point is called {point}": "{where}{point} adlı nokta yok",
    "{where}a point has no {axis}": "{where}noktanın {axis} bileşeni yok",
    "write {point}.x or {point}.y": "{point}.x ya da {point}.y yazın",
    "write {point}.x or {point}.y; {point}.v, {point}.a for its velocity and acceleration": (
        "{point}.x ya da {point}.y yazın; hızı ve ivmesi için {point}.v, {point}.a"
    ),
    "the mass centre is the point {center}: write {center}.{axis}": (
        "kütle merkezi {center} noktası: {center}.{axis} yazın"
    ),
    "no variable or output is called {name}": "{name} adlı değişken ya da çıktı yok",
    "{name} follows from all rows together: only charts can show it": (
        "{name} bütün satırların birlikte sonucudur: yalnız grafikte gösterilebilir"
    ),
    "{name} is an output of summaries, one number of the whole motion: it has no value in a row": (
        "{name} özetlerin çıktısı, bütün hareketin tek sayısı: bir satırda değeri yok"
    ),
    "{name} is a dimension, the same in every row; a variable or an output is needed": (
        "{name} bir boyut, her satırda aynı; bir değişken ya da çıktı gerekir"
    ),
    "{points} is a point of the ground: what does not move has no path": (
        "{points} sabit uzvun noktası: hareket etmeyenin yörüngesi olmaz"
    ),
    "{points} are points of the ground: what does not move has no path": (
        "{points} sabit uzvun noktaları: hareket etmeyenin yörüngesi olmaz"
    ),
    "{name} is a point of the ground: it has no velocity": "{name} sabit uzvun noktası: hızı yok",
    "a hodograph shows velocities: it needs the driver's speed": (
        "hodograf hızları gösterir: tahrikin hızını gerektirir"
    ),
    "{name} is listed twice": "{name} iki kez yazılmış",
    "expected the driver's symbol {symbol}, found {found}": "tahrikin simgesi {symbol} beklenir, bulunan: {found}",
    "over two dimensions a table shows a summary: rows = {{ {rows} = […] }}": (
        "iki boyuta göre tablo bir özeti gösterir: rows = {{ {rows} = […] }}"
    ),
    "{value} is a summary, one number of the whole sweep: over the driver it has one value only": (
        "{value} bir özet, bütün hareketin tek sayısı: tahrike göre yalnız bir değeri var"
    ),
    "give a second input: rows = { a2 = [40, 45, 50] }": "ikinci bir giriş verin: rows = { a2 = [40, 45, 50] }",
    "no summary is called {name}": "{name} adlı özet yok",
    "{name} is an output of summaries: in a table over two dimensions each cell is one summary": (
        "{name} özetlerin çıktısı: iki boyuta göre tabloda her hücre tek bir özettir"
    ),
    "{name} differs from row to row: over two dimensions the cells hold a summary": (
        "{name} satırdan satıra değişir: iki boyuta göre tabloda hücreler özet tutar"
    ),
    "{name} is of the driver, whose values are the same in every cell of the table": (
        "{name} tahrikin özeti; değeri tablonun her hücresinde aynı"
    ),
    "a line of the first sheet shows it": "ilk sayfanın bir satırı onu gösterir",
    "{row} goes down already: give another input": "{row} zaten aşağı doğru değişiyor: başka bir giriş verin",
    "the table has {rows} x {columns} = {pairs:,} cells; at most {most} have a summary": (
        "tablo {rows} x {columns} = {pairs:,} hücreli; özet en çok {most} hücrede olur"
    ),
    "{rows} x {columns} cells over {values:,} values of the driver are {cells:,} helper cells; at most {most:,} are made": (
        "tahrikin {values:,} değerine {rows} x {columns} hücre {cells:,} yardımcı hücre eder; en çok {most:,} yapılır"
    ),
    "give fewer values": "daha az değer verin",
    "give fewer values, or a larger step": "daha az değer ya da daha büyük bir adım verin",
    "{name} is a {what}: two-way tables have positions only": (
        "{name} konum değil ({what}); iki yönlü tablolarda yalnız konumlar olur"
    ),
    "{name} reads a velocity, an acceleration or a force: two-way tables have positions only": (
        "{name} hız, ivme ya da kuvvet okur; iki yönlü tablolarda yalnız konumlar olur"
    ),
    "{name} is a velocity, an acceleration or a force: two-way tables have positions only": (
        "{name} hız, ivme ya da kuvvet; iki yönlü tablolarda yalnız konumlar olur"
    ),
    "{name} reads a velocity or an acceleration: two-way tables have positions only": (
        "{name} hız ya da ivme okur; iki yönlü tablolarda yalnız konumlar olur"
    ),
    "{name} is a velocity or an acceleration: two-way tables have positions only": (
        "{name} hız ya da ivme; iki yönlü tablolarda yalnız konumlar olur"
    ),
    "a summary or a chart can show it": "bir özet ya da grafik onu gösterebilir",
    "no dimension is called {name}": "{name} adlı boyut yok",
    "the dimension {name} is derived; only an input can differ from column to column": (
        "{name} boyutu türetilmiş; sütundan sütuna yalnız bir giriş değişebilir"
    ),
    "the dimension {name} is derived; only an input can differ from row to row": (
        "{name} boyutu türetilmiş; satırdan satıra yalnız bir giriş değişebilir"
    ),
    "{where}{name} is not a variable or dimension": "{where}{name} değişken ya da boyut değil",
    "the outputs": "çıktılar",
    'write unit = "deg" beside the formula: without a unit an output is a length': (
        'formülün yanına unit = "deg" yazın: birimi olmayan çıktı uzunluktur'
    ),
    "with the outputs that it reads, the formula is too long for a cell": (
        "okuduğu çıktılarla birlikte formül bir hücre için çok uzun"
    ),
    "{name} differs from row to row, but {others} are numbers of the whole motion": (
        "{name} satırdan satıra değişir, oysa {others} bütün hareketin sayılarıdır"
    ),
    "{name} differs from row to row, but {other} is one number of the whole motion": (
        "{name} satırdan satıra değişir, oysa {other} bütün hareketin tek sayısıdır"
    ),
    "a summary of {name} may stand there": "orada {name} için bir özet olabilir",
    "{name} is not a summary or dimension": "{name} özet ya da boyut değil",
    '{text} is an angle, in radians unless `unit` says "deg": the label "{unit}" would stand behind radians': (
        '{text} bir açı; `unit` "deg" demedikçe radyandır: "{unit}" etiketi radyanın arkasında dururdu'
    ),
    'write unit = "deg" or unit = "rad", or convert it in the formula': (
        'unit = "deg" ya da unit = "rad" yazın ya da formülde çevirin'
    ),
    '{text} is a length in {length}, not in "{unit}"': '{text} {length} biriminde bir uzunluk, "{unit}" değil',
    'write unit = "{length}", or convert it in the formula': 'unit = "{length}" yazın ya da formülde çevirin',
    "stands on one line": "tek satırda yazılmış",
    "write them under headings, {heading}, then it can be drawn": (
        "başlıklar altına yazın, {heading}; o zaman çizilebilir"
    ),
    # masses, loads, flywheel
    "no link has a mass and nothing is loaded: there are no forces": "hiçbir uzvun kütlesi, hiçbir yük yok: kuvvet yok",
    "give links a `mass`, or [[loads]]": "uzuvlara `mass` ya da [[loads]] verin",
    "with lengths in {length_unit} forces are in N and masses in kg": (
        "{length_unit} uzunluklarla kuvvet N, kütle kg olur"
    ),
    "{key} is missing: with lengths in {length_unit} no unit goes without saying": (
        "{key} eksik: {length_unit} uzunluklarda birim kendiliğinden anlaşılmaz"
    ),
    "a force must be a mass times {length_unit}/s²": "kuvvet, kütle çarpı {length_unit}/s² olmalıdır",
    "take it away": "kaldırın",
    "a {what} is not negative: {number:.6g}": "{what} eksi olamaz: {number:.6g}",
    "the ground does not move: its mass changes nothing": "sabit uzuv hareket etmez: kütlesi bir şey değiştirmez",
    "goes with `mass`": "`mass` ile verilir",
    "the link {name} has {count} points: its mass needs a `center`": (
        "{name} uzvunun {count} noktası var: kütlesi için `center` gerekir"
    ),
    'write center = "…" or center = [x, y]': 'center = "…" ya da center = [x, y] yazın',
    "goes with `between`: the two points that a spring joins": "`between` ile verilir: yayın birleştirdiği iki nokta",
    "is missing: the link that is loaded": "eksik: yüklenen uzuv",
    "{name} is the ground: a load on it changes nothing": "{name} sabit uzuv: üzerindeki yük bir şey değiştirmez",
    "load a moving link, or take it away": "hareketli bir uzvu yükleyin ya da yükü kaldırın",
    "goes with `force`: a torque is the same wherever it acts": (
        "`force` ile verilir: moment nerede etkirse etkisin aynıdır"
    ),
    "goes with a force: a spring has its two points in `between`": (
        "kuvvetle verilir: yayın iki noktası `between` içindedir"
    ),
    "no point is called {point}": "{point} adlı nokta yok",
    "both points belong to the link {link}: the spring never changes its length": (
        "iki nokta da {link} uzvunun: yayın boyu hiç değişmez"
    ),
    "each point belongs to the first link, in the file's order": "her nokta, dosyadaki sırayla ilk uzvundur",
    "the link {name} has {count} points: the force needs a `point`": (
        "{name} uzvunun {count} noktası var: kuvvet için `point` gerekir"
    ),
    "{where}{name} is a {what}: loads may read positions and rates, no forces": (
        "{where}{name} kuvvetlerden çıkar ({what}): yükler konumları ve hızları okuyabilir, kuvvetleri okuyamaz"
    ),
    "give the link a point there": "uzva orada bir nokta verin",
    "{where}{name} is an output; loads read positions, rates and dimensions": (
        "{where}{name} bir çıktı; yükler konumları, hızları ve boyutları okur"
    ),
    "{where}{name} is not a position, a rate or a dimension": "{where}{name} konum, hız ya da boyut değil",
    "the point has the name of a joint force: {name}.x would be a part of either": (
        "noktanın adı bir mafsal kuvvetininkiyle aynı: {name}.x ikisinin de bileşeni olurdu"
    ),
    "the point has the name of the shaking force: shaking.x would be a part of either": (
        "noktanın adı sarsma kuvvetininkiyle aynı: shaking.x ikisinin de bileşeni olurdu"
    ),
    "the point has the name of the mass centre of {link}: {name}.x would be a part of either": (
        "noktanın adı {link} uzvunun kütle merkezininkiyle aynı: {name}.x ikisinin de bileşeni olurdu"
    ),
    'rename it, or write center = "{name}" where it is the mass centre': (
        'adını değiştirin ya da kütle merkeziyse center = "{name}" yazın'
    ),
    "rename it: the description has masses or loads": "adını değiştirin: tanımda kütle ya da yük var",
    "rename it: the flywheel's energy has a column": "adını değiştirin: volanın enerjisinin bir sütunu var",
    "rename it: the flywheel's has a cell of that name": "adını değiştirin: volanın bu adı taşıyan bir hücresi var",
    "a flywheel needs sheets of its own, which the layout page does not have": (
        "volana kendi sayfaları gerekir, tek sayfalık düzende bunlar yok"
    ),
    'write layout = "sheets"': 'layout = "sheets" yazın',
    "no link has a mass and nothing is loaded: there is no torque to even out": (
        "hiçbir uzvun kütlesi, hiçbir yük yok: dengelenecek moment yok"
    ),
    "{value:.6g} is no coefficient of fluctuation: it is (ω max − ω min) / ω mean, between 0 and 2": (
        "{value:.6g} düzgünsüzlük katsayısı olamaz: (ω max − ω min) / ω ort, 0 ile 2 arasındadır"
    ),
    "0.2 for presses and pumps, 0.02 for machine tools, 0.003 for generators": (
        "pres ve pompalarda 0.2, takım tezgâhlarında 0.02, jeneratörlerde 0.003"
    ),
    "a flywheel sits on a link that is driven against the ground, by its angle": (
        "volan, sabit uzva göre açısıyla tahrik edilen bir uzuv üzerindedir"
    ),
    "drive a crank": "bir krankı tahrik edin",
    "a flywheel needs a whole turn in equal steps, and the driver has `values`": (
        "volana eşit adımlarla bir tam dönüş gerekir, tahrikte ise `values` var"
    ),
    "write start, stop and step": "start, stop ve step yazın",
    "a flywheel needs a whole turn, first and last row alike: these rows cover {covered}": (
        "volana bir tam dönüş gerekir, ilk ve son satır aynı konumda: bu satırlar {covered} kapsıyor"
    ),
    "a flywheel needs the driver's speed": "volana tahrikin hızı gerekir",
    "a flywheel needs a constant speed: this one varies": "volana sabit bir hız gerekir: bu değişiyor",
    "give one number as `speed`, and no `acceleration`": "`speed` olarak tek bir sayı verin, `acceleration` vermeyin",
    "a flywheel needs a speed: at rest it stores no energy": "volana hız gerekir: dururken enerji depolamaz",
    "at {point} a driven pair, a link that moves with it and a third are joined: no forces yet": (
        "{point} noktasında tahrik edilen çift, onunla hareket eden bir uzuv ve bir üçüncüsü mafsallı: kuvvetler henüz yok"
    ),
    "take masses and loads away, or let the links be joined at two points": (
        "kütleleri ve yükleri kaldırın ya da uzuvlar iki ayrı noktada mafsallı olsun"
    ),
    "the driver turns two moving links about {point}, where a third one is joined: no forces there yet": (
        "tahrik iki hareketli uzvu {point} çevresinde döndürüyor, bir üçüncüsü de orada mafsallı: kuvvetler henüz yok"
    ),
    "take masses and loads away, or drive another link": (
        "kütleleri ve yükleri kaldırın ya da başka bir uzvu tahrik edin"
    ),
    # tolerances
    "there is no output and no summary of positions to give a band to": "bandı bulunacak konum çıktısı ya da özeti yok",
    'name what is wanted: of = ["{given}"]': 'istenenin adını verin: of = ["{given}"]',
    "bands need a sheet of their own, which the layout page does not have": (
        "bantlara kendi sayfası gerekir, tek sayfalık düzende bu yok"
    ),
    "{symbol} follows from other dimensions: its tolerance follows from theirs": (
        "{symbol} başka boyutlardan çıkar: toleransı da onlarınkinden çıkar"
    ),
    "give those tolerances": "toleransları onlara verin",
    "no dimension has a tolerance: there is nothing that could spread": (
        "hiçbir boyutun toleransı yok: sapacak bir şey yok"
    ),
    "write for example {symbol} = {{ value = {value:.12g}, tolerance = 0.1 }}": (
        "örneğin {symbol} = {{ value = {value:.12g}, tolerance = 0.1 }} yazın"
    ),
    "{name} is, or reads, a velocity, an acceleration or a force: bands are found of positions only": (
        "{name} bir hız, ivme ya da kuvvettir ya da onları okur: bantlar yalnız konumlar için bulunur"
    ),
    "{name} is no number that changes as its quantity does: bands are found of the largest, the smallest, the range,"
    " the mean, the first and the last": (
        "{name} niceliği gibi değişen bir sayı değildir: bantlar en büyük, en küçük, aralık, ortalama, ilk ve son değer"
        " için bulunur"
    ),
    "{name} is driven: no dimension changes it": "{name} tahrik edilir: hiçbir boyut onu değiştirmez",
    "{name} is the same in every row: it has no column that a chart could show": (
        "{name} her satırda aynıdır: grafikte gösterilebilecek bir sütunu yok"
    ),
    'give it one: an output with formula = "{name} + 0"': (
        'ona bir sütun verin: formula = "{name} + 0" olan bir çıktı'
    ),
    "{name} is of a point of the ground, which has no column of its own": (
        "{name} sabit uzvun bir noktasının, onun kendi sütunu yok"
    ),
    "no output, variable or summary is called {name}": "{name} adlı çıktı, değişken ya da özet yok",
    "{name} follows from summaries: bands are found of these": "{name} özetlerden çıkar: bantlar onlar için bulunur",
    # tasks of a synthesis
    "there is no part [synthesis] whose result it could be": "sonucu olabileceği bir [synthesis] bölümü yok",
    "must be greater than 0, not {value:g}": "0'dan büyük olmalıdır, {value:g} değil",
    "is true, or left out with another key in its place": "true olur ya da yerine başka bir anahtarla hiç yazılmaz",
    "is missing: give it here, or as a number in [dimensions]": (
        "eksik: burada ya da [dimensions] altında sayı olarak verin"
    ),
    "goes with `f`: the function of x that is to be generated": "`f` ile verilir: üretilecek x fonksiyonu",
    "has {count} angles for {others} of theta": "theta {others} açılı, burada {count} açı var",
    "has {count} angles: three precision points are the least": "{count} açı var: en az üç kesinlik noktası gerekir",
    "of a function `f` has two angles, the first and the last; found {count}": (
        "`f` fonksiyonunda iki açı olur, ilk ve son; bulunan: {count}"
    ),
    "is missing: the range of the function, [first, last]": "eksik: fonksiyonun aralığı, [ilk, son]",
    "in {text}: {name} is not known; a function of x alone": (
        "{text} içinde: {name} bilinmiyor; yalnız x fonksiyonu olur"
    ),
    "the range has no length": "aralığın uzunluğu yok",
    "{text} has no value at x = {x:.6g}: {error}": "{text}, x = {x:.6g} için değersiz: {error}",
    "{text} turns back near x = {x:.6g}: it must rise or fall throughout": (
        "{text}, x = {x:.6g} yakınında geri dönüyor: hep artmalı ya da hep azalmalıdır"
    ),
    "{text} does not change between x = {first:.6g} and {last:.6g}": (
        "{text}, x = {first:.6g} ile {last:.6g} arasında değişmiyor"
    ),
    "a synthesis of kind {kind} gives no {name}": "{kind} türündeki sentez {name} vermez",
    "{symbol} is another result of this synthesis: {name} under this name would mislead": (
        "{symbol} bu sentezin başka bir sonucu: bu ad altında {name} yanıltıcı olurdu"
    ),
    "name the dimension otherwise": "boyuta başka bir ad verin",
    "only an assembly mode is a result of a synthesis": "sentezin sonucu yalnız bir montaj biçimi olur",
    "mode_1 is that of the first group": "mode_1 ilk grubunkidir",
    "{result} is no assembly that a synthesis of kind {kind} gives": (
        "{result}, {kind} türündeki sentezin verdiği bir montaj değil"
    ),
    "rename it: a step of the synthesis has that name": "adını değiştirin: sentezin bir adımı bu adı taşıyor",
    # studies
    "a Sobol sample needs its number of designs": "Sobol örneğine tasarım sayısı gerekir",
    "for example count = 100_000": "örneğin count = 100_000",
    "belongs to a Sobol sample; a grid is all combinations": "Sobol örneğinde olur; ızgara bütün birleşimlerdir",
    'sample = "sobol"': 'sample = "sobol"',
    "the dimension {name} is derived; only an input can vary": "{name} boyutu türetilmiş; yalnız bir giriş değişebilir",
    "a Sobol sample varies between two ends, not over a list": (
        "Sobol örneği iki uç arasında değişir, bir liste üzerinde değil"
    ),
    "[from, to]": "[ilk, son]",
    "a Sobol sample has no step: any number between the ends": "Sobol örneğinde adım yok: uçlar arasında her sayı olur",
    "from {low:g} to {high:g} is no range": "{low:g} ile {high:g} bir aralık değil",
    "[from, to] with from < to": "[ilk, son], ilk < son",
    "a grid needs a step": "ızgaraya adım gerekir",
    '[from, to, step]; without a step: sample = "sobol" and count': (
        '[ilk, son, adım]; adımsız: sample = "sobol" ve count'
    ),
    "expected [from, to, step] with from <= to and a step above 0": (
        "[ilk, son, adım] beklenir; ilk <= son, adım 0'dan büyük"
    ),
    "{parts} = {total:,.4g} designs, at {rate:,} a second {days:,.0f} days: the most are {most:,}": (
        "{parts} = {total:,.4g} tasarım, saniyede {rate:,} ile {days:,.0f} gün: en çok {most:,} olur"
    ),
    "{parts} = {total:,.4g} designs, at {rate:,} a second {years:,.3g} years: the most are {most:,}": (
        "{parts} = {total:,.4g} tasarım, saniyede {rate:,} ile {years:,.3g} yıl: en çok {most:,} olur"
    ),
    'sample = "sobol" with count = 1_000_000 first; then a grid around what it finds': (
        'önce sample = "sobol" ve count = 1_000_000; sonra bulduğunun çevresinde ızgara'
    ),
    "closes has no argument: it asks for all rows": "closes argümansızdır: bütün satırları sorar",
    '"closes"': '"closes"',
    "in {plain}: no link is called {name}": "{plain} içinde: {name} adlı uzuv yok",
    "grashof asks of a loop": "grashof bir devreyi sorar",
    '"grashof(A0ABB0)": the loop by its pins': '"grashof(A0ABB0)": mafsallarıyla devre',
    "{text} is no condition": "{text} bir koşul değil",
    '"mu_min > 40", "60 < swing < 90", "closes", "crank(LINK)", "grashof(LOOP)"': (
        '"mu_min > 40", "60 < swing < 90", "closes", "crank(UZUV)", "grashof(DEVRE)"'
    ),
    "{count} objectives: a front of more than {most} tells nobody anything": (
        "{count} hedef var: {most} sayısından çok hedefin cephesi kimseye bir şey söylemez"
    ),
    "make conditions of the others": "ötekilerini koşul yapın",
    "{text} is an objective twice": "{text} iki kez hedef",
    "{name} has a value in every row": "{name} her satırda bir değer alır",
    "min({name}) or max({name}), or a summary of it": "min({name}) ya da max({name}) ya da bir özeti",
    "{name} is no summary and no dimension": "{name} ne özet ne boyut",
    # exercises
    "must lie between 0 and {most}, not {value:g}": "0 ile {most} arasında olmalıdır, {value:g} değil",
    "no variable, coordinate, rate, force, output or summary is called {symbol}": (
        "{symbol} adlı değişken, koordinat, hız, kuvvet, çıktı ya da özet yok"
    ),
    "{symbol} is given: the driver is no question": "{symbol} verilidir: tahrik sorulmaz",
    "ask for example for {names}": "örneğin {names} sorulabilir",
    "{symbol} follows from summaries: ask for these": "{symbol} özetlerden çıkar: onları sorun",
    '"{all_rows}", or a comparison such as "mu_min > 30"': '"{all_rows}" ya da "mu_min > 30" gibi bir karşılaştırma',
    # nouns
    "inputs": "girişler",
    "allowed": "olabilecekler",
    "links": "uzuvlar",
    "results": "sonuçlar",
    "sliding joints": "kayar mafsallar",
    "units": "birimler",
    "points": "noktalar",
    "moving points": "hareketli noktalar",
    "moving links": "hareketli uzuvlar",
    "summaries": "özetler",
    "dimensions": "boyutlar",
    "languages": "diller",
    "keys": "anahtarlar",
    "templates": "şablonlar",
    "modes": "montaj biçimleri",
    "the points": "noktalar",
    "the dimensions": "boyutlar",
    "the drivers": "tahrikler",
    "link": "uzuv",
    "point": "nokta",
    "joint": "mafsal",
    "dimension": "boyut",
    "output": "çıktı",
    "summary": "özet",
    "cell": "hücre",
    "driver": "tahrik",
    "synthesis": "sentez",
    "angle of a link": "uzuv açısı",
    "displacement of a joint": "mafsal ötelenmesi",
    "length of a redundant link": "fazladan uzvun boyu",
    "energy of the flywheel": "volanın enerjisi",
    "coefficient of fluctuation": "düzgünsüzlük katsayısı",
    "driver's power": "tahrik gücü",
    "shaking force": "sarsma kuvveti",
    "mass centre": "kütle merkezi",
    "velocity or acceleration of a mass centre": "kütle merkezinin hızı ya da ivmesi",
    "joint force": "mafsal kuvveti",
    "normal force": "normal kuvvet",
    "couple": "kuvvet çifti",
    "driving force": "tahrik kuvveti",
    "driving torque": "tahrik momenti",
    "coordinate": "koordinat",
    "speed": "hız",
    "acceleration": "ivme",
    "phase": "faz",
    "mass": "kütle",
    "moment of inertia": "kütle atalet momenti",
    "gravity": "yerçekimi ivmesi",
    "load": "yük",
    "stiffness": "yay katsayısı",
    "free length": "serbest boy",
    "damping": "sönüm",
    "variable, coordinate, rate, force, output or summary": "değişken, koordinat, hız, kuvvet, çıktı ya da özet",
    "point or variable; or an assembly mode that is a result of [synthesis]": (
        "nokta ya da değişken; ya da [synthesis] sonucu olan bir montaj biçimi"
    ),
    # what keys hold that must not be missing
    "version of this format": "bu biçimin sürümü",
    "what is described": "ne tanımlandığı",
    'stem of the files that are built: letters, digits, "-" and "_"': (
        'üretilen dosyaların adı: harf, rakam, "-" ve "_"'
    ),
    "kind of the task": "görevin türü",
    "angles of the input from A0B0; of a function `f` the first and the last": (
        "girişin A0B0 doğrultusundan açıları; `f` fonksiyonunda ilk ve son"
    ),
    "angles of the output, likewise": "çıkışın açıları, aynı biçimde",
    "[first, last]": "[ilk, son]",
    "swing of the rocker": "sarkacın salınımı",
    "three poses of the body: [x, y, angle]": "cismin üç konumu: [x, y, açı]",
    "[x, y, angle]": "[x, y, açı]",
    "what is given of the first crank": "ilk krankın verilenleri",
    "and of the second": "ve ikincinin",
    "[x, y]": "[x, y]",
    "[beta2, beta3]": "[beta2, beta3]",
    "of the slider": "kızağın",
    "time of the slow way over that of the quick one": "yavaş yolun süresi bölü hızlınınki",
    "of the end of the lever": "kolun ucunun",
    "rigid links; the first is the ground": "rijit uzuvlar; ilki sabit uzuvdur",
    "its points, in its own frame": "noktaları, kendi ekseninde",
    "kind of the joint": "mafsalın türü",
    "the link that slides": "kayan uzuv",
    "the link that carries the line": "doğruyu taşıyan uzuv",
    "the point of `link` that stays on the line": "`link` uzvunun doğru üzerinde kalan noktası",
    "a point of the line: a point of `on`, or [x, y] in its frame": (
        "doğrunun bir noktası: `on` uzvunun noktası ya da [x, y]"
    ),
    "the point, of some other link, that moves along the line": "doğru boyunca hareket eden, başka bir uzvun noktası",
    "the wheel whose angle is meant": "açısı verilen çark",
    "the other wheel; the ground is a wheel that stands": "öteki çark; sabit uzuv duran bir çarktır",
    "angle(link) - angle(arm) = ratio * (angle(on) - angle(arm)) + phase, of gear wheels: negative where they mesh outside, "
    "positive in a ring": (
        "açı(link) - açı(arm) = ratio * (açı(on) - açı(arm)) + phase; dişlilerde: dıştan çalışırsa eksi, halkada artı"
    ),
    "angle(link) - angle(arm) = ratio * (angle(on) - angle(arm)) + phase, of a belt: negative where it is crossed": (
        "açı(link) - açı(arm) = ratio * (açı(on) - açı(arm)) + phase; kayışta: çaprazsa eksi"
    ),
    "the sliding joint that moves as the pinion turns": "pinyon döndükçe hareket eden kayar mafsal",
    "the pinion": "pinyon",
    "displacement = radius * (angle of link - angle of arm) + phase; negative for the other sense": (
        "ötelenme = radius * (link açısı - arm açısı) + phase; öteki yön için eksi"
    ),
    "what is driven, and its values": "ne tahrik edildiği ve değerleri",
    "how the way grows with the time": "yolun zamanla nasıl arttığı",
    "time from start to stop, in s": "başlangıçtan bitişe süre, s",
    '"rad/s" or "deg/s" or "rpm"; of a displacement "LENGTH UNIT/s"': (
        '"rad/s" ya da "deg/s" ya da "rpm"; ötelenmede "UZUNLUK BİRİMİ/s"'
    ),
    '"rad/s^2" or "deg/s^2" or "rpm/s"; of a displacement "LENGTH UNIT/s^2"': (
        '"rad/s^2" ya da "deg/s^2" ya da "rpm/s"; ötelenmede "UZUNLUK BİRİMİ/s^2"'
    ),
    "a list with one for each of `values`": "`values` içindeki her değere bir tane olan bir liste",
    "coefficient of fluctuation of speed that is allowed, (ω max − ω min)/ω mean": (
        "hızda izin verilen düzgünsüzlük katsayısı, (ω max − ω min)/ω ort"
    ),
    "the result that says it": "onu veren sonuç",
    "an expression over variables, dimensions and other outputs, or over summaries and dimensions": (
        "değişkenler, boyutlar ve başka çıktılar ya da özetler ve boyutlar üzerine bir ifade"
    ),
    "what is looked at over the whole sweep": "bütün hareket boyunca neye bakıldığı",
    "which number is taken": "hangi sayının alındığı",
    "the driver's symbol; for a summary one input and its values": "tahrikin simgesi; özet için bir giriş ve değerleri",
    "one input and its values": "bir giriş ve değerleri",
    "what stands in the cells": "hücrelerde ne olduğu",
    "from, to, step": "ilk, son, adım",
    "dimensions that vary, in their own units: [from, to, step], or as a table; the last one changes first": (
        "değişen boyutlar, kendi birimlerinde: [ilk, son, adım] ya da tablo olarak; önce sonuncusu değişir"
    ),
}
