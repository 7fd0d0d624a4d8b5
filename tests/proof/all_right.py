#!/usr/bin/python3
"""all_right.py PROOF_FOLDER: exits with 1 if one of the cases was not answered rightly."""
import pathlib
import sys

from marks import mark_case, read_cases

rows = [mark_case(*case) for case in read_cases(pathlib.Path(sys.argv[1]))]
for row in rows:
    print(row["case"], row["kind"], "+".join(row["truth"]) or "-", row["verdict"], row["said"],
          "" if row["right"] else "<- not right")
sys.exit(not rows or not all(row["right"] for row in rows))
