// SPDX-FileCopyrightText: hoe_addon contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// The wavelength rides on ray time: every camera path keeps one `time` at all its hits.
#ifndef HOE_TIME_H
#define HOE_TIME_H

// Without motion blur Cycles sets `time` to exactly one half: the cue for the one-wavelength preview.
int hoe_is_preview()
{
    return time == 0.5;
}

// Position in a table of `cells` cells that `time` stands for. Cycles draws time by a 256-entry
// inverted shutter curve with half-texel ends, so a flat curve gives times in [0.5/256, 254.5/256]
// and not [0, 1]; scale and offset undo that and make the position uniform.
float hoe_table_position(float time_scale, float time_offset, int cells)
{
    return clamp(time * time_scale + time_offset, 0.0, 1.0) * cells;
}

#endif
