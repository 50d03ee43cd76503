# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The list of sockets, read from a stored piece of compiled text.

tests/blender/test_compiled_shaders.py reads what the compiler of the running Blender writes.
"""

import pytest

from hoe_addon.shading.interface import Parameter, ParameterKind, parameters

COMPILED = "\n".join(
    (
        "OpenShadingLanguage 1.00",
        "# Compiled by oslc 1.14.5.1",
        "shader example",
        'param\tfloat\twavelength_nm\t550\t\t%meta{string,label,"Wavelength"}'
        ' %meta{string,help,"Vacuum wavelength, in nm"}  %read{41,95} %write{2147483647,-1}',
        'param\tvector\tframe_origin\t0 -1.5 2e-07\t\t%meta{string,help,"Say \\"origin\\" < 1"}'
        " %read{4,4} %write{2147483647,-1}",
        "param\tint\tobject_converging\t1\t\t%read{2147483647,-1} %write{2147483647,-1}",
        "param\tcolor\timage\t1 0.5 0\t\t%meta{float,min,0} %read{0,1} %write{2147483647,-1}",
        "param\tfloat[3]\tnodes_nm\t380 532 780\t\t%read{14,16} %write{2147483647,-1}",
        "oparam\tclosure color\tresult\t\t\t%read{148,148} %write{148,148}",
        "local\tvector\tincident\t%read{0,0} %write{1,1}",
        'const\tstring\t$const1\t"param"\t\t%read{0,0} %write{2147483647,-1}',
        "code ___main___",
        "\tneg\t\tincident I \t%line{17} %argrw{\"wr\"}",
        "\tend",
    )
)  # fmt: skip


def test_all_socket_parameters_in_the_order_of_the_shader() -> None:
    assert parameters(COMPILED) == (
        Parameter(
            "wavelength_nm",
            ParameterKind.FLOAT,
            is_output=False,
            default=(550.0,),
            label="Wavelength",
            help="Vacuum wavelength, in nm",
        ),
        Parameter(
            "frame_origin",
            ParameterKind.VECTOR,
            is_output=False,
            default=(0.0, -1.5, 2e-07),
            label="Frame Origin",
            help='Say \\"origin\\" < 1',
        ),
        Parameter(
            "object_converging",
            ParameterKind.INT,
            is_output=False,
            default=(1.0,),
            label="Object Converging",
            help="",
        ),
        Parameter(
            "image",
            ParameterKind.COLOR,
            is_output=False,
            default=(1.0, 0.5, 0.0),
            label="Image",
            help="",
        ),
        Parameter(
            "result",
            ParameterKind.CLOSURE,
            is_output=True,
            default=(),
            label="Result",
            help="",
        ),
    )


def test_tables_are_no_sockets() -> None:
    assert "nodes_nm" not in {parameter.name for parameter in parameters(COMPILED)}


def test_windows_line_ends_make_no_difference() -> None:
    assert parameters(COMPILED.replace("\n", "\r\n")) == parameters(COMPILED)


def test_nothing_is_found_in_an_empty_text() -> None:
    assert parameters("") == ()


def test_a_type_without_a_socket_is_refused_by_name() -> None:
    with pytest.raises(ValueError, match="matrix"):
        parameters("param\tmatrix\tturn\t1\t\t%read{0,0}\n")
