"""Tests of formats/xlsx: a package, because modules of both formats have the same names."""
