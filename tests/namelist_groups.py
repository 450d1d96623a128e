"""Namelist groups that programs accept, for tests to copy and change."""

OBSERVATION = {
    "t_transient": 100.0,
    "t_observed": 200.0,
    "t_turning": 20.0,
    "interval": 5.0,
    "blocks": 2,
    "exponents": 4,
    "zero_level": 1e-4,
    "longest_bar": 1e-3,
    "doublings": 0,
    "sample_interval": 0.1,
    "window": "hann",
    "segments": 2,
    "overlap": 0.5,
    "peak_floor": 1e-6,
    "peak_prominence": 10.0,
    "tolerance": 1e-6,
    "method": "auto",
    "most_steps": 100000,
}
POINTS = {
    "name": "a part",
    "xi": 0.8,
    "gamma": 0.8,
    "epsilon_window": [0.1, 0.5],
    "epsilon_count": 3,
    "epsilon_part": [2, 3],
    "tau_window": [0.0, 10.0],
    "tau_count": 2,
    "tau_part": [1, 2],
    "theta": [0.0, 0.5],
    "u": [0.0, -0.5],
    "v": [1.1, 1.5],
    "kept": 100,
}
CASES = {
    "name": ["decay", "stiff"],
    "tau": [0.0, 1.0],
    "epsilon": [0.3, 0.7],
    "xi": [0.8, 0.5],
    "gamma": [0.8, 100.0],
    "theta": [0.1, 0.0],
    "u": [0.2, 0.0],
    "v": [1.5, 1.1],
    "t_end": [20.0, 5.0],
    "sample_interval": [0.5, 0.5],
}
MEASURE = {
    "methods": ["auto", "explicit", "rk4_cubic"],
    "tolerances": [1e-6, 1e-9],
    "steps": [0.01],
    "most_steps": 1000,
    "repeats": 2,
    "least_seconds": 1e-4,
}
REFERENCE = {
    "method": "radau13",
    "tolerance": 1e-18,
    "check_tolerance": 1e-16,
    "disturbance": 1e-15,
    "most_steps": 100000,
}
EXPONENTS = {
    "count": 2,
    "t_end": 20.0,
    "t_turning": 5.0,
    "interval": 1.0,
    "blocks": 2,
    "zero_level": 1e-3,
    "check_tolerances": [1e-7],
}
