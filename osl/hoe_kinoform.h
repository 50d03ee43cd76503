// SPDX-FileCopyrightText: hoe_addon contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Scalar efficiency of a kinoform: continuous or with N levels. Same functions as
// core/efficiency/kinoform.py.
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

// |sinc(order / parts)|: the rest of the quotient is exact, and so are the zeros.
float hoe_sinc_of_quotient(int order, float parts)
{
    float turns = round(order / parts);
    float rest = (order - turns * parts) / parts;
    float wave = hoe_sinc_pi_near_zero(rest);
    return turns == 0.0 ? wave : abs(rest * wave * parts / order);
}

// Phase depth in waves of a relief in air, for light along its normal.
float hoe_straight_depth(float depth_waves, float index, float design_index,
                         float design_wavelength_nm, float wavelength_nm)
{
    return depth_waves * ((index - 1.0) / (design_index - 1.0) * (design_wavelength_nm / wavelength_nm));
}

// The same for light whose n s has the tangential parts x and y: it goes with
// n cos theta - cos theta_air, written as (n^2 - 1) / (n cos theta + cos theta_air). Beyond the
// critical angle of air its cosine counts as 0.
float hoe_oblique_depth(float straight, float index, float x, float y)
{
    float squared = x * x + y * y;
    float in_relief = sqrt(max(index * index - squared, 0.0));
    if (squared < 1.0)
        return straight * ((index + 1.0) / (in_relief + sqrt(1.0 - squared)));
    return index > 1.0 ? straight * (in_relief / (index - 1.0)) : 0.0;
}

// |D_m|^2 at phase depth alpha (in waves); levels 0 is the continuous relief.
// Swanson (1989), MIT Lincoln Laboratory TR 854. Both forms are sin(pi (alpha - m)) over something
// that is zero with it: where that happens, the quotient of two sinc is used. Signs are left out,
// the result is a square. Whole numbers are taken out first, so that alpha - m loses no digits.
float hoe_kinoform_efficiency(int order, float alpha, float levels)
{
    float whole = round(alpha);
    float steps = whole - order;
    float distance = steps + (alpha - whole);
    float step_factor = 1.0;
    float step_width = 1.0;
    if (levels >= 2.0) {
        distance = (steps - levels * round(steps / levels)) + (alpha - whole);
        distance -= levels * round(distance / levels);
        step_factor = hoe_sinc_of_quotient(order, levels);
        step_width = hoe_sinc_pi_near_zero(distance / levels);
    }
    float wave = abs(distance) <= 0.5 ? hoe_sinc_pi_near_zero(distance)
                                      : hoe_sin_pi(alpha) / (M_PI * distance);
    float amplitude = step_factor * wave / step_width;
    return amplitude * amplitude;
}

#endif
