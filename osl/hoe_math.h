// SPDX-FileCopyrightText: hoe_addon contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Elementary functions to float32 precision. OSL's own are fast ones: sin() is wrong by 1e-4 near
// its zeros. Range reductions and minimax polynomials are those of the Cephes library, single
// precision (Moshier, 1989, Methods and Programs for Mathematical Functions).
// Arguments outside of a function's domain are the caller's to find: see shading/formula.py.
#ifndef HOE_MATH_H
#define HOE_MATH_H

#define HOE_PI 3.14159265358979
#define HOE_HALF_PI 1.57079632679490

// sin and cos for |x| <= pi / 4.
float hoe_sin_near_zero(float x)
{
    float z = x * x;
    return ((-1.9515295891e-4 * z + 8.3321608736e-3) * z - 1.6666654611e-1) * z * x + x;
}

float hoe_cos_near_zero(float x)
{
    float z = x * x;
    return ((2.443315711809948e-5 * z - 1.388731625493765e-3) * z + 4.166664568298827e-2) * z * z
           - 0.5 * z + 1.0;
}

// x less `turns` quarter turns, in three steps, of which the first two are exact.
float hoe_less_quarters(float x, float turns)
{
    return ((x - turns * 1.5703125) - turns * 4.837512969970703e-4) - turns * 7.54978995489188e-8;
}

// sin(x + quarter * pi / 2).
float hoe_sin_shifted(float x, int quarter)
{
    float turns = round(x * 0.636619772367581);
    float rest = hoe_less_quarters(x, turns);
    int place = ((int)turns + quarter) & 3;
    float value = (place & 1) ? hoe_cos_near_zero(rest) : hoe_sin_near_zero(rest);
    return (place & 2) ? -value : value;
}

float hoe_sin(float x) { return hoe_sin_shifted(x, 0); }

float hoe_cos(float x) { return hoe_sin_shifted(x, 1); }

float hoe_tan(float x) { return hoe_sin(x) / hoe_cos(x); }

// exp(x); 0 below -87, and never more than exp(88).
float hoe_exp(float x)
{
    float held = clamp(x, -87.0, 88.0);
    float power = round(held * 1.44269504088896);
    float rest = (held - power * 0.693359375) + power * 2.12194440e-4;
    float sum = ((((1.9875691500e-4 * rest + 1.3981999507e-3) * rest + 8.3334519073e-3) * rest
                  + 4.1665795894e-2) * rest + 1.6666665459e-1) * rest + 5.0000001201e-1;
    // exp2 of a whole number is exact.
    return x < -87.0 ? 0.0 : (sum * rest * rest + rest + 1.0) * exp2(power);
}

// log(x) for x > 0.
float hoe_log(float x)
{
    float power = logb(x);
    float part = x * exp2(-power);
    if (part > 1.41421356237310) {
        part *= 0.5;
        power += 1.0;
    }
    float rest = part - 1.0;
    float z = rest * rest;
    float sum = (((((((7.0376836292e-2 * rest - 1.1514610310e-1) * rest + 1.1676998740e-1) * rest
                     - 1.2420140846e-1) * rest + 1.4249322787e-1) * rest - 1.6668057665e-1) * rest
                  + 2.0000714765e-1) * rest - 2.4999993993e-1) * rest + 3.3333331174e-1;
    float small = sum * rest * z - power * 2.12194440e-4 - 0.5 * z;
    return (rest + small) + power * 0.693359375;
}

// x^y for x > 0 and any y; 0 for x = 0.
float hoe_power(float x, float y)
{
    return x > 0.0 ? hoe_exp(y * hoe_log(x)) : 0.0;
}

// atan(x) for |x| <= 1.
float hoe_atan_small(float x)
{
    int far = abs(x) > 0.414213562373095;
    float one = x < 0.0 ? -1.0 : 1.0;
    float rest = far ? (abs(x) - 1.0) / (abs(x) + 1.0) * one : x;
    float z = rest * rest;
    float sum = ((8.05374449538e-2 * z - 1.38776856032e-1) * z + 1.99777106478e-1) * z
                - 3.33329491539e-1;
    float value = sum * z * rest + rest;
    return far ? one * 0.785398163397448 + value : value;
}

// The angle of (x, y) from the x axis, -pi to pi; 0 at the origin.
float hoe_atan2(float y, float x)
{
    if (abs(y) > abs(x))
        return (y < 0.0 ? -HOE_HALF_PI : HOE_HALF_PI) - hoe_atan_small(x / y);
    float value = x == 0.0 ? 0.0 : hoe_atan_small(y / x);
    if (x < 0.0)
        value += y < 0.0 ? -HOE_PI : HOE_PI;
    return value;
}

float hoe_atan(float x) { return hoe_atan2(x, 1.0); }

// asin(x) for |x| <= 1/2.
float hoe_asin_small(float x)
{
    float z = x * x;
    float sum = (((4.2163199048e-2 * z + 2.4181311049e-2) * z + 4.5470025998e-2) * z
                 + 7.4953002686e-2) * z + 1.6666752422e-1;
    return sum * z * x + x;
}

// acos(x) for |x| <= 1.
float hoe_acos(float x)
{
    if (abs(x) <= 0.5)
        return HOE_HALF_PI - hoe_asin_small(x);
    float half = 2.0 * hoe_asin_small(sqrt(0.5 * (1.0 - abs(x))));
    return x > 0.0 ? half : HOE_PI - half;
}

// asin(x) for |x| <= 1.
float hoe_asin(float x)
{
    if (abs(x) <= 0.5)
        return hoe_asin_small(x);
    float value = HOE_HALF_PI - 2.0 * hoe_asin_small(sqrt(0.5 * (1.0 - abs(x))));
    return x > 0.0 ? value : -value;
}

float hoe_sinh(float x)
{
    float z = x * x;
    if (abs(x) <= 1.0)
        return ((2.03721912945e-4 * z + 8.33028376239e-3) * z + 1.66667160211e-1) * z * x + x;
    float grown = hoe_exp(abs(x));
    float value = 0.5 * grown - 0.5 / grown;
    return x < 0.0 ? -value : value;
}

float hoe_cosh(float x)
{
    float grown = hoe_exp(abs(x));
    return 0.5 * grown + 0.5 / grown;
}

float hoe_tanh(float x)
{
    float z = x * x;
    if (abs(x) <= 0.625)
        return ((((-5.70498872745e-3 * z + 2.06390887954e-2) * z - 5.37397155531e-2) * z
                 + 1.33314422036e-1) * z - 3.33332819422e-1) * z * x + x;
    float value = 1.0 - 2.0 / (hoe_exp(2.0 * abs(x)) + 1.0);
    return x < 0.0 ? -value : value;
}

// sqrt(x^2 + y^2) without overflow of the squares.
float hoe_hypot(float x, float y)
{
    float large = max(abs(x), abs(y));
    float part = large > 0.0 ? min(abs(x), abs(y)) / large : 0.0;
    return large * sqrt(1.0 + part * part);
}

#endif
