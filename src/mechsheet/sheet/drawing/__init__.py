"""The drawing and the charts, and the sheet of numbers behind them."""
