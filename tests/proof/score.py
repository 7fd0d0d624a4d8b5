#!/usr/bin/python3
"""score.py PROOF_FOLDER... [--html FILE] [--readme FILE]: opens the seals, and says what rvbench
explain made of them.

A PROOF_FOLDER holds, per case N: sealed/N.json, said/N.json (explain.json), said/N.run (seconds,
exit code and the SHA-256 of both) and said/N.baselines.json; several are parts of one proof. Prints
a line per case, and the card, with what the baselines make of the same cases beside it. --html
writes a page with plots, --readme puts the card between the marks in that file, if all cases of one
seed were asked of one rvbench.
"""
import argparse
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from baselines_said import baselines_said
from card import card_lines, card_markdown
from marked_block import put_into
from marks import mark_case, read_cases

ALL_CASES = 168


def line_of(row):
    mark = "" if row["right"] else "  <- not right"
    said = " + ".join("|".join(names) for names in row["said"]) or "-"
    snr = f" {row['snr_dB']:.0f} dB" if row.get("snr_dB") is not None else ""
    machine = f"{row['machine']} {row['variant']}".strip()
    return (f"{row['case']:4} {row['kind']:8} {machine:21} {'+'.join(row['truth']) or '-'}{snr}: "
            f"{row['verdict']} {said} ({row['seconds']:.0f} s){mark}")


def print_card(rows, baselines):
    print(f"{'':44} {'rvbench explain':30} {'target':18} {'':8}" +
          "".join(f"{method:>20}" for method in baselines))
    for quantity, value, target, met, others in card_lines(rows, baselines):
        print(f"{quantity:44} {value:30} {target:18} {'' if met else 'NOT MET':8}" +
              "".join(f"{other:>20}" for other in others))


def check_whole(cases, is_published):
    """One answer to each case, all of one seed and one tool; and to all cases, for the README."""
    numbers = [sealed["case"] for sealed, _, _ in cases]
    if len(set(numbers)) < len(numbers):
        sys.exit("score: a case was answered twice: the folders overlap")
    if len({sealed["seed"] for sealed, _, _ in cases}) > 1:
        sys.exit("score: the cases are of several seeds")
    if len({run.get("sealer_sha256") for _, _, run in cases}) > 1:
        sys.exit("score: the cases were sealed by several sealers")
    tools = {run["rvbench_sha256"] for _, _, run in cases}
    missing = ALL_CASES - len(numbers)
    print(f"{len(numbers)} of {ALL_CASES} cases, answered by "
          f"{' and '.join(f'rvbench {tool[:12]}' for tool in sorted(tools))}\n")
    if is_published and (missing or len(tools) > 1):
        sys.exit("score: the README gets the card of all cases, answered by one rvbench")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folders", type=pathlib.Path, nargs="+", metavar="PROOF_FOLDER")
    parser.add_argument("--html", type=pathlib.Path)
    parser.add_argument("--readme", type=pathlib.Path)
    args = parser.parse_args()
    cases = [case for folder in args.folders for case in read_cases(folder)]
    check_whole(cases, args.readme is not None)
    rows = sorted((mark_case(*case) for case in cases), key=lambda row: row["case"])
    baselines = {method: [mark_case(*case) for case in of_method]
                 for method, of_method in baselines_said(args.folders, cases).items()}
    for row in rows:
        print(line_of(row))
    print()
    print_card(rows, baselines)
    if args.html:
        from page import page  # matplotlib takes a second
        args.html.write_text(page(rows, baselines))
        print(f"\nPage: {args.html}")
    if args.readme:
        put_into(args.readme, "proof", card_markdown(rows, baselines))


if __name__ == "__main__":
    main()
