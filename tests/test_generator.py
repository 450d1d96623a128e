"""The generator of models: what a definition may not say, and what is made where it may.

The Fortran that it makes is tested in generator/test/, in quadruple precision.
"""

import re
import subprocess
import sys

import pytest
import sympy
from conftest import ROOT

from generator.definition import ModelError, overlaid, read_model
from generator.fortran import literal, text_of, wrapped
from generator.module import write_module
from generator.pointwise import characteristic_terms
from generator.series import flow_of
from generator.slow import balance_of
from scripts.files.read_config import read
from scripts.namelists.laws import BLOCK, PAPER, built_in

DECAY = {
    "name": "decay",
    "parameters": {"rate_of": {"above": 0}},
    "states": {"a": "size", "w": "logarithm"},
    "auxiliary": {"v": "exp(w)"},
    "equations": {"a": "-rate_of*a(t - 1) + v - 1", "w": "-a"},
    "steady_state": {"a": 0, "w": 0},
}


def block(law: str = PAPER) -> dict:
    return overlaid(read(BLOCK), built_in()[law])


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"name": "1st"}, r"name: '1st'; expected a letter"),
        ({"colour": 1}, r"keys: 'colour'; expected only about, auxiliary"),
        ({"equations": {}}, r"equations: {}; expected at least one entry"),
        ({"equations": {"a": "0"}}, r"equations: 'a'; expected one for each of a, w"),
        ({"states": {"a": "", "W": ""}, "auxiliary": None}, r"equations: 'a, w'; expected one for"),
        ({"parameters": {"A": {}}}, r"name: 'a'; expected each name once, whatever its case"),
        ({"parameters": {"unit": {}}}, r"name: 'unit'; expected .* no name of the generated code"),
        ({"parameters": {"p": {"most": 1}}}, r"parameter p: .*; expected keys of above, at_least"),
        ({"parameters": {"p": {"above": "0"}}}, r"above of parameter p: '0'; expected a number"),
        (
            {"parameters": {"w_delayed_1": {}}},
            r"name: 'w_delayed_1'; expected no name of a delayed",
        ),
        ({"auxiliary": {"v": "w**2"}}, r"auxiliary v: 'w\*\*2'; expected exp\(STATE\)"),
        ({"definitions": {"b": "c", "c": "b"}, "of_a": "b"}, r"definition: 'b > c > b'"),
        ({"of_a": "a +"}, r"equation of a: 'a \+'; expected an expression such as"),
        ({"of_a": "b"}, r"equation of a: 'b'; expected one of rate_of, a, w, v"),
        (
            {"of_a": "abs(a)"},
            r"equation of a: 'abs\(a\)'; expected one of exp, log, .*not analytic",
        ),
        ({"of_a": "exp(a, 2)"}, r"'exp\(a, 2\)'; expected one of exp"),
        ({"of_a": "a**w"}, r"'a\*\*w'; expected a power with a constant exponent"),
        ({"of_a": "a*9**9**9"}, r"'9\*\*9\*\*9'; expected an exponent of size <= 64"),
        ({"of_a": "a*((9**64)**64)**64"}, r"'\(9\*\*64\)\*\*64'; expected a power below exp"),
        ({"of_a": "a*1e999999999"}, r"'1e999999999'; expected a number from 1e-308 to 1e308"),
        ({"of_a": "a*1e-999999999"}, r"'1e-999999999'; expected a number from"),
        ({"of_a": "a % 2"}, r"'a % 2'; expected \+ - \* / \*\*"),
        ({"of_a": "a if w else v"}, r"'a if w else v'; expected numbers, names"),
        ({"of_a": "a(t - w)"}, r"'a\(t - w\)'; expected a\(t - DELAY\) with a delay >= 0"),
        ({"of_a": "a(t + 1)"}, r"'a\(t \+ 1\)'; expected a\(t - DELAY\)"),
        ({"of_a": "a(t + rate_of)"}, r"'a\(t \+ rate_of\)'; expected a\(t - DELAY\)"),
        ({"of_a": "a(t - rate_of/2 + rate_of)"}, r"expected a\(t - DELAY\) with a delay >= 0"),
        ({"of_a": "a/0"}, r"equation of a: 'a/0'; expected an expression that is finite"),
        ({"of_a": "v"}, r"equation of a at the steady state: 'v = 1'; expected 0"),
        ({"steady_state": {"a": 0}}, r"steady_state: 'a'; expected a value for each state"),
        ({"history": {"a": 0}}, r"history: 'a'; expected an expression of t for each state"),
        ({"history": {"a": "w", "w": 0}}, r"history of a: 'w'; expected an expression of t alone"),
        ({"fast": "b"}, r"fast: 'b'; expected one of the states a, w"),
        ({"domain": {"b": [0, 1]}}, r"domain of b: \[0, 1\]; expected a state with its least"),
        ({"of_a": "__import__('os')"}, r"__import__\(.*; expected one of exp"),
        ({"of_a": "a.real"}, r"'a.real'; expected numbers, names"),
    ],
)
def test_definition_is_refused_in_words(changes, words):
    """Place, what was met, and what is expected."""
    changes = dict(changes)
    of_a = changes.pop("of_a", None)
    values = {**DECAY, **changes}
    if of_a:
        values["equations"] = {"a": of_a, "w": "-a"}
    with pytest.raises(ModelError, match=words):
        read_model(values)


@pytest.mark.parametrize("end", ["\n", "\r", "\x0b", "\x0c", "\x1c", "\x85", "\u2028"])
def test_text_of_a_definition_becomes_no_code(end):
    """However its lines end: a shared file must not bring statements of its own."""
    code = f"mine{end}call execute_command_line('true')"
    # Python reads an expression over several lines of these two kinds alone
    between = end if end in ("\n", "\r") else " "
    values = {**DECAY, "about": code, "source": code, "states": {"a": code, "w": code}}
    values["parameters"] = {"rate_of": {"meaning": code, "unit": code, "above": 0}}
    values["equations"] = {"a": f"(-rate_of*a(t - 1){between}+ v - 1)", "w": "-a"}
    for line in write_module(read_model(values)).splitlines():
        if "execute_command_line" in line:
            before = line.strip().partition("call")[0]
            # a comment, or within a character constant
            assert before.startswith("!>") or before.count('"') % 2 == 1


def test_long_texts_are_refused():
    """They would be cut in files of results."""
    with pytest.raises(ModelError, match=r"source: 'xxx.*; expected at most 500 letters"):
        read_model({**DECAY, "source": 501 * "x"})
    with pytest.raises(ModelError, match=r"unit of p: .*; expected at most 60 letters"):
        read_model({**DECAY, "parameters": {"p": {"unit": 61 * "x"}}})


def test_later_files_add_and_replace():
    """An entry without a value goes, a whole section is joined."""
    whole = overlaid(DECAY, {"parameters": {"q": {}, "rate_of": None}, "fast": None, "name": "b"})
    assert whole["parameters"] == {"q": {}}
    assert (whole["name"], whole["fast"]) == ("b", None)


@pytest.mark.parametrize(
    ("number", "text"),
    [
        ("1/2", "0.5_wp"),
        ("12", "12.0_wp"),
        ("1/3", "1.0_wp/3.0_wp"),
        ("1/2000", "0.0005_wp"),
        ("10**20", "1.0e20_wp"),
        ("3*10**-18", "3.0e-18_wp"),
    ],
)
def test_literals_are_exact(number, text):
    assert literal(sympy.Rational(sympy.sympify(number))) == text


def test_expressions_keep_their_brackets():
    a, b, c = sympy.symbols("a b c", real=True)
    assert text_of(-(a**2) * (b + (a + c) / 3) / c) == "-a**2*(a/3.0_wp + b + c/3.0_wp)/c"
    assert text_of(-(a**2) * (b + (a + c) / b) / c) == "-a**2*(b + (a + c)/b)/c"
    assert text_of((a + b) ** sympy.Rational(1, 2) - 1 / (a * b)) == "sqrt(a + b) - 1.0_wp/(a*b)"
    assert text_of((a * b) ** c) == "(a*b)**c"


def test_long_lines_are_broken_outside_of_constants():
    line = 'text = "' + "a " * 20 + '" // "' + "b " * 30 + '"'
    lines = wrapped(line, 60)
    assert all(part.count('"') % 2 == 0 for part in lines)
    assert " ".join(part.removesuffix(" &").strip() for part in lines) == line


def test_velocity_of_the_block_is_integrated():
    """v' is linear, so that the series takes two convolutions; the balance is that of theory."""
    model = read_model(block())
    assert flow_of(model).integrated == {"v": "w"}
    balance = balance_of(model)
    assert str(balance.value) == "-theta - u*xi"
    assert str(balance.rate) == "gamma**2/xi"
    # a balance that is not linear in the other states has no slow series
    bent = overlaid(block(), {"definitions": {"friction": "theta + theta**2 + log(v)"}})
    assert balance_of(read_model(bent)) is None
    # its logarithm of v has no part that is linear in w
    assert balance_of(read_model(block("slip_cut_off"))) is None


def test_characteristic_function_of_the_papers_law_is_5():
    terms = {
        (power, str(delay)): value
        for value, power, delay in characteristic_terms(read_model(block()))
    }
    epsilon, gamma, xi = (sympy.Symbol(name, real=True) for name in ("epsilon", "gamma", "xi"))
    printed = {
        (3, "0"): sympy.Integer(1),
        (2, "0"): 1 + gamma**2 / xi,
        (1, "0"): gamma**2 * (1 + 1 / xi),
        (0, "0"): gamma**2,
        (1, "tau"): -(1 + epsilon) * gamma**2 / xi,
    }
    assert terms.keys() == printed.keys()
    assert all(sympy.simplify(terms[key] - value) == 0 for key, value in printed.items())


def test_equation_stands_above_each_procedure():
    """And the lines have a length that compilers take."""
    text = write_module(read_model(block()))
    assert "!>     w' = -gamma**2/v*(stretch + friction/xi)\n   pure subroutine rhs" in text
    assert "!>     v' = -gamma**2*(u + (theta + w)/xi)\n   pure subroutine series" in text
    assert max(map(len, text.splitlines())) <= 132
    assert not re.search(r"[ \t]$", text, re.MULTILINE)


def test_command_writes_a_module_or_nothing(tmp_path):
    """A definition that is refused leaves no file."""
    definition, module = tmp_path / "decay.yaml", tmp_path / "decay.f90"
    definition.write_text("name: decay\nstates: { a: size }\nequations: { a: -abs(a) }\n")
    command = [sys.executable, "-m", "generator", definition, module]
    run = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert run.returncode == 1
    assert run.stderr.startswith("error: model decay: equation of a: 'abs(a)'; expected one of exp")
    assert [path.name for path in tmp_path.iterdir()] == ["decay.yaml"]
    definition.write_text("name: decay\nstates: { a: size }\nequations: { a: -a }\n")
    assert subprocess.run(command, cwd=ROOT).returncode == 0
    assert module.read_text().endswith("end module decay_model\n")
    assert [path.name for path in sorted(tmp_path.iterdir())] == ["decay.f90", "decay.yaml"]
