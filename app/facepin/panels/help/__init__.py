"""Guide, keyboard, palette, about."""
