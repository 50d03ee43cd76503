# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Make window pictures small files: fewer bits for each colour, as few as it takes."""

import argparse
import sys
from pathlib import Path

import numpy as np
import OpenImageIO as oiio  # noqa: N813  (the name that its own documentation uses)

MOST_BYTES: int = 290_000
MOST_BITS: int = 3
"""Bits that may be lost of each colour."""


def shrink(source: Path, target: Path) -> int:
    """Write a picture as a small PNG file.

    Args:
        source: The picture.
        target: The file.

    Returns:
        Bits that are lost.

    Raises:
        OSError: It cannot be read or written.
    """
    picture = oiio.ImageBuf(str(source))
    pixels = picture.get_pixels(oiio.UINT8)
    if pixels is None:
        raise OSError(f"{source}: {picture.geterror()}")
    for bits in range(MOST_BITS + 1):
        write(rounded(pixels[..., :3], bits), target)
        if target.stat().st_size < MOST_BYTES:
            break
    return bits


def rounded(pixels: np.ndarray, bits: int) -> np.ndarray:
    """Round colours.

    Args:
        pixels: Bytes.
        bits: How many to lose.

    Returns:
        Bytes of the same shape.
    """
    step = 1 << bits
    nearest = (pixels.astype(int) + step // 2) // step * step
    return np.clip(nearest, 0, 255).astype(np.uint8)


def write(pixels: np.ndarray, target: Path) -> None:
    """Write a PNG file.

    Args:
        pixels: Bytes, shape ``(height, width, 3)``.
        target: The file.

    Raises:
        OSError: It cannot be written.
    """
    height, width, channels = pixels.shape
    made = oiio.ImageBuf(oiio.ImageSpec(width, height, channels, oiio.UINT8))
    made.set_pixels(oiio.ROI(), np.ascontiguousarray(pixels))
    made.specmod()["png:compressionLevel"] = 9
    if not made.write(str(target)):
        raise OSError(f"{target}: {made.geterror()}")


def main() -> int:
    """Run from the command line.

    Returns:
        Exit code.
    """
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, required=True, help="folder for the small files")
    parser.add_argument("pictures", type=Path, nargs="+", help="pictures as they were taken")
    chosen = parser.parse_args()
    for picture in chosen.pictures:
        target = chosen.out / f"{picture.stem}.png"
        lost = shrink(picture, target)
        print(f"{target}: {target.stat().st_size} bytes, {lost} bits of each colour lost")
    return 0


if __name__ == "__main__":
    sys.exit(main())
