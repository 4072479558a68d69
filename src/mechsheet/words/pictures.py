"""Words of the page that the workbook does not have."""

from __future__ import annotations

from mechsheet.model import Words

PLAY = Words("Play", "Oynat")
PAUSE = Words("Pause", "Durdur")
POSITION = Words("Position", "Konum")
SOURCE = Words("Source", "Kaynak")
CURVES = Words("Curves", "Eğriler")
DRAWING = Words("Drawing", "Çizim")
HELP = Words(
    "Drag the slider, or move it with the arrow keys, Page Up, Page Down, Home and End.",
    "Sürgüyü fareyle ya da ok, Page Up, Page Down, Home ve End tuşlarıyla hareket ettirin.",
)
NO_SCRIPT = Words(
    "Without JavaScript the page shows this one position.",
    "JavaScript olmadan sayfa yalnızca bu konumu gösterir.",
)

SPRING = Words("spring {name}", "{name} yayı")
DAMPER = Words("damper {name}", "{name} sönümleyicisi")
LOAD = Words("load {name}", "{name} yükü")
CYLINDER = Words("cylinder of {symbol}", "{symbol} silindiri")
MASS_CENTRE = Words("mass centre of {link}", "{link} kütle merkezi")
WEIGHT = Words("weight of {link}", "{link} ağırlığı")
FORCES = Words("Forces, and where each is largest", "Kuvvetler ve her birinin en büyük olduğu yer")
