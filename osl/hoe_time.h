// SPDX-FileCopyrightText: hoe_addon contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// The wavelength rides on ray time: every camera path keeps one `time` at all its hits.
#ifndef HOE_TIME_H
#define HOE_TIME_H

// Without motion blur Cycles sets `time` to exactly one half: the cue for the one-wavelength preview.
// A text that is made for one wavelength defines HOE_ONE_WAVELENGTH, and nothing of its tables is left.
int hoe_is_preview()
{
#ifdef HOE_ONE_WAVELENGTH
    return 1;
#else
    return time == 0.5;
#endif
}

// Lower node of the cell that `time` stands for, in tables of `nodes` values over equal steps of time;
// `part` is the share of the upper node. Tables of several samplings stand one behind the other.
// Cycles draws time by a 256-entry inverted shutter curve with half-texel ends, so a flat curve gives
// times in [0.5/256, 254.5/256] and not [0, 1]; scale and offset undo that.
int hoe_table_node(float time_scale, float time_offset, int nodes, int sampling, output float part)
{
    float position = clamp(time * time_scale + time_offset, 0.0, 1.0) * (nodes - 1);
    int cell = min((int)position, nodes - 2);
    part = position - cell;
    return sampling * nodes + cell;
}

#endif
