"""Of the command line itself: options that do not go together, files that are not touched, what was done."""

from __future__ import annotations

COMMANDS: dict[str, str] = {
    "warning: {fault}": "uyarı: {fault}",
    "note: {text}": "not: {text}",
    "wrote {name}": "yazıldı: {name}",
    "stopped": "durduruldu",
    "the output cannot be written: {reason}": "çıktı yazılamıyor: {reason}",
    # what is being done
    "building": "kuruluyor",
    "solving": "çözülüyor",
    "drawing": "çiziliyor",
    "drawing dimensions": "boyutlar çekiliyor",
    "auditing": "inceleniyor",
    "comparing": "karşılaştırılıyor",
    "recalculating": "yeniden hesaplanıyor",
    "looking for edits": "değişiklikler aranıyor",
    "building and checking {template}": "{template} kuruluyor ve denetleniyor",
    "writing {what}": "{what} yazılıyor",
    # doctor
    "  a workbook of {template}, built and checked: {works}": "  {template} çalışma kitabı kuruldu ve denetlendi: {works}",
    "agrees with its numpy reference": "numpy referansıyla uyuşuyor",
    "DOES NOT AGREE: see mechsheet check": "UYUŞMUYOR: mechsheet check komutuna bakın",
    "  the command is not on the PATH: {starter} -m mechsheet does the same (or install it by pipx)": (
        "  komut PATH üzerinde değil: {starter} -m mechsheet aynı işi görür (ya da pipx ile kurun)"
    ),
    "There": "Var",
    "Missing": "Yok",
    "pictures and animations: mechsheet plot, .svg, .png and .gif": (
        "resimler ve canlandırmalar: mechsheet plot, .svg, .png ve .gif"
    ),
    "millions of designs: mechsheet study": "milyonlarca tasarım: mechsheet study",
    "studies on many machines": "birçok makinede çalışma",
    "motion.frame() in notebooks": "not defterlerinde motion.frame()",
    "drawings for CAD: mechsheet export --to dxf": "CAD çizimleri: mechsheet export --to dxf",
    "probabilities and Bessel functions in workbooks of others: mechsheet recalc": (
        "başkalarının çalışma kitaplarında olasılık ve Bessel fonksiyonları: mechsheet recalc"
    ),
    "one more judge: mechsheet check --with formulas": "bir hakem daha: mechsheet check --with formulas",
    "one more judge: mechsheet check --with ironcalc": "bir hakem daha: mechsheet check --with ironcalc",
    "one more judge: mechsheet check --with onlyoffice (100 MB, AGPL)": (
        "bir hakem daha: mechsheet check --with onlyoffice (100 MB, AGPL)"
    ),
    "opens workbooks; mechsheet check --with libreoffice": (
        "çalışma kitaplarını açar; mechsheet check --with libreoffice"
    ),
    "mechsheet check --with gnumeric": "mechsheet check --with gnumeric",
    # options
    'no command is called "{name}": {hint}': '"{name}" adlı komut yok: {hint}',
    "commands: {names}": "komutlar: {names}",
    "names no file": "bir dosya adı değil",
    "a null character stands in no file name": "bir dosya adında boş (NUL) karakter olmaz",
    "-o needs a template: mechsheet new four-bar -o mine.toml": (
        "-o için bir şablon gerekir: mechsheet new four-bar -o benim.toml"
    ),
    '"{pair}" is not NAME=VALUE': '"{pair}" AD=DEĞER biçiminde değil',
    "for example --set a1=65": "örneğin --set a1=65",
    "for example -o out.xlsx": "örneğin -o out.xlsx",
    "with --against there is a description already": "--against ile zaten bir tanım verilmiş",
    "a workbook is written to a file, not printed": "çalışma kitabı bir dosyaya yazılır, ekrana değil",
    "a design is built from a file": "bir tasarım dosyadan kurulur",
    "{file} differs from the description of the study: the design is built as it says now": (
        "{file} çalışmadaki tanımdan farklı: tasarım dosyanın şimdi dediği gibi kurulur"
    ),
    "several files are not printed": "birkaç dosya birden ekrana yazılmaz",
    "name a folder": "bir klasör adı verin",
    "for several formats name a folder, with a slash at its end": (
        "birkaç biçim için sonu / ile biten bir klasör adı verin"
    ),
    "--mutate goes with --seed and --json only": "--mutate yalnız --seed ve --json ile verilir",
    "{given} does not go with --perturb and --mutate": "{given}, --perturb ve --mutate ile verilmez",
    "{names}: only with --check": "{names}: yalnız --check ile",
    "{count} workbooks: one at a time is recalculated, several only with --check": (
        "{count} çalışma kitabı: bir kerede bir tanesi yeniden hesaplanır, birkaçı yalnız --check ile"
    ),
    "--check compares with the stored values, which know nothing of --set": (
        "--check kayıtlı değerlerle karşılaştırır, onların --set'ten haberi yoktur"
    ),
    "--check compares: it goes without --print and -o": "--check karşılaştırır: --print ve -o ile verilmez",
    "--update-baseline goes with --baseline FILE": "--update-baseline, --baseline DOSYA ile verilir",
    "which file is it to write?": "hangi dosyayı yazsın?",
    # files
    "{names} would both be written into this file": "{names}: ikisi de bu dosyaya yazılacaktı",
    "build them one by one, each with its own -o": "her birini kendi -o adıyla ayrı ayrı kurun",
    "is read here: it is not overwritten": "burada okunuyor: üzerine yazılmaz",
    "name another file with -o": "-o ile başka bir dosya adı verin",
    "name another file": "başka bir dosya adı verin",
    "this is written to a file, not printed": "bu bir dosyaya yazılır, ekrana değil",
    "/dev/stdout is a file too": "/dev/stdout da bir dosyadır",
    "there is a file already: it is left as it is": "bu adda bir dosya var: olduğu gibi bırakıldı",
    "choose another name with -o": "-o ile başka bir ad seçin",
    "choose another name, or name the same file with --into": (
        "başka bir ad seçin ya da aynı dosyayı --into ile verin"
    ),
    "a workbook ends with .xlsx or .ods": "çalışma kitabının uzantısı .xlsx ya da .ods olur",
    "no workbook ({names}) in this folder": "bu klasörde çalışma kitabı ({names}) yok",
    "{file} only marks a workbook that is open: passed over": (
        "{file} yalnız bir çalışma kitabının açık olduğunu gösterir: atlandı"
    ),
    "name a description, a .toml file": "bir tanımın, yani bir .toml dosyasının adını verin",
    "a workbook carries its description inside: mechsheet pull WORKBOOK -o mine.toml": (
        "çalışma kitabı tanımını içinde taşır: mechsheet pull KİTAP -o benim.toml"
    ),
    "its folder is not there": "klasörü yok",
    "nothing was changed": "hiçbir şey değiştirilmemiş",
    "{name}; first line of a description beside it: #:schema {schema}": (
        "{name}; yanındaki tanımın ilk satırı: #:schema {schema}"
    ),
    "{head}{line}": "{head}{line}",
    "Close the page to end, or press Ctrl-C here.": "Bitirmek için sayfayı kapatın ya da burada Ctrl-C'ye basın.",
    "No browser was found: open the address above in one on this machine.": (
        "Tarayıcı bulunamadı: yukarıdaki adresi bu makinedeki bir tarayıcıda açın."
    ),
    "{value} is no number": "{value} bir sayı değil",
    # accepted differences
    "{name}: {count} accepted": "{name}: {count} fark kabul edildi",
    "{name}: {file} {cell} is no longer needed": "{name}: {file} {cell} artık gerekmiyor",
    "--update-baseline takes out what is no longer needed: {count}": (
        "--update-baseline artık gerekmeyenleri çıkarır: {count}"
    ),
    "; notes: {count}": "; notlar: {count}",
    "{count} judges": "{count} hakem",
    "{file}: all agree, worst {worst:.0e} ({judges}){notes}": (
        "{file}: hepsi uyuşuyor, en büyük fark {worst:.0e} ({judges}){notes}"
    ),
    # a study
    "{count:,} design": "{count:,} tasarım",
    "{count:,} designs": "{count:,} tasarım",
    "{count:>16,} fail {condition}": "{count:>16,} tasarım şunu sağlamıyor: {condition}",
    "{kept:>16,} kept of {designs} ({share:.3g} %)": "{kept:>16,} kaldı, hepsi {designs} (%{share:.3g})",
    (
        "{count:>16,} of them set apart, not ranked: a number that decides is marked in the workbook (rows only, "
        "grows without bound)"
    ): (
        "{count:>16,} tanesi ayrıldı, sıralanmadı: belirleyici bir sayı çalışma kitabında işaretli (yalnız satırlar, "
        "sınırsız büyür)"
    ),
    "none of {designs} meets all conditions": "bütün koşulları sağlayan yok: {designs}",
    "each design is counted once, by the first condition that it fails:{lines}": (
        "her tasarım bir kez sayılır, sağlamadığı ilk koşulda:{lines}"
    ),
    "{above}\n{line}": "{above}\n{line}",
    "{done:,} of {designs}": "{done:,} / {designs}",
    ", {share:.3g} % kept": ", %{share:.3g} kaldı",
    ", {rate:,.0f}/s, {left} left": ", {rate:,.0f}/s, kalan {left}",
    # exercises
    "everybody has the same dimensions; under [exercise] for example: vary = {{ {names} }}": (
        "herkesin boyutları aynı; [exercise] altında örneğin: vary = {{ {names} }}"
    ),
    "no draw of {draws} meets it: {names}": "{draws} çekilişin hiçbiri bunu sağlamıyor: {names}",
    "wider ranges in vary": "vary içinde daha geniş aralıklar verin",
    "{identifier} has the same dimensions as {other}: the grid has no others": (
        "{identifier} ile {other} aynı boyutları aldı: aralıklarda başkası kalmadı"
    ),
}
