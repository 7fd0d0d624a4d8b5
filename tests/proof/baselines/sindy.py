"""Sparse identification: least squares, sequentially without what is small.

Source: Brunton, Proctor & Kutz, PNAS 113(15), 3932-3937 (2016)
"""
import numpy as np

from table import left_out_error, linear, solve

THRESHOLDS = (0.02, 0.05, 0.1, 0.2, 0.4)  # of what the base leaves, that a law has to move
ROUNDS = 10


def survivors(table, threshold):
    names = list(table.library)
    size = np.std(table.y - linear([])(table)(table))
    for _ in range(ROUNDS):
        weights = solve(table.columns(names), table.y)
        at, kept = table.base.shape[1], []
        for name in names:
            columns = table.library[name]
            moves = columns @ weights[at:at + columns.shape[1]]
            at += columns.shape[1]
            if np.sqrt(np.mean(moves**2)) > threshold * size:
                kept.append((np.sqrt(np.mean(moves**2)), name))
        if len(kept) == len(names):
            break
        names = [name for _, name in kept]
    return [name for _, name in sorted(kept, reverse=True)] if names else []


def sindy(table):
    """The threshold is the one whose laws predict left-out conditions best."""
    tried = [survivors(table, threshold) for threshold in THRESHOLDS] + [[]]
    return min(tried, key=lambda names: (left_out_error(table, linear(names)), len(names)))
