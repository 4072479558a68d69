"""Tests of formats/reading: a package, because modules of both formats have the same names."""
