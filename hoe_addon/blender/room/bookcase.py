# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The bookcase of the living room, with books and a few vessels."""

from collections.abc import Sequence

import bpy
import numpy as np

from ..build import meshes
from . import materials as materials
from . import shapes as shapes
from .furniture import FLOOR, WALL

_SEED = 11
_LEFT, _RIGHT = -1390.0, -840.0
_DEPTH = 290.0
_BOARD = 24.0
_STEP = 335.0
_BOARDS = 6

_COVERS: tuple[materials.Colour, ...] = (
    (0.34, 0.085, 0.055),
    (0.045, 0.10, 0.15),
    (0.42, 0.36, 0.26),
    (0.09, 0.14, 0.085),
    (0.40, 0.22, 0.06),
    (0.55, 0.52, 0.47),
    (0.10, 0.085, 0.08),
)


def add_bookcase(collection: bpy.types.Collection) -> None:
    """Add an open oak bookcase at the left edge of the view."""
    front = WALL - _DEPTH
    oak = materials.mottled("Oak", ((0.25, 0.145, 0.075), (0.36, 0.22, 0.12)), (350.0, 60.0, 9.0))
    boards = [
        shapes.box((_LEFT, front, z), (_RIGHT, WALL, z + _BOARD))
        for z in map(_board, range(_BOARDS))
    ]
    top = _board(_BOARDS - 1) + _BOARD
    for x in (_LEFT - _BOARD, _RIGHT):
        boards.append(shapes.box((x, front, FLOOR), (x + _BOARD, WALL, top)))
    boards.append(shapes.box((_LEFT, WALL - 12.0, FLOOR), (_RIGHT, WALL, top)))
    meshes.add(collection, shapes.joined(boards).mesh("Bookcase"), oak)
    _add_books(collection)
    _add_vessels(collection)


def _board(number: int) -> float:
    """Height of the lower side of a board, the lowest first."""
    return FLOOR + 70.0 + number * _STEP


def _add_books(collection: bpy.types.Collection) -> None:
    """One object for each colour of cover."""
    rng = np.random.default_rng(_SEED)
    shelves = [
        (1, _LEFT, _RIGHT - 15.0),
        (2, _LEFT, _RIGHT - 190.0),
        (3, _RIGHT - 330.0, _RIGHT - 5.0),
        (4, _LEFT, _RIGHT - 215.0),
    ]
    books: list[list[shapes.Shape]] = [[] for _ in _COVERS]
    for board, start, end in shelves:
        for cover, book in _row(rng, start, end, _board(board) + _BOARD):
            books[cover].append(book)
    for level, cover in enumerate((5, 1, 4)):
        book = shapes.box((-95.0, -75.0, 0.0), (95.0 - 9.0 * level, 75.0, 28.0))
        book = book.turned("z", 4.0 * level - 5.0)
        books[cover].append(
            book.moved(_RIGHT - 112.0, WALL - 160.0, _board(4) + _BOARD + 28.0 * level)
        )
    for number, (colour, group) in enumerate(zip(_COVERS, books, strict=True)):
        mesh = shapes.joined(group).mesh(f"Books {number + 1}")
        meshes.add(collection, mesh, materials.matte(mesh.name, colour))


def _row(
    rng: np.random.Generator, start: float, end: float, foot: float
) -> Sequence[tuple[int, shapes.Shape]]:
    """Upright books from left to right: number of the cover, and body."""
    row: list[tuple[int, shapes.Shape]] = []
    x = start + 2.0
    while True:
        thick, high, deep = rng.uniform((17.0, 185.0, 140.0), (44.0, 270.0, 200.0))
        if x + thick > end:
            return row
        back = WALL - 40.0
        body = shapes.box((x, back - deep, foot), (x + thick, back, foot + high))
        row.append((int(rng.integers(len(_COVERS))), body))
        x += thick + 1.5


def _add_vessels(collection: bpy.types.Collection) -> None:
    vase = [(40.0, 0.0), (70.0, 60.0), (74.0, 105.0), (48.0, 170.0), (26.0, 200.0), (34.0, 232.0)]
    bowl = [(30.0, 0.0), (62.0, 26.0), (84.0, 66.0), (79.0, 66.0), (56.0, 30.0), (0.1, 14.0)]
    jar = [(52.0, 0.0), (64.0, 20.0), (64.0, 120.0), (45.0, 148.0), (0.1, 150.0)]
    places: list[tuple[str, list[tuple[float, float]], materials.Colour, float, int, float]] = [
        ("Vase", vase, (0.06, 0.16, 0.17), -98.0, 2, 0.0),
        ("Bowl", bowl, (0.56, 0.50, 0.42), -112.0, 4, 84.0),
        ("Jar", jar, (0.45, 0.22, 0.12), -425.0, 3, 0.0),
        ("Tall Vase", vase, (0.50, 0.47, 0.42), -120.0, 5, 0.0),
    ]
    for name, profile, colour, x, board, lift in places:
        mesh = shapes.lathe(profile).mesh(name, smooth=True)
        glaze = materials.polished(name, colour, 0.45)
        place = (_RIGHT + x, WALL - 160.0, _board(board) + _BOARD + lift)
        meshes.add(collection, mesh, glaze, location=place)
