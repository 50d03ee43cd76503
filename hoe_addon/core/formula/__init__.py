# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Formulas V(x, y) given as text: a parser of our own, exact derivatives, evaluation in numpy.

A text is parsed into a `Graph` of operations and nothing of it is ever run or pasted anywhere:
numpy evaluates the graph, and the shader's text is written from the same graph.
"""

from .error import FormulaError
from .evaluate import evaluate
from .formula import Formula
from .graph import Graph, Node, Op
from .parser import parse

__all__ = ["Formula", "FormulaError", "Graph", "Node", "Op", "evaluate", "parse"]
