"""What the converters share: how tables are read, measurements and tracks are written, and a person is told what is wrong."""
import csv
import json
import math
import sys


class Wrong(Exception):
    """A sentence for the person who called."""


def only(folder, *patterns):
    """The one file of a folder that the first of the patterns finds which finds any."""
    for pattern in patterns:
        found = sorted(folder.glob(pattern))
        if len(found) > 1:
            raise Wrong(f"{folder} has more than one {pattern}: {', '.join(path.name for path in found)}")
        if found:
            return found[0]
    raise Wrong(f"{folder} has no {' or '.join(patterns)}")


def rows(path, delimiter=",", columns=None):
    """Numbers of a table under one line of titles; of all columns, or of those whose titles are given, in their order."""
    try:
        with open(path, newline="") as file:
            lines = csv.reader(file, delimiter=delimiter)
            titles = [title.strip() for title in next(lines, [])]
            chosen = range(len(titles)) if columns is None else [titles.index(name) for name in columns]
            return [[float(line[i]) for i in chosen] for line in lines if line]
    except OSError as error:
        raise Wrong(f"cannot read {path}: {error.strerror}")
    except (ValueError, IndexError) as error:
        raise Wrong(f"{path} is not the table of numbers that is expected: {error}")


def rotate(quaternion_xyzw, vector):
    """A vector of the body, in the frame of the site."""
    x, y, z, w = quaternion_xyzw
    norm = (x * x + y * y + z * z + w * w) ** 0.5
    x, y, z, w = x / norm, y / norm, z / norm, w / norm
    a, b, c = vector
    tx, ty, tz = 2 * (y * c - z * b), 2 * (z * a - x * c), 2 * (x * b - y * a)
    return (a + w * tx + y * tz - z * ty, b + w * ty + z * tx - x * tz, c + w * tz + x * ty - y * tx)


def measurement(time_s, kind, **fields):
    """One object of a *.jsonl recording, fields as in fusion/measurement.h; what is None or no number is not known."""
    known = {name: value for name, value in fields.items()
             if value is not None and (isinstance(value, list) or math.isfinite(value))}
    return {"t": round(time_s, 6), "class": kind, "input": 0, "sequence": 0, **known}


def in_order(measurements):
    """By time, each with its number."""
    ordered = sorted(measurements, key=lambda one: one["t"])
    for number, one in enumerate(ordered):
        one["sequence"] = number
    return ordered


def write_measurements(path, measurements):
    write(path, [json.dumps(one) for one in in_order(measurements)])


def write_track(path, track):
    """Rows of time, x, y, z and perhaps an orientation x, y, z, w, as a TUM trajectory."""
    unturned = [0, 0, 0, 1]
    write(path, [" ".join(f"{value:.6f}" for value in [*row, *unturned[: 8 - len(row)]]) for row in track])


def site_yaml(name, anchors):
    """Lines of the section `site`; `anchors` are rows of number, x, y, z in metres."""
    lines = ["site:", f"  name: {name}", "  anchors:"]
    for number, x, y, z, *_ in anchors:
        lines.append(f"    - {{name: A{int(number)}, address: {int(number)}, position_site_m: [{x}, {y}, {z}]}}")
    return lines


def estimator_yaml(**settings):
    """Lines of the section `estimators`: what is known of a kind of device, for the default estimator and for range_ekf."""
    told = ", ".join(f"{name}: {value}" for name, value in settings.items())
    return ["estimators:", *(f"  {name}: {{{told}}}" for name in ("inertial_ekf", "range_ekf"))]


# Kits that the maker delivers and calibrates as a whole have no error that all their ranges share; modules whose antenna delay
# nobody measured have (the default).
CALIBRATED_KIT = {"common_range_error_sigma_m": 0}


def stretches(text, first_s, last_s):
    """START,DURATION[,PERIOD] in seconds after the first time: pairs of begin and end in the recording's time."""
    try:
        start_s, duration_s, *period = [float(part) for part in text.split(",")]
        period_s = period[0] if period else float("inf")
    except (ValueError, IndexError):
        raise Wrong(f"--outage wants START,DURATION or START,DURATION,PERIOD in seconds, not {text}")
    if start_s < 0 or duration_s <= 0 or period_s <= duration_s:
        raise Wrong("--outage wants a START of 0 or later and a PERIOD longer than its DURATION")
    begin_s = first_s + start_s
    while begin_s + duration_s <= last_s:
        yield begin_s, begin_s + duration_s
        begin_s += period_s


def within(time_s, stretches):
    return any(begin <= time_s < end for begin, end in stretches)


def write(path, lines):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("".join(line + "\n" for line in lines))
    print(f"{path}: {len(lines)} lines")


def run(parser, convert):
    """Calls convert(arguments); what is wrong ends the program with its sentence."""
    try:
        convert(parser.parse_args())
    except Wrong as problem:
        sys.exit(f"{parser.prog}: {problem}")
    except OSError as error:
        sys.exit(f"{parser.prog}: {error.filename}: {error.strerror}")
