"""Pictures of a report on matplotlib axes."""

from __future__ import annotations

from typing import Any

from .errors import optional

# What a curve is, in every picture in the same colour (those of the report).
_COLOURS = {
    "measured": "tab:gray",
    "before": "tab:orange",
    "model": "tab:blue",
    "other": "tab:green",
}


def draw(figure: dict[str, Any], ax: Any = None) -> Any:
    """Draw one of `Result.figures` on axes, new ones where none are given.

    Returns
    -------
    matplotlib axes
    """
    plt = optional("matplotlib.pyplot", "plot")

    if ax is None:
        is_orbit = figure["kind"] == "orbits"
        ax = plt.figure().add_subplot(projection="3d" if is_orbit else None)
    {"lines": _draw_lines, "rows": _draw_rows, "orbits": _draw_orbits}[figure["kind"]](figure, ax)
    ax.set_title(figure["title"], fontsize="medium")
    return ax


def _draw_lines(figure: dict[str, Any], ax: Any) -> None:
    if figure["band"]:
        low, high, label = figure["band"]
        ax.axhspan(low, high, alpha=0.2, color="tab:gray", label=label)
    for series in figure["series"]:
        style = {"linestyle": "", "marker": ".", "markersize": 3} if series["dots"] else {}
        colour = _COLOURS[series["curve"]]
        ax.plot(series["x"], series["y"], color=colour, label=series["label"], **style)
    if figure["logarithmic_x"]:
        ax.set_xscale("log")
    if figure["logarithmic_y"]:
        ax.set_yscale("log")
    ax.set_xlabel(figure["x_label"])
    ax.set_ylabel(figure["y_label"])
    if len(figure["series"]) > 1:
        ax.legend(fontsize="small")


def _draw_rows(figure: dict[str, Any], ax: Any) -> None:
    for place, row in enumerate(figure["rows"]):
        colour = "tab:blue" if row["marked"] else "tab:gray"
        if figure["intervals"]:
            low, high = row["low"], row["high"]
            if low is not None and high is not None:
                ax.plot([low, high], [place, place], color=colour)
            ax.plot(row["value"], place, "o", color=colour)
        else:
            ax.barh(place, row["value"], color=colour)
    ax.axvline(0.0, color="black", linewidth=0.8)
    ax.set_yticks(range(len(figure["rows"])), [row["label"] for row in figure["rows"]])
    ax.invert_yaxis()
    ax.set_xlabel(figure["x_label"])


def _draw_orbits(figure: dict[str, Any], ax: Any) -> None:
    for orbit in figure["orbits"]:
        ax.plot(*orbit["points"].T, color=_COLOURS[orbit["curve"]], label=orbit["label"], lw=0.8)
    for name, label in zip("xyz", figure["labels"], strict=True):
        getattr(ax, f"set_{name}label")(label)
    if len(figure["orbits"]) > 1:
        ax.legend(fontsize="small")
