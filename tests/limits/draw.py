# SPDX-License-Identifier: MIT
"""Maps of the outcomes of a sweep: a dot a case, over pairs of parameters."""
import shlex

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import referee

# Red is what must not be; the order is that of drawing.
COLOURS = {"stationary": "#2a7f3f", "end time": "#7cc47f", "step limit": "#a8a8a8", "refused": "#4a78b5",
           "failure": "#e0a32e", "time over": "#8a5fb0", "HANG": "#5b1f8a", "DISAGREES": "#ff7fbf",
           "NON-FINITE": "#ff5050", "WRONG": "#e00000", "CRASH": "#000000"}


def options(row):
    """Of the command line, numbers as such."""
    words = shlex.split(row["command"])
    result = {"program": words[0], "seconds": float(row["seconds"])}
    for name, value in zip(words[1::2], words[2::2]):
        try:
            result[name[2:]] = float(value)
        except ValueError:
            result[name[2:]] = value
    result.setdefault("excess-area", referee.excess_area(words[0], result))
    if "confinement" in result:
        # What is left to the narrowest tube that takes the body.
        result["slack"] = 1 - result["confinement"] / referee.closest_confinement(result["excess-area"] or 0)
    for name in ("bond", "capillary-number", "unbounded-capillary-number"):
        if name in result:
            result[name] = abs(result[name])
    return result


TITLES = {"excess-area": "excess area", "bond": "|Bond number|", "capillary-number": "|Ca|", "seconds": "seconds",
          "unbounded-capillary-number": "|Ca_unb|", "slack": "1 - L/(largest L)", "elements": "elements given", "dt": "fixed time step",
          "tolerance": "tolerance given", "gap": "gap of spheres", "throat": "radius of the throat", "flow-rate": "flow rate",
          "aspect": "aspect"}


def vesicles(o):
    return o["program"] in ("settling_vesicle", "poiseuille_vesicle", "relaxing_vesicle", "tether", "pearling")


def settling(o):
    return o["program"] in ("settling_vesicle", "tether", "pearling")


def program(name):
    return lambda o: o["program"] == name


# Pictures: panels of (title, which cases, x, y).
PICTURES = {
    "settling": [("settling, unbounded", lambda o: settling(o) and "slack" not in o, "bond", "excess-area"),
                 ("settling in a tube", settling, "slack", "excess-area"),
                 ("settling in a tube", settling, "slack", "bond")],
    "poiseuille": [("flow in a tube", program("poiseuille_vesicle"), "slack", "capillary-number"),
                   ("flow in a tube", program("poiseuille_vesicle"), "slack", "excess-area"),
                   ("unbounded flow", program("poiseuille_vesicle"), "unbounded-capillary-number", "excess-area")],
    "method": [("vesicles", vesicles, "elements", "seconds"), ("vesicles, fixed steps", vesicles, "dt", "excess-area"),
               ("vesicles", vesicles, "tolerance", "elements")],
    "others": [("sphere in a tube", program("sphere_in_tube"), "slack", "seconds"),
               ("spheres in line", program("bodies_in_line"), "gap", "seconds"),
               ("passages", program("vesicle_through_constriction"), "throat", "excess-area")],
}


def draw(table, directory):
    directory.mkdir(parents=True, exist_ok=True)
    cases = [(options(row), row["outcome"]) for row in table]
    for o, _ in cases:
        if o.get("kind") == "sphere":
            o["gap"] = o["distance"] - 2
    for name, panels in PICTURES.items():
        fig, axes = plt.subplots(1, len(panels), figsize=(4.2 * len(panels), 3.9))
        seen = set()
        for ax, (title, chosen, x, y) in zip(axes, panels):
            for outcome, colour in COLOURS.items():
                dots = [(o[x], o[y]) for o, found in cases
                        if found == outcome and chosen(o) and o.get(x, 0) > 0 and (o.get(y) or 0) > 0]
                if dots:
                    seen.add(outcome)
                    ax.scatter(*zip(*dots), s=14, color=colour, lw=0)
            ax.set_xscale("log")
            ax.set_yscale("log")
            ax.set_title(title, fontsize=9)
            ax.set_xlabel(TITLES[x], fontsize=8)
            ax.set_ylabel(TITLES[y], fontsize=8)
            ax.tick_params(labelsize=7)
        handles = [plt.Line2D([], [], marker="o", ls="", ms=4, color=c, label=o) for o, c in COLOURS.items() if o in seen]
        fig.tight_layout(rect=(0, 0.07, 1, 1))
        fig.legend(handles=handles, loc="lower center", ncol=len(handles), fontsize=8, frameon=False)
        path = directory / (name + ".png")
        fig.savefig(path, dpi=110, pil_kwargs={"optimize": True})
        plt.close(fig)
        print(path)
    return 0
