"""The parts of one frame, which `facepin.main_loop` calls in order."""
