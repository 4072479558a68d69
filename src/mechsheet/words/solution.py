"""Words of the written solution."""

from __future__ import annotations

from mechsheet.model import Words

SOURCE = Words("Source", "Kaynak")
GIVEN = Words("Given", "Verilenler")
SYMBOL = Words("symbol", "simge")
VALUE = Words("value", "değer")
MEANING = Words("meaning", "anlamı")
FOLLOWS = Words("From these follow", "Bunlardan elde edilenler")
DRIVER = Words("Driver", "Giriş")
DRIVEN = Words("The position is solved for one value of the driver:", "Konum, girişin bir değeri için çözülmektedir:")
LOOP = Words("Loop closure", "Devre kapalılığı")
VECTORS = Words("The loop as vectors, and in complex form:", "Devre, vektörlerle ve karmaşık sayılarla:")
COMPLEX = Words("The loop in complex form:", "Devre, karmaşık sayılarla:")
SCALARS = Words("Its real and imaginary parts:", "Gerçel ve sanal kısımlar:")
UNKNOWNS = Words("Unknown in it:", "Bilinmeyenler:")
STEPS = Words("Solution", "Çözüm")
CHECK = Words("Check with numbers", "Sayılarla sağlama")
VECTOR = Words("vector", "vektör")
LENGTH = Words("length", "uzunluk")
ANGLE = Words("angle", "açı")
REAL, IMAGINARY = Words("real part", "gerçel kısım"), Words("imaginary part", "sanal kısım")
LEFT, RIGHT = Words("left side", "sol taraf"), Words("right side", "sağ taraf")
CAM = Words("Cam", "Kam")
OUTPUTS = Words("Outputs", "Çıktılar")
RESULT = Words("Result", "Sonuç")
GROUP = Words("Group", "Grup")
AND = Words("and", "ve")
MODE = Words("assembly mode", "montaj biçimi")
TURNS = Words(
    "whole turns that keep the angle continuous from the first row of the sweep on, here",
    "açının ilk satırdan başlayarak sürekli olmasını sağlayan tam tur sayısı, burada",
)
HOW = Words(
    "Every number is computed with all its digits and shown rounded. arctan2(x; y) is the direction of the vector "
    "(x, y), x first, between −180° and 180°.",
    "Bütün sayılar tüm basamaklarıyla hesaplanmış, yuvarlanarak gösterilmiştir. arctan2(x; y), (x, y) vektörünün "
    "doğrultusudur: önce x yazılır, değeri −180° ile 180° arasındadır.",
)
UNITS = Words("Lengths are in {unit}.", "Uzunluklar {unit} birimindedir.")

KINDS = {
    "RRR": Words(
        "The sides of the triangle {0}{1}{2} are known: two of the links, and the distance of {1} and {0}. The law of "
        "cosines gives its angles; written with the triangle's area (Heron's formula) it keeps its digits at dead centres.",
        "{0}{1}{2} üçgeninin kenarları bilinmektedir: uzuvlarda ikisi, bir de {1} ile {0} arasındaki uzaklık. Açıları "
        "kosinüs teoremi verir; üçgenin alanıyla (Heron bağıntısı) yazılınca ölü konumlarda basamak yitirmez.",
    ),
    "RRP": Words(
        "{1} moves on a known line. Across the line the equation gives the direction of the link, along it the "
        "displacement.",
        "{1} bilinen bir doğru üzerinde hareket eder. Denklem, doğruya dik yönde uzvun doğrultusunu, doğru boyunca "
        "ötelenmeyi verir.",
    ),
    "RPR": Words(
        "The vector from {0} to {1} is known in length and direction. The sliding joint lies along it but for a constant "
        "offset; this gives the direction and the displacement.",
        "{0} noktasından {1} noktasına giden vektörün boyu ve doğrultusu bilinmektedir. Kayar mafsal, sabit bir kaçıklık "
        "dışında, bu doğrultudadır; doğrultu ve ötelenme buradan bulunur.",
    ),
    "PRP": Words(
        "The guides give the angles; the two equations are linear in the displacements (Cramer's rule).",
        "Açıları kızaklar belirler; iki denklem ötelenmelerde doğrusaldır (Cramer kuralı).",
    ),
    "RPP": Words(
        "The guides give the angles; the two equations are linear in the displacements (Cramer's rule).",
        "Açıları kızaklar belirler; iki denklem ötelenmelerde doğrusaldır (Cramer kuralı).",
    ),
}
"""How each dyad is solved; {0}, {1}, {2} are its pins."""
