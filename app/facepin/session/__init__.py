"""What is being posed: the drag tool, the solving of its pins, panes and the undo history.  No window, no GL."""
