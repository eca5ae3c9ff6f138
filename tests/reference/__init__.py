"""Slow reference code, written straight from the definitions; it shares nothing with the library it judges."""
