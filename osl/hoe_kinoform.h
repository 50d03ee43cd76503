// SPDX-FileCopyrightText: hoe_addon contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Scalar efficiency of a kinoform: continuous or with N levels. Same function as core/kinoform.py.
#ifndef HOE_KINOFORM_H
#define HOE_KINOFORM_H

#include "hoe_medium.h"

// sin(pi x) / (pi x) for |x| <= 1/2: Taylor's series to the tenth power, whose remainder is below
// 6e-8 there. OSL's own sin() is a fast one with an error of 1e-4 near zero, and dividing by x
// would lose the rest.
float hoe_sinc_pi_near_zero(float x)
{
    float squared = (M_PI * x) * (M_PI * x);
    return 1.0 - squared / 6.0 * (1.0 - squared / 20.0 * (1.0 - squared / 42.0
               * (1.0 - squared / 72.0 * (1.0 - squared / 110.0))));
}

// sin(pi x), with x reduced to its nearest integer first: no digits are lost near the zeros.
float hoe_sin_pi(float x)
{
    float nearest = round(x);
    float remainder = x - nearest;
    float value = M_PI * remainder * hoe_sinc_pi_near_zero(remainder);
    return mod(nearest, 2.0) == 0.0 ? value : -value;
}

// sin(pi x) / (pi x), smooth through 0.
float hoe_sinc_pi(float x)
{
    return abs(x) <= 0.5 ? hoe_sinc_pi_near_zero(x) : hoe_sin_pi(x) / (M_PI * x);
}

// Phase depth alpha in waves: (n - 1) / (n0 - 1) * lambda0 / lambda.
float hoe_phase_depth(float a, vector b, vector c_um2, float design_wavelength_nm, float wavelength_nm)
{
    float excess = hoe_index(a, b, c_um2, wavelength_nm) - 1.0;
    float design_excess = hoe_index(a, b, c_um2, design_wavelength_nm) - 1.0;
    return (excess / design_excess) * (design_wavelength_nm / wavelength_nm);
}

// |D_m|^2 at phase depth alpha (in waves); levels 0 is the continuous relief.
// Swanson (1989), MIT Lincoln Laboratory TR 854; derivation in core/kinoform.py. Both forms are
// sin(pi (alpha - m)) over something that is zero with it: where that happens, the quotient of two
// sinc is used. |sin(pi (alpha - m))| is the same for all orders, so the caller computes it once:
// sine_alpha = hoe_sin_pi(alpha). Signs are left out, the result is a square.
float hoe_kinoform_efficiency(int order, float alpha, float sine_alpha, float levels)
{
    float distance = alpha - order;
    float step_factor = 1.0;
    float step_width = 1.0;
    if (levels >= 2.0) {
        distance -= levels * round(distance / levels);
        step_factor = hoe_sinc_pi(order / levels);
        step_width = hoe_sinc_pi_near_zero(distance / levels);
    }
    float wave = abs(distance) <= 0.5 ? hoe_sinc_pi_near_zero(distance)
                                      : sine_alpha / (M_PI * distance);
    float amplitude = step_factor * wave / step_width;
    return amplitude * amplitude;
}

#endif
