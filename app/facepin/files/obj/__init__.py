"""Folders of OBJ files."""
