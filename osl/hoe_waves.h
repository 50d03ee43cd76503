// SPDX-FileCopyrightText: hoe_addon contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HOE_WAVES_H
#define HOE_WAVES_H

// Unit propagation direction of a recording wave at a point of the surface.
// Point: a diverging beam goes away from it, a converging one (`converging` = 1) toward it.
vector hoe_point_wave(vector source, int converging, vector position)
{
    vector away = normalize(position - source);
    return converging ? -away : away;
}

#endif
