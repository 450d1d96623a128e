# SPDX-License-Identifier: BSD-3-Clause
"""The Fortran module of a model."""

import hashlib
from pathlib import Path

import jinja2
import sympy

from . import network, pointwise, rest
from .address import couplings
from .definition import LONGEST_TEXT
from .exponents import exponents_of, exponents_procedure
from .flow import Flow, Procedure, flow_of, rate_of_auxiliary, with_parameters
from .fortran import FUNCTIONS, in_words, text_of, wrapped
from .model import TIME, Model
from .series import series_procedure
from .slow import Balance, balance_of
from .tangents import tangent_series_procedure

EQUATIONS, JACOBIAN, WHOLE = "equations", "jacobian", "whole"
"""Extents of a module: the equations alone, with their Jacobian, and with series and what is at
rest, which take most of the time of a compiler."""
LONGEST = 70
"""Letters of a character constant on one line."""
SUPPORT = Path(__file__).parent / "fortran"
"""Fortran that models or programs with models are built with."""
TEMPLATES = jinja2.Environment(
    loader=jinja2.FileSystemLoader(Path(__file__).parent),
    trim_blocks=True,
    lstrip_blocks=True,
    keep_trailing_newline=True,
    undefined=jinja2.StrictUndefined,
    autoescape=False,  # the text is Fortran
)


def write_module(model: Model, extent: str = WHOLE) -> str:
    """The text of the module with all procedures, or those of an extent alone."""
    whole = extent == WHOLE and not model.index
    balance = balance_of(model) if whole else None
    exponents = [] if model.index else exponents_of(model)
    plain = sympy.Tuple(*map(model.plain, model.equations.values()))
    parts = {
        "more": [name for name in ("atan2", "erf") if plain.has(FUNCTIONS[name])],
        "made": procedures(model, exponents, balance, extent),
        "description": description_lines(model, exponents, whole),
        "delayed": delayed_procedure(model) if not model.index else Procedure({}, []),
        "moving": pointwise.moving_procedure(model),
        "exponents": exponents,
        "flow_texts": flow_texts(model, flow_of(model)) if whole and not model.moving else {},
        "rests": bool(whole and model.steady_state),
        "has_forms": bool(whole and model.steady_state) and not (model.differences or model.moving),
    }
    if parts["rests"]:
        parts["steady_state"] = rest.steady_state_procedure(model)
        parts["characteristic"] = rest.characteristic_procedure(model.frozen())
        parts["terms"] = rest.characteristic_terms(model.frozen())
        if model.near:
            parts["at_rest"] = rest.rest_procedure(model)
        if parts["has_forms"]:
            parts["derivative"] = rest.derivative_procedure(model)
    return rendered("model.f90.jinja", model.written, model=model, balance=balance, **parts)


def procedures(
    model: Model, exponents: list[str], balance: Balance | None, extent: str
) -> dict[str, Procedure]:
    """Those for the solver."""
    if model.index:
        return {
            "rhs": network.rhs_procedure(model),
            "exponents": Procedure({}, []),
            "lags": network.lags_procedure(model),
            "jacobian": network.jacobian_procedure(model),
        }
    parts = {
        "rhs": pointwise.rhs_procedure(model),
        "exponents": exponents_procedure(model, exponents),
    }
    if extent != EQUATIONS:
        parts["jacobian"] = pointwise.jacobian_procedure(model)
    if extent == WHOLE and not model.moving:
        parts["series"] = series_procedure(model)
        parts["tangent_series"] = tangent_series_procedure(model)
    if model.switches:
        parts["switching"] = pointwise.switching_procedure(model)
    if model.events:
        parts["act"] = pointwise.act_procedure(model)
    if balance:
        parts["relaxation_rate"] = pointwise.relaxation_procedure(model, balance)
        parts["slow_series"] = series_procedure(model, balance)
        parts["slow_tangent_series"] = tangent_series_procedure(model, balance)
    return parts


def rendered(template: str, names: dict[str, str], **values) -> str:
    """The text of a template, in lines of a length that compilers take; comments in these names."""
    text = TEMPLATES.get_template(template).render(**values)
    lines = (in_words(line, names if "!>" in line else {}) for line in text.splitlines())
    lines = [part for line in lines for part in wrapped(line.rstrip())]
    return "\n".join(lines) + "\n"


def flow_texts(model: Model, flow: Flow) -> dict[str, str]:
    """The equations as they are integrated."""
    texts = dict(model.texts)
    for auxiliary, state in flow.integrated.items():
        texts[state] = f"{auxiliary}'/{auxiliary}"
        texts[auxiliary] = str(rate_of_auxiliary(model, auxiliary))
    return texts


def in_short(text: str) -> str:
    """The text of an equation as results have it."""
    return text if len(text) <= LONGEST_TEXT else f"{text[:LONGEST_TEXT]} ..."


def description_lines(model: Model, exponents: list[str], whole: bool) -> list[str]:
    """Lines that describe the model, as expressions of Fortran; the interface first."""
    equations = [f"{state}' = {in_short(text)}" for state, text in model.texts.items()]
    equations += [f"{name} = {text}" for name, text in model.definitions.items()]
    equations += [f"{name} = exp({state})" for name, state in model.auxiliary.items()]
    equations += [f"at {one.said}" for one in model.events]
    terms = rest.characteristic_terms(model.frozen()) if whole and model.steady_state else []
    states = list(model.states)
    rest_at = model.near or model.steady_state or {}
    where = ", ".join(f"{state} = {value}" for state, value in rest_at.items())
    own = [] if model.index else model.delayed
    counted = (model.parameters, equations, model.states, own, terms, exponents)
    delayed = sum(any(one.symbol.name in text for one in model.delayed) for text in exponents)
    taken = [*model.equations.values(), *(one.value for one in model.switches)]
    taken += [one.term for one in model.sums]
    sizes = [*map(len, counted), delayed, len(model.switches)]
    lines = [
        ("sizes", *map(str, sizes)),
        *(("coupling", str(row), str(column)) for row, column in couplings(model)),
        observed_line(model),
        *(network.network_lines(model) if model.index else ()),
        *([("moving", str(len(model.moving)))] if model.moving else ()),
        *([("acting", str(len(model.events)))] if model.events else ()),
        *([("driven",)] if any(one.has(TIME) for one in taken) else ()),
        ("name", model.name),
        ("kind", model.kind),
        ("source", model.source),
        *(("state", name, meaning) for name, meaning in model.states.items()),
        *(
            ("auxiliary", name, str(states.index(state) + 1))
            for name, state in model.auxiliary.items()
        ),
        *(("equation", text) for text in equations),
        *(("switch", in_short(one.text)) for one in model.switches),
        ("rest", f"near {where}, tried Newton's method" if model.near else where),
    ]
    for one in model.parameters:
        lines.append(("parameter", one.name, one.meaning, one.unit))
        for key in ("above", "at_least"):
            if getattr(one, key) is not None:
                lines.append((key, str(getattr(one, key))))
    interface = f'"{interface_digest()} " // achar(iachar("0") + storage_size(1.0_wp)/32)'
    written = ([quoted(in_words(word, model.written)) for word in line] for line in lines)
    return [interface, *map(" // tab // ".join, written)]


def observed_line(model: Model) -> tuple[str, ...]:
    """What is looked at: component of the signal, whether it is its exponential, its levels in the
    section and of events, component and time of its integral, and coordinates; 0 for none."""
    observed, states = model.observed, list(model.states)
    number = {None: 0} | {state: place for place, state in enumerate(states, 1)}
    signal = model.auxiliary.get(observed.signal, observed.signal)
    levels = ["rest" if x is None else repr(x) for x in (observed.section, observed.event)]
    coordinates = [*(number[state] for state in observed.coordinates), 0, 0][:2]
    integral = (number[observed.integral], int(observed.with_time))
    own = (number[signal], int(signal != observed.signal))
    return ("observed", *map(str, own), *levels, *map(str, (*integral, *coordinates)))


def interface_digest() -> str:
    """A digest of what models and programs share; a program refuses models of another one."""
    return hashlib.sha256((SUPPORT / "shared" / "model_border.f90").read_bytes()).hexdigest()[:32]


def quoted(text: str) -> str:
    """A character constant, in parts that fit on a line."""
    parts = [text[at : at + LONGEST] for at in range(0, max(1, len(text)), LONGEST)]
    return " // ".join('"' + part.replace('"', '""') + '"' for part in parts)


def delayed_procedure(model: Model) -> Procedure:
    """Delays and components of the delayed states; bounds of delays that move."""
    states = list(model.states)
    components = [states.index(one.state) + 1 for one in model.delayed]
    bound = "huge(1.0_wp)" if model.longest_delay is None else text_of(model.longest_delay)
    lags = [bound if one.moves else text_of(one.lag) for one in model.delayed]
    lines = [f"lag({i}) = {lag}" for i, lag in enumerate(lags, 1)]
    lines += [f"component({i}) = {number}" for i, number in enumerate(components, 1)]
    return with_parameters(model, lines)
