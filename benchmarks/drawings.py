"""Random drawings by hand: how many are restored or refused, what is said of them, and how long it takes."""

import multiprocessing
import os
import time
from collections import Counter

from tests.drawings import hand_drawing, outcome

DRAWINGS = 500
LIMIT = 10  # s, for each


def rows():
    os.environ |= dict.fromkeys(["OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"], "1")  # for the processes to come
    with multiprocessing.get_context("spawn").Pool() as pool:
        answers = list(pool.imap(answered, range(DRAWINGS), chunksize=5))
    seeds = {word: [seed for seed, (one, _) in enumerate(answers) if one == word] for word, _ in answers}
    wrong = [seed for word, found in seeds.items() if word.startswith("wrong") for seed in found]
    yield f"{DRAWINGS} drawings by hand, answered wrongly", len(wrong), "", "", "0", "NO" if wrong else "yes", 1
    slowest = max(seconds for _, seconds in answers)
    yield "  the slowest", f"{slowest:.1f} s", "", "", f"<= {LIMIT} s", "NO" if slowest > LIMIT else "yes", 1
    for word, count in sorted(Counter(word for word, _ in answers).items()):
        yield f"  {word}", count, " ".join(map(str, seeds[word][:4])), "", "", "", 1


def answered(seed):
    drawing, began = hand_drawing(seed), time.perf_counter()
    try:
        word, _ = outcome(drawing)
    except Exception as error:  # noqa: BLE001 (whatever comes is a result)
        word = f"wrong: {type(error).__name__}: {error}"[:56]
    return word, time.perf_counter() - began
