// SPDX-FileCopyrightText: hoe_addon contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Look-up in a table of efficiencies: core/efficiency/table.py in float32. The table is a constant
// array in the text, ways out side by side, so all that a hit reads lies together.
#ifndef HOE_TABLE_H
#define HOE_TABLE_H

#include "hoe_random.h"

// Rounding of float32 at the ends of an axis, as a share of the axis: it is not yet outside.
#define HOE_TABLE_ROUNDING 1e-6

// Number of the node below `value` on an increasing axis of at least two nodes, by bisection; a value
// outside belongs to the cell at that end.
int hoe_table_cell(float nodes[], int count, float value)
{
    int low = 0;
    int high = count - 1;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (value < nodes[middle])
            high = middle;
        else
            low = middle;
    }
    return low;
}

// How far `value` is on the way from a node to the next, 0 to 1.
float hoe_table_part(float nodes[], int cell, float value)
{
    return clamp((value - nodes[cell]) / (nodes[cell + 1] - nodes[cell]), 0.0, 1.0);
}

int hoe_table_holds(float nodes[], int count, float value)
{
    float slack = HOE_TABLE_ROUNDING * (nodes[count - 1] - nodes[0]);
    return value >= nodes[0] - slack && value <= nodes[count - 1] + slack;
}

// The neighbouring nodes on `axes` axes: `places` in the table and their `weights`, which sum to 1.
void hoe_table_corners(float parts[], int strides[], int axes, int lowest,
                       output float weights[], output int places[])
{
    weights[0] = 1.0;
    places[0] = lowest;
    int known = 1;
    for (int axis = 0; axis < axes; ++axis) {
        for (int corner = 0; corner < known; ++corner) {
            weights[known + corner] = weights[corner] * parts[axis];
            weights[corner] *= 1.0 - parts[axis];
            places[known + corner] = places[corner] + strides[axis];
        }
        known *= 2;
    }
}

// Share of one way out, interpolated.
float hoe_table_mean(float shares[], float weights[], int places[], int corners, int way)
{
    float sum = 0.0;
    for (int corner = 0; corner < corners; ++corner)
        sum += weights[corner] * shares[places[corner] + way];
    return sum;
}

// One of the neighbouring nodes, drawn by its weight in the interpolation.
int hoe_table_node(float parts[], int strides[], int axes, int lowest, float hit, int crossed)
{
    int place = lowest;
    for (int axis = 0; axis < axes; ++axis)
        if (hoe_drawn(hit, crossed, HOE_FOR_TABLE, 1 + axis) < parts[axis])
            place += strides[axis];
    return place;
}

// One way out, drawn by its share at a node; -1 where the light is absorbed. Shares that sum to more
// than 1 are scaled down, as those of a formula are.
int hoe_table_draw(float shares[], int place, int ways, float drawn)
{
    float total = 0.0;
    for (int way = 0; way < ways; ++way)
        total += shares[place + way];
    float left = drawn * max(total, 1.0);
    for (int way = 0; way < ways; ++way) {
        left -= shares[place + way];
        if (left < 0.0)
            return way;
    }
    return -1;
}

#endif
