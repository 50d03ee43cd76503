// SPDX-FileCopyrightText: hoe_addon contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Scalar efficiency of thin reliefs beyond the plain kinoform: walls that are not upright, binary,
// sinusoidal, and any profile as steps or straight pieces. Same functions as
// core/efficiency/{kinoform,profiles,bessel,segments}.py.
#ifndef HOE_RELIEF_H
#define HOE_RELIEF_H

#include "hoe_kinoform.h"
#include "hoe_math.h"

// sin(pi x) / (N sin(pi x / N)) with its sign: K(x + N) = (-1)^(N - 1) K(x).
float hoe_step_kernel(float x, float steps)
{
    float turns = round(x / steps);
    float near = x - steps * turns;
    float value = hoe_sinc_pi(near) / hoe_sinc_pi_near_zero(near / steps);
    return mod(turns * (steps - 1.0), 2.0) == 0.0 ? value : -value;
}

// |D_m|^2 of a kinoform each of whose walls takes the share `width` of the period.
float hoe_walled_kinoform_efficiency(int order, float alpha, float levels, float width)
{
    float distance = alpha - order;
    float back = order % 2 == 0 ? width : -width;
    float amplitude = 0.0;
    if (levels < 2.0) {
        amplitude = (1.0 - width) * hoe_sinc_pi((1.0 - width) * distance)
                    + back * hoe_sinc_pi((1.0 - width) * alpha + order * width);
    } else {
        float other = (levels - 1.0) / levels;
        amplitude = (1.0 - levels * width) * hoe_sinc_pi(order * (1.0 / levels - width))
                        * hoe_step_kernel(distance, levels)
                    + (levels - 1.0) * width * hoe_sinc_pi(alpha / levels - order * width)
                        * hoe_step_kernel(other * distance, levels - 1.0)
                    + back * hoe_sinc_pi(other * alpha + order * width);
    }
    return amplitude * amplitude;
}

// cos and sin of 2 pi turn.
vector hoe_turned(float turn)
{
    float quarters = round(4.0 * turn);
    float rest = 2.0 * HOE_PI * (turn - 0.25 * quarters);
    float cosine = hoe_cos_near_zero(rest);
    float sine = hoe_sin_near_zero(rest);
    int place = (int)quarters & 3;
    if (place & 1) {
        float kept = cosine;
        cosine = -sine;
        sine = kept;
    }
    return place & 2 ? vector(-cosine, -sine, 0.0) : vector(cosine, sine, 0.0);
}

// |D_m|^2 of a ridge with upright walls that takes the share `duty` of the period.
float hoe_binary_efficiency(int order, float alpha, float duty)
{
    vector half = hoe_turned(0.5 * alpha);
    if (order == 0) {
        float even = (1.0 - 2.0 * duty) * half[1];
        return half[0] * half[0] + even * even;
    }
    float amplitude = 2.0 * duty * half[1] * hoe_sinc_pi(order * duty);
    return amplitude * amplitude;
}

// |D_m|^2 = J_m(pi alpha)^2 of a sinusoidal relief, by the recurrence run downward: Abramowitz and
// Stegun (1964), section 9.12.
float hoe_sinusoid_efficiency(int order, float alpha)
{
    float z = M_PI * abs(alpha);
    int wanted = abs(order);
    float found = 1.0;
    if (z < 1e-3) {
        for (int k = 1; k <= wanted; ++k)
            found *= 0.5 * z / k;
        found *= 1.0 - 0.25 * z * z / (wanted + 1.0);
        return found * found;
    }
    float reach = max(z, (float)wanted);
    int top = 2 * (int)ceil(0.5 * (reach + 5.0 * cbrt(reach) + 10.0));
    float above = 0.0;
    float here = 1e-10;
    float norm = 2.0 * here;
    found = 0.0;
    for (int k = top; k > 0; --k) {
        float below = 2.0 * k / z * here - above;
        above = here;
        here = below;
        if (k - 1 == wanted)
            found = here;
        if (k % 2 == 1)
            norm += k == 1 ? here : 2.0 * here;
        if (abs(here) > 1e10) {
            above *= 1e-20;
            here *= 1e-20;
            found *= 1e-20;
            norm *= 1e-20;
        }
    }
    float amplitude = found / norm;
    return amplitude * amplitude;
}

// |D_m|^2 of level steps of equal width.
float hoe_steps_efficiency(int order, float alpha, float heights[])
{
    int count = arraylength(heights);
    vector sum = vector(0.0);
    for (int j = 0; j < count; ++j) {
        float turn = alpha * heights[j];
        sum += hoe_turned(turn - round(turn) - (float)((order * j) % count) / count);
    }
    float amplitude = hoe_sinc_of_quotient(order, (float)count) / count;
    return dot(sum, sum) * amplitude * amplitude;
}

// |D_m|^2 of straight pieces: their middles in two parts, of which the first times an order is
// exact; their widths; the heights of their middles; and what each of them rises.
float hoe_segments_efficiency(int order, float alpha, float coarse[], float fine[], float width[],
                              float height[], float rise[])
{
    vector sum = vector(0.0);
    for (int j = 0; j < arraylength(width); ++j) {
        float turn = alpha * height[j];
        float shift = order * coarse[j];
        float weight = width[j] * hoe_sinc_pi(alpha * rise[j] - order * width[j]);
        sum += weight * hoe_turned((turn - round(turn)) - (shift - round(shift)) - order * fine[j]);
    }
    return dot(sum, sum);
}

#endif
