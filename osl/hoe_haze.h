// SPDX-FileCopyrightText: hoe_addon contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Scattering haze, as in core/haze.py: a share of the light leaves around its order.
#ifndef HOE_HAZE_H
#define HOE_HAZE_H

#include "hoe_math.h"
#include "hoe_random.h"

// A tangential vector whose two components have the standard deviation 1 (Box and Muller, 1958).
vector hoe_gaussian(float first, float second, vector tangent_x, vector tangent_y)
{
    // 1 - first is a multiple of 2^-24, or 0.
    float radius = sqrt(-2.0 * hoe_log(max(1.0 - first, 5e-8)));
    float turn = 2.0 * HOE_PI * second;
    return radius * (hoe_cos(turn) * tangent_x + hoe_sin(turn) * tangent_y);
}

// A unit direction with other direction cosines in the tangent plane; one that could not leave stays
// as it is, so that no light is lost.
vector hoe_scattered(vector direction, vector outward, vector offset)
{
    float cosine = dot(direction, outward);
    float squared = cosine * cosine - dot(offset, 2.0 * direction + offset);
    if (squared <= 0.0)
        return direction;
    return direction + offset + outward * (sqrt(squared) - cosine);
}

// Share of the light that a rough surface scatters; `change` is that of n s along the normal.
float hoe_rough_share(float roughness_nm, float change, float wavelength_nm)
{
    float phase = 2.0 * HOE_PI * roughness_nm * change / wavelength_nm;
    float squared = phase * phase;
    // 1 - exp(-x) would lose the digits of a small share.
    return squared < 1e-3 ? squared * (1.0 - 0.5 * squared) : 1.0 - hoe_exp(-squared);
}

#endif
