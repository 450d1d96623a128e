#!/usr/bin/env bash
# scikit-sundae 1.2.0 returns the events of an earlier run with those of a later one.
#
# Expected: a solver that is used twice gives each run its own events, at times within that run.
# Seen: y'' = -y from (1, 0) up to t = 10 has its zeros at pi/2, 3 pi/2, 5 pi/2. A second run of the same
# object up to t = 1 has none, but returns the three of the first; 7.85 is past its end.
# Matters: an object is used again in each scan of parameters.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >run.py <<'END_OF_RUN'
import sys

import numpy as np
from sksundae.cvode import CVODE


def rate(t, y, derivative):
    derivative[:] = y[1], -y[0]


def zero(t, y, values):
    values[0] = y[0]


zero.terminal, zero.direction = [False], [0]
solver = CVODE(rate, rtol=1e-8, atol=1e-10, eventsfn=zero, num_events=1)
long, short = (solver.solve([0.0, end], [1.0, 0.0]) for end in (10.0, 1.0))
print("first run", long.t_events, "second run", short.t_events, "up to", short.t[-1])
expected = np.pi * np.array([0.5, 1.5, 2.5])
if short.t_events is None or not np.allclose(short.t_events, expected, atol=1e-6):
    sys.exit("changed")
END_OF_RUN
python3 -m venv .
bin/pip install -q scikit-sundae==1.2.0 numpy==2.4.6
bin/python run.py
