"""Solver, trade and tidying."""
