"""Hard use by chance, for as long as one likes: run as programs, `PYTHONPATH=tests python -m fuzz`.

`fuzz` breaks files, `fuzz.systems` draws systems for solvers, `fuzz.soak` uses the window.
"""
