# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
r"""Optics of hologram optical elements: numpy only, float64, vectorised over rays, SI units.

Every sign of the project is fixed here. The shaders follow the same conventions.

Surface. A surface is the plane z = 0 of its own frame. The normal is +z; ``back`` is the
side z < 0 and ``front`` the side z > 0. Light that travels along +z comes from the back::

          back  (z < 0)      |      front  (z > 0)
          index_back         |      index_front
                             |
         s  ---------------->|---> transmitted: goes on through the surface
                             |
              reflected: <---|
              goes back      |--> N = +z
                             |
                           z = 0

Directions. ``s`` is always the unit direction in which light travels, never the direction
from which it is seen.

Recording. Two waves with the unit propagation directions s_O (object) and s_R (reference)
meet at the surface point P, in media of index n_O and n_R, at the wavelength lambda_0::

        diverging             converging            plane

       source *                   P *               -------->
               \                 ^                  -------->
             s  \               /  s                -------->
                 v             /                        s
                P *           * point               same s at each P
          s = away from     s = toward
          the point         the point

    gradient g = grad(V_O - V_R) = n_O s_O - n_R s_R = lambda_0 Q     (no dimension)
    grating vector           Q = g / lambda_0                         (cycles per length)

Only the part of g in the tangent plane acts.

Ray law. For the order m, from the index n to the index n' (reflected: n' = n)::

    n' s' = n s + m (lambda / lambda_0) g + gamma N,     |s'| = 1

           |      ^ s'                  order +1 turns the ray toward +Q,
           |     /                      order -1 away from it.
           |    /  ------> Q
           |   /
      -----+--+------------ surface
           | ^
           | | s

    gamma's sign keeps a transmitted ray going on and sends a reflected ray back.
    |tangential part| > n'  ->  evanescent: no direction, and the weight is exactly 0.

Read-out with the reference wave at lambda_0 gives the object wave for m = +1; read-out with
the object wave gives the reference wave for m = -1.

Time reversal. The reversed ray -s' obeys the same law with the *same* m and the media
exchanged, and comes out as -s.

Time convention. A field is exp(+i (k V - omega t)): the phase grows along the ray. A kinoform of
depth alpha adds the phase 2 pi alpha x over one period x in [0, 1), where x grows along Q.
"""
