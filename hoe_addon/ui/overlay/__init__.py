# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is drawn over the 3-D view: recording sources, chief rays, the pupil and the eyebox.

`lines`, `colours`, `sources`, `optics`, `rays`, `eye` and `document` make lines from documents and
know nothing of Blender. `state` keeps what is shown up to date with the scene, `watch` says when,
and `draw` alone speaks to the graphics card; `failure` keeps mistakes from coming again and again.
"""
