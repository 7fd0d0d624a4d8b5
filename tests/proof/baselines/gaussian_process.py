"""What the base leaves, by a Gaussian process of the states: a law of any shape, without a name.

Source: Kennedy & O'Hagan, J. R. Stat. Soc. B 63(3), 425-464 (2001)
"""
import numpy as np
from sklearn.gaussian_process import GaussianProcessRegressor
from sklearn.gaussian_process.kernels import RBF, ConstantKernel, WhiteKernel

from table import linear

ROWS = 400  # learned from: a process costs their third power


def process(table):
    base = linear([])(table)
    some = np.linspace(0, table.y.size - 1, min(ROWS, table.y.size)).astype(int)
    scale = np.std(table.states, axis=0)
    scale[scale == 0] = 1
    left = table.y - base(table)
    size = np.std(left) or 1.0
    kernel = ConstantKernel(1.0) * RBF(np.ones(table.states.shape[1])) + WhiteKernel(1.0)
    fitted = GaussianProcessRegressor(kernel, random_state=0)
    fitted.fit(table.states[some] / scale, left[some] / size)
    return lambda rows: base(rows) + size * fitted.predict(rows.states / scale)
