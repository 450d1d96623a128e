# SPDX-License-Identifier: BSD-3-Clause
"""Exponents, classes of motion, roots, Hopf curves and cycles of a model, by the library.

Each gives an xarray.Dataset whose variables have descriptions (`long_name`). Times and rates are in
units of the model.
"""

import io
from collections.abc import Mapping

import f90nml
import numpy as np
import xarray as xr

from delaykit.arguments import Arguments, window_of
from delaykit.errors import ModelError, RunError, check_name
from delaykit.library import LIBRARY, Results, call
from delaykit.version import __version__

OBSERVATION = {
    **{"t_lasting": None, "t_path": 0.0, "interval": None, "exponents": 3, "zero_level": None},
    **{"longest_bar": None, "doublings": 6, "sample_interval": None, "window": "hann"},
    **{"segments": 8, "overlap": 0.5, "peak_floor": 1e-6, "peak_prominence": 10.0},
}
"""How attractors are judged unless the caller says otherwise; None: of TIMES or RATES."""
TIMES = {
    **{"t_transient": 100.0, "t_observed": 2000.0, "t_turning": 20.0, "t_lasting": 4000.0},
    **{"interval": 5.0, "sample_interval": 0.1, "longest_period": 50.0},
}
RATES = {"zero_level": 3e-5, "longest_bar": 1e-3}
"""Times that are not given in units of time of the model (the longest delay or, without one, the
inverse of the fastest rate at the start), and rates in units of its inverse."""
ALWAYS = ("point", "orbit", "special", "root", "peak")
"""Dimensions that results keep where they have no such thing."""
OF_FILES = ("scene", "name", "parameters")
"""Attributes of files that are left out."""
SIGNS = ("negative", "zero", "positive", "unclear")


def command(
    own: Arguments, name: str, groups: Mapping, histories: Mapping | None = None
) -> xr.Dataset:
    """Run a command of the library with a namelist of these groups."""
    lists = {"settings": groups} | ({"histories": histories} if histories else {})
    return answer(own.model.handle, name, text_of(lists))


def text_of(groups: Mapping) -> str:
    """The text of a namelist."""
    text = io.StringIO()
    f90nml.Namelist(groups).write(text)
    return text.getvalue()


def answer(handle, name: str, text: str) -> xr.Dataset:
    """What a command of the library returns for a namelist, of a model if it needs one."""
    return dataset_of(call(LIBRARY.dk_command, handle, name.encode(), text.encode()))


def dataset_of(found: Results) -> xr.Dataset:
    """Results of the library with words for letters and for flags."""
    dims, variables, attributes = {}, {}, {}
    for kind, *words in found.description():
        match kind:
            case "dimension":
                dims[words[0]] = int(words[1])
            case "variable":
                variables[words[0]] = (words[1], words[2:])
            case "attribute":
                owner, name, value_kind, *values = words
                attributes.setdefault(owner, {})[name] = value_of(value_kind, values)
    data = {}
    for name, (kind, names) in variables.items():
        shape = [dims[one] for one in names]
        about = attributes.get(name, {})
        numpy_kind = {"real": np.float64, "integer": np.int32, "letters": "S1"}[kind]
        values = found.values(name, numpy_kind).reshape(shape)
        if kind == "letters":
            values = np.array(["".join(row.astype("U1")) for row in values], dtype=object)
            names = names[:-1]
        elif "flag_meanings" in about:
            words = about.pop("flag_meanings").split()
            codes = np.atleast_1d(about.pop("flag_values"))
            word_of = dict(zip(codes.tolist(), words, strict=True))
            values = np.array([word_of[code] for code in values.ravel().tolist()], dtype=object)
            values = values.reshape(shape)
        data[name] = (names, values, about)
    whole = attributes.get("", {}) | {"source": f"delaykit {__version__}"}
    whole = {k: v for k, v in whole.items() if k not in OF_FILES and (k != "model_source" or v)}
    dataset = xr.Dataset(data, attrs=whole)
    dataset = dataset.drop_dims([k for k, n in dataset.sizes.items() if n == 0 and k not in ALWAYS])
    return dataset.set_coords([name for name in dataset if list(dataset[name].dims) == [name]])


def value_of(kind: str, values: list[str]):
    """The value of an attribute."""
    if kind == "letters":
        return "\t".join(values)
    numbers = [float(one) if kind == "real" else int(one) for one in values]
    return numbers[0] if len(numbers) == 1 else numbers


def model_group(own: Arguments, but=()) -> dict:
    """The model with its parameters, some left out."""
    model = own.model
    known = dict(zip(model.definition["parameters"], own.numbers.tolist(), strict=True))
    known = {key: value for key, value in known.items() if key not in but}
    group = {"name": model.definition["name"], "own_units": True}
    if known:
        group |= {"parameters": list(known), "values": list(known.values())}
    if model.blocks > 1 and not model.network:
        group |= {"blocks": model.blocks, "ends": model.ends}
    return group


def histories_group(own: Arguments, history) -> dict:
    """A constant history, or the last state of a run."""
    if hasattr(history, "t_events"):
        values = history.y[..., -1].reshape(own.model.blocks, -1)
    elif isinstance(history, xr.Dataset):
        last = history.isel(t=-1)
        values = np.transpose([np.atleast_1d(last[state].values) for state in own.states])
    else:
        given = own.by_name("history", history)
        if any(callable(one) or isinstance(one, tuple) for one in given.values()):
            raise ModelError("history: expected numbers here, or a run whose last state is taken")
        values = own.values("history", given).reshape(own.model.blocks, -1)
    return {"names": list(own.states), "values": values.T.ravel().tolist()}


def is_run(start) -> bool:
    """Whether a start is a run, as arrays or as a Dataset."""
    return hasattr(start, "t_events") or isinstance(start, xr.Dataset)


def mean_of(model, run) -> dict[str, float]:
    """The mean of each state over a run, about which it moves."""
    data = run if isinstance(run, xr.Dataset) else run.to_dataset()
    span = float(data.t[-1] - data.t[0])
    return {state: float(data[state].integrate("t")) / span for state in model.states}


def in_units(own: Arguments, histories: Mapping, given: Mapping) -> dict:
    """Options with times and rates in units of the model where they are None."""
    past = np.reshape(histories["values"], (len(own.states), -1)).T
    unit = own.unit_of_time(past.ravel())
    known = {key: time * unit for key, time in TIMES.items()}
    known |= {key: rate / unit for key, rate in RATES.items()}
    return {key: known[key] if value is None else value for key, value in given.items()}


def exponents(
    model,
    history,
    count=4,
    t_transient=None,
    t_end=None,
    *,
    parameters=None,
    rtol=1e-8,
    method="auto",
    t_turning=None,
    interval=None,
    batches=20,
    zero_level=None,
    longest_bar=None,
) -> xr.Dataset:
    """The `count` largest Lyapunov exponents from t_transient to t_end, with standard errors.

    One is that of the flow, 0, unless the motion ends at rest or time is in the equations. Also
    their signs (negative, zero, positive or unclear), the Kaplan-Yorke dimension
    (the count is too small where it is NaN), running averages over time, and the value in each
    batch of the time.

    history: constants, or a run, from whose last state the motion begins.
    t_turning: time before t_transient is over in which the vectors turn. interval: longest time
    between two orthonormalisations.
    """
    if not isinstance(count, int | np.integer):
        raise ModelError(f"count: {count!r}; expected a whole number >= 1")
    model = model.reduced("jacobian")
    own = Arguments(model, parameters)
    histories = histories_group(own, history)
    times = {"t_transient": t_transient, "t_observed": None, "t_turning": t_turning}
    levels = {"interval": interval, "zero_level": zero_level, "longest_bar": longest_bar}
    known = in_units(own, histories, times | levels)
    t_transient, t_observed = known.pop("t_transient"), known.pop("t_observed")
    t_end = t_transient + t_observed if t_end is None else t_end
    groups = {
        "scene": {
            **{"name": model.definition["name"], "model": model_group(own), "method": method},
            **{"t_end": t_end, "t_transient": t_transient, "sample_interval": t_observed},
            "tolerance": rtol,
        },
        "exponents": {"count": count, "t_end": t_end, "batches": batches, **known},
    }
    found = command(own, "exponents", groups, histories).isel(run=0)
    signs = [SIGNS[1 + int(sign)] for sign in found.sign]
    found = found.drop_vars(["tolerance", "longest_step", "mean_step", "sign"]).rename(
        dimension="kaplan_yorke",
        dimension_error="kaplan_yorke_error",
        time_block="batch",
        block_value="batch_value",
    )
    about = {"long_name": "sign of the exponent, unclear where its error is too long"}
    return found.assign(sign=("exponent", signs, about)).assign_attrs(rtol=rtol)


def attractor(
    model,
    history,
    *,
    parameters=None,
    near=None,
    rtol=1e-8,
    method="auto",
    max_steps=2 * 10**7,
    t_transient=None,
    t_observed=None,
    t_turning=None,
    kept=0,
    **observation,
) -> xr.Dataset:
    """The class of the motion from a history, and what it was judged by.

    Class: fixed_point, cycle, torus, three_torus, chaos or undecided, where exponents, section and
    spectrum do not contradict each other. near: a guess of the state at rest, unless there is a
    `steady_state` or a `section`. observation: keys of OBSERVATION.
    """
    model = model.resting(near, needed=False)
    if "steady_state" not in model.definition:
        model = model.reduced("jacobian")
    own = Arguments(model, parameters)
    for key in observation:
        check_name("option", key, OBSERVATION)
    histories = histories_group(own, history)
    times = {"t_transient": t_transient, "t_observed": t_observed, "t_turning": t_turning}
    groups = {
        "observation": in_units(own, histories, OBSERVATION | observation | times),
        "points": {
            **{"name": model.definition["name"], "model": model_group(own), "kept": kept},
            **{"refinements": 0, "sweep": "none"},
        },
        "solver": {"method": method, "tolerance": rtol, "most_steps": max_steps},
    }
    found = command(own, "attractors", groups, histories).isel(point=0)
    if problem := str(found.problem.item()):
        raise RunError(problem, found)
    return found


def roots(model, bound=-1.0, *, parameters=None, near=None) -> np.ndarray:
    """Characteristic roots at rest with a real part above the bound, the rightmost first.

    Of a network, `near` is needed, and roots that are alike are one: in a symmetric network many
    are.
    """
    if model.network:
        from delaykit.rests import roots_of_network

        return roots_of_network(model, bound, near, parameters)
    own = Arguments(model.resting(near), parameters)
    groups = {"linear_stability": {"model": model_group(own), "root_bound": bound}}
    found = command(own, "linear_stability", groups)
    return found.root_real.values + 1j * found.root_imag.values


def hopf(model, along, window, *, parameters=None, near=None, cells=40) -> xr.Dataset:
    """Hopf curves in a plane of two parameters, and their special points.

    Curves: points with frequency `omega`, first Lyapunov coefficient `l1` (negative:
    supercritical) and the number of unstable roots beside; `piece` numbers unbroken curves.
    special_...: double and generalised Hopf points. Also a map of the number of unstable roots.

    along: names of abscissa and ordinate; window: ((least, most), (least, most)).
    near: a guess of the state at rest, if the model has no `steady_state`.

    Of a network: points along one parameter (along="k", window=(0, 2)).
    """
    if model.network:
        from delaykit.rests import hopf_of_network

        check_name("parameter", along, model.definition["parameters"])
        return hopf_of_network(model, along, window_of(window, along), near, parameters, cells)
    model = model.resting(near)
    for key in along:
        check_name("parameter", key, model.definition["parameters"])
    if len(along) != 2:
        raise ModelError(f"along: {along!r}; expected two names of parameters")
    window = window_of(window, *along)
    corner = dict(zip(along, window[::2], strict=True))
    own = Arguments(model, {**(parameters or {}), **corner})
    groups = {
        "hopf_curves": {
            **{"along": list(along), "windows": window, "cells": cells},
            "model": model_group(own, but=along),
        }
    }
    return command(own, "hopf", groups)


def cycle(
    model,
    start,
    along,
    window,
    *,
    parameters=None,
    near=None,
    t_transient=None,
    degree=7,
    intervals=40,
    longest_period=None,
    most_orbits=1000,
    curves=None,
) -> xr.Dataset:
    """Branches of periodic orbits along a parameter, from Hopf points and from a motion.

    start: a run or a history from which cycles are approached at the model's own parameter and at
        both ends of the window; None: from Hopf points alone.
    near: a guess of the state at rest, unless the model has a `steady_state`; of a run its mean.
    curves: {name: window} of two parameters over which folds, period doublings and torus
        bifurcations are followed.

    Orbits: the parameter, period, least and greatest signal, Floquet multipliers. special_...:
    folds, period doublings and torus bifurcations of the branches.
    """
    if near is None and "steady_state" not in model.definition and is_run(start):
        near = mean_of(model, start)
    model = model.resting(near)
    check_name("parameter", along, model.definition["parameters"])
    window = window_of(window, along)
    own = Arguments(model, parameters)
    here = dict(zip(model.definition["parameters"], own.numbers.tolist(), strict=True))[along]
    histories = histories_group(own, dict.fromkeys(own.states, 0.0) if start is None else start)
    times = {"t_transient": t_transient, "longest_period": longest_period}
    group = {
        **{"along": along, "window": window, "model": model_group(own, but=[along])},
        **{"degree": degree, "intervals": intervals, "most_orbits": most_orbits},
        **in_units(own, histories, times),
    }
    if start is not None:
        group["starts"] = [here, *window]
    if curves:
        group |= {
            "curves_along": list(curves),
            "curves_windows": list(np.ravel([*curves.values()])),
        }
    return command(own, "cycles", {"cycles": group}, histories)
