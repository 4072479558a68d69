Private Function PiValue() As Double
    PiValue = 4 * Atn(1)
End Function

Private Function MaxOf(ByVal x As Double, ByVal y As Double) As Double
    If x > y Then MaxOf = x Else MaxOf = y
End Function

Private Function MinOf(ByVal x As Double, ByVal y As Double) As Double
    If x < y Then MinOf = x Else MinOf = y
End Function

Private Function Modulo(ByVal x As Double, ByVal y As Double) As Double
    Modulo = x - y * Int(x / y)
End Function

Private Function ArcSin(ByVal x As Double) As Variant
    If Abs(x) > 1 Then
        ArcSin = CVErr(xlErrNA)
    ElseIf Abs(x) = 1 Then
        ArcSin = x * 2 * Atn(1)
    Else
        ArcSin = Atn(x / Sqr((1 - x) * (1 + x)))
    End If
End Function

Private Function ArcCos(ByVal x As Double) As Variant
    If Abs(x) > 1 Then
        ArcCos = CVErr(xlErrNA)
    ElseIf x = -1 Then
        ArcCos = 4 * Atn(1)
    Else
        ArcCos = 2 * Atn(Sqr((1 - x) / (1 + x)))
    End If
End Function
