// SPDX-FileCopyrightText: hoe_addon contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HOE_MEDIUM_H
#define HOE_MEDIUM_H

// Refractive index by Sellmeier's formula n^2 = a + sum b_i L^2 / (L^2 - c_i), L in micrometres.
// A constant index is a = n^2, b = 0. Shipped media: see core/media.py, which has the sources.
float hoe_index(float a, vector b, vector c_um2, float wavelength_nm)
{
    float squared = wavelength_nm * wavelength_nm * 1e-6;
    return sqrt(max(1.0, a + squared * (b[0] / (squared - c_um2[0])
                                        + b[1] / (squared - c_um2[1])
                                        + b[2] / (squared - c_um2[2]))));
}

#endif
