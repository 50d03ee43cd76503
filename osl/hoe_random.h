// SPDX-FileCopyrightText: hoe_addon contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Random numbers: OSL in Cycles has none, so they are hashes of what differs from hit to hit.
#ifndef HOE_RANDOM_H
#define HOE_RANDOM_H

#define HOE_DIMENSIONS 4

// Uniform number in [0, 1) for this hit: of the source with number `source` (so that two sources
// of one hologram draw independently), dimension 0 to HOE_DIMENSIONS - 1. Equal hits of one path
// at one time differ by how many surfaces the path has crossed.
float hoe_random(int source, int dimension)
{
    int crossed = 0;
    getattribute("path:transparent_depth", crossed);
    float hit = hashnoise(P, time);
    return hashnoise(hit, (float)((crossed * 2 + source) * HOE_DIMENSIONS + dimension));
}

#endif
