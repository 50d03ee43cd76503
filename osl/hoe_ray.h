// SPDX-FileCopyrightText: hoe_addon contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HOE_RAY_H
#define HOE_RAY_H

#include "hoe_constants.h"

// How far a continued ray must start off the surface it has hit, and how far that hit is from the
// edges of its triangle. float32 places a hit to a few 1e-7 of the largest coordinate or of the
// triangle: ten times that is clear of the surface, of its neighbours, and of one that touches it.
void hoe_find_clearance(output float clearance, output float room)
{
    float longest = max(length(dPdu), max(length(dPdv), length(dPdu - dPdv)));
    float extent = max(abs(P[0]), max(abs(P[1]), abs(P[2])));
    clearance = 1e-6 * max(extent, longest);
    room = min(u, min(v, 1.0 - u - v)) * length(cross(dPdu, dPdv)) / longest;
}

// Start of a continued ray, off the surface on the side `outward` that it goes to. It is on the ray
// itself, so that hundreds of hits in a guide add no shift. Near an edge, where a wall may stand, it
// goes on only as far as the edge, a little inward, and then straight up; and by more than 3.2e-5
// units, since only then does Cycles leave the start alone, and does not push it back through a
// neighbour.
point hoe_launch_point(float clearance, float room, vector outward, vector direction)
{
    float above = max(dot(direction, outward), 0.0);
    if (clearance < above * room)
        return P + direction * (clearance / above);
    // Cycles turns dPdu and dPdv round for rays from behind.
    vector inward = normalize((1.0 / 3.0 - u) * dPdu + (1.0 / 3.0 - v) * dPdv) * (backfacing() ? -1.0 : 1.0);
    return P + direction * room + inward * clearance + outward * max(clearance - above * room, 5e-5);
}

// Part of `v` in the tangent plane of the unit normal. What a first step leaves along the normal,
// whose length is rounded, a second one takes away: hundreds of reflections would add it up.
vector hoe_tangential(vector v, vector unit_normal)
{
    vector nearly = v - unit_normal * dot(v, unit_normal);
    return nearly - unit_normal * dot(nearly, unit_normal);
}

// Ray law n' s' = n s + m lambda Q + gamma N, as in core/ray_law.py.
// `tangential` is the tangential part of n s, `added` that of m lambda Q, cos_in >= 0 the cosine of
// incidence, `outward` the unit normal on the side that the ray goes to. Returns 0 for an evanescent
// order, which carries no power.
int hoe_leave(vector tangential, vector added, float cos_in, float index_in, float index_out,
              vector outward, output vector direction)
{
    vector leaving = tangential + added;
    // (n' cos')^2 from a small cosine of incidence keeps the digits of grazing rays, which
    // n'^2 - |leaving|^2 would lose. With a large one that is worse: unit vectors of float32 are not
    // quite so long, and the square of the cosine takes that in.
    float normal_squared = index_out * index_out - dot(leaving, leaving);
    if (cos_in < 0.5)
        normal_squared = (index_out - index_in) * (index_out + index_in)
                       + (index_in * cos_in) * (index_in * cos_in)
                       - dot(added, tangential + leaving);
    direction = (leaving + outward * sqrt(max(normal_squared, 0.0))) / index_out;
    return normal_squared >= 0.0;
}

#endif
