"""Places and velocities out of satellite ranges, for converters: the Earth (WGS-84) there and back, a fix of one epoch by least squares."""
import math

from conversion import Wrong
from geometry import cauchy, solved

SEMI_MAJOR_M, FLATTENING = 6378137.0, 1 / 298.257223563
SQUARED_ECCENTRICITY = FLATTENING * (2 - FLATTENING)


def geodetic(x, y, z):
    """Latitude and longitude in radians and the height over the ellipsoid; by iteration, to the micrometre near the ground."""
    latitude, flat = math.atan2(z, math.hypot(x, y) * (1 - SQUARED_ECCENTRICITY)), math.hypot(x, y)
    for _ in range(6):
        curvature_m = SEMI_MAJOR_M / math.sqrt(1 - SQUARED_ECCENTRICITY * math.sin(latitude) ** 2)
        height_m = flat / math.cos(latitude) - curvature_m
        latitude = math.atan2(z, flat * (1 - SQUARED_ECCENTRICITY * curvature_m / (curvature_m + height_m)))
    return latitude, math.atan2(y, x), height_m


def ecef(latitude, longitude, height_m):
    curvature_m = SEMI_MAJOR_M / math.sqrt(1 - SQUARED_ECCENTRICITY * math.sin(latitude) ** 2)
    flat = (curvature_m + height_m) * math.cos(latitude)
    return (flat * math.cos(longitude), flat * math.sin(longitude),
            (curvature_m * (1 - SQUARED_ECCENTRICITY) + height_m) * math.sin(latitude))


def east_north_up(latitude, longitude):
    """The three directions at a place, in the Earth's frame."""
    sin_lat, cos_lat, sin_lon, cos_lon = math.sin(latitude), math.cos(latitude), math.sin(longitude), math.cos(longitude)
    return ((-sin_lon, cos_lon, 0.0), (-sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat),
            (cos_lat * cos_lon, cos_lat * sin_lon, sin_lat))


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def weighted_normal(lines, values, weights):
    normal = [[sum(w * h[i] * h[j] for w, h in zip(weights, lines)) for j in range(4)] for i in range(4)]
    return normal, [sum(w * h[i] * v for w, h, v in zip(weights, lines, values)) for i in range(4)]


def fitted(lines, values, sigmas):
    """Four unknowns, Cauchy weights at three sigma. The solution, the normal matrix and how many times the sigmas the residuals
    are, at least 1; or None."""
    answer, weights = [0.0] * 4, [1 / s**2 for s in sigmas]
    for _ in range(5):
        normal, right = weighted_normal(lines, values, weights)
        answer = solved(normal, right)
        if answer is None:
            return None
        weights = [cauchy(v - dot(h, answer), 3 * s) / s**2 for h, v, s in zip(lines, values, sigmas)]
    squares = sum(((v - dot(h, answer)) / s) ** 2 for h, v, s in zip(lines, values, sigmas))
    return answer, normal, max(1.0, (squares / max(len(values) - 4, 1)) ** 0.5)


def fix(satellites, near_m, code_sigma_m, rate_sigma_mps):
    """Of one epoch, from rows (place, velocity, pseudorange, rate, sine of the elevation): place, velocity, and the standard
    deviations of both, east, north and up; or None."""
    place, sigmas = list(near_m), [1 / max(row[4], 0.1) for row in satellites]
    for _ in range(6):
        arms = [[s - p for s, p in zip(row[0], place)] for row in satellites]
        lines = [[-a / math.hypot(*arm) for a in arm] + [1.0] for arm in arms]
        found = fitted(lines, [row[2] - math.hypot(*arm) for row, arm in zip(satellites, arms)], [code_sigma_m * s for s in sigmas])
        if found is None:
            return None
        place = [p + d for p, d in zip(place, found[0])]
        if math.hypot(*found[0][:3]) < 1e-3:
            break
    rates = [row[3] + dot(h[:3], row[1]) for row, h in zip(satellites, lines)]
    moved = fitted(lines, rates, [rate_sigma_mps * s for s in sigmas])
    if moved is None:
        return None
    up = east_north_up(*geodetic(*place)[:2])
    return place, moved[0][:3], sigma_enu(*found[1:], up), sigma_enu(*moved[1:], up)


def sigma_enu(normal, scale, directions):
    """Standard deviations along the directions, by the normal matrix and what the residuals come to."""
    return [scale * max(dot(direction, solved(normal, [*direction, 0.0])[:3]), 0.0) ** 0.5 for direction in directions]


def local_track(lines):
    """From lines of time, latitude, longitude (radians), height: the first place, and rows of time, east, north, up of it."""
    if not lines:
        raise Wrong("there is no line with a place in the truth")
    origin = lines[0][1:]
    origin_m, directions = ecef(*origin), east_north_up(*origin[:2])
    arms = ((one[0], [p - o for p, o in zip(ecef(*one[1:]), origin_m)]) for one in lines)
    return origin, [[time_s, *(dot(direction, arm) for direction in directions)] for time_s, arm in arms]


def vehicle_yaml(name, origin, target, tag, settings, gnss=""):
    """Lines of a configuration: a site without anchors at a place on the Earth, one target with gnss_ins."""
    latitude, longitude, height_m = origin
    place = f"latitude_deg: {math.degrees(latitude):.9f}, longitude_deg: {math.degrees(longitude):.9f}, height_ellipsoid_m: {height_m:.4f}"
    return ["site:", f"  name: {name}", "  anchors: []", f"  origin: {{{place}}}", "fusion: {estimator: gnss_ins}",
            *([f"gnss: {gnss}"] if gnss else []), f"targets: [{{name: {target}, address: {tag}}}]",
            f"estimators: {{gnss_ins: {{{', '.join(filter(None, settings))}}}}}"]
