Private Function {name}(ByVal index As Long, ByVal arguments As Variant) As Variant
    Dim asked({arguments}) As Double, i As Long, same As Boolean, again As Boolean
    {name} = CVErr(xlErrNA)
    On Error GoTo NoPosition
    For i = 0 To {arguments}
        asked(i) = arguments(i)
    Next i
    same = {name}_kept
    again = {name}_kept
    For i = 0 To {arguments}
        If asked(i) <> {name}_asked(i) Then
            again = False
            If i < {first} Or i > {last} Then same = False
        End If
        {name}_asked(i) = asked(i)
    Next i
    {name}_kept = False
    If Not again Then
        {name}_found = False
        If Not same Then {name}_begun = {name}_Begin(asked)
        If {name}_begun Then {name}_found = {name}_Go(asked)
    End If
    {name}_kept = True
    If {name}_found Then {name} = {name}_x(index)
NoPosition:
End Function

Private Function {name}_Begin(asked() As Double) As Boolean
    Dim x({unknowns}) As Double, before({unknowns}) As Double, earlier({unknowns}) As Double
    Dim here({here}) As Double, given({given}) As Double, correction({unknowns}) As Double
    Dim residual As Double, determinant As Double, first As Double, steady As Double
    Dim share As Double, pass As Long, i As Long
@declared
    On Error GoTo NoPosition
    Select Case Int(asked({mode}) + 0.5)
@starts
    Case Else
        Exit Function
    End Select
    If Not {name}_Still(asked) Then Exit Function
@at_home
    For pass = 0 To {first_passes}
        share = MinOf(pass / {led}, 1)
@way
        If Not {name}_Given(here, given) Then Exit Function
        If Not {name}_Pass(x, given, correction, residual, determinant) Then Exit Function
        If pass = 0 Then first = determinant
        If pass = 1 Then steady = MaxOf({steady} * residual, {settled})
        If Not (determinant * first > 0) Then Exit Function
        If pass > 1 Then
            If Not (residual < steady) Then Exit Function
@trends
        End If
        If pass < {first_passes} Then
            For i = 0 To {unknowns}
                earlier(i) = before(i)
                before(i) = x(i)
                x(i) = x(i) - correction(i)
            Next i
        End If
    Next pass
    If Not (residual <= {closed}) Then Exit Function
    For i = 0 To {unknowns}
        {name}_home(i) = x(i)
    Next i
    {name}_sign = Sgn(determinant)
    {name}_Return
    {name}_Begin = True
NoPosition:
End Function

Private Sub {name}_Return()
    Dim i As Long
    {name}_made = 0
    For i = 0 To {unknowns}
        {name}_last(i) = {name}_home(i)
        {name}_before(i) = {name}_home(i)
    Next i
End Sub

Private Function {name}_Go(asked() As Double) As Boolean
    Dim place({drives}) As Double, stride({drives}) As Double, far As Double, steps As Long
    Dim i As Long, same As Boolean
    On Error GoTo NoPosition
@far
    If Not (far < {farthest}) Then Exit Function
    steps = MaxOf(1, -Int(0.000000001 - far))
@strides
    same = {name}_made < steps
    For i = 0 To {drives}
        If stride(i) <> {name}_stride(i) Then same = False
        {name}_stride(i) = stride(i)
    Next i
    If Not same Then {name}_Return
    Do While {name}_made < steps - 1
@next
        If Not {name}_Step(asked, place, 1) Then Exit Function
        For i = 0 To {unknowns}
            {name}_before(i) = {name}_last(i)
            {name}_last(i) = {name}_x(i)
        Next i
        {name}_made = {name}_made + 1
    Loop
    For i = 0 To {drives}
        place(i) = asked({first} + i)
    Next i
    {name}_Go = {name}_Step(asked, place, {share})
NoPosition:
End Function

Private Function {name}_Step(asked() As Double, place() As Double, ByVal share As Double) As Boolean
    Dim x({unknowns}) As Double, here({here}) As Double, given({given}) As Double, pass As Long, i As Long
    Dim correction({unknowns}) As Double, residual As Double, determinant As Double
@declared
    For i = 0 To {stays}
        here(i) = {name}_there(i)
    Next i
    For i = 0 To {drives}
        here({still} + i) = place(i)
    Next i
@on_the_way
    If Not {name}_Given(here, given) Then Exit Function
    For i = 0 To {unknowns}
        x(i) = {name}_last(i)
    Next i
    For pass = 1 To {passes}
        If Not {name}_Pass(x, given, correction, residual, determinant) Then Exit Function
        For i = 0 To {unknowns}
            x(i) = x(i) - correction(i)
        Next i
    Next pass
    If Not {name}_Pass(x, given, correction, residual, determinant) Then Exit Function
    If Not (residual <= {closed} And determinant * {name}_sign > 0) Then Exit Function
@leaps
    For i = 0 To {unknowns}
        {name}_x(i) = x(i)
    Next i
    {name}_Step = True
End Function
