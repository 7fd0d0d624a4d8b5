"""The proof as a page: the card, how naming falls with the noise, sizes beside the truth, every case."""
import base64
import html
import io

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

from card import card_lines, wilson  # noqa: E402

STEPS_DB = (-10, -3, 3, 10, 20)  # as cases are planned; each takes what lies nearest
OWN = "rvbench explain"
LARGEST_SIZE = 2.5  # of what is drawn, in true sizes
STYLE = """
body { font: 15px/1.45 system-ui, sans-serif; margin: 2rem auto; max-width: 70rem; padding: 0 1rem;
       color: #1a1a1a; background: #fff; }
table { border-collapse: collapse; width: 100%; font-size: 13px; }
td, th { text-align: left; padding: .25rem .5rem; border-bottom: 1px solid #ddd; }
.no { color: #b00020; font-weight: 600; }
.plots { display: flex; flex-wrap: wrap; gap: 1rem; }
.plots img { max-width: 100%; height: auto; }
.scroll { overflow-x: auto; }
"""


def image(figure):
    file = io.BytesIO()
    figure.savefig(file, format="svg", bbox_inches="tight")
    plt.close(figure)
    return base64.b64encode(file.getvalue()).decode()


def nearest_step(snr_dB):
    return min(STEPS_DB, key=lambda step: abs(step - snr_dB))


def shares_by_step(rows, key):
    """Per step of the signal-to-noise ratio that has cases: share, and its interval."""
    points = []
    for step in STEPS_DB:
        marks = [bool(r[key]) for r in rows if nearest_step(r["snr_dB"]) == step]
        if marks:
            low, high = wilson(sum(marks), len(marks))
            points.append((step, sum(marks) / len(marks), low, high))
    return points


def singles_of(rows):
    return [r for r in rows if r["kind"] == "single" and r["snr_dB"] is not None]


def naming_by_noise(rows, baselines):
    figure, axes = plt.subplots(figsize=(6, 4))
    for label, of in ((OWN, rows), *baselines.items()):
        points = shares_by_step(singles_of(of), "top1")
        if not points:
            continue
        steps, shares, lows, highs = zip(*points)
        is_own = label == OWN
        axes.plot(steps, shares, marker="o", label=label, linewidth=2.5 if is_own else 1)
        if is_own:
            axes.fill_between(steps, lows, highs, alpha=0.15)
    detected = shares_by_step(singles_of(rows), "detected")
    if detected:
        axes.plot([p[0] for p in detected], [p[1] for p in detected], "k:", label="detected")
    axes.set(xlabel="signal to noise in the effect's own bin [dB]", ylabel="share of single effects",
             ylim=(-0.03, 1.03), title="Named first, by noise")
    axes.legend(fontsize=8, loc="upper left")
    return image(figure)


def sizes(rows):
    with_size = [r for r in rows if r.get("estimate")]
    figure, axes = plt.subplots(figsize=(6, max(2.5, 0.22 * len(with_size) + 1)))
    shown = lambda of: min(max(of, 0), LARGEST_SIZE)
    for place, row in enumerate(with_size):
        value, low, high = row["estimate"]
        colour = "tab:blue" if row["covered"] else "tab:red"
        axes.plot([shown(low), shown(high)], [place, place], color=colour)
        mark = "<" if value < 0 else ">" if value > LARGEST_SIZE else "o"
        axes.plot(shown(value), place, mark, color=colour, markersize=4, clip_on=False)
    axes.axvline(1, color="black", linewidth=0.8)
    axes.set_yticks(range(len(with_size)), [f"{r['case']} {r['truth'][0]}" for r in with_size],
                    fontsize=7)
    axes.set(xlabel="estimate over truth, with its 90 % interval", title="Sizes (arrows: beyond)",
             xlim=(0, LARGEST_SIZE))
    return image(figure)


def confusion(rows):
    """What was hidden, beside the first name that was said."""
    singles = singles_of(rows)
    nothing = "(nothing)"
    said = [r["truth"][0] if r["top1"] else r["said"][0][0] if r["said"] else nothing
            for r in singles]
    hidden = sorted({r["truth"][0] for r in singles})
    names = hidden + sorted(set(said) - set(hidden))
    counts = [[sum(r["truth"][0] == h and s == n for r, s in zip(singles, said)) for n in names]
              for h in hidden]
    figure, axes = plt.subplots(figsize=(7, 6))
    axes.imshow(counts, cmap="Blues", aspect="auto")
    for y, row in enumerate(counts):
        for x, count in enumerate(row):
            if count:
                dark = count > 0.6 * max(map(max, counts))
                axes.text(x, y, count, ha="center", va="center", fontsize=7,
                          color="white" if dark else "black")
    axes.set_xticks(range(len(names)), names, rotation=90, fontsize=7)
    axes.set_yticks(range(len(hidden)), hidden, fontsize=7)
    axes.set(xlabel="said first", ylabel="hidden", title="Single effects")
    return image(figure)


def held_out(rows):
    figure, axes = plt.subplots(figsize=(6, 4))
    of = {"condition": [], "speed": [], "load": []}
    for left_out, values in of.items():
        values += [r[f"remaining_{left_out}"] for r in rows
                   if r.get(f"remaining_{left_out}") is not None]
    axes.boxplot(list(of.values()), showfliers=True)
    axes.set_xticks(range(1, 4), [f"{name} left out\n{len(v)} cases" for name, v in of.items()])
    axes.set(ylabel="of the error above noise, what remains", title="Held-out error",
             ylim=(0, None))
    return image(figure)


def seconds(rows):
    figure, axes = plt.subplots(figsize=(6, 3))
    axes.hist([r["seconds"] for r in rows], bins=30)
    axes.axvline(45, color="black", linewidth=0.8)
    axes.set(xlabel="seconds per case, seal, answer and baselines", ylabel="cases", title="Time")
    return image(figure)


def table(head, body):
    lines = ["<tr>" + "".join(f"<th>{html.escape(h)}</th>" for h in head) + "</tr>"]
    for cells, is_wrong in body:
        mark = ' class="no"' if is_wrong else ""
        lines.append(f"<tr{mark}>" + "".join(f"<td>{html.escape(str(c))}</td>" for c in cells) +
                     "</tr>")
    return '<div class="scroll"><table>' + "\n".join(lines) + "</table></div>"


def case_cells(row):
    # Twins show at all frequencies: their ratio to the noise is none in a bin.
    has_bin = row.get("snr_dB") is not None and row["kind"] != "twin"
    snr = f"{row['snr_dB']:.0f}" if has_bin else ""
    return (row["case"], row["kind"], f"{row['machine']} {row['variant']}".strip(),
            " + ".join(row["truth"]) or "-", snr, row["verdict"],
            " + ".join("|".join(names) for names in row["said"]) or "-", f"{row['seconds']:.0f}")


def page(rows, baselines):
    card = [((quantity, target, value, *others), not met)
            for quantity, value, target, met, others in card_lines(rows, baselines)]
    right = sum(bool(r["right"]) for r in rows)
    plots = [seconds(rows)]
    if singles_of(rows):
        plots = [naming_by_noise(rows, baselines), confusion(rows), sizes(rows), held_out(rows),
                 *plots]
    images = "".join(f'<img src="data:image/svg+xml;base64,{data}" alt="plot">' for data in plots)
    return f"""<!doctype html><html lang="en"><head><meta charset="utf-8"><title>Proof by concealment</title>
<style>{STYLE}</style></head><body>
<h1>Proof by concealment</h1>
<p>{right} of {len(rows)} cases answered rightly. What is hidden was sealed, by its SHA-256, before
rvbench explain saw the recordings; red: a target that is not met, a case that is not right.</p>
{table(["quantity", "must", OWN, *baselines], card)}
<h2>Plots</h2><div class="plots">{images}</div>
<h2>Cases</h2>
{table(["case", "kind", "machine", "hidden", "dB", "verdict", "said", "s"],
       [(case_cells(r), not r["right"]) for r in rows])}
</body></html>
"""
