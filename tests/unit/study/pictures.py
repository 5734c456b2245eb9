"""A picture of two pixels, for pages whose figures nobody looks at."""

from pathlib import Path

from PIL import Image


def write_picture(path: Path, colour: tuple[int, int, int] = (200, 40, 40)) -> None:
    """Write a PNG of one colour."""
    Image.new("RGB", (2, 1), colour).save(path)
