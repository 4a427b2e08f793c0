# SPDX-License-Identifier: MIT
"""What results must satisfy, whatever computed them: exact values, bounds, what is conserved.

Drag grows with a body and falls with the fluid around it (Hill and Power 1956): that bounds the velocity of settling
bodies by those of spheres inside and around them, and the drag in a tube by those in wider and narrower ones. Where
nothing but uniform weight moves a body of volume 4 pi/3, no shape falls faster than 0.351 B0: the mean velocity of a fluid
with that weight in it is at most that at the point of the shape for which it is largest.
"""
import csv
import math

FASTEST = 0.351
# Drag factor of a sphere in a tube by confinement (tests/sphere_in_tube_reference.hpp).
DRAG = {0: 1, 0.1: 1.26321390527, 0.3: 2.37009489017, 0.5: 5.94737424576, 0.7: 24.6759838510, 0.9: 469.224390521,
        1 / 1.1: 601.511506823}


def excess_area(program, options):
    usual = {"settling_vesicle": 0.6, "poiseuille_vesicle": 1.59, "tether": 0.93, "pearling": 0.73, "bodies_in_line": 0.6}
    return options.get("excess-area", usual.get(program))


def closest_confinement(area):
    """1/R for the cylinder with round ends, of radius R, of volume 4 pi/3 and area 4 pi + area: its volume is
    R A/2 - 2 pi R^3/3. No longer body of that area fits into a narrower tube."""
    total = 4 * math.pi + area
    low, high = 0.0, 1.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if middle * total / 2 - 2 * math.pi / 3 * middle**3 < 4 * math.pi / 3 else (low, middle)
    return 1 / high


def spheroid_drag_factor(aspect):
    """Over that of the sphere of equal volume: translation along the axis (Happel and Brenner 1983, (5-11))."""
    a = aspect ** (-1 / 3)
    c = aspect * a
    if abs(aspect - 1) < 1e-3:
        return 1 - 2 / 15 * (aspect - 1)  # to first order; the formulas below are 0/0 for a sphere
    t = aspect
    if t > 1:
        root = math.sqrt(t * t - 1)
        k = 8 / 3 / (-2 * t / root**2 + (2 * t * t - 1) / root**3 * math.log((t + root) / (t - root)))
    else:
        root = math.sqrt(1 - t * t)
        k = 8 / 3 / (2 * t / root**2 + 2 * (1 - 2 * t * t) / root**3 * math.atan(root / t))
    return k * a


def not_finite(value, place=""):
    """Places in what was read from JSON that hold no number where one belongs."""
    if isinstance(value, dict):
        return [p for k, v in value.items() if k != "error_estimate" for p in not_finite(v, f"{place}.{k}" if place else k)]
    if isinstance(value, list):
        return [p for i, v in enumerate(value) for p in not_finite(v, f"{place}[{i}]")]
    return [place] if value is None or isinstance(value, float) and not math.isfinite(value) else []


def table(path):
    with open(path, newline="") as file:
        return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]


def enclosing_radius(nodes):
    """Of the smallest sphere around a body of revolution, centre on the axis."""
    low, high = min(n["z"] for n in nodes), max(n["z"] for n in nodes)

    def radius(z):
        return max(math.hypot(n["r"], n["z"] - z) for n in nodes)

    for _ in range(100):
        a, b = low + (high - low) / 3, high - (high - low) / 3
        low, high = (low, b) if radius(a) < radius(b) else (a, high)
    return radius(low)


class Complaints:
    """What is checked, each with five times the error that the program tells of."""

    def __init__(self, summary):
        self.error = 5 * (summary.get("error_estimate") or 0)
        self.list = []

    def require(self, holds, what):
        if not holds:
            self.list.append(what)

    def within(self, name, value, low, high, floor=1e-9):
        slack = self.error + floor
        scale = max(abs(low), abs(high)) if math.isfinite(low) and math.isfinite(high) else abs(value)
        self.require(low - slack * scale <= value <= high + slack * scale, f"{name} {value!r} not in [{low!r}, {high!r}]")

    def equal(self, name, value, exact, floor):
        self.require(abs(value - exact) <= (self.error + floor) * abs(exact), f"{name} {value!r} is not {exact!r}")


def sphere_in_tube(check, options, summary, _):
    confinement = options.get("confinement", 0.5)
    if options.get("flow", "none") == "poiseuille":
        # Between that of a plug, the mean one, and the largest one.
        check.within("velocity ratio", summary["velocity_ratio"], 0.5, 1)
        return
    factor = summary["drag_factor"]
    below = [DRAG[c] for c in DRAG if c <= confinement]
    above = [DRAG[c] for c in DRAG if c >= confinement]
    # Texts of 7 digits leave their trace where the drag grows fast.
    floor = 1e-6 if confinement < 0.9 else 1e-5
    check.within("drag factor", factor, max(below), min(above, default=math.inf), floor)
    if confinement <= 0.1:
        # Faxen's series; the next term is that of the 14th power.
        series = 1 - 2.104443 * confinement + 2.08877 * confinement**3 - 0.94813 * confinement**5
        check.equal("drag factor", factor, 1 / series, 1e-5)


def spheroid_drag(check, options, summary, _):
    aspect = options.get("aspect", 2)
    if options.get("flow", "none") == "poiseuille":
        check.within("velocity ratio", summary["velocity_ratio"], 0, 1)
        return
    exact = spheroid_drag_factor(aspect)
    if "confinement" in options:
        check.within("drag factor", summary["drag_factor"], exact, math.inf, 1e-5)
    else:
        check.equal("drag factor", summary["drag_factor"], exact, 1e-6 if abs(aspect - 1) < 1e-3 else 1e-7)


def conserved(check, program, options, body):
    """Area, volume and bending energy of a vesicle."""
    area = 4 * math.pi + excess_area(program, options)
    check.equal("area", body["area"], area, 1e-6)
    check.equal("volume", body["volume"], 4 * math.pi / 3, 1e-6)
    check.within("bending energy over 8 pi", body["bending_energy"] / (8 * math.pi), 1, math.inf, 1e-6)


def settles(check, options, summary, directory):
    """Stationary: the fluid inside is at rest, it falls like a rigid body of its shape."""
    bond = options.get("bond", {"tether": 392, "pearling": 9320}.get(options.get("program"), 47))
    fall = -summary["velocity"] / bond
    check.require(fall > 0, f"velocity {summary['velocity']!r} against gravity of B0 = {bond!r}")
    highest = FASTEST
    if "confinement" in options:
        check.within("velocity over B0", fall, 0, highest, 1e-6)
        return
    nodes = table(directory / "shape.csv")
    check.within("velocity over B0", fall, 2 / 9 / enclosing_radius(nodes), highest, 1e-6)


def flows(check, options, summary, _):
    if "unbounded-capillary-number" in options:
        ratio = -summary["velocity"] / options["unbounded-capillary-number"]
        check.within("velocity over Ca_unb", ratio, 0, summary["max_radius"] ** 2, 1e-6)
    else:
        check.within("velocity over Ca", summary["velocity"] / options.get("capillary-number", 100), 0, 1, 1e-6)


def relaxes(check, _, summary, directory):
    history = table(directory / "history.csv")
    if history:
        check.within("bending energy over its first value", summary["bending_energy"] / history[0]["bending_energy"], 0, 1,
                     1e-6)


def line(check, options, summary, _):
    if options["kind"] == "vesicle":
        return
    velocities = [body["velocity"] for body in summary["bodies"]]
    if "bond" in options and "confinement" not in options:
        # Each is carried along by the others.
        for velocity in velocities:
            check.within("velocity over that of a single sphere", -velocity / options["bond"] * 4.5, 1, len(velocities), 1e-6)
    if "capillary-number" in options:
        for velocity in velocities:
            check.within("velocity over Ca", velocity / options["capillary-number"], 0, 1, 1e-6)


def complaints(program, options, summary, directory):
    """What is wrong with a result that is reported as good, as a list of texts."""
    check = Complaints(summary)
    if program in ("sphere_in_tube", "spheroid_drag", "bodies_in_line"):
        {"sphere_in_tube": sphere_in_tube, "spheroid_drag": spheroid_drag, "bodies_in_line": line}[program](
            check, options, summary, directory)
    elif program == "vesicle_through_constriction":
        for key in ("area_drift", "volume_drift"):
            check.within(key, summary[key], -1e-6, 1e-6)
    else:
        conserved(check, program, options, summary)
        if program == "relaxing_vesicle":
            relaxes(check, options, summary, directory)
        elif summary["stationary"] and program == "poiseuille_vesicle":
            flows(check, options, summary, directory)
        elif summary["stationary"]:
            settles(check, {**options, "program": program}, summary, directory)
    return check.list


def difference(first, second):
    """In what two results for one scene differ by more than five times their errors; states of different length are
    taken for different branches of a stationary solution, and compared no further."""
    allowed = 5 * ((first.get("error_estimate") or 0) + (second.get("error_estimate") or 0)) + 1e-9
    if "bodies" in first:
        pairs = [(a, b) for a, b in zip(first["bodies"], second["bodies"])]
    else:
        pairs = [(first, second)]
    for a, b in pairs:
        for key in ("length", "velocity", "drag_factor", "velocity_ratio"):
            if key not in a or key not in b:
                continue
            scale = max(abs(a[key]), abs(b[key]))
            off = abs(a[key] - b[key])
            if key == "velocity" and scale < 1e-7:  # nothing drives it
                continue
            if off > allowed * scale:
                stationary = "" if "bodies" in first or not first.get("stationary") else ", stationary"
                return f"{key} {a[key]!r} and {b[key]!r}, {off / scale:.1e} apart, {allowed:.1e} allowed{stationary}"
    return None
