#!/usr/bin/python3
"""run.py SEEN ANSWER.json: what methods without a model of the machine make of a case.

SEEN holds what rvbench explain is given: plant.json and recording.h5 or campaign.json.
"""
import json
import pathlib
import sys
import warnings

import numpy as np

from bench_table import bench_table
from frols import frols
from gaussian_process import process
from sindy import sindy
from slide_table import slide_table
from table import left_out_error, left_over, linear


def fingerprint(table):
    """Of what the base leaves, the share that each law could do by itself."""
    left = left_over(table)
    shares = {}
    for name in table.library:
        after = table.y - linear([name])(table)(table)
        shares[name] = float(1 - np.sum(after**2) / np.sum(left**2))
    return shares


def main(seen, answer):
    warnings.simplefilter("ignore")
    is_bench = (seen / "recording.h5").exists()
    table = bench_table(seen) if is_bench else slide_table(seen)
    before = left_out_error(table, linear([]))
    said = {"fingerprint": fingerprint(table)}
    for method in (sindy, frols):
        names = method(table)
        said[method.__name__] = {"names": names,
                                 "remaining": left_out_error(table, linear(names)) / before}
    after = left_out_error(table, process)
    said["gaussian_process"] = {"names": None, "remaining": after / before}
    answer.write_text(json.dumps(said, indent=2) + "\n")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
