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
    "the sketch says nothing about group {group}: mode +1 was taken, {mode}; a point under [assembly] decides": (
        "eskiz {group}. grup için bir şey söylemiyor: +1 alındı, {mode}; [assembly] altında bir nokta karar verir"
    ),
    "{package} is not installed": "{package} kurulu değil",
    "{package} is not installed: {use}": "{package} kurulu değil: {use}",
    "it draws the pictures": "resimleri o çizer",
    "cannot be written: {reason}": "yazılamıyor: {reason}",
    "is not the name of a file in this folder": "bu klasörde bir dosyanın adı olamaz",
    "for example mine.toml": "örneğin benim.toml",
}
