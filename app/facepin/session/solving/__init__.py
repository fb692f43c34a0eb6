"""From pins to weights: the problem of a pose, its solution, and what keeps it calm."""
