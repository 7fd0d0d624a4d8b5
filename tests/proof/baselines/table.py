"""What a regression sees of a case: a column to explain, what the plant has, what it may lack."""
import dataclasses

import numpy as np


@dataclasses.dataclass
class Table:
    y: np.ndarray  # n values to explain
    base: np.ndarray  # n × b: what the plant has
    library: dict  # name -> n × c: what it may lack
    condition: np.ndarray  # n labels: rows that are left out together
    states: np.ndarray  # n × s: what an unknown law may depend on

    def rows(self, chosen):
        return Table(self.y[chosen], self.base[chosen],
                     {name: columns[chosen] for name, columns in self.library.items()},
                     self.condition[chosen], self.states[chosen])

    def columns(self, names):
        return np.column_stack([self.base, *(self.library[name] for name in names)])


def solve(columns, y):
    """Least squares. Columns of different units are scaled first."""
    scale = np.linalg.norm(columns, axis=0)
    scale[scale == 0] = 1
    return np.linalg.lstsq(columns / scale, y, rcond=1e-10)[0] / scale


def left_out_error(table, fit):
    """Root mean square of what is predicted under each condition from the others.

    fit  table -> function of a table that predicts its y
    """
    squares = 0.0
    for condition in np.unique(table.condition):
        out = table.condition == condition
        predict = fit(table.rows(~out))
        squares += np.sum((table.y[out] - predict(table.rows(out))) ** 2)
    return float(np.sqrt(squares / table.y.size))


def linear(names):
    """A fit by the base and some effects of the library."""
    def fit(table):
        weights = solve(table.columns(names), table.y)
        return lambda rows: rows.columns(names) @ weights
    return fit


def left_over(table):
    """What the base alone leaves."""
    return table.y - table.base @ solve(table.base, table.y)
