"""Studies of the solvers without a human: a simulated animator, and drags one by one."""
