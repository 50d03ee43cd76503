// SPDX-FileCopyrightText: hoe_addon contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HOE_CONSTANTS_H
#define HOE_CONSTANTS_H

#define HOE_TRANSMITTED 0
#define HOE_REFLECTED 1

// What the code calls "front" is the side that the frame's z axis points to.
#define HOE_BACK 0
#define HOE_FRONT 1

#endif
