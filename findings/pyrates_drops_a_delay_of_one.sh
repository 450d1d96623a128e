#!/usr/bin/env bash
# PyRates 1.2.3 with the solver "scipy" drops a delay of exactly 1.
#
# Expected: z' = -z(t - tau) with history 1 falls as 1 - t up to t = tau: z(0.9) is 0.1 for tau >= 0.9.
# Seen: with tau = 1.01 it does. With tau = 1 the run is that of z' = -z, and so it is with a delay of at
# most the step; the one warning says that this is a delayed system.
# Matters: 1 is the delay of every model whose time is scaled by it.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >run.py <<'END_OF_RUN'
import math
import sys

import numpy as np
from pyrates import CircuitTemplate, NodeTemplate, OperatorTemplate

delay, expected = float(sys.argv[1]), eval(sys.argv[2])
variables = {"z": "output(1.0)", "r": "input(0.0)"}
decay = OperatorTemplate(name="decay", equations=["z' = r"], variables=variables, path=None)
node = NodeTemplate(name="node", operators=[decay])
edge = ("one/decay/z", "one/decay/r", None, {"weight": -1.0, "delay": delay})
circuit = CircuitTemplate(name="circuit", nodes={"one": node}, edges=[edge])
run = circuit.run(2.0, 0.01, solver="scipy", outputs={"z": "one/decay/z"}, verbose=False)
found = float(np.interp(0.9, run.index, run["z"]))
print(f"delay {delay}: z(0.9) = {found:.4f}")
if abs(found - expected) > 2e-3:
    sys.exit(f"expected {expected}")
END_OF_RUN
python3 -m venv .
bin/pip install -q pyrates==1.2.3 numpy==2.4.6 scipy==1.17.1 pandas==3.1.1 sympy==1.14.0
bin/python run.py 1.01 0.1
bin/python run.py 1.0 "math.exp(-0.9)"
