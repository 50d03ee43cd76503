// SPDX-FileCopyrightText: hoe_addon contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HOE_SURFACE_H
#define HOE_SURFACE_H

// Distance along the ray from a point near the surface c (wx x^2 + wy y^2 + wz z^2) = 2 z to that
// surface. Solved from the hit on the facet, it is a small number with all its digits. A ray that
// meets the facet but passes the surface goes to where it is nearest.
float hoe_quadric_step(vector place, vector heading, float curvature, vector weights)
{
    vector weighted = curvature * weights * place;
    float a = dot(curvature * weights * heading, heading);
    float b = dot(weighted, heading) - heading[2];
    float k = dot(weighted, place) - 2.0 * place[2];
    float square = b * b - a * k;
    if (square <= 0.0)
        return a == 0.0 ? 0.0 : -b / a;
    return -k / (b + (b < 0.0 ? -1.0 : 1.0) * sqrt(square));
}

// Unit normal of the same surface, on the side of +z.
vector hoe_quadric_normal(vector place, float curvature, vector weights)
{
    return normalize(vector(0.0, 0.0, 1.0) - curvature * weights * place);
}

// Normal at the hit, in the frame. `exact` is the one that meshes made by the add-on carry in
// float32, in object space, or zero; Cycles packs the normals of all others into 32 bits, good to
// some 3e-5 rad, and turns them to the viewer. `mapped_x` to `mapped_z` are the frame's axes in the
// world: a normal goes back by products with them, however the object is scaled or sheared.
vector hoe_mesh_normal(vector exact, vector shading_normal, int from_behind, vector frame_x, vector frame_y,
                       vector frame_z, vector mapped_x, vector mapped_y, vector mapped_z)
{
    if (dot(exact, exact) > 0.0)
        return normalize(vector(dot(exact, frame_x), dot(exact, frame_y), dot(exact, frame_z)));
    vector smooth = from_behind ? -shading_normal : shading_normal;
    return normalize(vector(dot(smooth, mapped_x), dot(smooth, mapped_y), dot(smooth, mapped_z)));
}

// The direction, at least a little to the side of the facet that it is meant for: on facets a ray
// near grazing could else go through, or come back, where the smooth surface would not let it.
vector hoe_kept_on_side(vector direction, vector facet_side)
{
    float above = dot(direction, facet_side);
    return above >= 1e-4 ? direction : normalize(direction + (1e-4 - above) * facet_side);
}

#endif
