"""Of studies: many designs, their folder, the processes and machines that compute them."""

from __future__ import annotations

STUDIES: dict[str, str] = {
    "the description has no part [study]": "tanımda [study] kısmı yok",
    "[study] vary = { … }": "[study] vary = { … }",
    'every study has a column "{name}" of its own': 'her çalışmanın kendi "{name}" sütunu vardır',
    "give it another name in the description": "tanımda ona başka bir ad verin",
    "a study does not solve links that must be found all at once: {group}": (
        "bir çalışma, hep birden bulunması gereken uzuvları çözmez: {group}"
    ),
    "`mechsheet build --set` builds one design at a time": "`mechsheet build --set` her seferinde bir tasarım kurar",
    "the dimensions that a synthesis finds vary here, and its assembly with them": (
        "sentezin bulduğu boyutlar burada değişiyor, onlarla birlikte montajı da"
    ),
    "vary what the synthesis does not read": "sentezin okumadığı değerleri değiştirin",
    "the driver's values follow {moved}, which vary here: each design would have its own rows": (
        "tahrikin değerleri burada değişen {moved} boyutuna bağlı: her tasarımın satırları ayrı olurdu"
    ),
    "give [driver] start, stop and step as numbers": "[driver] altında start, stop ve step değerlerini sayı olarak verin",
    'a study does not find "{of}", of which "{name}" is': 'bir çalışma "{of}" değerini bulmaz, "{name}" ise onun özetidir',
    "leave it out of [summary] for the study": "çalışma için onu [summary] altında yazmayın",
    'no four-bar loop is called "{name}"': '"{name}" adlı dört-çubuk devresi yok',
    "{near} {hint}": "{near} {hint}",
    "loops: {known}": "devreler: {known}",
    "it has no four-bar loop on the ground": "sabit uzuvda dört-çubuk devresi yok",
    'the ground "{ground}" does not turn': 'sabit uzuv "{ground}" dönmez',
    # its folder
    "is a file: a study is written into a folder": "bir dosya: çalışma bir klasöre yazılır",
    "this study has been begun here": "bu çalışmaya burada başlanmış",
    "go on with --resume, or name another folder with -o": "--resume ile sürdürün ya da -o ile başka klasör verin",
    "there is no study to resume": "sürdürülecek çalışma yok",
    "leave --resume out to begin it": "başlatmak için --resume yazmayın",
    "holds other files, and no study": "içinde başka dosyalar var, çalışma yok",
    "name a new or an empty folder with -o": "-o ile yeni ya da boş bir klasör verin",
    "name another folder with -o": "-o ile başka klasör verin",
    "another study is being computed in this folder": "bu klasörde şu anda başka bir çalışma hesaplanıyor",
    "wait for its end, or name another folder with -o": "bitmesini bekleyin ya da -o ile başka klasör verin",
    "another study has written into this folder at the same time": "bu klasöre aynı anda başka bir çalışma yazmış",
    "go on with --resume: parts that are not of this study are computed again": (
        "--resume ile sürdürün: bu çalışmanın olmayan parçalar yeniden hesaplanır"
    ),
    "the study was begun with {others}: its end might differ from its beginning": (
        "çalışmaya {others} ile başlanmış: sonu başına uymayabilir"
    ),
    "go on with these releases, on a processor that computes alike, or begin anew in another folder": (
        "bu sürümlerle, aynı hesaplayan bir işlemcide sürdürün ya da başka klasörde yeniden başlayın"
    ),
    "is the folder of another study: it differs in {differing}": "başka bir çalışmanın klasörü: farkı {differing}",
    "the folder that mechsheet study wrote": "mechsheet study komutunun yazdığı klasör",
    "is no manifest of a study": "bir çalışmanın künyesi değil",
    "is no manifest of a study that this program knows": "bu programın tanıdığı bir çalışma künyesi değil",
    '"{given}" is not FOLDER:NUMBER': '"{given}" KLASÖR:NUMARA biçiminde değil',
    "the folder of a study and a design's number in it: wiper:17": (
        "çalışmanın klasörü ve içindeki bir tasarımın numarası: wiper:17"
    ),
    "the folder's description has no part [study]": "klasördeki tanımda [study] kısmı yok",
    "there is no design {number}: they go from 1 to {total:,}": "{number} numaralı tasarım yok: 1 ile {total:,} arası",
    # processes and machines
    '"{size}" is no size': '"{size}" bir büyüklük değil',
    "for example 2GiB or 500MB": "örneğin 2GiB ya da 500MB",
    "at least 1 process, not {workers}": "en az 1 süreç, {workers} değil",
    "cannot be read again": "yeniden okunamıyor",
    "is the disk full?": "disk dolu mu?",
    "{memory:.0f} MiB are too little: one process needs {least} MiB": (
        "{memory:.0f} MiB çok az: bir süreç {least} MiB ister"
    ),
    "a process of the study was ended from outside, perhaps for want of memory": (
        "çalışmanın bir süreci dışarıdan sonlandırıldı, belki bellek yetmedi"
    ),
    "what is done is kept: go on with --resume, with fewer --workers": (
        "yapılanlar duruyor: --resume ile, daha az --workers vererek sürdürün"
    ),
    "what is done is kept: go on with --resume": "yapılanlar duruyor: --resume ile sürdürün",
    "the scheduler has no workers after {seconds} s": "{seconds} s sonra zamanlayıcının hâlâ işçisi yok",
    "dask worker {address}": "dask worker {address}",
    "a worker would not compute the same bytes: {differing}": "bir işçi aynı baytları hesaplamazdı: {differing}",
    "the same releases, on processors that compute alike": "aynı sürümler, aynı hesaplayan işlemcilerde",
    "the cluster has given a part up: {reason}": "küme bir parçadan vazgeçti: {reason}",
    "cannot be reached: {reason}": "ulaşılamıyor: {reason}",
    "nobody answers within {seconds} s": "{seconds} s içinde yanıt yok",
    "the address that `dask scheduler` prints, for example tcp://10.0.0.5:8786": (
        "`dask scheduler` komutunun yazdığı adres, örneğin tcp://10.0.0.5:8786"
    ),
}
