// SPDX-FileCopyrightText: hoe_addon contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HOE_FRESNEL_H
#define HOE_FRESNEL_H

// Reflectance for unpolarised light; cosines are those of the ray in each medium.
float hoe_reflectance(float cos_in, float cos_out, float index_in, float index_out)
{
    float s = (index_in * cos_in - index_out * cos_out) / (index_in * cos_in + index_out * cos_out);
    float p = (index_out * cos_in - index_in * cos_out) / (index_out * cos_in + index_in * cos_out);
    return 0.5 * (s * s + p * p);
}

#endif
