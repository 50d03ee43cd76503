# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Texts and numbers as somebody with bad intentions would write them."""

import random

MARK = "zq7x3v"
"""Stands in every hostile name: it must come up in no shader."""

TEXTS = (
    "",
    " ",
    MARK,
    f'{MARK}"); system("x"); //',
    f"{MARK}\n#include <evil.h>\n",
    f"*/ {MARK} /*",
    f"__import__('os').system('{MARK}')",
    f"{{0.__class__.{MARK}}}",
    f"%s%n{MARK}",
    f"${{jndi:{MARK}}}",
    f"\x1b[31m{MARK}\x07",
    f"\u202e{MARK}\u2066",
    f"\x00{MARK}",
    f"{MARK}\ud800".encode("utf-8", "replace").decode(),
    "\u0661\u0662",
    "e\u0301" * 40,
    "\U0001f600" * 20,
    "A" * 5000,
    "line\rbreak\x85\u2028\u2029",
    "NaN",
    "null",
    "1e400",
    "auto",
    "air",
    "__class__",
    "__proto__",
    "../../../../etc/passwd",
    "/etc/passwd",
    "/dev/zero",
    "/proc/self/environ",
    "C:\\Windows\\win.ini",
    "\\\\host\\share\\x.exr",
    "file:///etc/passwd",
    "http://localhost/x.exr",
    "x.exr\x00.png",
    "~/x.exr",
    "|id",
    ".",
    "..",
    "a" * 300 + ".exr",
)

NUMBERS = (
    *(0, 1, -1, 2, 3, 7, 64, 100, 200, 201, 20000, -2, 0.0, -0.0, 0.5, 1.0, 1.5, 90.0, 180.0, 532),
    *(1e-300, 5e-324, -5e-324, 1e-30, 1e-12, 1e-9, 1e-6, 1e6, 1e9, 1e12, -1e12, 1.0000001e12),
    *(1e30, 1e38, 3.5e38, 1e154, 1e155, 1e300, 1.7976931348623157e308, -1e308),
    *(2**31 - 1, 2**31, -(2**31), 2**53 + 1, 2**63, -(2**63) - 1, 2**64, 10**30, 10**400),
    *(float("nan"), float("inf"), float("-inf"), 1e-16, 0.999999999999, 1 + 2e-16, 199.99999),
)


def some_text(rng: random.Random) -> str:
    """Draw a text."""
    if rng.random() < 0.8:
        return rng.choice(TEXTS)
    return "".join(
        chr(rng.choice((rng.randrange(128), rng.randrange(0xD800), 0x10000 + rng.randrange(999))))
        for _ in range(rng.randrange(1, 30))
    )


def some_number(rng: random.Random) -> float:
    """Draw a number, also one that is none."""
    kind = rng.randrange(4)
    if kind == 0:
        return rng.uniform(-10.0, 10.0)
    if kind == 1:
        return rng.choice((1.0, -1.0)) * 10.0 ** rng.uniform(-20.0, 20.0)
    return rng.choice(NUMBERS)
