# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""``efficiency``: how much light each order gets, as a table."""

import argparse
from collections.abc import Iterator
from itertools import product
from typing import Any

from ..core.errors import HoeError
from .one_hologram import add_hologram_arguments, hologram_of
from .parser import LIST_HELP, numbers, orders

HEADER = "wavelength_nm,theta_deg,phi_deg,order,side,efficiency\n"

_DESCRIPTION = """\
Write the share of the incident power that each order gets, transmitted (T) and reflected (R).
The angles are those of the incident ray in its own medium: theta from the surface normal, phi the
azimuth of its direction of travel from +x toward +y. The ray meets the centre of the element. An
evanescent order has exactly 0. Every order asked for gets the value of the efficiency model; the
document's "orders" only limit what a picture traces. An order of a multiplexed hologram gets the
sum over its exposures. Scalar models give the same for every polarisation.
"""
RIGHT_ANGLE_DEG = 90.0
_BLOCK = 10_000
"""Directions looked at together: enough for numpy, little memory."""


def register(subparsers: "argparse._SubParsersAction[Any]") -> None:
    """Add the command to the parser.

    Args:
        subparsers: Where the commands are.
    """
    parser = subparsers.add_parser(
        "efficiency", help="share of the light in each order, as CSV", description=_DESCRIPTION
    )
    add_hologram_arguments(parser)
    add = parser.add_argument
    add("--wavelengths", metavar="LIST", type=numbers, required=True, help=f"nm, {LIST_HELP}")
    add("--orders", metavar="A:B", type=orders, required=True, help="A:B (B included) or a,b,c")
    add("--theta", metavar="LIST", type=numbers, default=[0.0], help="degrees, default 0")
    add("--phi", metavar="LIST", type=numbers, default=[0.0], help="degrees, default 0")
    add(
        "--from",
        dest="side",
        choices=("back", "front"),
        default="back",
        help="side that the light comes from, default back (z < 0)",
    )
    add(
        "--polarization",
        choices=("s", "p", "u"),
        default="u",
        help="s (electric field across the plane of incidence), p (in it) or u, the mean (default)",
    )
    add("--out", metavar="OUT.csv", required=True, help="file to write")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Write the table.

    Args:
        args: Arguments as registered.

    Returns:
        Exit code.
    """
    from ..files import write_text
    from ..model import fields

    for wavelength_nm in args.wavelengths:
        fields.wavelength_value("--wavelengths", wavelength_nm)
    for theta in args.theta:
        if abs(theta) >= RIGHT_ANGLE_DEG:
            raise HoeError(f"--theta: must be between -90 and 90, got {theta!r}")
    spec = hologram_of(args)
    write_text(args.out, _rows(args, spec))
    return 0


def _rows(args: argparse.Namespace, spec: Any) -> Iterator[str]:
    """Make the lines of the table, wavelength by wavelength."""
    import numpy as np
    from tqdm import tqdm

    from ..core.efficiency import Polarization
    from ..model.evaluate import efficiencies, incident_direction
    from ..model.reading import naming

    yield HEADER
    polarization = Polarization(args.polarization)
    block = max(1, _BLOCK // len(args.phi))
    starts = range(0, len(args.theta), block)
    for wavelength_nm in tqdm(args.wavelengths, desc="efficiency", unit="nm", disable=None):
        for thetas in (args.theta[start : start + block] for start in starts):
            grid = np.meshgrid(thetas, args.phi, indexing="ij")
            direction = incident_direction(*grid, from_front=args.side == "front")
            with naming(args.document):
                shares = efficiencies(spec, direction, wavelength_nm, args.orders, polarization)
            angles = product(thetas, args.phi)
            of_angles = shares.reshape(-1, *shares.shape[2:]).tolist()
            for (theta, phi), of_orders in zip(angles, of_angles, strict=True):
                start = f"{wavelength_nm!r},{theta!r},{phi!r}"
                for order, (transmitted, reflected) in zip(args.orders, of_orders, strict=True):
                    yield f"{start},{order},T,{transmitted!r}\n"
                    yield f"{start},{order},R,{reflected!r}\n"
