# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Good files of every kind that a document may name, and how a program reads each."""

import copy
import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import OpenImageIO as oiio  # noqa: N813  (the name that its own documentation uses)

from hoe_addon.cli.ray_files import ray_table, read_rays
from hoe_addon.core.efficiency.table import EfficiencyTable
from hoe_addon.core.orders import Branch
from hoe_addon.model.document import hologram_from, load_device, load_hologram, to_document
from hoe_addon.model.reading import naming
from hoe_addon.model.tables.file import write_table
from hoe_addon.shading.pictures import check_picture
from tests.strangers.documents import PRESETS, lens

type Make = Callable[[Path], None]
type Read = Callable[[Path], object]


@dataclass(frozen=True)
class Sample:
    """A kind of file.

    Attributes:
        name: What it is.
        suffix: Ending of its name.
        make: Writes a good one.
        read: Reads one that may be anything.
        is_text: Whether people may write it by hand.
    """

    name: str
    suffix: str
    make: Make
    read: Read
    is_text: bool = False


def _table(path: Path) -> None:
    rng = np.random.default_rng(5)
    axes = {
        "wavelength": np.array([450e-9, 650e-9]),
        "along": np.array([-0.5, 0.0, 0.5]),
        "across": np.zeros(1),
        "x": np.zeros(1),
        "y": np.array([-1e-3, 2e-3]),
    }
    branches = (Branch(0), Branch(1), Branch(-1, reflected=True))
    shares = rng.random((1, *(len(nodes) for nodes in axes.values()), 3)) / 3.0
    write_table(path, EfficiencyTable(branches, *axes.values(), ("back",), shares, "clamp"))


def _read_hologram(change: Callable[[dict[str, Any], str], None]) -> Read:
    """Read a file by a hologram that names it, and write the hologram again."""

    def read(path: Path) -> object:
        document = copy.deepcopy(lens())
        change(document, str(path))
        with naming("a.json"):
            spec = hologram_from(document)
            assert hologram_from(to_document(spec)) == spec
        return spec

    return read


def _with_table(document: dict[str, Any], file: str) -> None:
    document["efficiency"] = {"model": "table", "file": file}
    del document["orders"]


def _with_grid(document: dict[str, Any], file: str) -> None:
    size = {"size_mm": [50, 50], "wavelength_nm": 532, "unit": "waves"}
    document["characteristic"] = {"kind": "sampled", "file": file, **size}
    del document["recording"]


def _with_heights(document: dict[str, Any], file: str) -> None:
    document["efficiency"]["levels"] = 0
    document["efficiency"]["profile"] = {"shape": "sampled", "file": file}


def _with_mesh(document: dict[str, Any], file: str) -> None:
    document["surface"] = {"shape": "mesh", "file": file}


def _grid() -> np.ndarray[Any, np.dtype[np.float64]]:
    x, y = np.meshgrid(np.linspace(-5.0, 5.0, 7), np.linspace(-5.0, 5.0, 6))
    return x**2 + 0.1 * x * y


def _grid_exr(path: Path) -> None:
    _picture(path, _grid()[..., None].astype(np.float32), oiio.FLOAT)


def _grid_npy(path: Path) -> None:
    np.save(path, _grid())


def _grid_csv(path: Path) -> None:
    np.savetxt(path, _grid(), delimiter=",", fmt="%.6g")


def _heights_npy(path: Path) -> None:
    np.save(path, np.linspace(0.0, 1.0, 16))


def _heights_text(path: Path) -> None:
    path.write_text("\n".join(f"{share / 15:.4f}" for share in range(16)), encoding="utf-8")


_CORNERS = ((-10, -10, 0), (10, -10, 0.5), (10, 10, 0), (-10, 10, 0.5), (0, 0, 1))
_FACES = ((0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4))


def _stl(path: Path) -> None:
    record = np.zeros(len(_FACES), [("n", "<f4", 3), ("c", "<f4", (3, 3)), ("e", "<u2")])
    record["c"] = np.array(_CORNERS)[np.array(_FACES)]
    path.write_bytes(bytes(80) + len(_FACES).to_bytes(4, "little") + record.tobytes())


def _stl_text(path: Path) -> None:
    lines = ["solid a"]
    for face in _FACES:
        lines += ["facet normal 0 0 1", "outer loop"]
        lines += [f"vertex {' '.join(map(str, _CORNERS[corner]))}" for corner in face]
        lines += ["endloop", "endfacet"]
    path.write_text("\n".join([*lines, "endsolid a", ""]), encoding="utf-8")


def _obj(path: Path) -> None:
    lines = ["# a", *(f"v {x} {y} {z}" for x, y, z in _CORNERS), "vn 0 0 1", "vn 0.1 0 1"]
    lines += [f"f {' '.join(f'{corner + 1}//{1 + corner % 2}' for corner in f)}" for f in _FACES]
    path.write_text("\n".join([*lines, ""]), encoding="utf-8")


def _hologram(path: Path) -> None:
    path.write_text(json.dumps(lens(), indent=1), encoding="utf-8")


def _device(path: Path) -> None:
    path.write_bytes((PRESETS / "holographic_sight.json").read_bytes())


def _rays(path: Path) -> None:
    rows = [f"{x},{0.5 * x},-10,0.1,0,{1 + x},532.5,{x % 3 - 1},{'TR'[x % 2]}" for x in range(6)]
    head = "x_mm,y_mm,z_mm,l,m,n,wavelength_nm,order,side"
    path.write_text("\n".join([head, *rows, ""]), encoding="utf-8")


def _read_rays(path: Path) -> object:
    return ray_table(read_rays(path))


def _picture(path: Path, pixels: Any, kind: Any) -> None:
    output = oiio.ImageOutput.create(str(path))
    height, width, channels = pixels.shape
    assert output.open(str(path), oiio.ImageSpec(width, height, channels, kind))
    assert output.write_image(pixels)
    output.close()


def _colours(path: Path) -> None:
    pixels = np.random.default_rng(7).integers(0, 255, (9, 12, 3), dtype=np.uint8)
    _picture(path, pixels, oiio.UINT8)


def _light(path: Path) -> None:
    _picture(path, np.random.default_rng(8).random((9, 12, 3), dtype=np.float32), oiio.FLOAT)


_TABLE, _GRID = _read_hologram(_with_table), _read_hologram(_with_grid)
_HEIGHTS, _MESH = _read_hologram(_with_heights), _read_hologram(_with_mesh)

SAMPLES = (
    Sample("hologram", ".json", _hologram, load_hologram, is_text=True),
    Sample("device", ".json", _device, load_device, is_text=True),
    Sample("table csv", ".csv", _table, _TABLE, is_text=True),
    Sample("table text", ".txt", _table, _TABLE, is_text=True),
    Sample("table npz", ".npz", _table, _TABLE),
    Sample("table exr", ".exr", _table, _TABLE),
    Sample("grid exr", ".exr", _grid_exr, _GRID),
    Sample("grid npy", ".npy", _grid_npy, _GRID),
    Sample("grid csv", ".csv", _grid_csv, _GRID, is_text=True),
    Sample("heights npy", ".npy", _heights_npy, _HEIGHTS),
    Sample("heights text", ".txt", _heights_text, _HEIGHTS, is_text=True),
    Sample("mesh stl", ".stl", _stl, _MESH),
    Sample("mesh stl text", ".stl", _stl_text, _MESH, is_text=True),
    Sample("mesh obj", ".obj", _obj, _MESH, is_text=True),
    Sample("rays", ".csv", _rays, _read_rays, is_text=True),
    Sample("picture png", ".png", _colours, check_picture),
    Sample("picture jpg", ".jpg", _colours, check_picture),
    Sample("picture tif", ".tif", _colours, check_picture),
    Sample("picture exr", ".exr", _light, check_picture),
    Sample("picture hdr", ".hdr", _light, check_picture),
)
