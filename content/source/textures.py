"""Procedural, seamless textures: a height field gives the normal map, the cavities and the tint."""

from __future__ import annotations

import io
import math

import numpy as np
from PIL import Image, ImageDraw, ImageFilter

SIZE = 512


# ----------------------------------------------------------------------------------------- noise


def _axis(size: int, frequency: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    t = (np.arange(size) + 0.5) * frequency / size
    cell = np.floor(t).astype(int)
    f = t - cell
    return cell % frequency, (cell + 1) % frequency, f * f * f * (f * (f * 6 - 15) + 10)


def value_noise(fx: int, fy: int, seed: int, size: int = SIZE) -> np.ndarray:
    """Smooth periodic noise of fx by fy cells, in 0 to 1."""
    lattice = np.random.RandomState(seed).rand(fy, fx)
    x0, x1, tx = _axis(size, fx)
    y0, y1, ty = _axis(size, fy)
    top = lattice[np.ix_(y0, x0)] * (1 - tx) + lattice[np.ix_(y0, x1)] * tx
    bottom = lattice[np.ix_(y1, x0)] * (1 - tx) + lattice[np.ix_(y1, x1)] * tx
    return top * (1 - ty[:, None]) + bottom * ty[:, None]


def fbm(fx: int, fy: int, octaves: int, seed: int, size: int = SIZE) -> np.ndarray:
    total = np.zeros((size, size))
    weight = 0.0
    for k in range(octaves):
        if max(fx, fy) << k > size:
            break
        total += value_noise(fx << k, fy << k, seed + 101 * k, size) * 0.5**k
        weight += 0.5**k
    return np.clip((total / weight - 0.5) * 1.6 + 0.5, 0, 1)


def voronoi(cells: int, seed: int, size: int = SIZE) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Periodic nearest and second nearest distances, in cells, and the nearest cell's number."""
    jitter = np.random.RandomState(seed).rand(cells, cells, 2)
    t = (np.arange(size) + 0.5) * cells / size
    x, y = np.meshgrid(t, t)
    cx, cy = np.floor(x).astype(int), np.floor(y).astype(int)
    first = np.full((size, size), 9.0)
    second = first.copy()
    number = np.zeros((size, size), int)
    for dy in (-2, -1, 0, 1, 2):
        for dx in (-2, -1, 0, 1, 2):
            ix, iy = (cx + dx) % cells, (cy + dy) % cells
            px = cx + dx + jitter[iy, ix, 0]
            py = cy + dy + jitter[iy, ix, 1]
            d = np.hypot(x - px, y - py)
            nearer = d < first
            second = np.where(nearer, first, np.minimum(second, d))
            number = np.where(nearer, iy * cells + ix, number)
            first = np.where(nearer, d, first)
    return first, second, number


def smoothstep(low: float, high: float, x: np.ndarray) -> np.ndarray:
    t = np.clip((x - low) / (high - low), 0, 1)
    return t * t * (3 - 2 * t)


def mix(a, b, t: np.ndarray) -> np.ndarray:
    t = t[..., None]
    return np.asarray(a) * (1 - t) + np.asarray(b) * t


def warped(field: np.ndarray, dx: np.ndarray, dy: np.ndarray) -> np.ndarray:
    size = field.shape[0]
    y, x = np.mgrid[0:size, 0:size]
    return field[(y + dy.astype(int)) % size, (x + dx.astype(int)) % size]


def blurred(field: np.ndarray, radius: int) -> np.ndarray:
    for axis in (0, 1):
        field = sum(np.roll(field, k, axis) for k in range(-radius, radius + 1)) / (2 * radius + 1)
    return field


# ------------------------------------------------------------------------------------- relief


def normal_map(height: np.ndarray, metres: float, strength: float = 1.0) -> np.ndarray:
    """Height in metres over a tile that is `metres` wide; green points up in the image."""
    step = 2 * metres / height.shape[0] / strength
    dx = (np.roll(height, -1, 1) - np.roll(height, 1, 1)) / step
    dy = (np.roll(height, -1, 0) - np.roll(height, 1, 0)) / step
    n = np.stack([-dx, dy, np.ones_like(height)], axis=2)
    n /= np.linalg.norm(n, axis=2, keepdims=True)
    return n * 0.5 + 0.5


def cavities(colour: np.ndarray, height: np.ndarray, depth: float, amount: float) -> np.ndarray:
    """Dirt gathers where the surface lies below its surroundings."""
    low = np.clip((blurred(height, 6) - height) / depth, -0.5, 1)
    return colour * (1 - amount * low)[..., None]


def courses(
    rows: list[tuple[float, list[float]]], tile: float, shifts: list[float], rough, size=SIZE
):
    """Blocks in courses: each pixel's block number and its distance to the joint, in metres."""
    t = (np.arange(size) + 0.5) * tile / size
    x, y = np.meshgrid(t, t)
    x = x + rough[0]
    y = y + rough[1]
    number = np.zeros((size, size), int)
    edge = np.full((size, size), 1.0)
    count = 0
    for copy in (-1, 0, 1):
        top = copy * tile
        count = 0
        for (tall, widths), shift in zip(rows, shifts):
            inside = (y >= top) & (y < top + tall)
            ydist = np.minimum(y - top, top + tall - y)
            left = shift - 2 * tile
            for wrap in range(4):
                for k, width in enumerate(widths):
                    here = inside & (x >= left) & (x < left + width)
                    xdist = np.minimum(x - left, left + width - x)
                    number[here] = count + k
                    edge[here] = np.minimum(xdist, ydist)[here]
                    left += width
            count += len(widths)
            top += tall
    return number, edge


def per_block(number: np.ndarray, seed: int, spread: float) -> np.ndarray:
    values = np.random.RandomState(seed).uniform(-spread, spread, int(number.max()) + 1)
    return values[number]


def _wobble(seed: int, amount: float):
    return [
        (fbm(8, 8, 4, seed + k) - 0.5) * 2 * amount + (fbm(40, 40, 2, seed + 9 + k) - 0.5) * amount
        for k in range(2)
    ]


# ------------------------------------------------------------------------------------- materials
# Each returns (colour in sRGB 0 to 1, height in metres or None).


def ashlar():
    """Squared sandstone, 2 m."""
    rows = [
        (0.5, [0.8, 0.55, 0.65]),
        (0.4, [0.6, 0.9, 0.5]),
        (0.6, [1.0, 0.45, 0.55]),
        (0.5, [0.7, 0.5, 0.8]),
    ]
    number, edge = courses(rows, 2.0, [0.1, 0.45, 0.0, 0.3], _wobble(11, 0.006))
    face = smoothstep(0.004, 0.028, edge)
    grain = fbm(16, 16, 5, 21)
    chips = smoothstep(0.62, 0.8, fbm(24, 24, 3, 22)) * (1 - smoothstep(0.02, 0.07, edge))
    first, second, _ = voronoi(40, 23)
    pits = 1 - smoothstep(0.05, 0.3, first)
    pits = pits * smoothstep(0.55, 0.75, fbm(10, 10, 3, 24))
    height = face * 0.014 + grain * 0.005 - chips * 0.008 - pits * 0.003
    height = height + per_block(number, 25, 0.0025) * face
    tone = per_block(number, 26, 0.085) + (fbm(3, 3, 5, 27) - 0.5) * 0.16 + (grain - 0.5) * 0.16
    warm = per_block(number, 28, 0.5) + 0.5
    stone = mix((0.70, 0.61, 0.49), (0.66, 0.62, 0.56), np.clip(warm, 0, 1)) * (1 + tone)[..., None]
    mortar = np.asarray((0.50, 0.46, 0.40)) * (0.85 + 0.3 * grain)[..., None]
    colour = mix(mortar, stone, smoothstep(0.002, 0.012, edge))
    return cavities(colour, height, 0.012, 0.55), height


def trim():
    """Dressed limestone for columns and mouldings, 1 m."""
    soft = fbm(3, 3, 5, 31)
    fine = fbm(40, 40, 4, 32)
    first, _, _ = voronoi(28, 33)
    pits = (1 - smoothstep(0.04, 0.22, first)) * smoothstep(0.5, 0.7, fbm(7, 7, 3, 34))
    height = fine * 0.0006 + soft * 0.004 - pits * 0.0015
    tone = (soft - 0.5) * 0.16 + (fine - 0.5) * 0.05 - pits * 0.13
    colour = mix((0.80, 0.73, 0.62), (0.76, 0.73, 0.67), fbm(4, 4, 4, 35)) * (1 + tone)[..., None]
    return colour, height


def marble():
    """A polished checkered floor of metre slabs, 4 m."""
    rows = [(1.0, [1.0] * 4)] * 4
    number, edge = courses(rows, 4.0, [0.0] * 4, [0.0, 0.0])
    dark = ((number % 4 + number // 4) % 2).astype(float)
    rng = np.random.RandomState(41)
    veins = np.zeros((SIZE, SIZE))
    cloud = np.zeros((SIZE, SIZE))
    base = np.abs(fbm(5, 5, 6, 42) - 0.5) * 2
    bend = fbm(4, 4, 4, 43) * 90
    base = warped(base, bend, np.roll(bend, 77, 0))
    soft = fbm(6, 6, 5, 44)
    for k in range(16):  # every slab is cut from another place of the quarry
        dy, dx = rng.randint(0, SIZE, 2)
        here = number == k
        turned = base.T if k % 3 else base
        veins[here] = np.roll(turned, (dy, dx), (0, 1))[here]
        cloud[here] = np.roll(soft, (dx, dy), (0, 1))[here]
    line = 1 - smoothstep(0.0, 0.16, veins)
    light = mix((0.76, 0.69, 0.59), (0.67, 0.59, 0.49), cloud)
    light = mix(light, (0.55, 0.46, 0.36), line * 0.5)
    deep = mix((0.37, 0.31, 0.265), (0.46, 0.385, 0.32), cloud)
    deep = mix(deep, (0.58, 0.50, 0.42), line * 0.5)
    colour = mix(light, deep, dark) * (1 + per_block(number, 45, 0.07))[..., None]
    joint = smoothstep(0.004, 0.014, edge)
    colour = mix((0.24, 0.21, 0.18), colour, joint)
    height = smoothstep(0.003, 0.018, edge) * 0.004 + soft * 0.0018
    return colour, height


def flagstones():
    """Worn irregular paving, 2 m."""
    bend = (fbm(6, 6, 4, 51) - 0.5) * 26
    first, second, number = voronoi(5, 52)
    gap = warped(second - first, bend, np.roll(bend, 111, 1)) * 0.4
    number = warped(number, bend, np.roll(bend, 111, 1))
    face = smoothstep(0.012, 0.06, gap)
    grain = fbm(14, 14, 5, 53)
    height = face * 0.016 + grain * 0.007 + per_block(number, 54, 0.003) * face
    tone = per_block(number, 55, 0.13) + (grain - 0.5) * 0.22
    stone = mix((0.50, 0.49, 0.46), (0.56, 0.51, 0.44), per_block(number, 56, 0.5) + 0.5)
    stone = stone * (1 + tone)[..., None]
    moss = mix((0.25, 0.24, 0.20), (0.24, 0.27, 0.15), fbm(5, 5, 3, 57))
    colour = mix(moss * (0.8 + 0.4 * grain)[..., None], stone, smoothstep(0.01, 0.04, gap))
    return cavities(colour, height, 0.014, 0.4), height


def brick():
    """Old brickwork in running bond, 2 m."""
    rows = [(2.0 / 16, [0.25] * 8)] * 16
    shifts = [0.125 * (k % 2) for k in range(16)]
    number, edge = courses(rows, 2.0, shifts, _wobble(61, 0.0045))
    face = smoothstep(0.003, 0.014, edge)
    grain = fbm(40, 40, 4, 62)
    height = face * 0.010 + grain * 0.004 + per_block(number, 63, 0.003) * face
    tone = per_block(number, 64, 0.20) + (grain - 0.5) * 0.28
    clay = mix((0.64, 0.37, 0.27), (0.56, 0.42, 0.33), per_block(number, 65, 0.5) + 0.5)
    clay = clay * (1 + tone)[..., None]
    soot = smoothstep(0.45, 0.8, fbm(3, 3, 5, 66))
    clay = mix(clay, clay * 0.62, soot)
    mortar = np.asarray((0.62, 0.57, 0.50)) * (0.75 + 0.45 * grain)[..., None]
    colour = mix(mortar, clay, smoothstep(0.002, 0.008, edge))
    return cavities(colour, height, 0.009, 0.4), height


def plaster():
    """Lime plaster with hair cracks, 2 m."""
    soft = fbm(3, 3, 6, 71)
    trowel = fbm(5, 14, 4, 72)
    bend = (fbm(8, 8, 4, 73) - 0.5) * 30
    first, second, _ = voronoi(6, 74)
    crack = 1 - smoothstep(0.0, 0.025, warped(second - first, bend, np.roll(bend, 90, 1)))
    crack = crack * smoothstep(0.55, 0.7, fbm(4, 4, 3, 75))
    height = trowel * 0.005 + fbm(40, 40, 3, 76) * 0.0015 - crack * 0.004
    tone = (soft - 0.5) * 0.16 + (trowel - 0.5) * 0.06 - crack * 0.35
    colour = mix((0.72, 0.63, 0.49), (0.68, 0.56, 0.42), fbm(2, 2, 5, 77)) * (1 + tone)[..., None]
    return colour, height


def _grain(seed: int) -> tuple[np.ndarray, np.ndarray]:
    rings = fbm(24, 2, 4, seed) * 0.6 + fbm(80, 3, 3, seed + 1) * 0.4
    lines = 0.5 + 0.5 * np.sin(fbm(8, 1, 4, seed + 2) * 2 * math.pi * 9)
    return rings, lines


def planks():
    """Oak boards that run along v, 2 m."""
    width = 2.0 / 9
    rng = np.random.RandomState(81)
    t = (np.arange(SIZE) + 0.5) * 2.0 / SIZE
    x, y = np.meshgrid(t, t)
    column = np.minimum((x / width).astype(int), 8)
    offset = rng.rand(9)[column] * 2.0
    along = (y + offset) % 2.0
    half = (along > 1.0).astype(int)
    number = column * 2 + half
    xdist = np.minimum(x - column * width, (column + 1) * width - x)
    ydist = np.minimum(along % 1.0, 1.0 - along % 1.0)
    edge = np.minimum(xdist, ydist)
    rings, lines = _grain(82)
    shift = rng.randint(0, SIZE, 18)
    grain = np.zeros((SIZE, SIZE))
    for k in range(18):
        here = number == k
        grain[here] = np.roll(rings * 0.7 + lines * 0.3, (shift[k], shift[-k - 1]), (0, 1))[here]
    nails = ((np.abs(ydist - 0.05) < 0.008) & (np.abs(xdist - 0.05) < 0.008)).astype(float)
    gap = smoothstep(0.001, 0.008, edge)
    height = gap * 0.008 + grain * 0.0022 + per_block(number, 83, 0.0015) + nails * 0.002
    tone = per_block(number, 84, 0.17) + (grain - 0.5) * 0.38
    wood = mix((0.57, 0.40, 0.25), (0.50, 0.355, 0.235), per_block(number, 85, 0.5) + 0.5)
    wood = wood * (1 + tone)[..., None]
    colour = mix((0.10, 0.07, 0.05), wood, smoothstep(0.0, 0.006, edge))
    colour = mix(colour, (0.16, 0.14, 0.13), blurred(nails, 1))
    return colour, height


def timber():
    """Dark beams, the grain along u, 1 m."""
    rings, lines = _grain(92)
    grain = (rings * 0.75 + lines * 0.25).T
    checks = smoothstep(0.72, 0.86, fbm(2, 44, 3, 95))
    height = grain * 0.003 - checks * 0.004
    tone = (grain - 0.5) * 0.5 - checks * 0.4
    colour = np.asarray((0.44, 0.31, 0.20)) * (1 + tone)[..., None]
    return colour, height


def carpet():
    """A runner: u goes across once, v along it."""
    t = (np.arange(SIZE) + 0.5) / SIZE
    x, y = np.meshgrid(t, t)
    side = np.minimum(x, 1 - x)
    # two lozenges a tile across and along
    a = np.abs(((x - 0.5) * 3) % 1.0 - 0.5) + np.abs((y * 3) % 1.0 - 0.5)
    motif = (np.abs(a - 0.36) < 0.035) | (a < 0.09)
    small = np.abs(((x - 0.5) * 3 + 0.5) % 1.0 - 0.5) + np.abs((y * 3 + 0.5) % 1.0 - 0.5) < 0.07
    gold = (np.abs(side - 0.045) < 0.012) | (np.abs(side - 0.125) < 0.008)
    wave = np.abs(side - 0.085 - 0.018 * np.sin(y * 2 * math.pi * 8)) < 0.010
    mask = blurred((((motif | small) & (side > 0.15)) | gold | wave).astype(float), 1)
    weave = 0.5 + 0.25 * np.sin(x * 2 * math.pi * 128) * np.sin(y * 2 * math.pi * 128)
    weave = weave + (fbm(64, 64, 3, 101) - 0.5) * 0.6
    wear = fbm(4, 4, 5, 102)
    red = mix((0.50, 0.065, 0.055), (0.40, 0.045, 0.05), wear)
    colour = mix(red, (0.70, 0.51, 0.22), mask * (0.55 + 0.4 * wear))
    colour = mix(colour, colour * 0.72, smoothstep(0.128, 0.14, 0.16 - side))
    return colour * (0.78 + 0.44 * weave)[..., None], weave * 0.004 + mask * 0.003


def iron():
    """Wrought iron, 1 m."""
    dents = fbm(14, 14, 4, 111)
    rust = smoothstep(0.55, 0.85, fbm(6, 6, 5, 112))
    colour = (
        mix((0.17, 0.17, 0.18), (0.30, 0.20, 0.13), rust * 0.7) * (0.75 + 0.5 * dents)[..., None]
    )
    return colour, dents * 0.006


def brass():
    """Tarnished gilding, 1 m; no relief of its own."""
    soft = fbm(5, 5, 5, 121)
    return mix((0.84, 0.63, 0.28), (0.58, 0.41, 0.17), soft)


def water():
    height = fbm(5, 5, 4, 131) * 0.035
    return mix((0.20, 0.36, 0.42), (0.27, 0.45, 0.48), fbm(3, 3, 3, 132)), height


def grass():
    """A meadow, 4 m."""
    blades = fbm(48, 48, 4, 141)
    tufts = smoothstep(0.35, 0.75, fbm(5, 5, 5, 142))
    green = mix((0.30, 0.42, 0.16), (0.50, 0.54, 0.26), tufts)
    return green * (0.75 + 0.5 * blades)[..., None]


def books():
    """Two shelves of spines, 1 m wide and 1 m high."""
    rng = np.random.RandomState(141)
    colour = np.zeros((SIZE, SIZE, 3)) + (0.045, 0.032, 0.024)
    height = np.zeros((SIZE, SIZE))
    palette = [(0.42, 0.12, 0.09), (0.16, 0.22, 0.15), (0.15, 0.17, 0.27), (0.46, 0.33, 0.18),
               (0.30, 0.19, 0.11), (0.52, 0.44, 0.32), (0.24, 0.11, 0.15)]  # fmt: skip
    half = SIZE // 2
    for shelf in range(2):
        foot = (shelf + 1) * half
        x = 0
        while x < SIZE - 8:
            width = min(int(rng.randint(11, 30)), SIZE - x)
            tall = int(half * rng.uniform(0.66, 0.9))
            tone = np.asarray(palette[rng.randint(len(palette))]) * rng.uniform(0.75, 1.25)
            round_ = np.sin(np.linspace(0.12, math.pi - 0.12, width))
            spine = np.tile(round_, (tall, 1))
            colour[foot - tall : foot, x : x + width] = tone * (0.55 + 0.5 * spine)[..., None]
            height[foot - tall : foot, x : x + width] = 0.01 + spine * 0.012
            if width > 14:
                for band in rng.uniform(0.1, 0.9, rng.randint(1, 4)):
                    row = foot - tall + int(tall * band)
                    colour[row : row + 4, x + 1 : x + width - 1] = (0.62, 0.47, 0.2)
                    height[row : row + 4, x : x + width] += 0.003
            x += width
            if rng.rand() < 0.08:
                x += int(rng.randint(8, 30))
    shade = 0.85 + 0.3 * fbm(20, 20, 3, 142)
    return colour * shade[..., None], blurred(height, 1)


def grate():
    """An iron lattice with holes, 1 m: returns the mask as the colour's fourth channel."""
    t = (np.arange(256) + 0.5) / 256
    x, y = np.meshgrid(t, t)

    def bar(v, count):
        return np.abs((v * count) % 1.0 - 0.5) / count

    vertical, flat = bar(x, 8), bar(y, 3)
    radius = 0.017
    near = np.minimum(vertical, flat * 0.8)
    height = np.sqrt(np.maximum(radius**2 - np.minimum(vertical, radius) ** 2, 0))
    height = np.maximum(height, 1.1 * np.sqrt(np.maximum(0.0004 - np.minimum(flat, 0.02) ** 2, 0)))
    dents = fbm(14, 14, 4, 151, 256)
    colour = mix((0.15, 0.15, 0.16), (0.28, 0.18, 0.12), fbm(5, 5, 4, 152, 256))
    colour = colour * (0.8 + 0.5 * dents)[..., None]
    alpha = (near < radius).astype(float)[..., None]
    return np.concatenate([colour, alpha], axis=2), height + dents * 0.002


def coffer():
    """A painted panel of the vault with a gilded rosette; once per panel."""
    t = (np.arange(256) + 0.5) / 256 - 0.5
    x, y = np.meshgrid(t, t)
    r, a = np.hypot(x, y), np.arctan2(y, x)
    petals = smoothstep(0.0, 0.05, 0.20 + 0.11 * np.abs(np.cos(4 * a)) - r)
    inner = smoothstep(0.0, 0.03, 0.11 + 0.045 * np.abs(np.sin(4 * a)) - r)
    bud = smoothstep(0.0, 0.03, 0.055 - r)
    side = 0.5 - np.maximum(np.abs(x), np.abs(y))
    frame = smoothstep(0.03, 0.04, side) * (1 - smoothstep(0.065, 0.075, side))
    gold = np.maximum(petals, frame)
    wear = fbm(5, 5, 5, 221, 256)
    ground = mix((0.10, 0.17, 0.36), (0.07, 0.12, 0.27), wear)
    gilt = mix((0.80, 0.60, 0.28), (0.60, 0.43, 0.19), wear) * (0.75 + 0.35 * inner)[..., None]
    colour = mix(ground, gilt, gold)
    return colour, petals * 0.02 + inner * 0.025 + bud * 0.03 + frame * 0.012 + wear * 0.002


# ------------------------------------------------------------------------------- drawn pictures


def _falcon(draw: ImageDraw.ImageDraw, cx: float, cy: float, s: float, fill) -> None:
    """The house's emblem: a stooping peregrine, wings raised."""
    right = [(0, -0.30), (0.07, -0.40), (0.10, -0.30), (0.30, -0.62), (0.62, -0.80), (0.50, -0.55),
             (0.60, -0.52), (0.46, -0.36), (0.54, -0.30), (0.38, -0.18), (0.44, -0.10),
             (0.24, -0.02), (0.16, 0.22), (0.10, 0.36), (0.22, 0.72), (0.08, 0.60), (0, 0.78)]  # fmt: skip
    outline = [(cx + x * s, cy + y * s) for x, y in right]
    outline += [(cx - x * s, cy + y * s) for x, y in reversed(right)]
    draw.polygon(outline, fill=fill)
    head = 0.115 * s
    draw.ellipse([cx - head, cy - 0.42 * s - head, cx + head, cy - 0.42 * s + head], fill=fill)
    beak = [
        (cx + 0.08 * s, cy - 0.50 * s),
        (cx + 0.22 * s, cy - 0.42 * s),
        (cx + 0.07 * s, cy - 0.37 * s),
    ]
    draw.polygon(beak, fill=fill)


def banner(field: tuple, ground: tuple) -> np.ndarray:
    """Cloth with a swallow-tailed foot: RGBA, 256 by 512."""
    k = 2
    w, h = 256 * k, 512 * k
    cloth = Image.new("RGBA", (w, h), (0, 0, 0, 0))
    draw = ImageDraw.Draw(cloth)
    gold = (196, 150, 66, 255)

    def tail(m):
        return [
            (m, m),
            (w - m, m),
            (w - m, h - 2 - 2 * m),
            (w / 2, h - 100 * k - m),
            (m, h - 2 - 2 * m),
        ]

    draw.polygon(tail(0), fill=gold)
    draw.polygon(tail(9 * k), fill=ground)
    draw.polygon(tail(14 * k), fill=gold)
    draw.polygon(tail(18 * k), fill=field)
    draw.ellipse([w / 2 - 88 * k, 110 * k, w / 2 + 88 * k, 286 * k], fill=gold)
    draw.ellipse([w / 2 - 82 * k, 116 * k, w / 2 + 82 * k, 280 * k], fill=ground)
    _falcon(draw, w / 2, 200 * k, 88 * k, gold)
    for y in (60, 330):
        draw.rectangle([34 * k, y * k, w - 34 * k, (y + 7) * k], fill=gold)
    for x in range(-2, 3):
        cx, cy = w / 2 + x * 36 * k, 362 * k
        draw.polygon(
            [(cx, cy - 13 * k), (cx + 11 * k, cy), (cx, cy + 13 * k), (cx - 11 * k, cy)], fill=gold
        )
    small = np.asarray(cloth.resize((256, 512), Image.LANCZOS), float) / 255
    weave = fbm(64, 64, 2, 161)[:, :256]
    folds = fbm(6, 1, 3, 162)[:, :256]
    small[..., :3] *= (0.72 + 0.28 * weave + 0.25 * (folds - 0.5))[..., None]
    return np.clip(small, 0, 1)


def stained_glass() -> np.ndarray:
    """A tall arched light: 256 by 512. The arch's spring lies a quarter of the way down."""
    k = 2
    w, h = 256 * k, 512 * k
    glass = Image.new("RGB", (w, h), (8, 8, 10))
    draw = ImageDraw.Draw(glass)
    rng = np.random.RandomState(171)
    lead = (6, 6, 8)
    blues = [(38, 74, 168), (52, 108, 190), (28, 52, 128), (70, 140, 205), (34, 96, 150)]
    warms = [(214, 148, 44), (196, 62, 40), (226, 182, 82), (164, 36, 44)]
    step = 32 * k
    for row in range(-1, h // step + 1):  # a ground of diamond quarries
        for column in range(-1, w // step + 2):
            cx = column * step + (step // 2 if row % 2 else 0)
            cy = row * step
            tint = blues[rng.randint(len(blues))]
            quarry = [(cx, cy - step), (cx + step / 2, cy), (cx, cy + step), (cx - step / 2, cy)]
            draw.polygon(quarry, fill=tint)
            draw.line(quarry + quarry[:1], fill=lead, width=2 * k)

    def ring(cx, cy, r0, r1, parts, tints):
        for part in range(parts):
            a0 = 2 * math.pi * part / parts
            a1 = 2 * math.pi * (part + 1) / parts
            arc = [a0 + (a1 - a0) * q / 6 for q in range(7)]
            shape = [(cx + r1 * math.cos(a), cy + r1 * math.sin(a)) for a in arc]
            shape += [(cx + r0 * math.cos(a), cy + r0 * math.sin(a)) for a in reversed(arc)]
            draw.polygon(shape, fill=tints[part % len(tints)])
            draw.line(shape + shape[:1], fill=lead, width=3 * k)

    cx, cy = w / 2, 150 * k
    ring(cx, cy, 78 * k, 104 * k, 16, warms)
    ring(cx, cy, 60 * k, 78 * k, 12, [blues[3], (232, 222, 190)])
    draw.ellipse(
        [cx - 60 * k, cy - 60 * k, cx + 60 * k, cy + 60 * k],
        fill=(24, 44, 110),
        outline=lead,
        width=3 * k,
    )
    _falcon(draw, cx, cy, 62 * k, (236, 206, 130))
    for cy in (312, 420):
        ring(cx, cy * k, 26 * k, 46 * k, 8, [warms[cy % 4], warms[2], warms[1], blues[3]])
        ring(cx, cy * k, 0.5 * k, 26 * k, 4, [warms[0], (232, 222, 190)])
    edge = 9 * k
    for y in range(0, h, 26 * k):
        for x in (0, w - edge):
            draw.rectangle(
                [x, y, x + edge, y + 26 * k], fill=warms[rng.randint(4)], outline=lead, width=2 * k
            )
    for x in (85 * k, 171 * k):  # stone-like mullions in iron
        draw.rectangle([x - 2 * k, 255 * k, x + 2 * k, h], fill=lead)
    for y in range(64 * k, h, 64 * k):
        draw.rectangle([0, y - k, w, y + k], fill=lead)
    small = glass.resize((256, 512), Image.LANCZOS).filter(ImageFilter.SMOOTH)
    pixels = np.asarray(small, float) / 255
    uneven = 0.72 + 0.56 * fbm(6, 6, 4, 172)[:, :256]
    return np.clip(pixels * uneven[..., None], 0, 1)


def leaded_glass() -> np.ndarray:
    """Clear diamond panes against the night: 256 by 256, tiles."""
    t = (np.arange(256) + 0.5) / 256
    x, y = np.meshgrid(t, t)
    a, b = (x * 4 + y * 2) % 1.0, (x * 4 - y * 2) % 1.0
    lead = np.minimum(np.minimum(a, 1 - a), np.minimum(b, 1 - b))
    pane = (np.floor(x * 4 + y * 2) * 7 + np.floor(x * 4 - y * 2) * 13).astype(int) % 17
    tint = np.random.RandomState(181).uniform(0.7, 1.25, 17)[pane]
    colour = (
        np.asarray((0.38, 0.52, 0.74)) * (tint * (0.8 + 0.4 * fbm(5, 5, 3, 182, 256)))[..., None]
    )
    return np.clip(mix((0.02, 0.02, 0.025), colour, smoothstep(0.045, 0.085, lead)), 0, 1)


def leaded_glass_pale() -> np.ndarray:
    """The same panes with a lamp behind them."""
    pixels = leaded_glass()
    return np.repeat(np.clip(pixels.mean(axis=2, keepdims=True) * 1.5, 0, 1), 3, axis=2)


def embers() -> np.ndarray:
    first, second, number = voronoi(9, 191, 256)
    heat = fbm(6, 6, 4, 192, 256)
    glow = smoothstep(0.30, 0.02, second - first) * (0.35 + 0.8 * heat)
    return np.clip(
        np.stack([glow * 1.25 + 0.10, glow**1.6 * 0.62 + 0.02, glow**3 * 0.22], axis=2), 0, 1
    )


def fire() -> np.ndarray:
    """A tongue of flame from its tip (above) to its foot, wrapped around once; 128 square."""
    size = 128
    t = (np.arange(size) + 0.5) / size
    x, up = np.meshgrid(t, 1 - t)
    lick = up + (fbm(4, 3, 3, 231, size) - 0.5) * 0.35
    colour = mix((0.30, 0.10, 0.06), (1.0, 0.86, 0.42), smoothstep(-0.05, 0.30, lick))
    colour = mix(colour, (1.0, 0.60, 0.14), smoothstep(0.30, 0.65, lick))
    return np.clip(mix(colour, (0.86, 0.22, 0.03), smoothstep(0.60, 1.0, lick)), 0, 1)


def night_sky() -> np.ndarray:
    """A disc seen from below: the zenith in the middle, the horizon on the rim; 1024 square."""
    size = 1024
    t = (np.arange(size) + 0.5) / size * 2 - 1
    x, y = np.meshgrid(t, t)
    rim = np.clip(np.hypot(x, y), 0, 1)
    sky = mix((0.035, 0.055, 0.125), (0.12, 0.17, 0.29), rim**1.5)
    cloud = smoothstep(0.45, 0.85, fbm(4, 4, 7, 201, size))
    sky = mix(sky, (0.19, 0.23, 0.34), cloud * 0.75)
    rng = np.random.RandomState(202)
    stars = np.zeros((size, size))
    for _ in range(1500):
        row, column = rng.randint(1, size - 1, 2)
        power = rng.rand() ** 5
        stars[row, column] += 0.25 + 0.9 * power
        if power > 0.4:
            for dy, dx in ((0, 1), (1, 0), (0, -1), (-1, 0)):
                stars[row + dy, column + dx] += 0.3 * power
    sky += (stars * (1 - cloud))[..., None] * (0.85, 0.92, 1.0)
    moon = np.hypot(x - 0.42, y - 0.06)
    sky += (0.35 * np.exp(-((moon / 0.10) ** 2)))[..., None] * (0.7, 0.8, 1.0)
    seas = 0.82 + 0.3 * fbm(40, 40, 4, 203, size)
    disc = smoothstep(0.036, 0.033, moon)
    return np.clip(mix(sky, np.ones(3) * seas[..., None] * (0.95, 0.97, 1.0), disc), 0, 1)


def ivy() -> np.ndarray:
    """Leaves with holes between them, 1 m, 512 square, RGBA, tiles."""
    rng = np.random.RandomState(211)
    size = SIZE
    picture = Image.new("RGBA", (size, size), (0, 0, 0, 0))
    draw = ImageDraw.Draw(picture)
    for layer in range(3):
        for _ in range(120):
            cx, cy = rng.randint(0, size, 2)
            r = rng.uniform(15, 27)
            turn = rng.uniform(-0.9, 0.9) + math.pi / 2
            tone = rng.uniform(0.55, 1.0) * (0.55 + 0.25 * layer)
            fill = (int(112 * tone), int(152 * tone), int(70 * tone), 255)
            vein = (int(150 * tone), int(185 * tone), int(105 * tone), 255)
            lobes = [(0.0, 1.0), (0.45, 0.55), (0.95, 0.9), (1.5, 0.5), (2.2, 0.75), (2.8, 0.4)]
            angles = [(turn + a, q) for a, q in lobes] + [(turn - a, q) for a, q in reversed(lobes)]
            for ox in (-size, 0, size):
                for oy in (-size, 0, size):
                    at = [
                        (cx + ox + r * q * math.cos(a), cy + oy + r * q * math.sin(a))
                        for a, q in angles
                    ]
                    draw.polygon(at, fill=fill)
                    tip = (cx + ox + r * 0.8 * math.cos(turn), cy + oy + r * 0.8 * math.sin(turn))
                    draw.line([(cx + ox, cy + oy), tip], fill=vein, width=1)
    return np.asarray(picture, float) / 255


# --------------------------------------------------------------------------------------- encoding


def _pixels(array: np.ndarray) -> Image.Image:
    return Image.fromarray(np.round(np.clip(array, 0, 1) * 255).astype(np.uint8))


def jpeg(array: np.ndarray, quality: int = 90, size: int | None = None) -> bytes:
    image = _pixels(array)
    if size and size != image.width:
        image = image.resize((size, size), Image.BOX)
    out = io.BytesIO()
    image.save(out, "JPEG", quality=quality, subsampling=0 if quality > 92 else 2, optimize=True)
    return out.getvalue()


def png(array: np.ndarray) -> bytes:
    out = io.BytesIO()
    image = _pixels(array)
    if array.shape[2] == 4:  # colour under a hole is the mean, so that filtering makes no dark rim
        data = np.asarray(image).copy()
        hole = data[..., 3] == 0
        data[hole, :3] = data[~hole, :3].mean(axis=0).astype(np.uint8)
        image = Image.fromarray(data)
    image.save(out, "PNG", optimize=True)
    return out.getvalue()
