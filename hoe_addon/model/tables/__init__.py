# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of shares: made of any model, kept in a cache, read from files and written to them."""
