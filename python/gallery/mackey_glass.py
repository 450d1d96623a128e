# SPDX-License-Identifier: BSD-3-Clause
"""Blood cells: Mackey and Glass (1977), Science 197, 287; chaotic at tau = 17 and 23.

Published exponents spread over 0.0050 to 0.0086 at tau = 17; these are well resolved ones.
"""

import delaykit as dk
from delaykit.gallery import show

PUBLISHED = {
    "y(200)": (1.186718107117, 1e-8),
    **{"1 at 17": (0.0052, 5e-4), "3 at 17": (-0.039, 1e-3), "4 at 17": (-0.053, 1e-3)},
    **{"1 at 23": (0.0096, 5e-4), "3 at 23": (-0.012, 1e-3), "4 at 23": (-0.034, 1e-3)},
}
MODEL = dk.Model(
    {"y": "beta*y(t - tau)/(1 + y(t - tau)**n) - rate*y"},
    parameters={"beta": 0.2, "n": 10, "rate": 0.1, "tau": 17},
)


def numbers() -> dict[str, float]:
    """A value of the run, and exponents by number and tau; exponent 2 is 0, along the flow."""
    found = {"y(200)": MODEL.integrate(1.2, 200, t_eval=[200]).y[0, 0]}
    for tau in (17, 23):
        model = MODEL.with_parameters(tau=tau)
        values = model.exponents(1.2, count=4, t_end=3e5).value.values
        found |= {f"{k} at {tau}": values[k - 1] for k in (1, 3, 4)}
    return found


def plot():
    """y over time."""
    MODEL.run(1.2, 500).y.plot()


if __name__ == "__main__":
    show(numbers, PUBLISHED, plot)
