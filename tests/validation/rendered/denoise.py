"""Averages a picture's light over neighbours that show the same flat thing: what hundreds of samples more would take hours for.

    smooth = rho sum Y / sum rho,   over the pixels of a window that show the same thing and face the same way
    Y: luminance. rho: what a pixel reflects.

A pattern stays, edges of things stay; those of shadows are softer by half of the window. At edges, where too few pixels are alike, the window
is 3 x 3 and takes all. What shines, borders on it, or reflects next to nothing, stays as it is.
"""
import os

os.environ["OPENCV_IO_ENABLE_OPENEXR"] = "1"
import cv2  # noqa: E402
import numpy as np  # noqa: E402

REACH = 4  # pixels to each side
SAME_WAY = 0.995
FEWEST = 9  # pixels alike


def read(path):
    return cv2.imread(str(path), cv2.IMREAD_UNCHANGED)[..., :3]


class Guides:
    """What the pixels of a view show."""

    def __init__(self, folder, view):
        self.index = np.rint(read(folder / f"{view}_index.exr")[..., 0]).astype(int)
        normal = read(folder / f"{view}_normal.exr")
        self.normal = normal / np.maximum(np.linalg.norm(normal, axis=2, keepdims=True), 1e-6)
        self.colour = read(folder / f"{view}_colour.exr").mean(axis=2)
        shines = (read(folder / f"{view}_shining.exr").max(axis=2) > 0).astype(np.uint8)
        self.is_kept = (cv2.dilate(shines, np.ones((3, 3), np.uint8)) > 0) | (self.colour < 0.01)

    def _sums(self, light, colour, reach, is_alike):
        """Returns the sums of light, of colour and of pixels over a window."""
        height, width = light.shape
        pad = [(reach, reach)] * 2
        index, normal = np.pad(self.index, pad, constant_values=-1), np.pad(self.normal, [*pad, (0, 0)])
        light, colour = np.pad(light, pad), np.pad(colour, pad)
        sums = np.zeros((3, height, width))
        for v in range(2 * reach + 1):
            for u in range(2 * reach + 1):
                at = (slice(v, v + height), slice(u, u + width))
                takes = is_alike(index[at], normal[at])
                sums += np.stack([takes * light[at], takes * colour[at], takes * np.ones_like(light[at])])
        return sums

    def smooth(self, luminance):
        light, colour = np.where(self.is_kept, 0, luminance), np.where(self.is_kept, 0, self.colour)
        alike = self._sums(light, colour, REACH, lambda index, normal: (index == self.index) & ((normal * self.normal).sum(axis=2) > SAME_WAY))
        near = self._sums(light, colour, 1, lambda index, normal: np.ones(index.shape))
        sums = np.where(alike[2] < FEWEST, near, alike)
        return np.where(self.is_kept, luminance, self.colour * sums[0] / np.maximum(sums[1], 1e-9))
