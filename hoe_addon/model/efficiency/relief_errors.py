# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors of the making of a relief in a document, and the profile that they leave."""

from msgspec import Struct
from msgspec.structs import force_setattr

from ...core.efficiency.fabrication import mask_count, mask_segments, mask_steps, with_walls
from ...core.efficiency.profiles import Binary, Profile, Sawtooth, Sinusoid
from ...core.efficiency.segments import Segments, Steps, joined_samples, triangle
from .. import fields
from ..field_error import FieldError
from .lists import listed
from .relief_shapes import BinaryRelief, ReliefShape, SampledRelief, SawtoothRelief, TriangleRelief

_MOST_MASKS = 12
_WIDEST_EDGE = 0.5


class ReliefErrors(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """What the making of a relief does to it; all 0 by default.

    Attributes:
        depth_error: Relative error of the whole depth.
        etch_errors: Relative error of the depth of each binary mask, the deepest one first, of a
            sawtooth in levels whose number is a power of 2; empty for none.
        edge_width: Share of the period that each wall takes instead of being upright; the height
            is averaged over it, so a continuous sawtooth loses it to its flyback.
        duty_error: Excess width of each ridge, as a share of the period: of a binary relief, or of
            every line of every mask of a sawtooth in levels whose number is a power of 2.
    """

    depth_error: float = 0.0
    etch_errors: tuple[float, ...] = ()
    edge_width: float = 0.0
    duty_error: float = 0.0

    def __post_init__(self) -> None:
        """Check each number by itself."""
        fields.number(self, "depth_error", above=-1.0, at_most=1.0)
        fields.number(self, "edge_width", at_least=0.0, at_most=_WIDEST_EDGE)
        fields.number(self, "duty_error", above=-1.0, at_most=1.0)
        items = listed("etch_errors", self.etch_errors, 0, _MOST_MASKS)
        paths = [f"etch_errors[{place}]" for place in range(len(items))]
        values = tuple(map(fields.value, paths, items))
        for path, value in zip(paths, values, strict=True):
            if not -1.0 < value <= 1.0:
                raise FieldError(path, "must be above -1 and at most 1", value)
        force_setattr(self, "etch_errors", values)


NO_ERRORS = ReliefErrors()


def check_together(shape: ReliefShape, levels: int, errors: ReliefErrors) -> None:
    """Check that a shape, its levels and its errors fit.

    Args:
        shape: The shape of the period.
        levels: Number of levels, or 0.
        errors: What its making does to it.

    Raises:
        FieldError: Levels of a shape that has none, or an error that the shape cannot have.
    """
    sawtooth = isinstance(shape, SawtoothRelief)
    if levels and not sawtooth:
        raise FieldError("levels", "must be 0 unless the profile is a sawtooth", levels)
    masks = mask_count(levels) if sawtooth else None
    if errors.etch_errors and len(errors.etch_errors) != masks:
        rule = f"must be one for each of {masks} masks"
        if masks is None:
            rule = "needs a sawtooth in levels whose number is a power of 2"
        raise FieldError("errors.etch_errors", rule, errors.etch_errors)
    if errors.duty_error:
        _check_duty(shape, masks, errors.duty_error)
    if errors.edge_width:
        _check_edges(shape, levels, errors.edge_width)


def _check_duty(shape: ReliefShape, masks: int | None, error: float) -> None:
    if isinstance(shape, BinaryRelief):
        if not 0.0 < shape.duty + error < 1.0:
            raise FieldError("errors.duty_error", "must leave a ridge and a gap", error)
        return
    if masks is None or masks > _MOST_MASKS:
        most = 2**_MOST_MASKS
        rule = f"needs a binary profile, or a sawtooth in 2, 4, 8, ... at most {most} levels"
        raise FieldError("errors.duty_error", rule, error)
    if abs(error) >= 0.5**masks:
        raise FieldError("errors.duty_error", f"must be below {0.5**masks:g} in size", error)


def _check_edges(shape: ReliefShape, levels: int, width: float) -> None:
    stepped = isinstance(shape, SampledRelief) and shape.between == "steps"
    if not (stepped or isinstance(shape, SawtoothRelief | BinaryRelief)):
        raise FieldError("errors.edge_width", "needs a profile with upright walls", width)
    if levels and width * levels > 1.0:
        raise FieldError("errors.edge_width", f"must be at most {1.0 / levels:g}, one step", width)


def made_profile(shape: ReliefShape, levels: int, errors: ReliefErrors) -> Profile:
    """Make the profile that is left of a shape; the error of the whole depth is not in it.

    Args:
        shape: The shape of the period.
        levels: Number of levels, or 0.
        errors: What its making does to it; they fit.

    Returns:
        The profile of the core.
    """
    match shape:
        case SawtoothRelief():
            return _sawtooth(levels, errors)
        case BinaryRelief():
            return _binary(shape.duty + errors.duty_error, errors.edge_width)
        case TriangleRelief():
            return triangle(shape.peak)
        case SampledRelief():
            return _sampled(shape, errors.edge_width)
        case _:
            return Sinusoid()


def _sawtooth(levels: int, errors: ReliefErrors) -> Profile:
    if not (errors.etch_errors or errors.duty_error):
        return Sawtooth(levels, errors.edge_width)
    if errors.duty_error or errors.edge_width:
        lines = mask_segments(levels, errors.etch_errors, errors.duty_error)
        return with_walls(lines, errors.edge_width) if errors.edge_width else lines
    return mask_steps(levels, errors.etch_errors)


def _binary(duty: float, edge_width: float) -> Profile:
    if not edge_width:
        return Binary(duty)
    return with_walls(Binary(duty).segments(), edge_width)


def _sampled(shape: SampledRelief, edge_width: float) -> Segments | Steps:
    if shape.between == "linear":
        return joined_samples(shape.samples())
    steps = Steps(shape.samples())
    return with_walls(steps.segments(), edge_width) if edge_width else steps
