"""What is being posed: drag tool, solving, panes and undo history.  No window, no GL."""
