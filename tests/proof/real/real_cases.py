#!/usr/bin/python3
"""real_cases.py list: the cases of real machines, one line each.
real_cases.py NUMBER --data DATA --seed SEED --plants PLANTS --rvbench RVBENCH --out SEEN
--sealed SEALED: writes what the tool is shown of a case, and what others found in the recordings.

A plain case is the shipped plant beside the recordings as they came. A neutral one is the same in
other words: names without meaning, every quantity and the time in other measures, drawn from the
seed, so that no name and no number says which machine it is.
"""
import argparse
import json
import pathlib
import shutil
import subprocess
import sys

from neutral import neutral_emps, neutral_silverbox, neutral_ur10e

ROOT = pathlib.Path(__file__).resolve().parents[3]
FIRST_NUMBER = 161  # after those that are sealed

DRY_FRICTION = {"name": "coulomb_friction", "also": ["asymmetric_friction", "stribeck_friction"]}
CUBIC = {"name": "cubic_stiffness", "also": []}
TRUTHS = {  # what the publications say that the base lacks, the largest first
    "silverbox": [CUBIC],
    "emps": [DRY_FRICTION],
    "ur10e": [DRY_FRICTION],
    "oedi": [{"name": "slip", "also": []}],
    "cwru": [{"name": "bearing_defect", "also": []}],
}


def write_case(folder, plant, campaign):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "plant.json").write_text(json.dumps(plant, indent=1, ensure_ascii=False))
    (folder / "campaign.json").write_text(json.dumps(campaign, indent=1, ensure_ascii=False))


def campaign_of(name, data):
    """A campaign of tests/campaigns, its files where the data are."""
    text = (ROOT / "tests/campaigns" / f"{name}.json").read_text()
    return json.loads(text.replace("../../../shared/data", str(data.resolve())))


def plain(plant, campaign):
    def write(args):
        shown = json.loads((args.plants / f"{plant}.json").read_text())
        write_case(args.out, shown, campaign_of(campaign, args.data))
    return write


def bearing(args):
    """The housing is fitted to a sound bearing first."""
    sound = args.out / "sound"
    write_case(sound, json.loads((args.plants / "bearing_housing.json").read_text()),
               campaign_of("bearing_sound", args.data))
    subprocess.run([args.rvbench, "explain", "--plant", sound / "plant.json", "--rec",
                    sound / "campaign.json", "--out", sound / "said"], check=True,
                   capture_output=True)
    fitted = json.loads((sound / "said/plant_updated.json").read_text())
    write_case(args.out, fitted, campaign_of("bearing_inner_race", args.data))
    shutil.rmtree(sound)


def neutral(make):
    def write(args):
        write_case(args.out, *make(args.data, args.plants, args.seed, args.out))
    return write


CASES = [("silverbox", "", plain("silverbox", "silverbox")),
         ("emps", "", plain("emps", "emps")),
         ("ur10e", "", plain("ur10e_joint", "ur10e_joint_1")),
         ("oedi", "", plain("oedi_gearbox", "oedi")),
         ("cwru", "", bearing),
         ("silverbox", "neutral", neutral(neutral_silverbox)),
         ("emps", "neutral", neutral(neutral_emps)),
         ("ur10e", "neutral", neutral(neutral_ur10e))]


def main():
    if sys.argv[1:] == ["list"]:
        for i, (machine, variant, _) in enumerate(CASES):
            print(FIRST_NUMBER + i, "real", machine, variant)
        return
    parser = argparse.ArgumentParser()
    parser.add_argument("number", type=int)
    parser.add_argument("--seed", type=int, required=True)
    for path in ("data", "plants", "rvbench", "out", "sealed"):
        parser.add_argument(f"--{path}", type=pathlib.Path, required=True)
    args = parser.parse_args()
    machine, variant, write = CASES[args.number - FIRST_NUMBER]
    write(args)
    args.sealed.mkdir(parents=True, exist_ok=True)
    answer = {"case": args.number, "kind": "real", "machine": machine, "variant": variant,
              "seed": args.seed, "effects": TRUTHS[machine]}
    (args.sealed / f"{args.number}.json").write_text(json.dumps(answer, indent=1) + "\n")


if __name__ == "__main__":
    main()
