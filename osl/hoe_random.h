// SPDX-FileCopyrightText: hoe_addon contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Random numbers: OSL in Cycles has none, so they are hashes of what differs from hit to hit.
#ifndef HOE_RANDOM_H
#define HOE_RANDOM_H

// What a number is for; all of them are independent at one hit.
#define HOE_FOR_OBJECT 0
#define HOE_FOR_REFERENCE 1
#define HOE_FOR_TABLE 2
#define HOE_FOR_HAZE 3

#define HOE_PURPOSES 4
#define HOE_DIMENSIONS 8

// What differs from hit to hit: point and time, and, for equal hits of one path at one time, how
// many surfaces the path has crossed.
float hoe_hit(output int crossed)
{
    crossed = 0;
    getattribute("path:transparent_depth", crossed);
    return hashnoise(P, time);
}

// Uniform number in [0, 1] of a hit, for one purpose, dimension 0 to HOE_DIMENSIONS - 1. Numbers of
// different crossings, purposes and dimensions never share a stream.
float hoe_drawn(float hit, int crossed, int purpose, int dimension)
{
    int stream = (crossed * HOE_PURPOSES + purpose) * HOE_DIMENSIONS + dimension;
    return hashnoise(hit, (float)stream);
}

// The same for a caller that needs few numbers.
float hoe_random(int purpose, int dimension)
{
    int crossed;
    float hit = hoe_hit(crossed);
    return hoe_drawn(hit, crossed, purpose, dimension);
}

#endif
