"""The figure of docs/performance.md: python -m benchmarks.figure, from what is in results/."""

import json
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt

ROOT = Path(__file__).resolve().parents[1]
RESULTS = Path(__file__).with_name("results")
NAMES = {
    "branchcrush": "branchcrush",
    "branchcrush_bin": "branchcrush,\none grid",
    "yade": "YADE",
    "liggghts": "LIGGGHTS",
}


def result(part):
    """Return the result of a part, as its JSON tells."""
    return json.loads((RESULTS / f"{part}.json").read_text(encoding="utf-8"))["result"]


def plot_paper(ax):
    """Draw the times of the paper's case to one state at rest, by both paths."""
    found, codes = result("paper"), ("branchcrush", "yade", "liggghts")
    for shift, (key, label) in enumerate(
        (
            ("fastest_path_of_each", "fastest path of each"),
            ("same_path_for_all", "same path for all"),
        )
    ):
        seconds = [found[key][code]["cpu_s"] for code in codes]
        place = [k + 0.4 * shift - 0.2 for k in range(len(codes))]
        bars = ax.bar(place, seconds, 0.38, label=label)
        ax.bar_label(bars, fmt="%.1f", fontsize=8)
    ax.set_xticks(range(len(codes)), [NAMES[code] for code in codes])
    ax.set_ylabel("processor time [s]")
    ax.set_title("paper's case, one state at rest")
    ax.set_ylim(top=1.35 * ax.get_ylim()[1])
    ax.legend(frameon=False, loc="upper left")


def plot_fractal(ax):
    """Draw the time of a force evaluation of 20 000 grains of a fractal grading."""
    cost = result("fractal")["parts"]
    codes = [code for code in NAMES if code in cost]
    seconds = [1e3 * cost[code]["cpu_s_per_evaluation"]["median"] for code in codes]
    bars = ax.bar(range(len(codes)), seconds, 0.6, color="C2")
    ax.bar_label(bars, fmt="%.1f", fontsize=8)
    ax.set_xticks(range(len(codes)), [NAMES[code] for code in codes])
    ax.set_ylabel("force evaluation [ms]")
    ax.set_title("20 000 grains, fractal, ratio 20")


def plot_growth(ax):
    """Draw the cost of a grain against the number of grains."""
    rows = result("growth")["grains"]
    for form, marker in zip(dict.fromkeys(row["form"] for row in rows), "osv", strict=False):
        of = [row for row in rows if row["form"] == form]
        grains = [row["grains"] for row in of]
        cost = [row["ns_per_grain_and_evaluation"] for row in of]
        ax.semilogx(grains, cost, marker=marker, label=form.replace(" ", ", ratio "))
    ax.set_ylim(bottom=0)
    ax.set_xlabel("number of grains")
    ax.set_ylabel("grain and force evaluation [ns]")
    ax.set_title("growth with the number of grains")
    ax.legend(frameon=False)


def plot_ratios(ax):
    """Draw the cost of a grain against the ratio of the largest to the smallest radius."""
    rows = result("growth")["size_ratios"]
    for name, marker in (("loguniform", "o"), ("fractal", "s")):
        of = [row for row in rows if row["form"].startswith(name)]
        ratios = [row["realised_ratio"] for row in of]
        cost = [row["ns_per_grain_and_evaluation"] for row in of]
        label = "log-uniform" if name == "loguniform" else name
        ax.semilogx(ratios, cost, marker=marker, label=label)
    ax.set_ylim(bottom=0)
    ax.set_xlabel(r"size ratio $R_M/R_m$")
    ax.set_ylabel("grain and force evaluation [ns]")
    ax.set_title("growth with the size ratio")
    ax.legend(frameon=False)


def main():
    """Draw the figure where docs/performance.md shows it."""
    matplotlib.use("Agg")
    figure, axes = plt.subplots(2, 2, figsize=(9.0, 6.6), layout="constrained")
    for ax, plot in zip(
        axes.flat, (plot_paper, plot_fractal, plot_growth, plot_ratios), strict=True
    ):
        plot(ax)
        ax.spines[["top", "right"]].set_visible(False)
    path = ROOT / "docs" / "figures" / "performance.png"
    figure.savefig(path, dpi=120)


if __name__ == "__main__":
    main()
