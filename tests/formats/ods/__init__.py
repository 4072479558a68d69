"""Tests of formats/ods: a package, because modules of both formats have the same names."""
