// SPDX-FileCopyrightText: hoe_addon contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Volume holograms in coupled two-wave theory. Same functions as in core/efficiency/kogelnik.py,
// volume.py and sharing.py, which have the derivations. It needs hoe_math.h before it.
#ifndef HOE_VOLUME_H
#define HOE_VOLUME_H

// Waves nearer to the plane of the layer than this cosine are taken as having it.
#define HOE_LEAST_OBLIQUITY 1e-6

// Beyond this a phase loses 1,024 whole turns first, given in two parts, the first exact in 16 bits.
#define HOE_LARGE_PHASE 8192.0
#define HOE_TURNS 6433.875
#define HOE_TURNS_REST 0.106754552

// Phases beyond this have no digits left in float32.
#define HOE_MOST_PHASE 1e7

// Power that is left of an amplitude of exp(-depth); most layers do not absorb.
float hoe_fallen(float depth)
{
    return depth == 0.0 ? 1.0 : hoe_exp(-2.0 * depth);
}

// Principal square root of a + i b.
void hoe_complex_root(float a, float b, output float real, output float imag)
{
    if (b == 0.0) {
        real = a > 0.0 ? sqrt(a) : 0.0;
        imag = a < 0.0 ? sqrt(-a) : 0.0;
        return;
    }
    float large = sqrt(0.5 * (hoe_hypot(a, b) + abs(a)));
    float small = large > 0.0 ? 0.5 * abs(b) / large : 0.0;
    real = a >= 0.0 ? large : small;
    imag = (b < 0.0 ? -1.0 : 1.0) * (a >= 0.0 ? small : large);
}

// cosh(x + i y) and sinh(x + i y) / (x + i y), both over exp(x), for x >= 0: (real, imaginary, 0).
void hoe_scaled_hyperbolic(float x, float y, output vector cosine, output vector sine)
{
    float grown = 1.0;
    float left = 0.0;
    if (x > 0.0) {
        float fallen = hoe_exp(-2.0 * x);
        grown = 0.5 + 0.5 * fallen;
        left = x < 0.5 ? hoe_exp(-x) * hoe_sinh(x) : 0.5 - 0.5 * fallen;
    }
    float c = 1.0;
    float s = 0.0;
    if (abs(y) > HOE_MOST_PHASE) {
        c = 0.70710678;
        s = 0.70710678;
    } else if (y != 0.0) {
        float turns = abs(y) > HOE_LARGE_PHASE ? round(y / HOE_TURNS) : 0.0;
        float rest = (y - turns * HOE_TURNS) - turns * HOE_TURNS_REST;
        c = hoe_cos(rest);
        s = hoe_sin(rest);
    }
    cosine = vector(grown * c, left * s, 0.0);
    float squared = x * x + y * y;
    sine = vector(1.0, 0.0, 0.0);
    if (squared > 1e-12)
        sine = vector(left * c * x + grown * s * y, grown * s * x - left * c * y, 0.0) / squared;
}

// What x, the real part of the root of (half + i turn)^2 - (coupled + i crossed), has above |half|. Of
// two large numbers that are nearly the same the difference follows from the equation itself.
float hoe_root_above(float x, float y, float half, float turn, float coupled, float crossed)
{
    float size = abs(half);
    if (size < 1.0 || x < 0.5 * size || x > 2.0 * size)
        return x - size;
    float along = half < 0.0 ? -turn : turn;
    return -(coupled + 0.5 * crossed * (y + along) / x) / (x + size + along * (y + along) / x);
}

// Shares of the diffracted wave and, as `rest`, of order 0. `phase` is theta d, (real, imag) is
// kappa d and `loss` is alpha d.
float hoe_two_waves(float cos_light, float cos_diffracted, float phase, float real, float imag,
                    float loss, output float rest)
{
    float c_r = max(cos_light, HOE_LEAST_OBLIQUITY);
    float c_s = max(abs(cos_diffracted), HOE_LEAST_OBLIQUITY);
    if (cos_diffracted < 0.0)
        c_s = -c_s;
    float half = 0.5 * (loss / c_s - loss / c_r);
    float turn = -0.5 * phase / c_s;
    float both = 1.0 / (c_r * c_s);
    float coupled = (real - imag) * (real + imag) * both;
    float crossed = 2.0 * real * imag * both;
    float x;
    float y;
    hoe_complex_root((half - turn) * (half + turn) - coupled, 2.0 * half * turn - crossed, x, y);
    float above = hoe_root_above(x, y, half, turn, coupled, crossed);
    vector cosine;
    vector sine;
    hoe_scaled_hyperbolic(x, y, cosine, sine);
    // (half + i turn) sinh(g) / g
    vector mixed = vector(half * sine[0] - turn * sine[1], half * sine[1] + turn * sine[0], 0.0);
    float taken = (real * real + imag * imag) * abs(both) * dot(sine, sine);
    if (c_s > 0.0) {
        float fallen = hoe_fallen(loss / max(c_r, c_s) - above);
        rest = fallen * dot(cosine + mixed, cosine + mixed);
        return fallen * taken;
    }
    float divisor = dot(cosine - mixed, cosine - mixed);
    rest = hoe_fallen(loss / c_r + above) / divisor;
    return taken / divisor;
}

// Normal part of n s of a recording wave inside the emulsion; `enters` = 0 where it stays outside.
float hoe_volume_normal_part(vector wave, vector axis, float index, output int enters)
{
    float outside = dot(wave, axis);
    vector tangential = wave - axis * outside;
    float squared = index * index - dot(tangential, tangential);
    if (squared < 0.0)
        enters = 0;
    float size = sqrt(max(squared, 0.0));
    return outside < 0.0 ? -size : size;
}

// lambda_0 Q along the normal, as two waves record it in a medium.
float hoe_volume_normal_step(vector object_wave, vector reference_wave, vector axis, float index,
                             output int recorded)
{
    recorded = 1;
    float object_part = hoe_volume_normal_part(object_wave, axis, index, recorded);
    return object_part - hoe_volume_normal_part(reference_wave, axis, index, recorded);
}

// The same as hoe_two_waves() for a ray n s in the emulsion and lambda Q of one order. `in_plane`:
// the electric field lies in the plane of both, and not along the fringes. `phase_scale` is
// pi d / (lambda n).
float hoe_volume_wave(vector ray, vector step, float index, float phase_scale, float real, float imag,
                      float loss, int in_plane, output float rest)
{
    vector leaving = ray + step;
    float factor = 1.0;
    if (in_plane)
        factor = dot(ray, leaving) / (index * max(length(leaving), 1e-6));
    if (leaving[0] * leaving[0] + leaving[1] * leaving[1] >= index * index) {
        rest = hoe_fallen(loss / max(ray[2] / index, HOE_LEAST_OBLIQUITY));
        return 0.0;
    }
    return hoe_two_waves(ray[2] / index, leaving[2] / index, -phase_scale * dot(2.0 * ray + step, step),
                         factor * real, factor * imag, loss, rest);
}

// Share of one way out for light in one polarisation; see hoe_volume_share().
float hoe_volume_mode(vector ray, float normal_sign, vector gratings[], float real[], float imag[],
                      int count, float index, float phase_scale, float loss, int in_plane,
                      int exposure, int order)
{
    float bare = hoe_fallen(loss / max(ray[2] / index, HOE_LEAST_OBLIQUITY));
    float left = 1.0;
    float kept = bare;
    float total = 0.0;
    float mine = 0.0;
    for (int i = 0; i < count; ++i) {
        vector step = vector(gratings[i][0], gratings[i][1], normal_sign * gratings[i][2]);
        float rest_plus;
        float rest_minus;
        float plus = hoe_volume_wave(ray, step, index, phase_scale, real[i], imag[i], loss, in_plane,
                                     rest_plus);
        float minus = hoe_volume_wave(ray, -step, index, phase_scale, real[i], imag[i], loss, in_plane,
                                      rest_minus);
        float strong = max(plus, minus);
        float weak = min(plus, minus);
        float alike = strong > 0.0 ? max(2.0 * weak / strong - 1.0, 0.0) : 0.0;
        float product = strong * weak;
        strong -= 0.5 * alike * product;
        weak -= (1.0 - 0.5 * alike) * product;
        total += strong + weak;
        left *= 1.0 - strong - weak;
        kept *= bare > 0.0 ? (rest_plus / bare) * (rest_minus / bare) : 0.0;
        if (i == exposure)
            mine = (order > 0) == (plus >= minus) ? strong : weak;
    }
    if (order == 0)
        return min(kept, left);
    return count > 1 && total > 0.0 ? mine * (1.0 - left) / total : mine;
}

// Share of one way out, for unpolarised light with the tangential part (along, across) of n s and
// the size `normal_part` of the one along the normal, from which that inside follows: the index
// squared less the square of the tangential part would lose its digits toward grazing.
// `gratings` are lambda Q in the frame of the grating, z to the front; (real, imag) is kappa d.
// Order 0 is the transmitted one, and belongs to no exposure. `folds`: an order that cannot leave
// on its own side is totally reflected and leaves on the other, if it can.
float hoe_volume_share(float along, float across, float normal_part, int from_back,
                       vector gratings[], float real[], float imag[], int count, float index,
                       float phase_scale, float loss, float index_back, float index_front,
                       int folds, int exposure, int order, int side)
{
    float outside = from_back ? index_back : index_front;
    float squared = normal_part * normal_part + (index - outside) * (index + outside);
    if (squared <= 0.0)
        return 0.0;
    vector ray = vector(along, across, sqrt(squared));
    float normal_sign = from_back ? 1.0 : -1.0;
    if (order != 0) {
        vector leaving = ray + order * vector(gratings[exposure][0], gratings[exposure][1],
                                              normal_sign * gratings[exposure][2]);
        int reflected = leaving[2] < 0.0;
        float turned = leaving[0] * leaving[0] + leaving[1] * leaving[1];
        if (folds) {
            int to_back = (from_back != 0) == reflected;
            float here = to_back ? index_back : index_front;
            float there = to_back ? index_front : index_back;
            if (turned >= here * here && turned < there * there)
                reflected = !reflected;
        }
        if (reflected != (side == HOE_REFLECTED) || turned >= index * index)
            return 0.0;
    }
    float share = 0.0;
    for (int in_plane = 0; in_plane < 2; ++in_plane)
        share += 0.5 * hoe_volume_mode(ray, normal_sign, gratings, real, imag, count, index, phase_scale,
                                       loss, in_plane, exposure, order);
    return share;
}

#endif
