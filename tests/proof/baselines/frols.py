"""Forward regression by orthogonal least squares, as long as Schwarz's criterion falls.

Source: Chen, Billings & Luo, Int. J. Control 50(5), 1873-1896 (1989); Schwarz, Ann. Stat. 6(2),
        461-464 (1978)
"""
import numpy as np

from table import linear


def criterion(table, names):
    left = table.y - linear(names)(table)(table)
    n = table.y.size
    return n * np.log(np.mean(left**2)) + table.columns(names).shape[1] * np.log(n)


def frols(table):
    names, best = [], criterion(table, [])
    while len(names) < len(table.library):
        further = [(criterion(table, names + [name]), name)
                   for name in table.library if name not in names]
        value, name = min(further)
        if value >= best:
            break
        names, best = names + [name], value
    return names
