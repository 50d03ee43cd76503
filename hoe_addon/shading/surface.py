# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The surface's shape in the shader: code for its true normal, and for the exact hit.

The code may read ``position`` and ``heading`` (the hit and the ray's unit direction of travel, in
the frame of the recording, in scene units). On a curved surface it sets ``curved`` to 1 and
``frame_normal`` to the true unit normal on the front; it may move ``position`` onto the surface.

The object may be moved, turned, mirrored, scaled and sheared: the code works in the object's own
measures, and the shader maps the normal as the object's matrix maps the surface.
"""

from ..core.shapes.quadric import Quadric
from ..model.mesh_surface import MeshSurface
from ..model.outline import reach_mm
from ..model.surface import AsphereSurface, PlaneSurface, SurfaceSpec
from .part import ShaderPart, SocketValues, parameter

_CURVATURE = parameter(
    "float", "surface_curvature", "0.0", "Curvature", "One over the radius, in 1 / scene units"
)
_WEIGHTS = parameter(
    "vector", "surface_weights", "vector(1.0)", "Weights", "Factors of x^2, y^2, z^2 of the surface"
)
_QUADRIC = (
    "curved = 1; "
    "position += heading * "
    "hoe_quadric_step(position, heading, surface_curvature, surface_weights); "
    "frame_normal = hoe_quadric_normal(position, surface_curvature, surface_weights);"
)
_MESH = (
    "curved = 1; frame_normal = hoe_mesh_normal(attribute_hoe_normal, N, backfacing(), frame_x, "
    "frame_y, frame_z, mapped_x, mapped_y, mapped_z);"
)
_EXACT_NORMAL = parameter(
    "vector", "attribute_hoe_normal", "vector(0.0)", "Exact Normal", "From the mesh, or zero"
)
_NEWTON_STEPS = 4
"""From a facet that is 1e-3 off, three steps reach float32; the fourth is for grazing rays."""


def surface_part(surface: SurfaceSpec, units_per_mm: float) -> ShaderPart:
    """The shader's part for the shape.

    Args:
        surface: The shape.
        units_per_mm: Scene units in one mm.

    Returns:
        Its part; a plane needs none.
    """
    if isinstance(surface, PlaneSurface):
        return ShaderPart()
    if isinstance(surface, MeshSurface):
        return ShaderPart(parameters=_EXACT_NORMAL, code=_MESH)
    if isinstance(surface, AsphereSurface):
        return _asphere(surface, units_per_mm)
    shape = surface.core_shape()
    assert isinstance(shape, Quadric), "spheres, conics and cylinders are of second degree"
    return ShaderPart(
        parameters=f"{_CURVATURE} {_WEIGHTS}",
        code=_QUADRIC,
        sockets={
            "surface_curvature": 1.0 / (surface.radius_mm * units_per_mm),
            "surface_weights": shape.weights,
        },
    )


def hit_part(surface: SurfaceSpec) -> ShaderPart:
    """The part that moves the hit onto the true surface, where there is a formula for it.

    Args:
        surface: The shape.

    Returns:
        The same as in the hologram's shader; none for planes and meshes.
    """
    return ShaderPart() if isinstance(surface, MeshSurface) else surface_part(surface, 1.0)


def _asphere(surface: AsphereSurface, units_per_mm: float) -> ShaderPart:
    """Newton's method from the facet; powers of the radius over the reach stay near 1."""
    count = len(surface.coefficients)
    names = [f"surface_a{2 * place + 4}" for place in range(count)]
    shared = ["surface_curvature", "surface_conic", "surface_reach", *names]
    reach = reach_mm(surface.outline, surface.size_mm)
    sockets: SocketValues = {
        "surface_curvature": 1.0 / (surface.radius_mm * units_per_mm),
        "surface_conic": surface.conic,
        "surface_reach": reach * units_per_mm,
    }
    for place, name in enumerate(names):
        sockets[name] = surface.coefficients[place] * reach ** (2 * place + 3)
    declared = [
        _CURVATURE,
        parameter("float", "surface_conic", "0.0", "Conic", "Conic constant"),
        parameter("float", "surface_reach", "1.0", "Reach", "Radius that the powers refer to"),
    ]
    for place, name in enumerate(names):
        words = f"Height of the r^{2 * place + 4} part at the reach, over the reach"
        declared.append(parameter("float", name, "0.0", f"A{2 * place + 4}", words))
    arguments = ", ".join(shared)
    return ShaderPart(
        functions=_asphere_functions(names, shared),
        parameters=" ".join(declared),
        code=(f"curved = 1; hoe_asphere_hit(position, heading, frame_normal, {arguments});"),
        sockets=sockets,
    )


def _asphere_functions(names: list[str], shared: list[str]) -> str:
    declared = ", ".join(f"float {name}" for name in shared)
    height = slope = "0.0"
    for place in range(len(names) - 1, -1, -1):
        height = f"({names[place]} + share * {height})"
        slope = f"({place + 2}.0 * {names[place]} + share * {slope})"
    return f"""\
void hoe_asphere_hit(output vector place, vector heading, output vector upright, {declared})
{{
    for (int step = 0; step <= {_NEWTON_STEPS}; ++step) {{
        float square = place[0] * place[0] + place[1] * place[1];
        float bend = surface_curvature * surface_curvature * square;
        float root = sqrt(max(1.0 - (1.0 + surface_conic) * bend, 1e-6));
        float share = square / (surface_reach * surface_reach);
        float z = surface_curvature * square / (1.0 + root)
                + surface_reach * share * share * {height};
        // The derivative by r^2, times 2.
        float rise = surface_curvature / root + 2.0 * share * {slope} / surface_reach;
        upright = normalize(vector(-rise * place[0], -rise * place[1], 1.0));
        float toward = heading[2] - rise * (heading[0] * place[0] + heading[1] * place[1]);
        // A ray along the surface stays near its facet.
        float steep = toward < 0.0 ? min(toward, -1e-2) : max(toward, 1e-2);
        if (step < {_NEWTON_STEPS})
            place += heading * (z - place[2]) / steep;
    }}
}}

"""
