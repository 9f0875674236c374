"""The suite's scenes in plain numbers, for renderers in RGB that have only meshes: spectra become linear sRGB (reflectances as seen in
equal-energy light), transforms matrices, shapes triangles and quads. Knows no renderer; refuses what it cannot say."""
import math

import numpy as np

XYZ_TO_SRGB = np.array([[3.2404542, -1.5371385, -0.4985314], [-0.9692660, 1.8760108, 0.0415560], [0.0556434, -0.2040259, 1.0572252]])


def observer(nm):
    """The CIE 1931 observer, as the sums of Gaussians of Wyman, Sloan and Shirley 2013."""
    g = lambda mean, below, above: np.exp(-0.5 * ((nm - mean) * np.where(nm < mean, below, above)) ** 2)
    return np.array([1.056 * g(599.8, 0.0264, 0.0323) + 0.362 * g(442.0, 0.0624, 0.0374) - 0.065 * g(501.1, 0.0490, 0.0382),
                     0.821 * g(568.8, 0.0213, 0.0247) + 0.286 * g(530.9, 0.0613, 0.0322),
                     1.217 * g(437.0, 0.0845, 0.0278) + 0.681 * g(459.0, 0.0385, 0.0725)])


NM = np.arange(360.0, 831.0)
OBSERVER = observer(NM)
OBSERVER /= OBSERVER.sum(1, keepdims=True)  # an equal-energy spectrum of 1 has X = Y = Z = 1
WHITE = XYZ_TO_SRGB @ np.ones(3)


def reflectance(value):
    """R, G, B of a reflectance: what it leaves of equal-energy light."""
    if isinstance(value, (int, float)):
        return [float(value)] * 3
    if value["type"] == "constant":
        return [float(value["value"])] * 3
    if value["type"] == "sampled":
        curve = np.interp(NM, value["wavelengths"], value["values"])
        return np.clip(XYZ_TO_SRGB @ (OBSERVER @ curve) / WHITE, 0, 1).tolist()
    raise ValueError(f"no colour in RGB for {value}")


def emission(value):
    """The factor of WHITE that a constant spectrum is."""
    if not isinstance(value, dict) or value["type"] != "constant":
        raise ValueError("emissions must be constant: a number would be D65-shaped")
    return float(value["value"])


def coefficients(medium):
    """sigma_a and sigma_s of a grey medium."""
    extinction, albedo = float(medium["sigma_t"]), reflectance(medium["albedo"])
    if len(set(albedo)) > 1:
        raise ValueError(f"no coloured media here: {medium}")
    return extinction * (1 - albedo[0]), extinction * albedo[0]


def frame(step):
    """A camera's frame: x right, y up, -z looking at the target."""
    unit = lambda v: v / np.linalg.norm(v)
    z = unit(np.subtract(step["from"], step["at"]))
    x = unit(np.cross(step["up"], z))
    m = np.eye(4)
    m[:3, :3] = np.transpose([x, np.cross(z, x), z])
    m[:3, 3] = step["from"]
    return m


def rotation(degrees, axis):
    """Around an axis, counter-clockwise as seen from its tip."""
    x, y, z = np.array(axis, dtype=float) / np.linalg.norm(axis)
    cross, angle = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]]), math.radians(degrees)
    m = np.eye(4)
    m[:3, :3] += math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross
    return m


def transform(entries):
    """The list of steps as one matrix: the first step is applied first."""
    total = np.eye(4)
    for step in entries if isinstance(entries, list) else [entries]:
        m = np.eye(4)
        if "translate" in step:
            m[:3, 3] = step["translate"]
        elif "rotate" in step:
            m = rotation(step["rotate"][0], step["rotate"][1:])
        elif "scale" in step:
            m[range(3), range(3)] = step["scale"]
        elif "from" in step:
            m = frame(step)
        else:
            raise ValueError(f"no matrix for {step}")
        total = m @ total
    return total


def read_obj(path):
    points, faces = [], []
    for line in open(path):
        words = line.split()
        if words and words[0] == "v":
            points.append([float(w) for w in words[1:4]])
        elif words and words[0] == "f":
            faces.append([int(w.split("/")[0]) - 1 for w in words[1:]])
    return points, faces


def icosphere(radius, subdivisions):
    """20 x 4^subdivisions triangles, outward, with points on the sphere."""
    g = (1 + 5 ** 0.5) / 2
    points = [np.array(p) / np.linalg.norm(p) for a in (-1, 1) for b in (-g, g) for p in ((a, b, 0), (0, a, b), (b, 0, a))]
    near = lambda i, j: abs(np.dot(points[i], points[j]) - 5 ** -0.5) < 1e-9  # the ends of an edge
    faces = [(i, j, k) for i in range(12) for j in range(i) for k in range(j) if near(i, j) and near(j, k) and near(k, i)]
    faces = [f if np.linalg.det([points[i] for i in f]) > 0 else f[::-1] for f in faces]
    for _ in range(subdivisions):
        middles = {}

        def middle(i, j):
            key = min(i, j), max(i, j)
            if key not in middles:
                middles[key] = len(points)
                total = points[i] + points[j]
                points.append(total / np.linalg.norm(total))
            return middles[key]

        divided = []
        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            divided += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        faces = divided
    return radius * np.array(points), faces


def geometry(surface):
    """Points in the scene's space, faces, and whether normals are to be interpolated. Spheres are 20,480 triangles."""
    if surface["type"] == "quad":
        h = surface["size"] / 2
        points, faces, smooth = [(-h, -h, 0), (h, -h, 0), (h, h, 0), (-h, h, 0)], [(0, 1, 2, 3)], False
    elif surface["type"] == "sphere":
        (points, faces), smooth = icosphere(surface["radius"], 5), True
    elif surface["type"] == "mesh" and "filename" in surface:
        (points, faces), smooth = read_obj(surface["filename"]), False
    else:
        raise ValueError(f"no mesh for {surface}")
    to_world = transform(surface.get("transform", []))
    return (np.asarray(points, dtype=float) @ to_world[:3, :3].T + to_world[:3, 3]).tolist(), faces, smooth
