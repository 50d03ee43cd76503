// SPDX-FileCopyrightText: hoe_addon contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// The frame of a recording in the world. Its object may be turned, mirrored, scaled and sheared:
// places and the surface follow the object's matrix, directions follow unit axes at right angles,
// of which x is the mapped x axis and z the true normal of the mapped plane z = 0.
#ifndef HOE_FRAME_H
#define HOE_FRAME_H

// -1 where the object is mirrored, else 1. `mapped_x` to `mapped_z` are the frame's axes, as the
// object's matrix maps them.
float hoe_handedness(vector mapped_x, vector mapped_y, vector mapped_z)
{
    return dot(cross(mapped_x, mapped_y), mapped_z) < 0.0 ? -1.0 : 1.0;
}

// True unit normal of a mapped surface, of which `upright` is the normal in the frame.
vector hoe_mapped_normal(vector upright, vector mapped_x, vector mapped_y, vector mapped_z)
{
    vector mapped = upright[0] * cross(mapped_y, mapped_z) + upright[1] * cross(mapped_z, mapped_x)
                  + upright[2] * cross(mapped_x, mapped_y);
    return hoe_handedness(mapped_x, mapped_y, mapped_z) * normalize(mapped);
}

// Direction in the frame, in the object's own measures, of a direction in the world.
vector hoe_heading(vector direction, vector frame_x, vector frame_y, vector frame_z)
{
    vector inside = transform("common", "object", direction);
    return normalize(vector(dot(inside, frame_x), dot(inside, frame_y), dot(inside, frame_z)));
}

#endif
