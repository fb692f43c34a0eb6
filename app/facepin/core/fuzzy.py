"""Finding a phrase by some of its letters, as in the command palettes of text editors."""

WORD_START, CAPITAL, CONSECUTIVE, LETTER = 10.0, 8.0, 9.0, 1.0
"""What a letter is worth: that begins a word, that is a capital inside of one, that follows the letter found
before it, and any other."""
GAP = 1.0
"""What each letter skipped between two found ones costs, up to `LONGEST_GAP` of them."""
LONGEST_GAP = 6
LEAST = 1.5
"""What each letter has to be worth on average: less is a phrase that has them somewhere, by chance."""
WHOLE_WORD = 5.0
"""What it is worth that a word was typed from its beginning to its end."""

Way = tuple[float, tuple[int, ...]]
"""How well the letters fit, and which ones of the phrase they are."""
_NONE: Way = (float("-inf"), ())


def match(word: str, phrase: str) -> Way | None:
    """Find the letters of a word in a phrase, in order, where they fit best.

    Parameters
    ----------
    word : str
        Some letters of what is meant ("wf" or "wire" for "Wireframe"); case is ignored.
    phrase : str
        What may be meant.

    Returns
    -------
    (float, tuple of int) or None
        How well it fits (more is better), and which letters of `phrase` were found, ascending; None when they
        are not all there, or scattered by chance, or `word` is empty.
    """
    letters, worths = phrase.lower(), _worths(phrase)
    ways: list[Way] = []  # the best way that ends at each letter of the phrase
    for number, wanted in enumerate(word.lower()):
        longer = []
        for at, letter in enumerate(letters[: len(worths)]):
            best = _NONE
            if letter == wanted and number == 0:
                best = (worths[at], (at,))
            elif letter == wanted:
                best = max((_step(way, at, worths[at]) for way in ways[:at]), default=_NONE)
            longer.append(best)
        ways = longer
    worth, found = max(ways, default=_NONE)
    if worth < LEAST * len(word) or not found:
        return None
    first, last = found[0], found[-1]
    ends = last + 1 == len(phrase) or not phrase[last + 1].isalnum()
    if ends and worths[first] == WORD_START and len(found) == last - first + 1:
        worth += WHOLE_WORD
    return worth, found


def _step(way: Way, at: int, worth: float) -> Way:
    """Return a way that goes on with the letter at `at`."""
    total, found = way
    if not found:
        return _NONE
    gap = at - found[-1] - 1
    gain = max(worth, CONSECUTIVE) if gap == 0 else worth - GAP * min(gap, LONGEST_GAP)
    return total + gain, (*found, at)


def _worths(phrase: str) -> list[float]:
    """Return what each letter is worth by where it stands."""
    worths = []
    for before, letter in zip(" " + phrase, phrase, strict=False):
        if letter.isalnum() and not before.isalnum():
            worths.append(WORD_START)
        elif letter.isupper() and not before.isupper():
            worths.append(CAPITAL)
        else:
            worths.append(LETTER)
    return worths
