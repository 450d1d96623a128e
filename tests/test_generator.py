"""The generator of models: what a definition may not say, and what is made where it may.

The Fortran that it makes is tested in generator/test/, in quadruple precision.
"""

import re
import subprocess
import sys

import pytest
import sympy

from conftest import ROOT
from generator.definition import overlaid, read_model
from generator.flow import flow_of
from generator.fortran import FUNCTIONS, in_words, literal, wrapped
from generator.model import ModelError
from generator.module import write_module
from generator.rest import characteristic_terms
from generator.slow import balance_of
from scripts.files.read_config import read
from scripts.models.models import BLOCK, PAPER, built_in

DECAY = {
    "name": "decay",
    "parameters": {"rate_of": {"above": 0}},
    "states": {"a": "size", "w": "logarithm"},
    "auxiliary": {"v": "exp(w)"},
    "equations": {"a": "-rate_of*a(t - 1) + v - 1", "w": "-a"},
    "steady_state": {"a": 0, "w": 0},
}


def of_a(text: str) -> dict[str, str]:
    """Equations with this one of a."""
    return {"a": text, "w": "-a"}


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
        ({"parameters": {"a": {}}}, r"name: 'a'; expected .*; not acos, .*, a\Z"),
        (
            {"parameters": {"t": {}}},
            r"name: 't'; expected .*; not acos, .*, cosh, derivative, exp, .*, tanh\Z",
        ),
        ({"parameters": {"1a": {}}}, r"name: '1a'; expected a letter, then letters, digits or _"),
        ({"parameters": {"p": {"most": 1}}}, r"parameter p: .*; expected keys of above, at_least"),
        ({"parameters": {"p": {"above": "0"}}}, r"above of parameter p: '0'; expected a number"),
        ({"auxiliary": {"v": "w**2"}}, r"auxiliary v: 'w\*\*2'; expected exp\(STATE\)"),
        ({"definitions": {"b": "c", "c": "b"}, "equations": of_a("b")}, r"definition: 'b > c > b'"),
        ("a +", r"equation of a: 'a \+'; expected an expression such as"),
        ("b", r"equation of a: 'b'; expected one of rate_of, a, w, v"),
        ("gamma(a)", r"equation of a: 'gamma\(a\)'; expected one of exp, expm1, .*, min, .*series"),
        ("abs(a)", r"steady_state: {'a': 0, 'w': 0}; expected none where .* smooth, at abs\(a\)"),
        (
            {"equations": of_a("max(a, w, 1)"), "steady_state": None, "fast": "w"},
            r"fast: 'w'; expected none where the model is not smooth, at max\(a, w\)\Z",
        ),
        (
            {"equations": of_a("second_difference(a)*heaviside(w)"), "steady_state": None},
            r"second_difference: 'a'; expected none where .* smooth, at heaviside\(w\)",
        ),
        ("a(t - max(rate_of, a))", r"'a\(t - max.*; expected a\(t - DELAY\) with a delay >= 0"),
        ("where(a == 1, a, w)", r"'a == 1'; expected < <= > >=: motions have exactly this value"),
        ("where(sqrt(a**2) > 1, a, w)", r"'sqrt\(a\*\*2\) > 1'; expected a real expression; abs"),
        ("max(a, 1/0)", r"equation of a: 'max\(a, 1/0\)'; expected an expression that is finite"),
        ("where(a > 1, a)", r"'where\(a > 1, a\)'; expected abs, sign, heaviside of one argument"),
        ("Piecewise((a, w), (1, True))", r"'w'; expected a condition of < <= > >=, and, or, not"),
        ("exp(a, 2)", r"'exp\(a, 2\)'; expected one of exp"),
        ("a**w", r"'a\*\*w'; expected a power with a constant exponent"),
        ("a*9**9**9", r"'9\*\*9\*\*9'; expected an exponent of size <= 256"),
        ("a*((9**64)**64)**64", r"'\(9\*\*64\)\*\*64'; expected a power below exp"),
        ("a*1e999999999", r"'1e999999999'; expected a number from 1e-308 to 1e308"),
        ("a*1e-999999999", r"'1e-999999999'; expected a number from"),
        ("a*1e300*1e300", r"'a\*1e300\*1e300'; expected an expression that is finite"),
        ("atan2(a)", r"'atan2\(a\)'; expected one of exp, .*atan2: 2"),
        ({"parameters": {25 * "λ": {}}}, r"name: 'λλλ.*'; expected a letter, then letters, digit"),
        ("a % 2", r"'a % 2'; expected \+ - \* / \*\*"),
        ("a if w else v", r"'a if w else v'; expected numbers, names"),
        (
            {"equations": of_a("lambda**a"), "parameters": {"lambda": {}}},
            r"'lambda\*\*a'; expected a power with a constant exponent",
        ),
        ("w - a'(t - 1)", "expected no slope y': an equation with one is neutral"),
        ("a(t - a(t - 1))", r"'a\(t - a.*; expected a\(t - DELAY\) with a delay >= 0"),
        ("a(t + 1)", r"'a\(t \+ 1\)'; expected a\(t - DELAY\)"),
        ("a(t + rate_of)", r"'a\(t \+ rate_of\)'; expected a\(t - DELAY\)"),
        ("a(t - rate_of/2 + rate_of)", r"expected a\(t - DELAY\) with a delay >= 0"),
        ("a/0", r"equation of a: 'a/0'; expected an expression that is finite"),
        ("sqrt(a**2)", r"'sqrt\(a\*\*2\)'; expected a real expression; abs\(a\) for"),
        ("a + asin(2)", r"'a \+ asin\(2\)'; expected a real expression"),
        ("a*acosh(0)", r"'a\*acosh\(0\)'; expected a real expression"),
        ("v", r"equation of a at the steady state: 'v = 1'; expected 0"),
        ({"steady_state": {"a": 0}}, r"steady_state: 'a'; expected a value for each state"),
        ({"steady_state": {"near": {"a": 0}}}, r"steady_state: 'a'; expected a value for each st"),
        (
            {"steady_state": {"near": {"a": 0, "w": "a"}}},
            r"steady state of w: 'a'; expected an exp",
        ),
        ({"steady_state": {"near": {"a": 0, "w": 0}, "a": 0}}, r"'near, a'; expected near alone"),
        (
            {"steady_state": {"near": {"a": 0, "w": 0}}, "equations": of_a("sin(t) - a")},
            r"equation of a with a steady state: 'sin\(t\) - a'; expected no t",
        ),
        ("w/a", r"w/a at the steady state: nan; expected a number"),
        ({"fast": "b"}, r"fast: 'b'; expected one of the states a, w"),
        ({"domain": {"b": [0, 1]}}, r"domain of b: \[0, 1\]; expected a state with its least"),
        ("__import__('os')", r"__import__\(.*; expected one of exp"),
        ("a.real", r"'a.real'; expected numbers, names"),
    ],
)
def test_definition_is_refused_in_words(changes, words):
    """Place, what was met, and what is expected; a text is the equation of a."""
    if isinstance(changes, str):
        changes = {"equations": of_a(changes)}
    with pytest.raises(ModelError, match=words):
        read_model({**DECAY, **changes})


@pytest.mark.parametrize(
    "part", ["log(a)", "log1p(a)", "a**0.3", "1/a", "exp(acosh(a))", "atan2(0, a)", "asin(a/9)"]
)
def test_the_part_that_is_left_out_has_a_value(part):
    """And so have its derivatives: 0 times what is not finite is no number."""
    equations = {"a": f"Piecewise((w, a <= 3), ({part}, True))", "w": "where(not a > 3, 1, 0)"}
    model = read_model({**DECAY, "equations": equations, "steady_state": None})
    (a, w), (one,) = map(model.symbol, model.states), model.switches
    assert (one.value, model.equations[w.name]) == (3 - a, one.symbol)
    equation = model.equations[a.name]
    for place in (-10, 0, 1):
        below = {one.symbol: 1, a: sympy.Integer(place)}
        assert equation.xreplace(below) == w
        assert equation.diff(a).xreplace(below) == 0
    above = {one.symbol: 0, a: sympy.Integer(4)}
    assert equation.xreplace(above).equals(sympy.sympify(part, FUNCTIONS | {"a": 4}, rational=True))


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("Abs(a - w) + max(w, a)", "(2*s - 1)*(a - w) + s*a + (1 - s)*w"),
        ("where(~(a < w) & (True | (a > 9)), 1, 2)", "1 + s"),
        ("Max(2, 3, -1) + sign(0) + Heaviside(0, 1/2) + where(1 <= 1 < 2, a, 1/0)", "a + 7/2"),
        ("where(False or a < a, exp(a), 5) + min(a, a)", "a + 5"),
    ],
)
def test_terms_that_are_not_smooth_have_sides(text, meant):
    """1 or 0 for each condition, the same for the same one; numbers are compared at once."""
    model = read_model({**DECAY, "equations": of_a(text), "steady_state": None})
    names = dict(zip("aw", map(model.symbol, model.states), strict=True))
    names["s"] = sympy.Symbol("side_1", real=True)
    assert (next(iter(model.equations.values())) - sympy.sympify(meant, names)).expand() == 0


def test_steady_state_is_tested_by_numbers():
    """Where symbols do not show that the equation holds."""
    glass = {
        "name": "glass",
        "parameters": {"beta": {"above": 0}, "rate": {"above": 0}, "n": {"above": 0}},
        "states": {"near": "concentration"},
        "equations": {"near": "beta*near(t - 1)/(1 + near(t - 1)**n) - rate*near"},
        "steady_state": {"near": "(beta/rate - 1)**(1/n)"},
    }
    model = read_model(glass)
    assert model.near is None
    with pytest.raises(ModelError, match="at the steady state"):
        read_model({**glass, "steady_state": {"near": "(beta/rate - 1.0001)**(1/n)"}})
    guess = read_model({**glass, "steady_state": {"near": {"near": "beta"}}}).near
    assert [in_words(str(value), model.written) for value in guess.values()] == ["beta"]


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
        # numerator and denominator are not exact in double precision
        ("10**17/(3*10**16 + 1)", "3.333333333333333222222222222222225925926e0_wp"),
    ],
)
def test_literals_are_exact(number, text):
    assert literal(sympy.Rational(sympy.sympify(number))) == text


def test_long_lines_are_broken_outside_of_constants():
    line = 'text = "' + "a " * 20 + '" // "' + "b " * 30 + '"'
    lines = wrapped(line, 60)
    assert all(part.count('"') % 2 == 0 for part in lines)
    assert " ".join(part.removesuffix(" &").strip() for part in lines) == line


def test_velocity_of_the_block_is_integrated():
    """v' is linear, so that the series takes two convolutions; the balance is that of theory."""
    model = read_model(block())
    balance = balance_of(model)
    found = [*flow_of(model).integrated.items(), (balance.value, balance.rate)]
    in_our_names = [tuple(in_words(str(text), model.written) for text in pair) for pair in found]
    assert in_our_names == [("v", "w"), ("-theta - u*xi", "gamma**2/xi")]
    # a balance that is not linear in the other states has no slow series
    bent = overlaid(block(), {"definitions": {"friction": "theta + theta**2 + log(v)"}})
    assert balance_of(read_model(bent)) is None
    # its logarithm of v has no part that is linear in w
    assert balance_of(read_model(block("slip_cut_off"))) is None


def test_characteristic_function_of_the_papers_law_is_5():
    model = read_model(block())
    terms = {
        (power, in_words(str(delay), model.written)): value
        for value, power, delay in characteristic_terms(model)
    }
    _, epsilon, xi, gamma = (model.symbol(one.name) for one in model.parameters)
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
    definition.write_text("name: decay\nstates: { a: size }\nequations: { a: -gamma(a) }\n")
    command = [sys.executable, "-m", "generator", definition, module]
    run = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert run.returncode == 1
    assert run.stderr.startswith("error: model decay: equation of a: 'gamma(a)'; expected one of")
    assert [path.name for path in tmp_path.iterdir()] == ["decay.yaml"]
    definition.write_text("name: decay\nstates: { a: size }\nequations: { a: -a }\n")
    assert subprocess.run(command, cwd=ROOT).returncode == 0
    assert module.read_text().endswith("end module decay_model\n")
    assert [path.name for path in sorted(tmp_path.iterdir())] == ["decay.f90", "decay.yaml"]
