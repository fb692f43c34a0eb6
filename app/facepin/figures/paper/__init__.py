"""The figures of the paper, made anew."""
