# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Socket values of a medium: the coefficients of its dispersion formula."""

from ..model.medium import MediumRef, medium_from


def medium_sockets(
    prefix: str, ref: MediumRef
) -> dict[str, float | int | tuple[float, float, float]]:
    """The three sockets that every shader has for a medium.

    Args:
        prefix: First part of the sockets' identifiers, such as ``back``.
        ref: The medium of a document.

    Returns:
        Value by socket identifier.
    """
    medium = medium_from(ref)
    return {f"{prefix}_a": medium.a, f"{prefix}_b": medium.b, f"{prefix}_c_um2": medium.c_um2}
