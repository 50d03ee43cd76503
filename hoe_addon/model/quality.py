# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is asked of a picture: an error, a time, or both; quality names are such requests."""

from collections.abc import Mapping

from msgspec import Struct

from . import fields
from .field_error import FieldError
from .methods import QUALITY_ERRORS

ERROR_RANGE = (1e-4, 10.0)
SECONDS_RANGE = (0.1, 1e6)

LONGEST_S = 3600.0
"""A request for an error alone ends here; one that names seconds too ends where it says."""


class QualitySpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A request: the render goes on until the error is reached or the time is over.

    Attributes:
        error: Relative root mean square error of the luminance of a pixel: over the display's
            field of a light guide, over the lit picture of a scene. Null asks for none.
        seconds: All the time that may be taken, set-up counted. Null: an hour at most.
    """

    error: float | None = None
    seconds: float | None = None

    def __post_init__(self) -> None:
        """Check both numbers."""
        if self.error is None and self.seconds is None:
            raise FieldError.told("error", "must be given, or seconds, or both")
        for field, (low, high) in (("error", ERROR_RANGE), ("seconds", SECONDS_RANGE)):
            if getattr(self, field) is not None:
                fields.number(self, field, at_least=low, at_most=high)

    @property
    def time_limit(self) -> float:
        """Seconds after which the render ends, whatever it reached."""
        return LONGEST_S if self.seconds is None else self.seconds


QUALITIES: Mapping[str, QualitySpec] = {
    name: QualitySpec(error=error) for name, error in QUALITY_ERRORS.items()
}
"""Requests by name."""


def requested(quality: "str | QualitySpec | None") -> QualitySpec | None:
    """What a document or an option asks for.

    Args:
        quality: A name, a request, or None.

    Returns:
        The request; None where only a number of samples is asked for.

    Raises:
        FieldError: If there is no such name.
    """
    if not isinstance(quality, str):
        return quality
    if quality not in QUALITIES:
        raise FieldError("quality", f"must be one of {', '.join(QUALITIES)}", quality)
    return QUALITIES[quality]
