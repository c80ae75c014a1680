"""What the converters share: how a site is written, how files are, and how a person is told what is wrong."""
import sys


class Wrong(Exception):
    """A sentence for the person who called."""


def site_yaml(name, anchors):
    """Lines of the section `site`; `anchors` are rows of number, x, y, z in metres."""
    lines = ["site:", f"  name: {name}", "  anchors:"]
    for number, x, y, z, *_ in anchors:
        lines.append(f"    - {{name: A{int(number)}, address: {int(number)}, position_site_m: [{x}, {y}, {z}]}}")
    return lines


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
