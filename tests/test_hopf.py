"""The hopf program: every point in equation (5), the closed form, and whether all is there."""

import numpy as np
import pytest
import xarray as xr

from scripts.files.tsv import read_table, write_table
from scripts.tables.hopf_points_table import COLUMNS, rows_of

PLANES = ["tau_of_epsilon", "xi_of_epsilon"]
PLACE = ("epsilon", "tau", "xi")
COEFFICIENTS = [["2100", "1011"], ["1110", "0021"]]


@pytest.fixture
def plane(request, config) -> dict:
    """Settings of a plane as in the config."""
    return config["hopf_curves"][request.param] | {"cells": 20}


@pytest.fixture
def curves(programs, plane) -> xr.Dataset:
    """The plane's curves."""
    return programs.made_by("hopf", plane)


def terms(s, epsilon, tau, xi, gamma):
    """The terms of the characteristic function (5)."""
    stiffness = gamma**2 / xi
    return [
        s**3,
        s**2 * (1 + stiffness),
        s * gamma**2 * (1 + 1 / xi),
        gamma**2 + 0 * s,
        -s * (1 + epsilon) * stiffness * np.exp(-s * tau),
    ]


def residual(s, *parameters):
    """|(5)| over its largest term."""
    parts = terms(s, *parameters)
    return np.abs(np.sum(parts, axis=0)) / np.max(np.abs(parts), axis=0)


def root_near(s, epsilon, tau, xi, gamma):
    """The characteristic root next to s, by Newton's method."""
    stiffness = gamma**2 / xi
    for _ in range(20):
        slope = 3 * s**2 + 2 * s * (1 + stiffness) + gamma**2 * (1 + 1 / xi)
        slope -= (1 + epsilon) * stiffness * np.exp(-s * tau) * (1 - s * tau)
        s = s - np.sum(terms(s, epsilon, tau, xi, gamma), axis=0) / slope
    return s


def closed_form(omega, xi, gamma):
    """epsilon, and omega tau but for whole turns, of a pair i omega."""
    b = xi * (gamma**2 - omega**2) / (gamma**2 * omega)
    epsilon = np.sqrt((1 + omega**2) * (1 + b**2)) - 1
    return epsilon, np.arctan(b) - np.arctan(omega)


def parameters(curves: xr.Dataset) -> list[np.ndarray]:
    """epsilon, tau, xi and gamma of all points."""
    gamma = np.full(curves.sizes["point"], curves.attrs["gamma"])
    return [curves.epsilon.values, curves.tau.values, curves.xi.values, gamma]


def window_of(plane: dict) -> np.ndarray:
    """Corners of the window, shape (2, 2): least and most epsilon and ordinate."""
    return np.array([plane["epsilon_window"], plane["ordinate_window"]]).T


both_planes = pytest.mark.parametrize("plane", PLANES, indirect=True)


@both_planes
def test_every_point_solves_the_characteristic_equation(curves):
    """Equation (5) at i omega, recomputed, and as the file says."""
    recomputed = residual(1j * curves.omega.values, *parameters(curves))
    assert recomputed.max() <= 1e-10
    assert curves.residual.max() <= 1e-10
    np.testing.assert_allclose(curves.residual, recomputed, rtol=0, atol=1e-14)


@both_planes
def test_every_point_has_the_closed_form(curves, plane):
    """epsilon from omega alone, and omega tau but for whole turns."""
    epsilon, angle = closed_form(curves.omega, curves.xi, plane["gamma"])
    np.testing.assert_allclose(curves.epsilon, epsilon, rtol=1e-9, atol=1e-12)
    turns = (curves.omega * curves.tau - angle) / (2 * np.pi)
    np.testing.assert_allclose(turns, curves.branch, rtol=0, atol=1e-9)


@both_planes
def test_points_lie_in_the_plane_and_its_window(curves, plane):
    """The fixed parameter has its value, the others stay inside."""
    ordinate = plane["ordinate"]
    fixed = {"tau": "xi", "xi": "tau"}[ordinate]
    np.testing.assert_allclose(curves[fixed], plane["fixed"], rtol=1e-13)
    assert curves.attrs[fixed] == plane["fixed"]
    assert curves.attrs["gamma"] == plane["gamma"]
    assert curves.attrs["ordinate"] == ordinate
    low, high = window_of(plane)
    for axis, name in enumerate(["epsilon", ordinate]):
        slack = 1e-9 * (high - low)[axis]
        assert curves[name].min() >= low[axis] - slack
        assert curves[name].max() <= high[axis] + slack


@pytest.mark.parametrize("plane", ["tau_of_epsilon"], indirect=True)
def test_all_branches_of_tau_are_there_from_end_to_end(curves, plane):
    """A fine sweep of omega through the closed form finds no branch, and no part, that lacks."""
    omega = np.linspace(0, 2, 400001)[1:]
    epsilon, angle = closed_form(omega, plane["fixed"], plane["gamma"])
    low, high = window_of(plane)
    found = set()
    for k in range(50):
        tau = (angle + 2 * np.pi * k) / omega
        inside = (epsilon >= low[0]) & (epsilon <= high[0]) & (tau >= low[1]) & (tau <= high[1])
        if inside.any():
            found.add(k)
            on_branch = curves.omega.values[curves.branch.values == k]
            np.testing.assert_allclose(on_branch.min(), omega[inside].min(), atol=1e-5)
            np.testing.assert_allclose(on_branch.max(), omega[inside].max(), atol=1e-5)
    assert set(curves.branch.values) == found
    assert len(found) > 1


@pytest.mark.parametrize("plane", ["xi_of_epsilon"], indirect=True)
def test_all_branches_of_xi_are_there(curves, plane):
    """Where the closed form changes sign in xi at fixed tau, a point of a curve is near."""
    tau, gamma = plane["fixed"], plane["gamma"]
    low, high = window_of(plane)
    xi = np.linspace(low[1], high[1], 2001)
    found = []
    for omega in np.linspace(0.01, 2.0, 2000):
        epsilon, angle = closed_form(omega, xi, gamma)
        turns = (omega * tau - angle) / (2 * np.pi)
        for i in np.flatnonzero(np.floor(turns[1:]) != np.floor(turns[:-1])):
            if low[0] < epsilon[i] < high[0]:
                found.append((epsilon[i], xi[i]))
    points = np.column_stack([curves.epsilon, curves.xi])
    size = high - low
    distance = [np.min(np.linalg.norm((points - place) / size, axis=1)) for place in found]
    assert len(found) > 200
    assert max(distance) < 0.02


@both_planes
def test_drawn_line_is_smooth(curves, plane):
    """Between two points the curve leaves the chord by less than a thousandth of the window."""
    low, high = window_of(plane)
    ordinate, fixed = plane["ordinate"], plane["fixed"]
    place = (np.column_stack([curves.epsilon, curves[ordinate]]) - low) / (high - low)
    same = np.diff(curves.piece.values) == 0
    chord = np.diff(place, axis=0)[same]
    assert np.linalg.norm(chord, axis=1).max() < 0.05
    middle = ((curves.omega.values[1:] + curves.omega.values[:-1]) / 2)[same]
    if ordinate == "tau":
        epsilon, angle = closed_form(middle, fixed, plane["gamma"])
        tau = (angle + 2 * np.pi * curves.branch.values[1:][same]) / middle
        apart = (np.column_stack([epsilon, tau]) - low) / (high - low) - place[:-1][same]
        across = apart[:, 0] * chord[:, 1] - apart[:, 1] * chord[:, 0]
        assert (np.abs(across) / np.linalg.norm(chord, axis=1)).max() < 1e-3


@both_planes
def test_crossing_is_the_way_the_root_moves(curves):
    """The root beside i omega, followed by Newton's method over a small change of tau."""
    epsilon, tau, xi, gamma = parameters(curves)
    start = 1j * curves.omega.values
    step = 1e-5
    after = root_near(start, epsilon, tau + step, xi, gamma)
    before = root_near(start, epsilon, tau - step, xi, gamma)
    speed = (after - before).real / (2 * step)
    clear = np.abs(speed) > 1e-6
    assert clear.mean() > 0.9
    assert (curves.crossing.values == np.sign(speed))[clear].all()
    assert set(curves.crossing.values) == {-1, 1}


def test_branch_zero_starts_without_delay(programs, config):
    """Routh and Hurwitz: at tau = 0 the state is lost at epsilon = gamma^2 xi/(xi + gamma^2)."""
    plane = config["hopf_curves"]["tau_of_epsilon"] | {"cells": 20}
    curves = programs.made_by("hopf", plane)
    first = curves.isel(point=int(curves.tau.values.argmin()))
    xi, gamma = plane["fixed"], plane["gamma"]
    assert float(first.tau) == pytest.approx(0, abs=1e-9)
    assert float(first.epsilon) == pytest.approx(gamma**2 * xi / (xi + gamma**2), rel=1e-9)


@both_planes
def test_pieces_are_unbroken_and_counted(curves):
    """1, 2, ..., each of one branch, omega ascending."""
    pieces = curves.piece.values
    assert list(np.unique(pieces)) == list(range(1, pieces.max() + 1))
    for piece in np.unique(pieces):
        part = curves.isel(point=pieces == piece)
        assert len(set(part.branch.values)) == 1
        assert (np.diff(part.omega) > 0).all()


@both_planes
def test_printed_formula_is_kept_with_its_residual(curves):
    """(10) as printed, recomputed, does not solve (5), and the file says by how much."""
    omega, branch = curves.omega.values, curves.branch.values
    epsilon, _, xi, gamma = parameters(curves)
    numerator = -(omega**2) * (gamma**2 / xi + 1)
    denominator = -(omega**3) + omega * gamma**2 * (1 + xi) / xi
    printed = (np.arctan(numerator / denominator) + 2 * np.pi * branch) / omega
    np.testing.assert_allclose(curves.printed_tau, printed, rtol=1e-10)
    recomputed = residual(1j * omega, epsilon, printed, xi, gamma)
    np.testing.assert_allclose(curves.printed_residual, recomputed, rtol=0, atol=1e-9)
    assert np.median(recomputed) > 1e-3


@both_planes
def test_two_runs_make_the_same_bytes(programs, plane):
    """No time stamps."""
    programs.made_by("hopf", plane)
    first = programs.output.read_bytes()
    programs.made_by("hopf", plane)
    assert programs.output.read_bytes() == first


def test_window_without_a_curve_makes_an_empty_file(programs, config):
    """Below epsilon = 0.1 nothing oscillates by itself at small delays."""
    plane = config["hopf_curves"]["tau_of_epsilon"] | {"cells": 20}
    plane |= {"epsilon_window": [0.0, 0.05], "ordinate_window": [0.0, 1.0]}
    curves = programs.made_by("hopf", plane)
    assert curves.sizes["point"] == curves.sizes["special"] == 0
    assert rows_of("empty", curves) == []


def count_by_crossings(epsilon, tau, xi, gamma):
    """Unstable pairs, independently: those of the cubic at tau = 0, and what crosses up to tau."""
    lost = gamma**2 * xi / (xi + gamma**2)
    pairs = 1 if epsilon > lost else 0
    c = xi**2 / gamma**4
    cubic = [c, c + 1 - 2 * c * gamma**2, 1 - 2 * c * gamma**2 + xi**2 - (1 + epsilon) ** 2, xi**2]
    squares = np.roots(cubic)
    squares = np.sort(squares[(abs(squares.imag) < 1e-9) & (squares.real > 0)].real)
    for way, omega in zip((-1, 1), np.sqrt(squares), strict=False):
        _, angle = closed_form(omega, xi, gamma)
        turns = np.arange(100)
        delays = (angle + 2 * np.pi * turns) / omega
        pairs += way * np.count_nonzero((delays > 0) & (delays < tau))
    return pairs


@both_planes
def test_map_counts_the_crossings(curves, plane):
    """In every cell: pairs at tau = 0 plus crossings of all curves below."""
    for i, epsilon in enumerate(curves.map_epsilon.values):
        for j, ordinate in enumerate(curves.map_ordinate.values):
            place = {plane["ordinate"]: ordinate}
            tau, xi = place.get("tau", plane["fixed"]), place.get("xi", plane["fixed"])
            expected = count_by_crossings(epsilon, tau, xi, plane["gamma"])
            assert curves.map_unstable_pairs.values[j, i] == expected


@both_planes
def test_special_points_solve_the_characteristic_equation(curves):
    """At one frequency or two, to rounding; coefficients vanish where they should."""
    rows = rows_of("plane", curves)
    assert {"double_hopf", "generalised_hopf"} <= {row["kind"] for row in rows}
    for row in rows:
        place = [float(row[key]) for key in ("epsilon", "tau", "xi", "gamma")]
        omegas = [float(row[key]) for key in ("omega_1", "omega_2") if row[key]]
        assert len(omegas) == (2 if row["kind"] == "double_hopf" else 1)
        for omega in omegas:
            assert residual(1j * omega, *place) < 1e-10
        assert (row["l1_1"] == "0") is (row["kind"] == "generalised_hopf")


@both_planes
def test_curves_start_where_the_normal_form_says(curves, plane):
    """Along the start of a curve of tori the pair of the cycle grows as it must, the other too."""
    rows = [row for row in rows_of("plane", curves) if row["kind"] == "double_hopf"]
    for row in rows:
        p = np.array([[float(row[f"g{key}"]) for key in keys] for keys in COEFFICIENTS])
        assert float(row["theta"]) == pytest.approx(p[0, 1] / p[1, 1], rel=1e-4)
        assert float(row["delta"]) == pytest.approx(p[1, 0] / p[0, 0], rel=1e-4)
        for j in (0, 1):
            step = {key: 1e-5 * float(row[f"start_{key}_{j + 1}"]) for key in PLACE}
            there = [float(row[key]) + step[key] for key in PLACE]
            growth = [
                root_near(1j * float(row[f"omega_{k}"]), *there, plane["gamma"]).real
                for k in (1, 2)
            ]
            assert np.linalg.norm(list(step.values())) == pytest.approx(1e-5, rel=1e-5)
            expected = -p[:, j] / np.linalg.norm(p[:, j])
            assert growth / np.linalg.norm(growth) == pytest.approx(expected, abs=1e-2)
            angle = 2 * np.pi * float(row[f"omega_{2 - j}"]) / float(row[f"omega_{j + 1}"])
            assert np.cos(float(row[f"angle_{j + 1}"])) == pytest.approx(np.cos(angle))


@both_planes
def test_generalised_points_have_their_columns(curves):
    """Folds leave along the Hopf curve; there is one curve and no coefficient of two pairs."""
    rows = [row for row in rows_of("plane", curves) if row["kind"] == "generalised_hopf"]
    for row in rows:
        step = {key: 1e-5 * float(row[f"start_{key}_1"]) for key in PLACE}
        there = [float(row[key]) + step[key] for key in PLACE]
        root = root_near(1j * float(row["omega_1"]), *there, curves.attrs["gamma"])
        assert abs(root.real) < 1e-3 * np.linalg.norm(list(step.values()))
        assert float(row["l2"]) != 0
        assert {row[key] for key in ("g2100", "theta", "unfolding", "angle_1", "torus_1")} == {""}
        assert {row[f"start_{key}_2"] for key in PLACE} == {""}


@both_planes
def test_table_of_points_is_whole(curves, tmp_path):
    """What is written is read again, also of no points."""
    rows = rows_of("plane", curves)
    write_table(tmp_path / "points.tsv", rows, COLUMNS)
    read = read_table(tmp_path / "points.tsv")
    assert [list(row) for row in read] == [COLUMNS] * len(rows)
    assert [row["tau"] for row in read] == [float(row["tau"]) for row in rows]
    write_table(tmp_path / "none.tsv", [], COLUMNS)
    assert (tmp_path / "none.tsv").read_text().split() == COLUMNS
