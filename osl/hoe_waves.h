// SPDX-FileCopyrightText: hoe_addon contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Directions of recording waves. Same functions as in core/waves/, which has the derivations.
// A diverging beam (`converging` = 0) goes away from its point, a converging one toward it.
#ifndef HOE_WAVES_H
#define HOE_WAVES_H

#include "hoe_kinoform.h"
#include "hoe_random.h"

// Newton's steps at most; from below it takes one per factor 1.5 toward grazing at worst.
#define HOE_WINDOW_STEPS 32

// A place this little before the far face, relative to the distance of the source, is on it.
#define HOE_ON_FACE 1e-6

// Unit propagation direction of a recording wave at a point of the surface.
vector hoe_point_wave(vector source, int converging, vector position)
{
    vector away = normalize(position - source);
    return converging ? -away : away;
}

// The same less `heading`, its direction at the frame's origin, where that is not zero: how far the
// wave of a far source has turned. (h + q) / |h + q| - h with q = curvature * position, and
// |h + q| - 1 from its square: nothing large is subtracted. `curvature` is 1 / distance, negative
// while converging.
vector hoe_point_turn(vector heading, float curvature, vector source, int converging, vector position)
{
    if (heading == vector(0.0))
        return hoe_point_wave(source, converging, position);
    vector bend = curvature * position;
    float growth = dot(bend, bend + 2.0 * heading);
    float distance = sqrt(1.0 + growth);
    return (bend - heading * (growth / (1.0 + distance))) / distance;
}

// Tangent of the angle in a layer, over that in the layer of lowest index, u.
float hoe_layer(float index, float lowest, float u)
{
    return lowest / sqrt(index * index + (index - lowest) * (index + lowest) * u * u);
}

// The most that a layer can add to the lateral distance; a layer of lowest index adds to `straight`.
float hoe_layer_bound(float thickness, float index, float lowest, output float straight)
{
    float excess = (index - lowest) * (index + lowest);
    straight += excess == 0.0 ? thickness : 0.0;
    return excess > 0.0 ? thickness * lowest / sqrt(excess) : 0.0;
}

// A layer's lateral distance over u, and what it adds to the slope. One without thickness is none.
float hoe_layer_reach(float thickness, float index, float lowest, float u, output float slope)
{
    if (thickness <= 0.0)
        return 0.0;
    float tangent = hoe_layer(index, lowest, u);
    float cosine = index * tangent / lowest;
    slope += thickness * tangent * cosine * cosine;
    return thickness * tangent;
}

// Wave of a point that comes through a flat window. The unknown is u, the tangent of the angle in
// the layer of lowest index: nothing cancels. Returns 0 where no ray arrives.
int hoe_window_wave(vector source, int converging, float source_index, vector window_position,
                    vector window_normal, float window_thickness, float window_index, float index,
                    vector position, output vector direction)
{
    vector axis = normalize(window_normal);
    vector away = position - source;
    vector lateral = away - axis * dot(away, axis);
    lateral -= axis * dot(lateral, axis);
    float rho = length(lateral);
    float before = dot(window_position - source, axis);
    float behind = dot(position - window_position, axis) - window_thickness;
    direction = vector(0.0);
    if (before <= 0.0 || behind < -HOE_ON_FACE * length(away))
        return 0;
    behind = max(behind, 0.0);

    float lowest = source_index;
    if (window_thickness > 0.0)
        lowest = min(lowest, window_index);
    if (behind > 0.0)
        lowest = min(lowest, index);
    float straight = 0.0;
    float bound = hoe_layer_bound(before, source_index, lowest, straight)
                + hoe_layer_bound(window_thickness, window_index, lowest, straight)
                + hoe_layer_bound(behind, index, lowest, straight);
    float paraxial = lowest * (before / source_index + window_thickness / window_index + behind / index);
    float u = max(rho / paraxial, (rho - bound) / straight);
    for (int i = 0; i < HOE_WINDOW_STEPS; ++i) {
        float slope = 0.0;
        float reach = hoe_layer_reach(before, source_index, lowest, u, slope)
                    + hoe_layer_reach(window_thickness, window_index, lowest, u, slope)
                    + hoe_layer_reach(behind, index, lowest, u, slope);
        float larger = u + (rho - u * reach) / slope;
        if (larger <= u * (1.0 + 1e-7))
            break;
        u = larger;
    }
    // Total reflection at the far face, for a place that touches it.
    if (index * index + (index - lowest) * (index + lowest) * u * u <= 0.0)
        return 0;
    vector sideways = rho > 0.0 ? lateral * (u * hoe_layer(index, lowest, u) / rho) : vector(0.0);
    direction = normalize(axis + sideways);
    if (converging)
        direction = -direction;
    return 1;
}

// Toric wave: away from an arc through `second`, of this radius, around the straight line through
// `first`. The unit vectors `chief`, from `first` to `second`, and `line` at a right angle to it are
// given, since far foci may be the same place in float32.
vector hoe_astigmatic_wave(vector first, vector second, float radius, vector chief, vector line,
                           int converging, vector position)
{
    vector across = cross(line, chief);
    vector from_first = position - first;
    vector from_second = position - second;
    float outward = dot(from_first, chief);
    float beyond = dot(from_second, chief);
    vector nearer = abs(outward) < abs(beyond) ? from_first : from_second;
    float side = dot(nearer, across);
    float axis_distance = sqrt(outward * outward + side * side);
    // Far foci: the radius and the distance from the axis are nearly equal large numbers.
    float excess = outward > 0.0
                 ? (beyond * (radius + outward) + side * side) / (axis_distance + radius)
                 : -axis_distance - radius;
    vector radial = (outward * chief + side * across) / (outward < 0.0 ? -axis_distance : axis_distance);
    vector away = normalize(dot(nearer, line) * line + excess * radial);
    return converging ? -away : away;
}

// Points of extended sources from numbers in [0, 1): `x` and `y` reach from the middle to the edge.
vector hoe_line_point(vector centre, vector x, float a)
{
    return centre + (2.0 * a - 1.0) * x;
}

vector hoe_rectangle_point(vector centre, vector x, vector y, float a, float b)
{
    return centre + (2.0 * a - 1.0) * x + (2.0 * b - 1.0) * y;
}

// Concentric map; Shirley, Chiu (1997). The angle is at most pi / 4: by series, since OSL's own sine
// is a fast one.
vector hoe_disc_point(vector centre, vector x, vector y, float draw_a, float draw_b)
{
    float a = 2.0 * draw_a - 1.0;
    float b = 2.0 * draw_b - 1.0;
    if (a == 0.0 && b == 0.0)
        return centre;
    int wide = abs(a) > abs(b);
    float turn = 0.25 * (wide ? b / a : a / b);
    float along = (wide ? a : b) * hoe_sin_pi(0.5 - turn);
    float over = (wide ? a : b) * hoe_sin_pi(turn);
    return centre + (wide ? along : over) * x + (wide ? over : along) * y;
}

// Triangle by its share of the area: the first whose running share exceeds the draw.
int hoe_choose(float shares[], int count, float draw)
{
    int low = 0;
    int high = count - 1;
    while (low < high) {
        int middle = (low + high) / 2;
        if (shares[middle] > draw)
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

vector hoe_corner(float corners[], int triangle, int corner)
{
    int at = 9 * triangle + 3 * corner;
    return vector(corners[at], corners[at + 1], corners[at + 2]);
}

// Point of a mesh, in the frame of the mesh; corners are 9 numbers a triangle.
vector hoe_mesh_point(float corners[], float shares[], int count, float choice, float draw_a, float draw_b)
{
    int triangle = hoe_choose(shares, count, choice);
    int folded = draw_a + draw_b > 1.0;
    float a = folded ? 1.0 - draw_a : draw_a;
    float b = folded ? 1.0 - draw_b : draw_b;
    vector start = hoe_corner(corners, triangle, 0);
    return start + a * (hoe_corner(corners, triangle, 1) - start)
         + b * (hoe_corner(corners, triangle, 2) - start);
}

// Point of a frame: where it is, from its components along the frame's axes.
vector hoe_placed(vector origin, vector x, vector y, vector z, vector local)
{
    return origin + local[0] * x + local[1] * y + local[2] * z;
}

#endif
