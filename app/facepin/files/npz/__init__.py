"""Rigs as arrays."""
