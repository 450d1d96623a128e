#!/usr/bin/env bash
# SciPy 1.17.1 returns values 1e5 tolerances off where DOP853 fills in output times.
#
# Expected: x' = -k (x - cos t), cos t by two equations of its own: all of t_eval is as accurate as steps.
# Seen: at rtol = atol = 1e-8 and k = 50 the ends of steps are 1e-6 off, values of t_eval between them
# 4e-3, with success and no message. RK45 is right to 4e-8 at both, Radau to 1e-8. DOP853 accepts steps of
# up to 31/k here; from 6.4/k on it is unstable.
# Matters: t_eval is what is plotted, and a tight tolerance is why one takes DOP853.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >run.py <<'END_OF_RUN'
import sys

import numpy as np
from scipy.integrate import solve_ivp

tolerance, wrong = 1e-8, 0.0
for k in (20.0, 30.0, 40.0, 50.0):

    def exact(t):
        return (k * k * np.cos(t) + k * np.sin(t) + np.exp(-k * t)) / (1 + k * k)

    for method in ("DOP853", "RK45", "Radau"):
        options = {"method": method, "rtol": tolerance, "atol": tolerance}
        found = [
            solve_ivp(lambda t, y: [k * (y[1] - y[0]), y[2], -y[1]], (0, 20), [1, 1, 0], t_eval=t, **options)
            for t in (None, np.linspace(0, 20, 20001))
        ]
        errors = [np.abs(run.y[0] - exact(run.t)).max() / tolerance for run in found]
        print(f"{method} k = {k:g}: errors at steps {errors[0]:.1f}, between {errors[1]:.1f} tolerances")
        wrong = max(wrong, errors[1] / max(errors[0], 1)) if method == "DOP853" else wrong
        if max(errors[:1] if method == "DOP853" else errors) > 1000:
            sys.exit("another error")
if wrong < 100:
    sys.exit("changed")
END_OF_RUN
python3 -m venv .
bin/pip install -q scipy==1.17.1 numpy==2.4.6
bin/python run.py
