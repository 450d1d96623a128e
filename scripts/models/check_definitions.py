"""Whether a model can be made of a definition, and what it says without being compiled."""

import contextlib
import hashlib
import json
from functools import reduce
from pathlib import Path

from scripts.files.digests import digest_of_files
from scripts.files.outputs import FileError, written
from scripts.files.read_config import ConfigError

PROJECT = Path(__file__).parents[2]
GENERATOR = PROJECT / "generator"
CHECKED = PROJECT / "build" / "checked_laws"
"""A file for each definition that was checked before, named by its digest."""


def check_definition(place: str, parts: list[dict]) -> tuple[bool, str, str]:
    """Refuse parts of a definition of which no model can be made; raise ConfigError saying why.

    Otherwise whether the model has t in its equations, its first term that is not smooth, and the
    first delay that depends on t or the states.
    """
    checked = CHECKED / _digest_of(parts)
    if checked.exists():
        return tuple(json.loads(checked.read_text(encoding="utf-8")))
    # needs SymPy, which takes half a second to load
    from generator.definition import overlaid, read_model
    from generator.fortran import in_words
    from generator.model import TIME, ModelError
    from generator.module import write_module

    try:
        model = read_model(reduce(overlaid, parts))
        write_module(model)
    except (ModelError, TypeError) as problem:
        reason = str(problem).removeprefix(f"model {parts[-1]['name']}: ")
        raise ConfigError(f"{place}: {reason}") from None
    terms = [*model.equations.values(), *(one.term for one in model.sums)]
    has_time = any(one.has(TIME) for one in terms)
    switches = [in_words(one.text, model.written) for one in model.switches]
    moving = [in_words(str(one.lag), model.written) for one in model.moving]
    facts = has_time, next(iter(switches), ""), next(iter(moving), "")
    # where nothing can be written, the model is checked again
    with contextlib.suppress(OSError, FileError):
        CHECKED.mkdir(parents=True, exist_ok=True)
        with written(checked) as unfinished:
            unfinished.write_text(json.dumps(facts), encoding="utf-8")
    return facts


def _digest_of(parts: list[dict]) -> str:
    """A digest of a definition and of all by which it is checked."""
    sources = [*sorted(GENERATOR.glob("*.py")), *sorted(GENERATOR.glob("*.jinja"))]
    said = json.dumps([parts, digest_of_files(sources)])
    return hashlib.sha256(said.encode()).hexdigest()
