"""FLIP (Andersson et al. 2020) written down a second time, with two-dimensional kernels, as the test's oracle.

flip_oracle.py TEST.raw REFERENCE.raw WIDTH HEIGHT: float64 files, height x width x 3, sRGB encoded in [0,1]; prints the
FLIP value of every pixel, one a line.
"""
import sys

import numpy as np

PIXELS_PER_DEGREE = 3840 * np.pi / 180
XYZ_FROM_RGB = np.array([[0.4123908, 0.3575843, 0.1804808], [0.2126390, 0.7151687, 0.0721923],
                         [0.0193308, 0.1191948, 0.9505322]])
WHITE = XYZ_FROM_RGB.sum(1)


def linear(encoded):
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


def opponents(relative_xyz):
    x, y, z = np.moveaxis(relative_xyz, -1, 0)
    return np.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], -1)


def ycxcz(rgb):
    return opponents(rgb @ XYZ_FROM_RGB.T / WHITE)


def rgb_from_ycxcz(color):
    y = (color[..., 0] + 16) / 116
    xyz = np.stack([y + color[..., 1] / 500, y, y - color[..., 2] / 200], -1) * WHITE
    return xyz @ np.linalg.inv(XYZ_FROM_RGB).T


def hunt_lab(rgb):
    xyz, delta = rgb @ XYZ_FROM_RGB.T / WHITE, 6 / 29
    lab = opponents(np.where(xyz > delta**3, np.cbrt(xyz), xyz / (3 * delta**2) + 4 / 29))
    return np.stack([lab[..., 0], 0.01 * lab[..., 0] * lab[..., 1], 0.01 * lab[..., 0] * lab[..., 2]], -1)


def hyab(a, b):
    d = a - b
    return np.abs(d[..., 0]) + np.sqrt(d[..., 1] ** 2 + d[..., 2] ** 2)


def correlate(plane, kernel):
    radius, (height, width) = len(kernel) // 2, plane.shape
    padded, total = np.pad(plane, radius, mode="edge"), np.zeros_like(plane)
    for j in range(len(kernel)):
        for i in range(len(kernel)):
            total += kernel[j, i] * padded[j:j + height, i:i + width]
    return total


def grid(radius):
    return np.meshgrid(np.arange(-radius, radius + 1), np.arange(-radius, radius + 1))


def sensitivity_kernel(a1, b1, a2, b2):
    x, y = grid(int(np.ceil(3 * np.sqrt(0.04 / (2 * np.pi**2)) * PIXELS_PER_DEGREE)))
    d2 = (x**2 + y**2) / PIXELS_PER_DEGREE**2
    kernel = sum(a * np.sqrt(np.pi / b) * np.exp(-np.pi**2 * d2 / b) for a, b in ((a1, b1), (a2, b2)))
    return kernel / kernel.sum()


def perceived(color):
    kernels = [(1, 0.0047, 0, 1e-5), (1, 0.0053, 0, 1e-5), (34.1, 0.04, 13.5, 0.025)]
    filtered = [correlate(color[..., c], sensitivity_kernel(*kernels[c])) for c in range(3)]
    return hunt_lab(np.clip(rgb_from_ycxcz(np.stack(filtered, -1)), 0, 1))


def features(luminance, edge):
    sigma = 0.5 * 0.082 * PIXELS_PER_DEGREE
    x, y = grid(int(np.ceil(3 * sigma)))
    kernel = (-x if edge else x**2 / sigma**2 - 1) * np.exp(-(x**2 + y**2) / (2 * sigma**2))
    kernel = np.where(kernel > 0, kernel / kernel[kernel > 0].sum(), kernel / -kernel[kernel < 0].sum())
    return np.hypot(correlate(luminance, kernel), correlate(luminance, kernel.T))


def flip(test, reference):
    t, r = ycxcz(linear(test)), ycxcz(linear(reference))
    largest = hyab(hunt_lab(np.array([0.0, 1, 0])), hunt_lab(np.array([0.0, 0, 1]))) ** 0.7
    color, knee = hyab(perceived(t), perceived(r)) ** 0.7, 0.4 * largest
    color = np.where(color < knee, 0.95 * color / knee, 0.95 + 0.05 * (color - knee) / (largest - knee))
    t, r = (t[..., 0] + 16) / 116, (r[..., 0] + 16) / 116
    feature = np.maximum(*(np.abs(features(t, edge) - features(r, edge)) for edge in (True, False)))
    return color ** (1 - np.sqrt(feature / np.sqrt(2)))


if __name__ == "__main__":
    shape = (int(sys.argv[4]), int(sys.argv[3]), 3)
    images = [np.fromfile(path, np.float64).reshape(shape) for path in sys.argv[1:3]]
    print("\n".join("%.17g" % value for value in flip(*images).ravel()))
