# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Options that all commands with a picture share, and the way they change a device."""

import argparse
import json
from collections.abc import Sequence
from typing import TYPE_CHECKING

from ..core.errors import HoeError
from ..model.methods import METHODS

if TYPE_CHECKING:
    from ..blender.build.device import DeviceScene
    from ..model.device import DeviceSpec, LightGuideSpec

OF_DOCUMENT = "default: of the document"


def add_picture_options(parser: argparse.ArgumentParser) -> None:
    """Add what sets a picture's size, cost and content.

    Args:
        parser: Parser of one command.
    """
    add = parser.add_argument
    add("device", metavar="PRESET|FILE.json", help="name of a preset, or a device's JSON file")
    add("--out", metavar="DIR", required=True, help="folder for the results, made if need be")
    add("--size", metavar="WxH", type=size, help=f"pixels of a picture ({OF_DOCUMENT})")
    add("--samples", metavar="N", type=int, help=f"samples per pixel ({OF_DOCUMENT})")
    add("--seed", metavar="N", type=int, help=f"same seed, same picture ({OF_DOCUMENT})")
    add(
        "--mode",
        choices=("spectral", "preview"),
        help=f"all wavelengths, or one for a quick look ({OF_DOCUMENT})",
    )
    add(
        "--set",
        metavar="PATH=VALUE",
        action="append",
        default=[],
        dest="assignments",
        help="change a field of the device, such as guide.medium=1.5 or eye.position_mm=[0,1,0]; "
        "may be given more than once",
    )
    add(
        "--method",
        choices=tuple(METHODS),
        help="published: uniform wavelengths, orders by significance, all effects; guided: what a "
        f"render does by itself, in less time ({OF_DOCUMENT})",
    )
    add_effects_option(parser)
    add(
        "--no-denoise",
        action="store_false",
        dest="denoise",
        help="leave the noise in PNG files; EXR files and numbers are never denoised",
    )


def add_effects_option(parser: argparse.ArgumentParser) -> None:
    """Add what changes the effect plan.

    Args:
        parser: Parser of one command.
    """
    parser.add_argument(
        "--effects",
        metavar="CHANGES",
        type=effects,
        help="change the effect plan: +haze,-levels turns effects on and off, NAME:-levels for one "
        "hologram, all simulates everything",
    )


def effects(text: str) -> list[str]:
    """Read changes of the effect plan.

    Args:
        text: Changes with a comma between.

    Returns:
        The changes.

    Raises:
        ArgumentTypeError: One is empty.
    """
    found = [part.strip() for part in text.split(",")]
    if not all(found):
        raise argparse.ArgumentTypeError(f"must be changes with a comma between, got {text!r}")
    return found


def effects_assignment(args: argparse.Namespace) -> list[str]:
    """The change that ``--effects`` asks for, in the form of ``--set``.

    Args:
        args: Arguments with the option of ``add_effects_option``.

    Returns:
        One text ``path=value``, or none.
    """
    return [] if args.effects is None else [f"render.effects={json.dumps(args.effects)}"]


def size(text: str) -> tuple[int, int]:
    """Read ``WxH``.

    Args:
        text: Two whole numbers with an x between.

    Returns:
        The numbers.

    Raises:
        ArgumentTypeError: It is not so.
    """
    try:
        width, height = (int(part) for part in text.lower().split("x"))
    except ValueError:
        raise argparse.ArgumentTypeError(
            f"must be two whole numbers with an x between, got {text!r}"
        ) from None
    if width < 1 or height < 1:
        raise argparse.ArgumentTypeError(f"both numbers must be at least 1, got {text!r}")
    return width, height


def assignments(args: argparse.Namespace) -> list[str]:
    """All changes that the options ask for, in the form of ``--set``.

    Args:
        args: Arguments with the options of ``add_picture_options``.

    Returns:
        Texts ``path=value``; those of ``--set`` come first, so that an option of its own wins.
    """
    options = {"size": args.size, "samples": args.samples, "seed": args.seed, "mode": args.mode}
    given = {name: value for name, value in options.items() if value is not None}
    given = {**METHODS.get(args.method, {}), **given}
    own = [f"render.{name}={json.dumps(value)}" for name, value in given.items()]
    return [*args.assignments, *own, *effects_assignment(args)]


def device_of(args: argparse.Namespace, more: Sequence[str] = ()) -> "DeviceSpec":
    """Read the device that the options name, with their changes.

    Args:
        args: Arguments with the options of ``add_picture_options``.
        more: Further changes, in the form of ``--set``.

    Returns:
        The valid device.

    Raises:
        SpecError: The document, or a change, is not valid.
    """
    from ..model.document import find_device, load_device, picture_paths
    from ..model.effects.holograms import holograms_of
    from ..model.effects.overrides import read_overrides
    from ..model.reading import naming
    from ..shading.pictures import check_picture

    spec = load_device(args.device, [*assignments(args), *more])
    with naming(args.device):
        read_overrides(spec.render.effects, holograms_of(spec))
        for field, path in picture_paths(spec, find_device(args.device).parent).items():
            check_picture(path, field)
    return spec


def light_guide_of(args: argparse.Namespace, more: Sequence[str] = ()) -> "LightGuideSpec":
    """Read the light guide that the options name, with their changes.

    Args:
        args: Arguments with the options of ``add_picture_options``.
        more: Further changes, in the form of ``--set``.

    Returns:
        The valid light guide.

    Raises:
        SpecError: The document, or a change, is not valid, or it is a device of another kind.
    """
    from ..core.errors import SpecError
    from ..model.device import LightGuideSpec

    for changes in ((), more):
        spec = device_of(args, changes)
        if not isinstance(spec, LightGuideSpec):
            raise SpecError(f"{args.device}: kind: must be light_guide for an eyebox, got scene")
    return spec


def open_device(args: argparse.Namespace, spec: "DeviceSpec") -> "DeviceScene":
    """Build a device in a new, empty Blender file.

    Args:
        args: Arguments with the options of ``add_picture_options``.
        spec: The device that ``device_of`` gave.

    Returns:
        The device in its scene.

    Raises:
        HoeError: This Blender cannot render it.
        SpecError: Its effects cannot be followed.
    """
    from ..model.effects import plan_effects
    from ..model.reading import naming

    with naming(args.device):
        plan = plan_effects(spec)

    import bpy

    from ..blender.build.device import build_device
    from ..blender.quiet import forget_removed_engines
    from ..model.document import find_device

    forget_removed_engines()

    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    if scene is None:
        raise HoeError("Blender has no scene to build in")
    return build_device(scene, spec, find_device(args.device).parent, plan)
