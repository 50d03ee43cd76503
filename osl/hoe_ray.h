// SPDX-FileCopyrightText: hoe_addon contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HOE_RAY_H
#define HOE_RAY_H

#include "hoe_constants.h"

// Start of a continued ray: off the surface, on the side that it goes to (along `unit_normal`).
// A ray that starts on an edge of two triangles would hit the second one and be diffracted twice.
// Cycles forgets the surface it came from only when the start has moved by more than 3.2e-5 units,
// and float32 places a hit to about 1e-7 of the largest coordinate: the offset exceeds both.
point hoe_launch_point(point hit, vector unit_normal)
{
    float extent = max(abs(hit[0]), max(abs(hit[1]), abs(hit[2])));
    return hit + unit_normal * max(5e-5, 2e-6 * extent);
}

// Part of `v` in the tangent plane of the unit normal.
vector hoe_tangential(vector v, vector unit_normal)
{
    return v - unit_normal * dot(v, unit_normal);
}

// Ray law n' s' = n s + m lambda Q + gamma N, as in core/ray_law.py.
// `tangential` is the tangential part of n s, `added` that of m lambda Q, cos_in >= 0 the cosine of
// incidence, `outward` the unit normal on the side that the ray goes to. Returns 0 for an evanescent
// order, which carries no power.
int hoe_leave(vector tangential, vector added, float cos_in, float index_in, float index_out,
              vector outward, output vector direction)
{
    vector leaving = tangential + added;
    // (n' cos')^2 from the cosine of incidence and not from n'^2 - |leaving|^2, which would lose its
    // digits toward grazing.
    float normal_squared = (index_out - index_in) * (index_out + index_in)
                         + (index_in * cos_in) * (index_in * cos_in)
                         - dot(added, tangential + leaving);
    direction = (leaving + outward * sqrt(max(normal_squared, 0.0))) / index_out;
    return normal_squared >= 0.0;
}

#endif
