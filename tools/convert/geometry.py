"""What two converters need to bring a truth into the frame and the clock of the anchors: places out of ranges, rigid
alignment, and the solving of small linear systems. Plain Python, for a recording's length only."""


def solved(matrix, right):
    """x of matrix x = right, by elimination with the largest pivot; None where there is no one solution."""
    rows = [list(row) + [value] for row, value in zip(matrix, right)]
    size = len(rows)
    for column in range(size):
        pivot = max(range(column, size), key=lambda i: abs(rows[i][column]))
        if abs(rows[pivot][column]) < 1e-12:
            return None
        rows[column], rows[pivot] = rows[pivot], rows[column]
        for i in range(size):
            if i != column:
                factor = rows[i][column] / rows[column][column]
                rows[i] = [a - factor * b for a, b in zip(rows[i], rows[column])]
    return [rows[i][size] / rows[i][i] for i in range(size)]


def cauchy(error, scale):
    """Weight of an error: 1 where it is small, little where it is many times the scale."""
    return 1 / (1 + (error / scale) ** 2)


def place(ranges, start_m, scale_m=0.2, steps=12):
    """Point that fits ranges [((x, y, z) of the anchor, range)]: Gauss-Newton with Cauchy weights, a trace of damping.
    Returns the point and the weighted mean square of what is left, or None."""
    point, left = list(start_m), 0.0
    for _ in range(steps):
        normal, right, weights, squares = [[1e-6 * (i == j) for j in range(3)] for i in range(3)], [0.0] * 3, 0.0, 0.0
        for anchor, range_m in ranges:
            arm = [p - a for p, a in zip(point, anchor)]
            distance = max(sum(d * d for d in arm) ** 0.5, 1e-6)
            error, slope = range_m - distance, [d / distance for d in arm]
            weight = cauchy(error, scale_m)
            weights, squares = weights + weight, squares + weight * error * error
            for i in range(3):
                right[i] += weight * slope[i] * error
                for j in range(3):
                    normal[i][j] += weight * slope[i] * slope[j]
        step, left = solved(normal, right), squares / weights
        if step is None:
            return None
        length = sum(s * s for s in step) ** 0.5
        point = [p + s * min(1, 2 / max(length, 1e-12)) for p, s in zip(point, step)]
        if length < 1e-4:
            break
    return point, left


def largest_eigenvector(symmetric):
    """By repeated multiplication; the matrix is moved so that its largest eigenvalue is the largest in size too."""
    size = len(symmetric)
    shift = max(sum(abs(value) for value in row) for row in symmetric)
    vector = [1.0 + 0.1 * i for i in range(size)]
    for _ in range(5000):
        moved = [sum(symmetric[i][j] * vector[j] for j in range(size)) + shift * vector[i] for i in range(size)]
        length = sum(value * value for value in moved) ** 0.5
        moved = [value / length for value in moved]
        if max(abs(a - b) for a, b in zip(moved, vector)) < 1e-13:
            break
        vector = moved
    return vector


def mean(points, weights):
    return [sum(w * p[k] for w, p in zip(weights, points)) / sum(weights) for k in range(3)]


def turn_between(source, target, weights):
    """Quaternion x, y, z, w of the rotation that best takes source to target: B. K. P. Horn, Closed-form solution of
    absolute orientation using unit quaternions, J. Opt. Soc. Am. A 4 (1987), section 4."""
    a, b = mean(source, weights), mean(target, weights)
    s = [[sum(w * (p[i] - a[i]) * (q[j] - b[j]) for w, p, q in zip(weights, source, target)) for j in range(3)] for i in range(3)]
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = s
    w, x, y, z = largest_eigenvector([[xx + yy + zz, yz - zy, zx - xz, xy - yx], [yz - zy, xx - yy - zz, xy + yx, zx + xz],
                                      [zx - xz, xy + yx, yy - xx - zz, yz + zy], [xy - yx, zx + xz, yz + zy, zz - xx - yy]])
    return x, y, z, w
