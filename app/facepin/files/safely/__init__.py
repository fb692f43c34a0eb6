"""What every reader and writer stands on: whole writes, locks, checked JSON."""
